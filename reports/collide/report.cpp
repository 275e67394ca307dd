#include "reports/collide/report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>

#include "reports/common/causes.hpp"
#include "results/schema.hpp"

namespace crossgrain::reports {

namespace {

// --- collisions.csv

/// Quantities with columns of their own beyond the restitutions.
std::vector<const CollisionQuantity*> furtherQuantities() {
  std::vector<const CollisionQuantity*> further;
  for (const CollisionQuantity& quantity : collisionQuantities())
    if (quantity.csvPlace > 0 && quantity.csvPlace < firstPlaceAtEnd) further.push_back(&quantity);
  std::ranges::sort(further, {}, &CollisionQuantity::csvPlace);
  return further;
}

/// Those at the end of all columns that some law of the file has.
std::vector<const CollisionQuantity*> quantitiesAtEnd(const CollideResults& results) {
  std::vector<const CollisionQuantity*> there;
  for (const CollisionQuantity& quantity : collisionQuantities()) {
    const auto has = [&](const CollisionTable& table) { return bool(table.columns[quantity.id]); };
    if (quantity.csvPlace < firstPlaceAtEnd) continue;
    if (std::ranges::any_of(results.variants, [&](const CollisionVariant& variant) {
          return has(variant.reference) ||
                 std::ranges::any_of(variant.curves, [&](const CollisionCurve& curve) {
                   return has(curve.points);
                 });
        }))
      there.push_back(&quantity);
  }
  return there;
}

std::string columnsOf(const std::vector<const CollisionQuantity*>& quantities) {
  std::string columns;
  for (const CollisionQuantity* quantity : quantities) {
    std::string unit(quantity->unit);
    std::ranges::replace(unit, '/', '_');
    if (!unit.empty()) unit = "_" + unit;
    columns += fmt::format(",{0}{1},{0}_reference{1}", quantity->name, unit);
  }
  return columns;
}

std::string cellsOf(const std::vector<const CollisionQuantity*>& quantities,
                    const CollisionTable& points, const CollisionTable& reference, std::size_t k) {
  std::string cells;
  for (const CollisionQuantity* quantity : quantities)
    for (const CollisionTable* table : {&points, &reference})
      cells += "," + cell(table->at(quantity->id, k));
  return cells;
}

/// Of each curve its outcome, verdicts by the scene's law and by the one that its engine declares,
/// and its own scheme.
std::string collisionsCsv(const CollideResults& results) {
  const auto further = furtherQuantities(), atEnd = quantitiesAtEnd(results);
  const bool convex = std::ranges::any_of(
      results.variants, [](const CollisionVariant& variant) { return variant.convex.has_value(); });
  std::string table =
      "engine,case,variant,psi_i,v_n,e_n,psi_f,e_n_reference,psi_f_reference,dt_s,status" +
      columnsOf(further) + ",reason,outcome,verdict_scene,verdict_declared,own_scheme" +
      columnsOf(atEnd) + (convex ? ",orientation_deg,spin_before_rad_s,kind\n" : "\n");
  for (const CollisionVariant& variant : results.variants)
    for (const CollisionCurve& curve : variant.curves) {
      const CollisionPoints& points = curve.points;
      const auto verdictBy = [&](const CurveScore& score) {
        return std::string(points.size() > 0 ? nameOf(score.verdict, curveVerdictNames) : "");
      };
      const auto add = [&](const CollisionTable& found, const CollisionTable& reference,
                           std::size_t k, const std::string& status, const std::string& reason) {
        table += cells(curve.engine, caseOf(results, variant), variant.variant, at(found.psi, k),
                       at(found.vn, k), found.at(QuantityId::en, k), found.at(QuantityId::psiF, k),
                       reference.at(QuantityId::en, k), reference.at(QuantityId::psiF, k),
                       finite(curve.dt), status) +
                 cellsOf(further, found, reference, k) + "," +
                 cells(reason, outcomeName(curve), verdictBy(curve.score),
                       verdictBy(declaredScore(curve)), ownDeviation(curve)) +
                 cellsOf(atEnd, found, reference, k);
        if (convex)
          table += "," + cells(at(found.orientation, k), at(found.spin, k),
                               variant.convex && k < found.size() ? variant.convex->kinds.at(k)
                                                                  : std::string());
        table += "\n";
      };
      for (std::size_t k = 0; k < points.size(); ++k)
        add(points, variant.reference, k, points.status(k),
            k < points.reason.size() ? points.reason[k] : "");
      if (points.size() == 0) add({}, {}, 0, curve.statusName(), curve.reason);
    }
  return table;
}

// --- checks

/// By name.
std::vector<CollisionQuantity> sortedQuantities() {
  std::vector<CollisionQuantity> sorted(scoredQuantities().begin(), scoredQuantities().end());
  std::ranges::sort(sorted, {}, &CollisionQuantity::name);
  return sorted;
}

/// Quantities that any sweep of this variant was judged by.
std::vector<QuantityId> judgedQuantities(const CollisionVariant& variant) {
  std::vector<QuantityId> judged;
  for (const CollisionCurve& curve : variant.curves)
    for (const CollisionQuantity& quantity : sortedQuantities())
      if (const auto& score = curve.score.of[quantity.id];
          score && score->limit && std::ranges::find(judged, quantity.id) == judged.end())
        judged.push_back(quantity.id);
  return judged;
}

/// "0.0031 of the range against a limit of 0.001 (why)"
std::string errorOf(const QuantityScore& score) {
  const std::string why = score.why.value_or("");
  return fmt::format(
      "largest error {:.4g}{} against a limit of {:.4g}{}", finite(score.max).value_or(0.0),
      score.unitIs == ErrorUnitKind::absolute ? ""
                                              : fmt::format(" of the {}", nameOf(score.unitIs)),
      score.limit.value_or(0.0), why.empty() ? "" : " (" + why + ")");
}

/// One quantity against one law. @param why  it was not judged, if it was not
JUnitCase judged(const std::string& name, const std::optional<QuantityScore>& score,
                 const std::string& why) {
  JUnitCase one{"", name};
  if (score && score->held) {
    one.verdict = *score->held ? Verdict::pass : Verdict::fail;
    if (one.verdict == Verdict::fail) one.message = errorOf(*score);
  } else {
    one.verdict = Verdict::notMeasured;
    one.message = score && score->limit ? fmt::format("{}, not judged: {}", errorOf(*score), why)
                                        : "not measured, or not known of the reference";
  }
  return one;
}

/// Whether a failure by the scene's law is a model difference: the curve passes by the law that its
/// engine declares, or defines that law.
bool isOfTheModel(const DeclaredScore& declared, QuantityId quantity) {
  const auto& own = declared.score.of[quantity];
  return declared.reference == DeclaredReference::itself || (own && own->held == true);
}

/// Against the scene's law; where the engine declares another one, also against that.
std::vector<JUnitCase> judgedSweep(const CollisionCurve& curve, const std::string& sweep,
                                   QuantityId quantity) {
  const std::string name = fmt::format("{}: {}", sweep, collisionQuantity(quantity).name);
  JUnitCase scene = judged(name, curve.score.of[quantity], curve.reason);
  if (!curve.declared) return {scene};
  const DeclaredScore& declared = *curve.declared;
  if (scene.verdict == Verdict::fail && isOfTheModel(declared, quantity)) {
    scene.verdict = Verdict::modelDifference;
    scene.passes = false;
    scene.message = "model difference: " + scene.message;
  }
  if (declared.reference == DeclaredReference::itself) return {scene};
  return {scene, judged(name + ", declared law", declared.score.of[quantity], curve.reason)};
}

JUnitCase judgedScheme(const SchemeScore& own, const std::string& sweep) {
  JUnitCase one{"", sweep + ": own scheme"};
  const std::string figures = fmt::format("deviates by {:.2g} d and {:.2g} of the speed",
                                          own.position.value_or(0.0), own.velocity.value_or(0.0));
  if (!own.held) {
    one.verdict = Verdict::notMeasured;
    one.message = figures + ", " + own.reason;
  } else if (!*own.held) {
    one.verdict = Verdict::fail;
    one.message = fmt::format("{} against a limit of {:g}", figures, own.limit.value_or(0.0));
  }
  return one;
}

/// Sweeps that ran; where pairs did not part, that is a failure of its own.
std::vector<JUnitCase> sweepCases(const CollisionVariant& variant, const CollisionCurve& curve) {
  const auto dt = finite(curve.dt);
  const std::string sweep = curve.engine + (dt ? fmt::format(", dt {:.4g} s", *dt) : std::string());
  if (curve.status == Status::failed)
    return {{"", sweep, Verdict::notMeasured, curve.reason, 0.0, true}};
  if (curve.status == Status::refused)
    return {{"", curve.engine, Verdict::notMeasured, curve.reason}};
  std::vector<JUnitCase> cases;
  for (const QuantityId quantity : judgedQuantities(variant))
    std::ranges::move(judgedSweep(curve, sweep, quantity), std::back_inserter(cases));
  if (ownDeviation(curve)) cases.push_back(judgedScheme(*curve.ownScheme, sweep));
  if (!curve.allParted())
    cases.push_back({"", sweep + ": all pairs part",
                     curve.score.isRounded() ? Verdict::notMeasured : Verdict::fail, curve.reason});
  if (cases.empty())
    cases.push_back({"", sweep, Verdict::notMeasured, "not judged: the case has no limits"});
  cases.front().seconds = junitSeconds(curve.stats);
  return cases;
}

std::vector<JUnitCase> collideChecks(const CollideResults& results) {
  std::vector<JUnitCase> cases;
  for (const CollisionVariant& variant : results.variants)
    for (const CollisionCurve& curve : variant.curves)
      for (JUnitCase& one : sweepCases(variant, curve)) {
        one.group = junitGroup(variant.name, variant.variant);
        cases.push_back(std::move(one));
      }
  return cases;
}

// --- the page

/// "Law: normal linear, tangential spring dashpot, …" of what all variants share.
std::string lawOf(const CaseGroup& group) {
  Names shared;
  for (const auto& [option, value] : group.variants.front()->law) {
    const bool same = std::ranges::all_of(
        group.variants, [&, &option = option, &value = value](const CollisionVariant* variant) {
          const auto found = variant->law.find(option);
          return found != variant->law.end() && found->second == value;
        });
    if (!same) continue;
    if (auto words = lawWords(option, value)) shared.push_back(std::move(*words));
  }
  return fmt::format("Law of all variants: {}.", fmt::join(shared, ", "));
}

/// Empty, or what collisions in space have besides, variant by variant.
std::string spaceOf(const CaseGroup& group) {
  Names words;
  for (const CollisionVariant* variant : group.variants)
    if (variant->space) words.push_back(fmt::format("{}: {}", variant->variant, *variant->space));
  if (words.empty()) return {};
  return fmt::format(
      "Spheres in space. {}. Spins besides are about n, which points from the second body to the "
      "first at the first touch, and s, along which Ψ_i is; after a collision Ψ_f is along s "
      "turned with n, and Ψ_f·b along n × s.",
      fmt::join(words, "; "));
}

/// Empty, or what meets, of convex bodies.
std::string convexOf(const CaseGroup& group) {
  Names bodies;
  for (const CollisionVariant* variant : group.variants)
    if (variant->convex) addOnce(bodies, variant->convex->bodies);
  if (bodies.empty()) return {};
  return fmt::format(
      "Convex bodies: {}. One corner meets; e_n = −u_n′/u_n and Ψ = u_t/|u_n| are of that point. "
      "The "
      "oracle is Newton's restitution with Coulomb's friction, and a point is judged where "
      "Poisson's "
      "and Stronge's end in the same. Causes of differences are not measured: the in-house engine, "
      "whose mixtures of laws measure them, has no convex bodies.",
      fmt::join(bodies, "; "));
}

/// Empty, or in what the laws that engines declare are others than the scene's, over all
/// variants.
std::string declaredOf(const CollideResults& results, const CaseGroup& group) {
  Names laws;
  for (const EngineRow& engine : results.engines) {
    if (runsBesideItsPeer(results, engine.name)) continue;  // its peer's law
    Names words;
    for (const CollisionVariant* variant : group.variants)
      for (const CollisionCurve* curve : curvesOf(*variant, engine.name)) {
        if (!curve->declared) continue;
        for (const auto& [name, value] : curve->declared->law) {
          std::string word = lawWords(name, value).value_or(termWords(name));
          addOnce(words, word);
        }
      }
    if (!words.empty()) laws.push_back(fmt::format("{}: {}", engine.name, fmt::join(words, ", ")));
  }
  if (laws.empty()) return {};
  return fmt::format("Declared instead: {}.", fmt::join(laws, "; "));
}

bool isConvex(const CollisionVariant* variant, std::string_view axis) {
  return variant->convex && variant->convex->axis == axis;
}

/// Empty, or which points were not judged because the law has no limit of small time steps there.
std::string limitsOf(const CaseGroup& group) {
  Names places;
  for (const CollisionVariant* variant : group.variants) {
    SaidOf byReason;
    for (const NoLimitPoint& point : variant->noLimit)
      byReason.add(readableSetting(isConvex(variant, "orientation")   ? point.orientation
                                   : isConvex(variant, "spin_before") ? point.spin
                                                                      : finite(point.psi)),
                   point.reason);
    for (const auto& [reason, at] : byReason.all())
      places.push_back(fmt::format("{}, {} = {}: {}", variant->variant,
                                   isConvex(variant, "orientation")   ? "orientation in degrees"
                                   : isConvex(variant, "spin_before") ? "spin in rad/s"
                                                                      : "Ψ_i",
                                   fmt::join(at, ", "), reason));
    if (!variant->oracleReason.empty())
      places.push_back(variant->variant + ": " + variant->oracleReason);
  }
  if (places.empty()) return {};
  return fmt::format("Not judged: {}.", fmt::join(places, "; "));
}

Table collideMatrix(const std::vector<CaseGroup>& groups, const std::vector<EngineRow>& engines) {
  Table table{engineColumns({"case"}, engines)};
  for (std::size_t g = 0; g < groups.size(); ++g) {
    TableRow row{{{groups[g].name, {counted(groups[g].variants.size(), "variant")}}}};
    row.cells.front().link = fmt::format("#case_{}", g + 1);
    for (const EngineRow& engine : engines) {
      const Tally tally = tallyOf(groups[g].variants, engine.name);
      Names notes = shortfalls(tally);
      if (tally.refused > 0)
        notes.push_back(tally.judged() > 0 ? fmt::format("{} refused", tally.refused)
                                           : tally.refusal);
      notes.push_back(tally.reason);
      row.cells.push_back({headline(tally), std::move(notes), stateOf(tally), true});
    }
    table.rows.push_back(std::move(row));
  }
  table.note =
      "Sweeps, one per variant and time step, of those judged. Passed: the largest errors are "
      "within the case's margins. ≠ model difference: beyond them by the scene's law, but within "
      "them by the law that the engine declares, the scene's with conventions of its own that the "
      "case lets it have. ✗ failed: by the law that it declares, or by its own scheme. Below: the "
      "quantity furthest beyond its limit, and how far. Refused: the engine does not have the law; "
      "nothing is judged. Dashed: mirrors, the in-house engine with a peer's conventions.";
  return table;
}

bool allPass(const CollideResults& results, const CaseGroup& group) {
  return std::ranges::all_of(results.engines, [&](const EngineRow& engine) {
    const Tally tally = tallyOf(group.variants, engine.name);
    return tally.held > 0 && tally.held == tally.judged() && tally.failed == 0;
  });
}

Blocks collisionCaseBlocks(const Report& report, const CollideResults& results,
                           const CaseGroup& group, std::size_t number) {
  using enum Paragraph::Style;
  const std::string figure = fmt::format("collision_{}", number);
  const auto drawing = [&](const std::string& name) {
    Drawings drawings{{}, false};
    for (const Figure& one : report.figures)
      if (one.name == name) drawings.names.push_back(name);
    return drawings;
  };
  const std::string convex = convexOf(group);
  Blocks blocks;
  for (std::string words :
       nonEmpty({convex, spaceOf(group), declaredOf(results, group), limitsOf(group)}))
    blocks.push_back(Paragraph{std::move(words), small});
  blocks.push_back(variantTable(results, group));
  if (!convex.empty()) blocks.push_back(Details{"Impacts, point by point", {kindTable(group)}});
  Table causes = causesTable(group, false);
  Names notes = causesNotes(group, false);
  if (!causes.rows.empty() || !notes.empty())
    blocks.push_back(Heading{"Causes of differences", fmt::format("causes_{}", number)});
  if (!causes.rows.empty()) {
    blocks.push_back(drawing(figure + "_causes"));
    blocks.push_back(std::move(causes));
    Details every{"Causes of every quantity", {causesTable(group, true)}};
    for (std::string& note : causesNotes(group, true))
      every.blocks.push_back(Paragraph{std::move(note), small});
    blocks.push_back(std::move(every));
  }
  for (std::string& note : notes) blocks.push_back(Paragraph{std::move(note), small});
  if (Table mirrors = mirrorTable(group, results.engines); !mirrors.rows.empty())
    blocks.push_back(Details{"Model or implementation?", {std::move(mirrors)}});
  if (Drawings energy = drawing(figure + "_energy"); !energy.names.empty())
    blocks.push_back(Details{"Where the energy went", {std::move(energy)}});
  blocks.push_back(Details{"Scores: engine × time step × quantity", {scoreTable(group)}});
  return {Paragraph{lawOf(group), small}, drawing(figure),
          Details{"Variants, limits, causes and scores", std::move(blocks)}};
}

std::string aboutCollisions(const CollideResults& results) {
  const auto convex = std::ranges::count_if(
      results.variants, [](const CollisionVariant& variant) { return variant.convex.has_value(); });
  return fmt::format(
      "{} meet{}. Ψ = v_t/v_n of "
      "the contact point, both by the approach speed before the collision; all numbers of an "
      "outcome are of the instant of separation, with that instant's normal. The oracle is {}. "
      "Errors are in units of the "
      "range of the oracle's curve; where that is below a tenth of the curve's largest "
      "magnitude (e_n, contact time and overlap of linear laws), in units of that magnitude; "
      "energies in units of the energy before.",
      convex == 0                             ? "Two disks, or a disk and a wall,"
      : convex < std::ssize(results.variants) ? "Two disks, two convex bodies, or one and a wall,"
                                              : "Two convex bodies, or one and a wall,",
      convex < std::ssize(results.variants) ? ": head on with spin, or obliquely" : " at a corner",
      convex < std::ssize(results.variants)
          ? "a high-precision solution of the same planar two-body problem"
          : "the impact of rigid bodies at one point");
}

/// "failed: a; model difference: b and c": engines that do not pass a case.
std::string statesOf(const CollideResults& results, const CaseGroup& group) {
  constexpr std::pair<Verdict, std::string_view> words[] = {
      {Verdict::fail, "failed"},
      {Verdict::modelDifference, "model difference"},
      {Verdict::notApplicable, "refused"}};
  Names parts;
  for (const auto& [verdict, word] : words) {
    Names who;
    for (const EngineRow& engine : results.engines)
      if (engine.mirrors.empty() && stateOf(tallyOf(group.variants, engine.name)) == verdict)
        who.push_back(engine.name);
    if (!who.empty()) parts.push_back(fmt::format("{}: {}", word, listedShortly(who, 3)));
  }
  return fmt::format("{}", fmt::join(parts, "; "));
}

/// In sight the first case in which an engine differs, then the summary; a section for each
/// other one that is not passed, and one for all that every engine passes. @returns the first's id
std::string addCollisionCases(Report& report, const CollideResults& results,
                              const std::vector<CaseGroup>& groups) {
  const auto notPassed = [&](const CaseGroup& group) { return !allPass(results, group); };
  const auto differs = [&](const CaseGroup& group) {
    return std::ranges::any_of(results.engines, [&](const EngineRow& engine) {
      const Verdict state = stateOf(tallyOf(group.variants, engine.name));
      return state == Verdict::fail || state == Verdict::modelDifference;
    });
  };
  auto first = std::ranges::find_if(groups, differs);
  if (first == groups.end()) first = std::ranges::find_if(groups, notPassed);
  const std::size_t shown =
      first == groups.end() ? 0 : static_cast<std::size_t>(first - groups.begin());
  const auto add = [&](std::size_t g) {
    const std::string states = statesOf(results, groups[g]);
    report
        .section(fmt::format("case_{}", g + 1),
                 groups[g].name + (states.empty() ? "" : ": " + states), groups[g].name)
        .blocks = collisionCaseBlocks(report, results, groups[g], g + 1);
  };
  if (!groups.empty()) add(shown);
  report.section("matrix", "Cases by engine", "Summary").blocks = {
      collideMatrix(groups, results.engines),
      Details{"What was compared", {Paragraph{aboutCollisions(results)}}}};
  Blocks passed;
  std::size_t count = 0;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    if (g == shown) continue;
    if (notPassed(groups[g])) {
      add(g);
      continue;
    }
    passed.push_back(Heading{groups[g].name, fmt::format("case_{}", g + 1)});
    std::ranges::move(collisionCaseBlocks(report, results, groups[g], g + 1),
                      std::back_inserter(passed));
    ++count;
  }
  if (count > 0)
    report.section("passed", "✓ passed by every engine: " + counted(count, "other case"), "Passed")
        .blocks = std::move(passed);
  return fmt::format("case_{}", shown + 1);
}

}  // namespace

Report reportOf(const CollideResults& results) {
  const std::vector<CaseGroup> groups = casesOf(results);
  Report report{{results.head, results.engines, collideOverview(results)}, results.elapsed};
  report.figures = collideFigures(results);
  const std::string inSight = addCollisionCases(report, results, groups);
  addEngines(report);
  std::vector<EffectiveScene> effective;
  for (const CollisionVariant& variant : results.variants)
    for (const CollisionCurve& curve : variant.curves)
      if (curve.effective)
        effective.push_back(
            {curve.engine, &*curve.effective, variant.effects ? &*variant.effects : nullptr});
  addDetails(report, effective);
  std::vector<const Causes*> causes;
  for (const CollisionVariant& variant : results.variants)
    for (const CollisionCurve& curve : variant.curves)
      if (curve.causes) causes.push_back(&*curve.causes);
  if (Table terms = causeTerms(causes); !terms.rows.empty())
    report.section("terms", "Options that differ", "Terms").blocks = {std::move(terms)};
  report.foldAllBut({"matrix", inSight});
  report.tables = {{"collisions.csv", collisionsCsv(results)}};
  if (!causes.empty()) report.tables.emplace_back("causes.csv", causesCsv(results));
  report.checks = collideChecks(results);
  return report;
}

}  // namespace crossgrain::reports

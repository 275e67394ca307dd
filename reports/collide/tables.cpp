#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "reports/collide/report.hpp"
#include "reports/common/causes.hpp"
#include "results/schema.hpp"

namespace crossgrain::reports {

namespace {

/// The clause that names what is missing, of "X cannot run FILE: CLAUSE; HINT".
std::string clauseOf(const std::string& refusal) {
  const auto colon = refusal.find(": ");
  const std::string rest = colon == std::string::npos ? refusal : refusal.substr(colon + 2);
  return rest.substr(0, rest.find("; "));
}

void addTo(Tally& tally, const CollisionCurve& curve) {
  tally.add(curve);
  const bool refused = curve.status == Status::refused;
  std::string& reason = refused ? tally.refusal : tally.reason;
  if (reason.empty()) reason = refused ? clauseOf(curve.reason) : curve.reason;
  const Verdict verdict = verdictOf(curve);
  if (verdict == Verdict::fail) tally.worst.take(declaredScore(curve));
  if (verdict == Verdict::modelDifference) tally.worstOfModel.take(curve.score);
  if (const auto own = ownDeviation(curve)) {
    tally.ownDeviation = std::max(tally.ownDeviation.value_or(0.0), *own);
    tally.ownPassed = tally.ownPassed && curve.ownScheme->held.value_or(true);
  }
}

std::string orderOf(const CollideResults& results, const CollisionVariant& variant,
                    const std::string& engine, QuantityId quantity) {
  for (const ConvergenceOrder& order : results.orders) {
    const bool own =
        order.variant == variant.variant && order.name == variant.name && order.engine == engine;
    if (!own) continue;
    const auto& fit = order.of[quantity];
    if (!fit) break;
    // Errors of orders below a hundredth are below the scheme's next term.
    return readable(fit->order, fit->standardError
                                    ? std::optional(std::max(*fit->standardError, 0.01))
                                    : std::nullopt);
  }
  return absentText;
}

Cell variantCell(const CollideResults& results, const CollisionVariant& variant,
                 const std::string& engine) {
  const Tally tally = tallyOf({&variant}, engine);
  Names notes;
  const CollisionCurve* curve = coarsestCurve(variant, engine);
  for (const QuantityId quantity : {QuantityId::psiF, QuantityId::en}) {
    if (!curve || !curve->score.of[quantity]) continue;
    const std::string order = orderOf(results, variant, engine, quantity);
    notes.push_back(fmt::format("{} {}{}", collisionQuantity(quantity).label,
                                shortly(curve->score.of[quantity]->max),
                                order == absentText ? "" : ", order " + order));
  }
  if (tally.ownDeviation) notes.push_back("own scheme " + shortly(tally.ownDeviation));
  notes.push_back(tally.refusal);
  notes.push_back(tally.reason);
  return {headline(tally), std::move(notes), stateOf(tally), true};
}

/// The law's members that variants of the case differ in, or that only some have.
Names changing(const CaseGroup& group) {
  Names names;
  for (const CollisionVariant* variant : group.variants)
    for (const auto& [name, value] : variant->law) {
      const auto differs = [&, &name = name, &value = value](const CollisionVariant* other) {
        const auto found = other->law.find(name);
        return found == other->law.end() || found->second != value;
      };
      if (std::ranges::find(names, name) == names.end() &&
          std::ranges::any_of(group.variants, differs))
        names.push_back(name);
    }
  return names;
}

std::string ownLaw(const CollisionVariant& variant, const Names& names) {
  Names words;
  for (const std::string& name : names)
    if (const auto found = variant.law.find(name); found != variant.law.end())
      words.push_back(lawWords(name, found->second).value_or(termWords(name) + " " + absentText));
  return fmt::format("{}", fmt::join(words, ", "));
}

/// Largest distance of two curves at the same places.
std::optional<double> distance(const CollisionCurve* a, const CollisionCurve* b,
                               QuantityId quantity) {
  if (!a || !b) return std::nullopt;
  std::optional<double> largest;
  for (std::size_t k = 0; k < std::min(a->points.size(), b->points.size()); ++k) {
    const auto x = a->points.at(quantity, k), y = b->points.at(quantity, k);
    if (x && y) largest = std::max(largest.value_or(0.0), std::abs(*x - *y));
  }
  return largest;
}

std::string dtOf(const CollisionCurve* curve) {
  return readableSetting(curve ? finite(curve->dt) : std::nullopt);
}

/// The quantities that any curve of the case has a score in.
std::vector<const CollisionQuantity*> scoredIn(const CaseGroup& group) {
  std::vector<const CollisionQuantity*> scored;
  for (const CollisionQuantity& quantity : scoredQuantities())
    if (std::ranges::any_of(group.variants, [&](const CollisionVariant* variant) {
          return std::ranges::any_of(variant->curves, [&](const CollisionCurve& curve) {
            return curve.score.of[quantity.id].has_value();
          });
        }))
      scored.push_back(&quantity);
  return scored;
}

/// Marked where it is judged.
Cell judgedCell(double value, Names notes, std::optional<bool> held) {
  Cell cell(shortly(value), std::move(notes));
  if (held) cell.verdict = *held ? Verdict::pass : Verdict::fail;
  cell.marked = held.has_value();
  return cell;
}

/// The rms error below.
Cell scoreCell(const std::optional<QuantityScore>& score) {
  return score ? judgedCell(score->max, {shortly(score->rms)}, score->held) : Cell(absentText);
}

/// The larger deviation from the own scheme.
Cell schemeCell(const std::optional<SchemeScore>& own) {
  if (!own) return "";
  if (!own->position) return absentText;
  return judgedCell(std::max(*own->position, own->velocity.value_or(0.0)), {}, own->held);
}

std::string sweepWord(const CollisionCurve& curve) {
  const char* const words[] = {"refused", "not judged", "passed", "model difference",
                               "",        "",           "failed"};
  return curve.status == Status::failed ? "broke down"
                                        : words[static_cast<std::size_t>(verdictOf(curve))];
}

/// Whether a sweep passed at a time step between the largest and the smallest of its engine: it
/// adds nothing to those.
bool passedBetween(const CollisionVariant& variant, const CollisionCurve& curve) {
  const auto dt = finite(curve.dt);
  if (!dt || verdictOf(curve) != Verdict::pass) return false;
  bool larger = false, smaller = false;
  for (const CollisionCurve* other : curvesOf(variant, curve.engine)) {
    larger = larger || finite(other->dt).value_or(*dt) > *dt;
    smaller = smaller || finite(other->dt).value_or(*dt) < *dt;
  }
  return larger && smaller;
}

/// By which of both laws a curve is scored, and what that one is known by.
struct ScoredBy {
  const CurveScore& score;
  const char* words;
};
std::vector<ScoredBy> lawsOf(const CollisionCurve& curve) {
  if (!curve.declared) return {{curve.score, "both"}};
  const bool mirror = curve.declared->reference == DeclaredReference::mirror;
  return {{curve.score, "scene's"}, {curve.declared->score, mirror ? "declared*" : "declared"}};
}

}  // namespace

std::string deviationWords(const CollisionCurve& curve) {
  Names words;
  if (curve.effective)
    for (const Deviation& deviation : curve.effective->deviations)
      addOnce(words, spaced(deviation.name));
  return fmt::format("{}", fmt::join(words, ", "));
}

std::string caseOf(const CollideResults& results, const CollisionVariant& variant) {
  return variant.name.empty() ? results.head.setup.name : variant.name;
}

std::vector<CaseGroup> casesOf(const CollideResults& results) {
  std::vector<CaseGroup> groups;
  for (const CollisionVariant& variant : results.variants) {
    const std::string name = caseOf(results, variant);
    auto group = std::ranges::find(groups, name, &CaseGroup::name);
    if (group == groups.end()) group = groups.insert(groups.end(), {name, {}});
    group->variants.push_back(&variant);
  }
  return groups;
}

const std::vector<double>& axisOf(const CollisionVariant& variant, const CollisionTable& table) {
  if (!variant.convex || variant.convex->axis == "psi_i") return table.psi;
  return variant.convex->axis == "orientation" ? table.orientation : table.spin;
}

const char* axisWords(const CollisionVariant& variant) {
  if (!variant.convex || variant.convex->axis == "psi_i") return "slide before Ψ_{i}";
  return variant.convex->axis == "orientation" ? "orientation [°]" : "spin before [rad/s]";
}

std::vector<const CollisionCurve*> curvesOf(const CollisionVariant& variant,
                                            const std::string& engine) {
  std::vector<const CollisionCurve*> curves;
  for (const CollisionCurve& curve : variant.curves)
    if (curve.engine == engine) curves.push_back(&curve);
  std::ranges::stable_sort(curves, std::ranges::greater{}, [](const CollisionCurve* curve) {
    return finite(curve->dt).value_or(0.0);
  });
  return curves;
}

const CollisionCurve* coarsestCurve(const CollisionVariant& variant, const std::string& engine) {
  for (const CollisionCurve* curve : curvesOf(variant, engine))
    if (curve->points.size() > 0) return curve;
  return nullptr;
}

std::optional<std::string> lawWords(const std::string& option, const LawValue& value) {
  if (const auto* word = std::get_if<std::string>(&value))
    return termWords(option) + " " + spaced(*word);
  const auto constant = finite(std::get<double>(value));
  if (!constant) return std::nullopt;
  return termWords(option) + " " + readableSetting(constant);
}

std::string quantityWords(const CollisionQuantity& quantity) {
  using enum QuantityId;
  constexpr std::pair<QuantityId, std::string_view> all[] = {
      {psiF, "tangential rebound Ψ_f"},
      {en, "restitution e_n"},
      {beta, "tangential restitution β"},
      {et, "tangential restitution of the centres e_t"},
      {centrePsiF, "tangential velocity of the centres"},
      {reboundAngle, "rebound angle"},
      {spinI, "spin ω_i"},
      {spinJ, "spin ω_j"},
      {maxOverlap, "largest overlap"},
      {lostNormalDamping, "energy lost to the normal dashpot"},
      {lostTangential, "energy lost tangentially"},
      {lostTangentialDamping, "energy lost to the tangential dashpot"},
      {lostStiffening, "energy lost to stiffening"},
      {lostSliding, "energy lost to sliding"},
      {lostStored, "energy left in the tangential spring"},
      {psiFOut, "tangential rebound out of the plane of impact Ψ_f·b"},
      {spinINormal, "spin of the first about the line of centres"},
      {spinITangent, "spin of the first about the tangent"},
      {spinJNormal, "spin of the second about the line of centres"},
      {spinJTangent, "spin of the second about the tangent"},
      {centreNormal, "normal velocity of the centres"}};
  const auto* const found =
      std::ranges::find(all, quantity.id, &std::pair<QuantityId, std::string_view>::first);
  return std::string(found == std::end(all) ? quantity.label : found->second);
}

Tally tallyOf(const std::vector<const CollisionVariant*>& variants, const std::string& engine) {
  Tally tally;
  for (const CollisionVariant* variant : variants)
    for (const CollisionCurve* curve : curvesOf(*variant, engine)) addTo(tally, *curve);
  return tally;
}

Names shortfalls(const Tally& tally) {
  Names lines;
  if (tally.worst.times > 1.0) lines.push_back(tally.worst.words());
  if (tally.worstOfModel.times > 1.0) lines.push_back("model: " + tally.worstOfModel.words());
  if (!tally.ownPassed) lines.push_back(fmt::format("own scheme {}", shortly(tally.ownDeviation)));
  return lines;
}

Verdict stateOf(const Tally& tally) {
  if (tally.failed > 0 || tally.beyondLimits > 0) return Verdict::fail;
  if (tally.judged() == 0) return tally.refused > 0 ? Verdict::notApplicable : Verdict::notMeasured;
  return tally.modelDifference > 0 ? Verdict::modelDifference : Verdict::pass;
}

std::string headline(const Tally& tally) {
  if (tally.judged() == 0)
    return tally.failed > 0 ? "failed" : tally.refused > 0 ? "refused" : "not judged";
  std::string words = fmt::format("{} of {} passed", tally.held, tally.judged());
  if (tally.modelDifference > 0) words += fmt::format(", {} ≠", tally.modelDifference);
  if (tally.beyondLimits > 0) words += fmt::format(", {} ✗", tally.beyondLimits);
  if (tally.notJudged > 0) words += fmt::format(", {} not judged", tally.notJudged);
  return words;
}

Table variantTable(const CollideResults& results, const CaseGroup& group) {
  const Names names = changing(group);
  Table table{engineColumns({"variant"}, results.engines)};
  for (const CollisionVariant* variant : group.variants) {
    TableRow row{{{variant->variant, {ownLaw(*variant, names)}}}};
    for (const EngineRow& engine : results.engines)
      row.cells.push_back(variantCell(results, *variant, engine.name));
    table.rows.push_back(std::move(row));
  }
  table.note =
      "Sweeps that passed, of those judged; the largest errors against the scene's law at the "
      "largest time step; and the order of convergence of the rms error, fitted over the time "
      "steps. Own scheme: one head-on impact, step by step, compared with the discrete solution of "
      "the engine's integrator in extended precision; the largest deviation of a position by the "
      "diameter or of a velocity by the speed of approach. In double precision more than 10^−12 is "
      "a fault, whatever the time step.";
  return table;
}

Table mirrorTable(const CaseGroup& group, const std::vector<EngineRow>& engines) {
  using enum QuantityId;
  Table table{{"peer", "variant"}};
  for (const char* name : {"model: |ΔΨ_f|", "model: |Δe_n|", "implementation: |ΔΨ_f|",
                           "implementation: |Δe_n|", "dt [s]: first | mirror | peer"})
    table.columns.push_back(numbers(name));
  table.columns.push_back(remarks("deviations of the peer from the scene"));
  table.note =
      "Largest differences over the curve at the largest time step of each. Model: the first "
      "engine against the mirror, the in-house engine with the peer's conventions. Implementation: "
      "the mirror against the peer itself; of a mirror that only approaches its peer (see Engines) "
      "part of the model remains in it.";
  for (const EngineRow& mirror : engines) {
    if (mirror.mirrors.empty()) continue;
    const std::string& first = engines.front().name;
    for (const CollisionVariant* variant : group.variants) {
      const CollisionCurve *ours =
                               first == mirror.mirrors ? nullptr : coarsestCurve(*variant, first),
                           *mirrored = coarsestCurve(*variant, mirror.name),
                           *peer = coarsestCurve(*variant, mirror.mirrors);
      if (!mirrored || !peer) continue;
      const bool oneStep = (!ours || dtOf(ours) == dtOf(mirrored)) && dtOf(mirrored) == dtOf(peer);
      table.rows.push_back(
          {{mirror.mirrors, variant->variant, shortly(distance(ours, mirrored, psiF)),
            shortly(distance(ours, mirrored, en)), shortly(distance(mirrored, peer, psiF)),
            shortly(distance(mirrored, peer, en)),
            oneStep ? dtOf(peer)
                    : fmt::format("{} | {} | {}", dtOf(ours), dtOf(mirrored), dtOf(peer)),
            deviationWords(*peer)}});
    }
  }
  return table;
}

Table scoreTable(const CaseGroup& group) {
  const auto scored = scoredIn(group);
  Table table{{"variant", "engine", numbers("dt [s]"), "outcome", numbers("own scheme"), "law"}};
  table.dense = true;
  for (const CollisionQuantity* quantity : scored)
    table.columns.push_back(numbers(std::string(quantity->label)));
  table.note =
      "Time steps between the largest and the smallest are left out where the sweep passed: "
      "results.json has every score. Law: the scene's, the one that the engine declares, or both "
      "where they are one. *: known by the in-house engine with that law at the same step, as it "
      "has no limit of small steps, or the sweep is short of the oracle by conventions of time "
      "stepping. Largest error, and rms error below it. Overlap and the parts of the energy are "
      "known where contacts were recorded step by step: at the largest time step. Sticking: lost "
      "by the tangential dashpot while the contact does not slip. Stored: left in the tangential "
      "spring.";
  for (const CollisionVariant* variant : group.variants)
    for (const CollisionCurve& curve : variant->curves) {
      if (passedBetween(*variant, curve)) continue;
      const bool ran = curve.points.size() > 0;
      for (const ScoredBy& law : lawsOf(curve)) {
        TableRow row;
        if (&law.score == &curve.score) {
          row.cells = {variant->variant,
                       curve.engine,
                       dtOf(&curve),
                       {sweepWord(curve), {curve.reason}, verdictOf(curve), true},
                       schemeCell(curve.ownScheme)};
        } else {
          row.cells.resize(5);
        }
        row.cells.emplace_back(ran ? law.words : "");
        if (ran)
          for (const CollisionQuantity* quantity : scored)
            row.cells.push_back(scoreCell(law.score.of[quantity->id]));
        table.rows.push_back(std::move(row));
      }
    }
  return table;
}

Table kindTable(const CaseGroup& group) {
  Table table{{"variant", numbers("orientation [°]"), numbers("Ψ_i"),
               numbers("spin before [rad/s]"), "impact"}};
  constexpr QuantityId shown[] = {QuantityId::en, QuantityId::psiF, QuantityId::centreNormal,
                                  QuantityId::centrePsiF, QuantityId::spinI};
  for (const QuantityId id : shown)
    table.columns.push_back(numbers(quantityWords(collisionQuantity(id))));
  table.dense = true;
  table.note =
      "Stick: the contact slips neither at the end nor, if not at the start, on the way. Slip: it "
      "slips to the end. Slip-stick: a slip stops for good. Slip-reversal: it stops and begins "
      "anew, the other way. Numbers are the reference's; –: Newton's, Poisson's and Stronge's "
      "restitution differ, and only a gain of energy is judged.";
  for (const CollisionVariant* variant : group.variants) {
    if (!variant->convex) continue;
    const CollisionTable& points = variant->reference;
    for (std::size_t k = 0; k < std::min(points.size(), variant->convex->kinds.size()); ++k) {
      TableRow row{{variant->variant, readableSetting(at(points.orientation, k)),
                    readableSetting(at(points.psi, k)), readableSetting(at(points.spin, k)),
                    variant->convex->kinds[k]}};
      for (const QuantityId id : shown) row.cells.emplace_back(shortly(points.at(id, k)));
      table.rows.push_back(std::move(row));
    }
  }
  return table;
}

}  // namespace crossgrain::reports

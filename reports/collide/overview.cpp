#include "reports/collide/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <ranges>

namespace crossgrain::reports {

namespace {

/// Quantities that are closely related, as one question.
struct QuantityGroup {
  const char *name, *asks;
  std::vector<QuantityId> quantities;
};

const std::vector<QuantityGroup>& quantityGroups() {
  using enum QuantityId;
  static const std::vector<QuantityGroup> groups = {
      {"restitution", "Normal restitution e_n.", {en}},
      {"tangential rebound Ψ_f",
       "Tangential velocity of the contact point after the collision, and what follows from it.",
       {psiF, beta, et, centrePsiF}},
      {"angle", "Angle of the rebound.", {reboundAngle}},
      {"spin", "Spins after the collision.", {spinI, spinJ}},
      {"contact time", "How long the disks touch.", {duration}},
      {"overlap", "Largest overlap.", {maxOverlap}},
      {"energy",
       "Energy lost, and where to.",
       {energyLost, lostNormalDamping, lostTangential, lostTangentialDamping, lostStiffening,
        lostSliding, lostStored}},
      {"normal velocity of the centres", "Of convex bodies, after the collision.", {centreNormal}},
      {"gain of energy",
       "Of convex bodies, at any point: no collision adds energy.",
       {energyGained}}};
  return groups;
}

/// The largest share of a limit, and where.
struct Extreme {
  double share = -1.0;
  std::string words, anchor;

  void look(double candidate, const std::string& what, const std::string& where) {
    if (candidate <= share) return;
    share = candidate;
    words = what;
    anchor = where;
  }
};

/// In a word, for a cell is small: the case, or of the only one the variant.
std::string placeOf(const std::vector<CaseGroup>& groups, const CaseGroup& group,
                    const CollisionVariant& variant) {
  return groups.size() > 1 || variant.variant.empty() ? group.name : variant.variant;
}

/// Errors of some quantities over all sweeps of an engine: beyond the law that it declares, beyond
/// the scene's alone, and all.
struct Errors {
  Extreme own, scene, any;
};

bool isTheLaw(const CollisionCurve& curve) {
  return curve.declared && curve.declared->reference == DeclaredReference::itself;
}

void look(Errors& errors, const CollisionCurve& curve, const CollisionQuantity& quantity,
          const std::string& words, const std::string& anchor) {
  const auto shareOf = [](const std::optional<QuantityScore>& score) -> std::optional<double> {
    if (!score || !score->limit || !score->held || *score->limit <= 0.0) return std::nullopt;
    return score->max / *score->limit;
  };
  const auto scene = shareOf(curve.score.of[quantity.id]),
             own = isTheLaw(curve) ? std::nullopt : shareOf(declaredScore(curve).of[quantity.id]);
  if (own && *own > 1.0) errors.own.look(*own, words, anchor);
  if (scene && *scene > 1.0) errors.scene.look(*scene, words, anchor);
  if (scene) errors.any.look(*scene, words, anchor);
}

/// @param besidePeer  of a mirror that runs beside its peer: it shows the effect of the peer's
/// conventions
OverviewCell errorCell(const Errors& errors, bool besidePeer) {
  const Verdict state = errors.own.share > 1.0 && !besidePeer ? Verdict::fail
                        : std::max(errors.own.share, errors.scene.share) > 1.0
                            ? Verdict::modelDifference
                        : errors.any.share >= 0.0 ? Verdict::pass
                                                  : Verdict::notMeasured;
  if (state == Verdict::notMeasured) return {state, {}, "of its limit", {}, {}, {}};
  const Extreme& shown = state == Verdict::fail ? errors.own
                         : state == Verdict::modelDifference
                             ? (errors.scene.share > 1.0 ? errors.scene : errors.own)
                             : errors.any;
  return {state,       shown.share, "of its limit", shortly(shown.share) + " × limit",
          shown.words, shown.anchor};
}

/// "by spring update: " where most of a curve's error is a difference from the in-house engine at
/// the same step: else the step makes it. Causes are known of the largest step.
std::string causeBefore(const CollisionVariant& variant, const CollisionCurve& curve,
                        QuantityId quantity) {
  const CollisionCurve* const coarsest = coarsestCurve(variant, curve.engine);
  const auto& score = curve.score.of[quantity];
  const auto worst =
      coarsest ? worstDifference(&variant, *coarsest, quantity) : std::optional<WorstDifference>();
  if (!worst || !score || !score->limit || worst->limits * *score->limit < 0.5 * score->max)
    return {};
  return fmt::format("by {}: ", largestCause(*worst));
}

/// Visits the curves of an engine that have an outcome.
void forCurves(const std::vector<CaseGroup>& groups, const std::string& engine, const auto& visit) {
  for (std::size_t g = 0; g < groups.size(); ++g)
    for (const CollisionVariant* variant : groups[g].variants)
      for (const CollisionCurve* curve : curvesOf(*variant, engine))
        visit(*variant, *curve, placeOf(groups, groups[g], *variant),
              fmt::format("case_{}", g + 1));
}

OverviewCell schemeCell(const std::vector<CaseGroup>& groups, const std::string& engine) {
  OverviewCell cell{Verdict::notMeasured, {}, "d or v_n", {}, {}, {}};
  forCurves(groups, engine,
            [&](const CollisionVariant&, const CollisionCurve& curve, const std::string& place,
                const std::string& anchor) {
              const auto deviation = ownDeviation(curve);
              if (!deviation || (cell.value && *deviation <= *cell.value)) return;
              cell.value = deviation;
              cell.shown = shortly(deviation);
              cell.words = place;
              cell.anchor = anchor;
              cell.verdict.reset();
              if (const auto held = curve.ownScheme->held)
                cell.verdict = *held ? Verdict::pass : Verdict::fail;
            });
  return cell;
}

/// ", on 20 of 33 points"; empty where all are judged.
std::string pointsWords(const SweepCount& count) {
  if (count.judgedPoints == count.points) return {};
  if (count.judgedPoints == 0) return ", by the gain of energy alone";
  return fmt::format(", on {} of {} points", count.judgedPoints, count.points);
}

/// How many sweeps pass: refused ones need a law that the engine lacks.
OverviewCell sweepsCell(const std::vector<CaseGroup>& groups, const EngineRow& engine,
                        bool besidePeer) {
  std::vector<const CollisionVariant*> variants;
  for (const CaseGroup& group : groups)
    variants.insert(variants.end(), group.variants.begin(), group.variants.end());
  const Tally all = tallyOf(variants, engine.name);
  OverviewCell cell{Verdict::notMeasured, {}, "sweeps", {}, {}, "matrix"};
  if (all.refused > 0) cell.words = fmt::format("{} refused", all.refused);
  if (all.failed > 0)
    cell.words += fmt::format("{}{} failed", cell.words.empty() ? "" : ", ", all.failed);
  if (all.judged() == 0) {
    if (all.failed > 0)
      cell.verdict = Verdict::fail;
    else if (all.refused > 0)
      cell.verdict = Verdict::notApplicable;
    return cell;
  }
  cell.value = all.held;
  cell.shown = fmt::format("{} of {}", all.held, all.judged());
  cell.shown += pointsWords(all);
  const int faults = (besidePeer ? 0 : all.beyondLimits) + all.failed;
  cell.verdict = faults > 0                                   ? Verdict::fail
                 : all.modelDifference + all.beyondLimits > 0 ? Verdict::modelDifference
                                                              : Verdict::pass;
  return cell;
}

bool anyShown(const Overview& overview, std::size_t column) {
  return std::ranges::any_of(overview.rows, [&](const OverviewRow& row) {
    return row.cells[column].verdict != Verdict::notMeasured;
  });
}

/// Drops questions that no engine has an answer to.
void dropEmptyColumns(Overview& overview) {
  for (std::size_t k = overview.columns.size(); k-- > 0;) {
    if (anyShown(overview, k)) continue;
    const auto place = static_cast<std::ptrdiff_t>(k);
    overview.columns.erase(overview.columns.begin() + place);
    for (OverviewRow& row : overview.rows) row.cells.erase(row.cells.begin() + place);
  }
}

/// In a sentence: the matrix has all names.
constexpr std::size_t mostEngines = 5, mostDifferences = 2;

/// Sweeps of an engine.
struct EngineCount : SweepCount {
  std::string engine;
};

/// Engines that are judged: not the mirrors beside their peers.
Names judgedEngines(const CollideResults& results) {
  Names names;
  for (const EngineRow& engine : results.engines)
    if (!runsBesideItsPeer(results, engine.name)) names.push_back(engine.name);
  return names;
}

std::vector<EngineCount> countsOf(const CollideResults& results) {
  std::vector<EngineCount> counts;
  for (const std::string& engine : judgedEngines(results)) {
    EngineCount& count = counts.emplace_back();
    count.engine = engine;
    for (const CollisionVariant& variant : results.variants)
      for (const CollisionCurve* curve : curvesOf(variant, engine)) count.add(*curve);
  }
  return counts;
}

/// Quantities beyond their limits.
Names failuresIn(const CollisionCurve& curve) {
  Names words;
  if (curve.ownScheme && curve.ownScheme->held == false) words.push_back("its own scheme");
  for (const CollisionQuantity& quantity : scoredQuantities())
    if (const auto& score = declaredScore(curve).of[quantity.id]; score && score->held == false)
      words.push_back(quantityWords(quantity));
  return words;
}

/// The quantity that most sweeps of engines that are judged fail in; empty: none does.
std::string failsMostOften(const CollideResults& results) {
  std::map<std::string, int> counts;
  for (const std::string& engine : judgedEngines(results))
    for (const CollisionVariant& variant : results.variants)
      for (const CollisionCurve* curve : curvesOf(variant, engine))
        if (verdictOf(*curve) == Verdict::fail && curve->status != Status::failed)
          for (const std::string& words : failuresIn(*curve)) ++counts[words];
  const auto most =
      std::ranges::max_element(counts, {}, [](const auto& one) { return one.second; });
  return most == counts.end() ? "" : most->first;
}

/// Of each engine that is judged the difference furthest beyond a limit, in a sentence; the largest
/// first.
std::string differencesByCause(const CollideResults& results) {
  const std::vector<CaseGroup> groups = casesOf(results);
  const Names engines = judgedEngines(results);
  std::vector<WorstDifference> all;
  for (const CaseGroup& group : groups)
    std::ranges::move(differencesIn(group.variants), std::back_inserter(all));
  std::erase_if(all, [&](const WorstDifference& one) {
    return one.limits <= 1.0 || one.curve->score.of[one.quantity]->held != false ||
           std::ranges::find(engines, one.curve->engine) == engines.end();
  });
  Names words;
  for (const WorstDifference& one :
       largestOfEngines(std::move(all)) | std::views::take(mostDifferences)) {
    const auto group = std::ranges::find_if(groups, [&](const CaseGroup& each) {
      return std::ranges::find(each.variants, one.variant) != each.variants.end();
    });
    words.push_back(differenceSentence(
        one, results.variants.size() > 1 ? placeOf(groups, *group, *one.variant) : "",
        words.empty()));
  }
  return fmt::format("{}", fmt::join(words, "; "));
}

/// "siconos (44 of 45 sweeps) and grain (2 of 242)"
std::string failedInWords(std::vector<EngineCount> tallies) {
  std::erase_if(tallies, [](const EngineCount& one) { return one.beyondLimits == 0; });
  std::ranges::stable_sort(tallies, std::greater(), [](const EngineCount& one) {
    return static_cast<double>(one.beyondLimits) / one.judged();
  });
  Names words;
  for (const EngineCount& one : tallies)
    words.push_back(fmt::format("{} ({} of {}{})", one.engine, one.beyondLimits, one.judged(),
                                words.empty() ? " sweeps" : ""));
  return listedShortly(words, mostEngines);
}

/// Engines that pass every sweep that was judged.
Names passAll(const std::vector<EngineCount>& tallies) {
  Names names;
  for (const EngineCount& one : tallies)
    if (one.held > 0 && one.held == one.judged()) names.push_back(one.engine);
  return names;
}

/// "Passed: grain; failed: siconos." Parts without words are left out.
std::string joinedParts(const std::vector<std::pair<std::string_view, std::string>>& parts) {
  std::string sentence;
  for (const auto& [what, words] : parts)
    if (!words.empty())
      sentence += fmt::format("{}{}: {}", sentence.empty() ? "" : "; ", what, words);
  if (sentence.empty()) return {};
  return capitalised(sentence) + ".";
}

std::string whoPasses(const CollideResults& results) {
  const std::vector<EngineCount> tallies = countsOf(results);
  SweepCount passed;
  for (const EngineCount& one : tallies) {
    if (one.held == 0 || one.held < one.judged()) continue;
    passed.points += one.points;
    passed.judgedPoints += one.judgedPoints;
  }
  Names ownLaw, unjudged;
  bool inPart = false;
  for (const EngineCount& one : tallies) {
    inPart = inPart || (one.judged() > 0 && one.notJudged > 0);
    if (one.modelDifference > 0 && one.beyondLimits == 0) ownLaw.push_back(one.engine);
    if (one.judged() == 0) unjudged.push_back(one.engine);
  }
  const std::string sentence = joinedParts(
      {{(inPart ? "passed every sweep that was judged" : "passed every sweep") +
            pointsWords(passed),
        listedShortly(passAll(tallies), mostEngines)},
       {"model difference: true to the law that they declare", listedShortly(ownLaw, mostEngines)},
       {"failed", failedInWords(tallies)},
       {"not judged", listedShortly(unjudged, mostEngines)}});
  return sentence.empty() ? "No engine took part." : sentence;
}

std::string causesOfDifferences(const CollideResults& results) {
  return joinedParts(
      {{"causes", differencesByCause(results)}, {"fails most often", failsMostOften(results)}});
}

std::string collideNextStep(const CollideResults& results) {
  if (const std::string nothing = nothingJudged(results); !nothing.empty())
    return fmt::format("Nothing was judged: {}.", nothing);
  const SweepCount count = countOf(results);
  if (count.failed > 0) return "Next: see why sweeps failed, in the table of scores.";
  if (count.beyondLimits > 0)
    return "Next: see whether the failures shrink with the time step, or of rigid contacts with "
           "more iterations; if not, they are a fault or another law.";
  if (count.modelDifference == 0) {
    const std::vector<EngineCount> tallies = countsOf(results);
    if (std::ranges::any_of(tallies, [](const EngineCount& one) { return one.refused > 0; }))
      return "All sweeps that were judged pass at these time steps; engines without a sweep's law "
             "refused it.";
    return count.notJudged > 0 ? "All sweeps that were judged pass at these time steps."
                               : "All engines pass at these time steps.";
  }
  const Names pass = passAll(countsOf(results));
  return fmt::format("Next: where the scene's own law is needed, take {}.",
                     pass.empty() ? "an engine that has it" : listedShortly(pass, mostEngines));
}

}  // namespace

Overview collideOverview(const CollideResults& results) {
  const std::vector<CaseGroup> groups = casesOf(results);
  Overview overview;
  overview.columns.push_back(
      {"cases passed", "Sweeps within the limits of the scene's law, of those judged.", "matrix"});
  for (const QuantityGroup& group : quantityGroups())
    overview.columns.push_back({group.name, group.asks, ""});
  overview.columns.push_back({"integrator (own scheme)",
                              "One impact compared with the discrete solution of the engine's "
                              "integrator, as a share of the diameter or the speed of approach.",
                              ""});
  for (const EngineRow& engine : results.engines) {
    const bool besidePeer = runsBesideItsPeer(results, engine.name);
    OverviewRow row{engine.name, true, {sweepsCell(groups, engine, besidePeer)}};
    for (const QuantityGroup& group : quantityGroups()) {
      Errors errors;
      forCurves(groups, engine.name,
                [&](const CollisionVariant& variant, const CollisionCurve& curve,
                    const std::string& sweep, const std::string& anchor) {
                  for (const QuantityId id : group.quantities) {
                    const CollisionQuantity& quantity = collisionQuantity(id);
                    const bool alone = group.quantities.size() == 1;  // the question names it
                    const std::string place =
                        alone ? sweep : fmt::format("{}, {}", quantity.label, sweep);
                    look(errors, curve, quantity, causeBefore(variant, curve, id) + place, anchor);
                  }
                });
      row.cells.push_back(errorCell(errors, besidePeer));
    }
    row.cells.push_back(schemeCell(groups, engine.name));
    overview.rows.push_back(std::move(row));
  }
  dropEmptyColumns(overview);
  overview.conclusion =
      nonEmpty({whoPasses(results), causesOfDifferences(results), collideNextStep(results)});
  return overview;
}

}  // namespace crossgrain::reports

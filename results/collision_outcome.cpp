#include "results/collision_outcome.hpp"

#include <algorithm>

namespace crossgrain::inline results {

const CurveScore& declaredScore(const CollisionCurve& curve) {
  const bool known = curve.declared && curve.declared->score.verdict != CurveVerdict::notJudged;
  return known ? curve.declared->score : curve.score;
}

std::optional<double> ownDeviation(const CollisionCurve& curve) {
  if (!curve.ownScheme || !curve.ownScheme->position || !curve.ownScheme->velocity)
    return std::nullopt;
  return std::max(*curve.ownScheme->position, *curve.ownScheme->velocity);
}

SweepOutcome outcomeOf(const CollisionCurve& curve) {
  using enum SweepOutcome;
  if (curve.status == SweepStatus::refused) return refused;
  if (curve.status == SweepStatus::failed) return failed;
  if (curve.ownScheme && curve.ownScheme->held == false) return beyondLimits;
  const CurveVerdict scene = curve.score.verdict, own = declaredScore(curve).verdict;
  const bool isTheLaw = curve.declared && curve.declared->reference == DeclaredReference::itself;
  if (own == CurveVerdict::notJudged) return notJudged;
  if (own == CurveVerdict::beyondLimits && !isTheLaw) return beyondLimits;
  return scene == CurveVerdict::beyondLimits ? modelDifference : held;
}

bool runsBesideItsPeer(const CollideResults& results, const std::string& engine) {
  const auto row = std::ranges::find(results.engines, engine, &EngineRow::name);
  return row != results.engines.end() && !row->mirrors.empty() &&
         std::ranges::find(results.engines, row->mirrors, &EngineRow::name) !=
             results.engines.end();
}

CollideCount countOf(const CollideResults& results) {
  CollideCount count;
  for (const CollisionVariant& variant : results.variants)
    for (const CollisionCurve& curve : variant.curves) {
      const SweepOutcome outcome = outcomeOf(curve);
      count.failed += outcome == SweepOutcome::failed;
      if (runsBesideItsPeer(results, curve.engine)) continue;
      count.held += outcome == SweepOutcome::held;
      count.modelDifference += outcome == SweepOutcome::modelDifference;
      count.beyondLimits += outcome == SweepOutcome::beyondLimits;
      count.notJudged += outcome == SweepOutcome::notJudged;
      count.refused += outcome == SweepOutcome::refused;
    }
  return count;
}

std::string nothingJudged(const CollideResults& results) {
  if (countOf(results).judged() > 0) return {};
  bool measured = false, noLimit = false;
  std::string noOracle;
  for (const CollisionVariant& variant : results.variants) {
    if (noOracle.empty()) noOracle = variant.oracleReason;
    noLimit = noLimit || !variant.noLimit.empty();
    for (const CollisionCurve& curve : variant.curves)
      for (const CollisionQuantity& quantity : scoredQuantities())
        measured = measured || curve.score.of[quantity.id];
  }
  if (measured) return "the case has no [collision.margins] for what was measured";
  if (!noOracle.empty()) return "there is no oracle to judge by: " + noOracle;
  if (noLimit) return "the law has no limit of small time steps at any point of the sweep";
  return "no engine has an outcome to judge";
}

}  // namespace crossgrain::inline results

#include "reports/collide/table.hpp"

#include <algorithm>
#include <functional>

#include "reports/common/labels.hpp"
#include "reports/common/numbers.hpp"

namespace crossgrain::reports {

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
  if (curve.ownScheme && curve.ownScheme->held == false) return fellShort;
  const CurveVerdict scene = curve.score.verdict, own = declaredScore(curve).verdict;
  const bool isTheLaw = curve.declared && curve.declared->reference == DeclaredReference::itself;
  if (own == CurveVerdict::notJudged) return notJudged;
  if (own == CurveVerdict::fellShort && !isTheLaw) return fellShort;
  return scene == CurveVerdict::fellShort ? modelDifference : held;
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
      count.fellShort += outcome == SweepOutcome::fellShort;
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

std::optional<std::string> lawWords(const std::string& option, const LawValue& value) {
  if (const auto* word = std::get_if<std::string>(&value))
    return spaced(option) + " " + spaced(*word);
  const auto constant = finite(std::get<double>(value));
  if (!constant) return std::nullopt;
  return spaced(option) + " " + readableSetting(constant);
}

std::string quantityWords(const CollisionQuantity& quantity) {
  using enum QuantityId;
  switch (quantity.id) {
    case psiF:
      return "tangential rebound Ψ_f";
    case en:
      return "restitution e_n";
    case beta:
      return "tangential restitution β";
    case et:
      return "tangential restitution of the centres e_t";
    case centrePsiF:
      return "tangential velocity of the centres";
    case reboundAngle:
      return "rebound angle";
    case spinI:
      return "spin ω_i";
    case spinJ:
      return "spin ω_j";
    case maxOverlap:
      return "largest overlap";
    case lostNormalDamping:
      return "energy lost to the normal dashpot";
    case lostTangential:
      return "energy lost tangentially";
    case lostTangentialDamping:
      return "energy lost to the tangential dashpot";
    case lostStiffening:
      return "energy lost to stiffening";
    case lostSliding:
      return "energy lost to sliding";
    case lostStored:
      return "energy left in the tangential spring";
    default:
      return std::string(quantity.label);
  }
}

}  // namespace crossgrain::reports

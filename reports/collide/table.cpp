#include "reports/collide/table.hpp"

#include <fmt/format.h>

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
    case psiFOut:
      return "tangential rebound out of the plane of impact Ψ_f·b";
    case spinINormal:
      return "spin of the first about the line of centres";
    case spinITangent:
      return "spin of the first about the tangent";
    case spinJNormal:
      return "spin of the second about the line of centres";
    case spinJTangent:
      return "spin of the second about the tangent";
    default:
      return std::string(quantity.label);
  }
}

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

}  // namespace

Tally tallyOf(const std::vector<const CollisionVariant*>& variants, const std::string& engine) {
  Tally tally;
  for (const CollisionVariant* variant : variants)
    for (const CollisionCurve* curve : curvesOf(*variant, engine)) addTo(tally, *curve);
  return tally;
}

std::vector<std::string> shortfalls(const Tally& tally) {
  std::vector<std::string> lines;
  if (tally.worst.times > 1.0) lines.push_back(tally.worst.words());
  if (tally.worstOfModel.times > 1.0) lines.push_back("model: " + tally.worstOfModel.words());
  if (!tally.ownPassed) lines.push_back(fmt::format("own scheme {}", shortly(tally.ownDeviation)));
  return lines;
}

}  // namespace crossgrain::reports

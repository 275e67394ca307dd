#include "reports/thesis/law_sweeps.hpp"

#include <cmath>

namespace crossgrain::reports {

namespace {

/// The engine's curve at the time step next to that many steps per contact; null: none finished.
const CollisionCurve* curveAt(const CollisionVariant& variant, const std::string& engine,
                              double steps) {
  const CollisionCurve* nearest = nullptr;
  const auto off = [&](const CollisionCurve& curve) {
    return std::abs(std::log(curve.stepsPerContact.value_or(steps) / steps));
  };
  for (const CollisionCurve& curve : variant.curves)
    if (curve.engine == engine && curve.status == SweepStatus::finished &&
        (!nearest || off(curve) < off(*nearest)))
      nearest = &curve;
  return nearest;
}

std::string wordOf(const LawWords& law, const char* option) {
  const auto found = law.find(option);
  const auto* const word = found == law.end() ? nullptr : std::get_if<std::string>(&found->second);
  return word ? *word : "";
}

}  // namespace

LawSweeps lawSweeps(const CollideResults& collisions, const std::string& engine,
                    const std::string& tension, double steps) {
  LawSweeps sweeps;
  for (const CollisionVariant& variant : collisions.variants) {
    const CollisionCurve* const curve = curveAt(variant, engine, steps);
    if (!curve || wordOf(variant.law, "tension") != tension) continue;
    LawSweep sweep;
    double count = 0.0;
    for (std::size_t row = 0; row < curve->points.size(); ++row) {
      const auto psi = curve->points.at(QuantityId::psiF, row);
      const auto en = curve->points.at(QuantityId::en, row);
      if (!psi || !en) continue;
      sweep.points.push_back({curve->points.psi[row], *psi, {}});
      sweep.en += *en;
      count += 1.0;
    }
    sweep.en /= count;
    if (!sweep.points.empty()) sweeps[wordOf(variant.law, "tangential")] = std::move(sweep);
  }
  return sweeps;
}

double lawFriction(const CollideResults& collisions) {
  double mu = 0.0;
  for (const CollisionVariant& variant : collisions.variants)
    if (const auto found = variant.law.find("mu"); found != variant.law.end())
      mu = std::get<double>(found->second);
  return mu;
}

}  // namespace crossgrain::reports

#pragma once

#include <map>

#include "runs/cost/collision.hpp"
#include "runs/cost/error_kind.hpp"

namespace crossgrain::inline runs {

/// Two disks that collide, against the oracle of the case's law and against the engine's own limit
/// of small steps.
class CollisionErrors final : public ErrorKind {
 public:
  explicit CollisionErrors(CostStudy& study) : study_(study) {}
  CostKind kind() const override { return CostKind::collision; }
  std::vector<std::string> measures() const override;
  double predicted(std::size_t engine, const CostSetting& setting) const override;
  ReferenceCost referenceCost(const std::vector<bool>& anew, double budget) const override;
  void makeReferences() override;
  std::vector<CostPoint> measure(const PlannedPoint& point) override;
  void addTo(CostResults& results) const override;

 private:
  /// Found when it is first needed.
  const CollisionLimit& limitOf(std::size_t engine);

  CostStudy& study_;
  CollisionReference reference_;
  std::map<std::size_t, CollisionLimit> limits_;  ///< by engine
};

}  // namespace crossgrain::inline runs

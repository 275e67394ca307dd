#pragma once

#include "runs/cost/collision.hpp"
#include "runs/cost/error_kind.hpp"

namespace crossgrain::inline runs {

/// Two disks that collide, against the oracle.
class CollisionErrors final : public ErrorKind {
 public:
  explicit CollisionErrors(CostStudy& study) : study_(study) {}
  CostKind kind() const override { return CostKind::collision; }
  std::vector<std::string> measures() const override;
  double predicted(std::size_t engine, const CostSetting& setting) const override;
  void makeReferences() override;
  std::vector<CostPoint> measure(const PlannedPoint& point) override;
  void addTo(CostResults& results) const override;

 private:
  CostStudy& study_;
  CollisionReference reference_;
};

}  // namespace crossgrain::inline runs

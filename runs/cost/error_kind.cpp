#include "runs/cost/error_kind.hpp"

#include <algorithm>

#include "runs/cost/average_errors.hpp"
#include "runs/cost/collision_errors.hpp"
#include "runs/cost/trajectory_errors.hpp"

namespace crossgrain::inline runs {

ReferenceCost ErrorKind::referenceCost(const std::vector<bool>&, double) const {
  return {};
}

std::string ErrorKind::obstacle(const PlannedPoint&) const {
  return {};
}

ErrorKinds errorKinds(CostStudy& study) {
  ErrorKinds all, wanted;
  all.push_back(std::make_unique<CollisionErrors>(study));
  all.push_back(std::make_unique<TrajectoryErrors>(study));
  all.push_back(std::make_unique<AverageErrors>(study));
  for (auto& one : all)
    if (std::ranges::find(study.setup.cost.kinds, one->kind()) != study.setup.cost.kinds.end())
      wanted.push_back(std::move(one));
  return wanted;
}

ErrorKind& errorKindOf(const ErrorKinds& kinds, CostKind kind) {
  return **std::ranges::find_if(kinds, [&](const auto& one) { return one->kind() == kind; });
}

}  // namespace crossgrain::inline runs

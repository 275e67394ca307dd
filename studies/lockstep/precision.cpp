#include "studies/lockstep/precision.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "studies/lockstep/rules.hpp"
#include "studies/lockstep/separation.hpp"

namespace crossgrain::inline studies {
namespace {

/// Every value off by as much as rounding it may make, whatever unit an engine counts in.
/// @param side  1: the one to which it rounds here, −1: the other
Disks nudged(Disks disks, double side) {
  constexpr double half = 0.5 * std::numeric_limits<float>::epsilon();
  const auto nudge = [side](double& value) {
    const double rounding = static_cast<double>(static_cast<float>(value)) - value;
    value += side * std::copysign(half * value, rounding);
  };
  for (auto* vectors : {&disks.position, &disks.velocity})
    for (Vec2& each : *vectors) {
      nudge(each.x());
      nudge(each.y());
    }
  std::ranges::for_each(disks.spin, nudge);
  return disks;
}

}  // namespace

std::vector<double> precisionLimits(const std::string& precision, Engine& mirror,
                                    const Scene& scene, const std::vector<LockstepFrame>& unchanged,
                                    const std::vector<std::uint64_t>& steps, double diameter) {
  if (precision != toString(Precision::float32)) return {};
  std::vector<double> limits(steps.size(), lockstepRounding);
  for (const double side : {1.0, -1.0}) {
    Scene other = scene;
    other.disks = nudged(scene.disks, side);
    mirror.load(other, {});
    const std::vector<LockstepFrame> moved = follow(mirror, scene.dt, steps);
    double once = 0.0;
    for (std::size_t k = 0; k < steps.size(); ++k) {
      once = std::max(once, farthest(moved[k], unchanged[k], diameter).distance);
      limits[k] = std::max(limits[k], (1.0 + static_cast<double>(steps[k])) * once);
    }
  }
  return limits;
}

}  // namespace crossgrain::inline studies

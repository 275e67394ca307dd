#include "studies/lockstep/responses.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
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

Responses referenceResponses(Engine& engine, const std::vector<LockstepFrame>& unchanged,
                             double diameter, const std::function<double(double)>& load) {
  Responses responses(unchanged.size());
  for (const double change : referencePerturbations) {
    const double step = load(change);
    std::vector<std::uint64_t> steps;
    for (const LockstepFrame& frame : unchanged) steps.push_back(stepsUntil(frame.time, step));
    const auto moved = follow(engine, step, steps);
    for (std::size_t k = 0; k < unchanged.size(); ++k)
      std::ranges::copy(distances(moved[k], unchanged[k], diameter),
                        std::back_inserter(responses[k]));
  }
  return responses;
}

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

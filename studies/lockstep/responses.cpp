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
template <int D>
DisksOf<D> nudged(DisksOf<D> disks, double side) {
  constexpr double half = 0.5 * std::numeric_limits<float>::epsilon();
  const auto nudge = [side](double& value) {
    const double rounding = static_cast<double>(static_cast<float>(value)) - value;
    value += side * std::copysign(half * value, rounding);
  };
  for (auto* vectors : {&disks.position, &disks.velocity})
    for (VecOf<D>& each : *vectors) std::ranges::for_each(each, nudge);
  for (SpinOf<D>& spin : disks.spin)
    if constexpr (D == 2)
      nudge(spin);
    else
      std::ranges::for_each(spin, nudge);
  return disks;
}

}  // namespace

template <int D>
Responses referenceResponses(Engine& engine, const std::vector<LockstepFrameOf<D>>& unchanged,
                             double diameter, const std::function<double(double)>& load,
                             const std::optional<BoxOf<D>>& box) {
  Responses responses(unchanged.size());
  for (const double change : referencePerturbations) {
    const double step = load(change);
    std::vector<std::uint64_t> steps;
    for (const LockstepFrameOf<D>& frame : unchanged) steps.push_back(stepsUntil(frame.time, step));
    auto moved = follow<D>(engine, step, steps);
    for (std::size_t k = 0; k < unchanged.size(); ++k) {
      unwrap<D>(moved[k].position, unchanged[k].position, box);
      std::ranges::copy(distances(moved[k], unchanged[k], diameter),
                        std::back_inserter(responses[k]));
    }
  }
  return responses;
}

template <int D>
std::vector<double> precisionLimits(const std::string& precision, Engine& mirror,
                                    const SceneOf<D>& scene,
                                    const std::vector<LockstepFrameOf<D>>& unchanged,
                                    const std::vector<std::uint64_t>& steps, double diameter) {
  if (precision != toString(Precision::float32)) return {};
  std::vector<double> limits(steps.size(), lockstepRounding);
  for (const double side : {1.0, -1.0}) {
    SceneOf<D> other = scene;
    other.disks = nudged(scene.disks, side);
    loadOn(mirror, other, {});
    const std::vector<LockstepFrameOf<D>> moved = follow<D>(mirror, scene.dt, steps);
    double once = 0.0;
    for (std::size_t k = 0; k < steps.size(); ++k) {
      once = std::max(once, farthest(moved[k], unchanged[k], diameter).distance);
      limits[k] = std::max(limits[k], (1.0 + static_cast<double>(steps[k])) * once);
    }
  }
  return limits;
}

template Responses referenceResponses(Engine&, const std::vector<LockstepFrameOf<2>>&, double,
                                      const std::function<double(double)>&,
                                      const std::optional<BoxOf<2>>&);
template std::vector<double> precisionLimits(const std::string&, Engine&, const SceneOf<2>&,
                                             const std::vector<LockstepFrameOf<2>>&,
                                             const std::vector<std::uint64_t>&, double);
template Responses referenceResponses(Engine&, const std::vector<LockstepFrameOf<3>>&, double,
                                      const std::function<double(double)>&,
                                      const std::optional<BoxOf<3>>&);
template std::vector<double> precisionLimits(const std::string&, Engine&, const SceneOf<3>&,
                                             const std::vector<LockstepFrameOf<3>>&,
                                             const std::vector<std::uint64_t>&, double);

}  // namespace crossgrain::inline studies

#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "adapters/engine.hpp"
#include "results/effects.hpp"

namespace crossgrain::inline studies {

/// One case whose steps are timed.
struct TimedVariant {
  std::function<std::unique_ptr<Engine>()> start;  ///< the engine, for one turn
  /// Has it load the scene of a round afresh, from another packing each; returns its dt [s].
  std::function<double(Engine&, int round)> load;
};

/// Time of a step of one variant.
struct StepTimes {
  std::vector<double> seconds;     ///< per step, round by round: processor time, of an engine that
                                   ///< does not report it wall time; empty if the engine failed
  std::optional<double> contacts;  ///< evaluated per step; absent if the engine does not count
  std::string failure;
  bool refused = false;  ///< it does not run such a scene: that is no failure
};

/// Times variants against each other: one at a time, in turn, `rounds` times, each time over the
/// same stretch of the round's run (loaded afresh, a warm-up of half that stretch, then the steps
/// timed), as many steps in all variants. One that fails has its reason, the others go on.
/// @param progress  called with the fraction done
/// @throws Interrupted
std::vector<StepTimes> timeSteps(const std::vector<TimedVariant>& variants, const TimingPlan& plan,
                                 const std::function<void(double)>& progress);

/// A time per step over another's: the mean of the ratios of the rounds, in each of which both
/// begin from one packing; the error is that of this mean.
struct TimeRatio {
  double value;
  std::optional<double> standardError;
};
/// Absent where either has not been timed.
std::optional<TimeRatio> timeRatio(const StepTimes& time, const StepTimes& whole);

/// The mean of the rounds; absent without one.
std::optional<double> meanStep(const StepTimes& time);

void fields(auto& io, StepTimes& times) {
  FIELDS(io, times.seconds, times.contacts, times.failure);
  io.when(times.refused, "refused", times.refused);
}

}  // namespace crossgrain::inline studies

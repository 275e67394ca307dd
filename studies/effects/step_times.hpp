#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "adapters/engine.hpp"
#include "results/effects.hpp"

namespace crossgrain::inline studies {

/// One scene whose steps are timed.
struct TimedVariant {
  std::function<std::unique_ptr<Engine>()> start;  ///< the engine, for one turn
  std::function<double(Engine&)> load;  ///< has it load the scene afresh, returns its dt [s]
};

/// What a step of one variant takes.
struct StepTimes {
  std::vector<double> seconds;     ///< per step, round by round: wall time, or CPU time if less;
                                   ///< empty if the engine failed
  std::optional<double> contacts;  ///< evaluated per step; absent if the engine does not count
  std::string failure;
};

/// Times variants against each other: one at a time, in turn, `rounds` times, each time over the
/// same stretch of the same run (loaded afresh, a warm-up of half that stretch, then the steps
/// timed), as many steps in all variants. One that fails has its reason, the others go on.
/// @param progress  called with the fraction done
/// @throws Interrupted
std::vector<StepTimes> timeSteps(const std::vector<TimedVariant>& variants, const TimingPlan& plan,
                                 const std::function<void(double)>& progress);

/// A time per step over another's: of the shortest rounds, since what disturbs a round
/// only lengthens it; the error is that of the mean over rounds.
struct TimeRatio {
  double value;
  std::optional<double> standardError;
};
/// Absent where either has not been timed.
std::optional<TimeRatio> timeRatio(const StepTimes& time, const StepTimes& whole);

/// The shortest round; absent without one.
std::optional<double> shortestStep(const StepTimes& time);

void fields(auto& io, StepTimes& times) {
  io("seconds", times.seconds);
  io("contacts", times.contacts);
  io("failure", times.failure);
}

}  // namespace crossgrain::inline studies

#pragma once

#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "adapters/engine.hpp"

namespace crossgrain::inline runs {

struct TimingPlan {
  double seconds = 0.2;  ///< each leg steps for at least as long in each round
  int rounds = 5;
};

/// One scene whose steps are timed.
struct TimedLeg {
  std::unique_ptr<Engine> engine;
  std::function<double()> load;  ///< has the engine load the scene afresh, returns its dt [s]
};

/// What a step of one leg takes.
struct StepTimes {
  std::vector<double> seconds;     ///< per step, round by round: wall time, or CPU time if less;
                                   ///< empty if the engine failed
  std::optional<double> contacts;  ///< evaluated per step; absent if the engine does not count
  std::string failure;
};

/// Times legs against each other: one at a time, in turn, `rounds` times, each time over the same
/// stretch of the same run (loaded afresh, a warm-up of half that stretch, then the steps timed),
/// as many steps in all legs. A leg that fails has its reason, the others go on.
/// @param progress  called with the fraction done
/// @throws Interrupted
std::vector<StepTimes> timeSteps(std::vector<TimedLeg>& legs, const TimingPlan& plan,
                                 const std::function<void(double)>& progress);

/// A time per step as a share of another's: of the shortest rounds, since what disturbs a round
/// only lengthens it; the error is that of the mean over rounds.
struct TimeRatio {
  double value;
  std::optional<double> standardError;
};
/// Absent where either has not been timed.
std::optional<TimeRatio> timeRatio(const StepTimes& time, const StepTimes& whole);

/// The shortest round; absent without one.
std::optional<double> shortestStep(const StepTimes& time);

/// Both ways, for keeping.
nlohmann::json toJson(const StepTimes& times);
StepTimes stepTimesFromJson(const nlohmann::json& times);

}  // namespace crossgrain::inline runs

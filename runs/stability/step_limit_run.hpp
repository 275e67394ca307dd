#pragma once

#include <functional>

#include "runs/stability/recorder.hpp"

namespace crossgrain::inline runs {

/// The largest time step with which a scene that barely moves goes on barely moving [s].
struct StepLimit {
  double measured = 0.0;
  double theory = 0.0;        ///< theoreticalStepLimit()
  double coordination = 0.0;  ///< coordinationStepLimit()
};

/// Halves the interval between a step that is stable and one that is not, from 0.1 to 1.6 of
/// theory's, until it is known to 0.5 % of that. Stable: over the scene's number of steps no sample
/// finds more than 100 times the kinetic energy of the start.
/// @throws UnsupportedScene for an engine that takes steps of its own, EngineFailure
StepLimit measureStepLimit(Engine& engine, const EngineEntry& entry, const HardScene& hard,
                           const std::function<void(double)>& progress);

}  // namespace crossgrain::inline runs

#pragma once

#include <functional>
#include <vector>

#include "adapters/engine.hpp"
#include "studies/lockstep/account.hpp"

namespace crossgrain::inline studies {

/// How far referencePerturbations take an engine from what it does without, from one start.
/// @param unchanged  what it does, at the times reported
/// @param load       has the engine load the start's scene, the yardstick changed by that part of
///                   itself; returns the engine's time step [s]
/// @throws EngineFailure, Interrupted; what `load` throws
Responses referenceResponses(Engine& engine, const std::vector<LockstepFrame>& unchanged,
                             double diameter, const std::function<double(double)>& load);

}  // namespace crossgrain::inline studies

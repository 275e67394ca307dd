#pragma once

#include <functional>
#include <vector>

#include "adapters/engine_entry.hpp"
#include "cases/case.hpp"
#include "results/lockstep.hpp"
#include "runs/lockstep/starts.hpp"

namespace crossgrain::inline runs {

/// The scene that an engine runs from a state, for its mirror: with the engine's conventions and
/// its effects, in double precision.
/// @param dt  the engine's [s]
Scene sceneOfMirror(const Capabilities& can, const EngineEntry& entry, const Case& setup,
                    const Scene& scene, double dt);

/// Holds one engine against its mirror, from each of the states.
/// @param engine  started; that of `entry`
/// @param dt      the case's [s]
/// @throws Interrupted, BadInput
LockstepRow holdAgainstMirror(Engine& engine, const EngineEntry& entry, const Case& setup,
                              const std::vector<FlowState>& states, double dt,
                              const std::function<void(double)>& progress);

}  // namespace crossgrain::inline runs

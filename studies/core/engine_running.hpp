#pragma once

#include <cstddef>
#include <functional>
#include <optional>

#include "adapters/engine.hpp"
#include "studies/core/engine_access.hpp"

namespace crossgrain::inline studies {

/// Advances in pieces that an engine can answer within its time-out; Ctrl-C is heard in between.
/// @param between  called before each piece with the time reached [s]
/// @returns the time reached, which is within a step of `to` [s]
/// @throws EngineFailure if it stops anywhere else, Interrupted
double advanceInPieces(Engine& engine, const EffectiveParameters& effective, double from, double to,
                       const std::function<void(double)>& between = {});

/// Time of a step of an engine, from a brief look.
struct BriefTiming {
  EffectiveParameters effective;      ///< its scene, with the engine's own time step
  double secondsPerStep = 0.0;        ///< wall time [s]
  int steps = 0;                      ///< that were timed
  std::optional<std::size_t> memory;  ///< most that its worker held so far [bytes]
};

/// Loads the scene and does steps, about a tenth of a second of them after a few to warm up.
/// @throws UnsupportedScene, EngineFailure, BadInput
template <int D>
BriefTiming briefTiming(Engine& engine, const EngineEntry& entry, const Case& setup,
                        const SceneOf<D>& scene);

/// The most that an engine's worker and what it has started held in memory so far: the sum of
/// VmHWM of /proc/PID/status (proc(5)) over those that still run [bytes]. Pages that several share
/// count in each. Absent for an engine that is no worker, or has gone.
std::optional<std::size_t> mostMemoryOf(const Engine& engine);

/// Memory that programs can still have without swapping: MemAvailable of /proc/meminfo [bytes];
/// absent where the kernel does not say.
std::optional<std::size_t> availableMemory();

}  // namespace crossgrain::inline studies

#pragma once

#include <cstddef>
#include <cstdint>
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

/// Work of an engine between two looks at its counters, per step.
struct StepCost {
  std::uint64_t steps = 0;         ///< between the looks
  double wall = 0.0;               ///< [s]
  double processor = 0.0;          ///< of all its threads; wall, where it is not reported [s]
  std::optional<double> contacts;  ///< evaluated; absent of an engine that does not count them
};
StepCost costBetween(const Stats& before, const Stats& after);

/// Steps a loaded engine on in stretches that double, until one takes `enough` of its processor
/// time [s] or `most` steps.
/// @returns that of the last stretch, as the first steps may be slow
StepCost briefSteps(Engine& engine, double dt, double enough = 0.05, std::uint64_t most = 1024);

/// The most that an engine's worker and what it has started held in memory so far: the sum of
/// VmHWM of /proc/PID/status (proc(5)) over those that still run [bytes]. Pages that several share
/// count in each. Absent for an engine that is no worker, or has gone.
std::optional<std::size_t> mostMemoryOf(const Engine& engine);

/// Memory that programs can still have without swapping: MemAvailable of /proc/meminfo [bytes];
/// absent where the kernel does not say.
std::optional<std::size_t> availableMemory();

}  // namespace crossgrain::inline studies

#pragma once

#include <cstddef>
#include <optional>

#include "runs/common/engine_access.hpp"

namespace crossgrain::inline runs {

/// What a step of an engine takes, from a brief look.
struct BriefTiming {
  Realised realised;                  ///< its scene, with the engine's own time step
  double secondsPerStep = 0.0;        ///< wall time [s]
  int steps = 0;                      ///< that were timed
  std::optional<std::size_t> memory;  ///< most that its worker held so far [bytes]
};

/// Loads the scene and does steps, about a tenth of a second of them after a few to warm up.
/// @throws UnsupportedScene, EngineFailure, BadInput
BriefTiming briefTiming(Engine& engine, const EngineEntry& entry, const Case& setup,
                        const Scene& scene);

}  // namespace crossgrain::inline runs

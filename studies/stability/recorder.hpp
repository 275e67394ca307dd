#pragma once

#include <filesystem>
#include <functional>

#include "cases/packing.hpp"
#include "stability/recording.hpp"
#include "studies/core/engine_access.hpp"

namespace crossgrain::inline studies {

/// A case as engines get it, whatever its kind.
struct HardScene {
  const Case* setup = nullptr;
  Scene scene;
  double duration = 0.0;  ///< how long it is watched [s]
};

/// The scene of a case, and for how long it says.
/// @param packing  of a Couette case
/// @throws BadInput
HardScene plainScene(const Case& setup, const Packing& packing);

/// The same of a hard case, with what its measure takes.
HardScene hardScene(const Case& setup, const Packing& packing);

/// Has an engine load the scene and takes `samples` samples while it runs. An engine that fails
/// on the way ends the recording there, with the reason and what was seen before.
/// @param progress  called with the fraction done, 0 … 1
/// @throws UnsupportedScene, BadInput, Interrupted
Recording record(Engine& engine, const EngineEntry& entry, const HardScene& hard,
                 const std::function<void(double)>& progress);

}  // namespace crossgrain::inline studies

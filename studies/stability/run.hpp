#pragma once

#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>

#include "cases/packing.hpp"
#include "results/stability.hpp"
#include "stability/recording.hpp"
#include "studies/core/engine_access.hpp"

namespace crossgrain::inline studies {

/// What one engine is to do with one hard case.
struct StabilityTask {
  const Case* setup;
  const Case* original;  ///< the first variant of its file: what copies are compared with
  EngineEntry entry;
  const Packing* packing;         ///< of a Couette case
  std::filesystem::path scratch;  ///< the worker's
  std::string unprepared = {};    ///< why there is no packing, empty: there is
  bool inSpace = false;           ///< in a plane of space, its disks as spheres: in_space.hpp
};

/// What was not run for want of time: no verdict on anybody.
class OutOfTime : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Does it, and whatever the engine does is a verdict. @throws Interrupted
void judged(StabilityRun& row, const std::function<void()>& work);

/// Runs it in a worker of its own. Whatever the engine does is a verdict.
/// @param progress  called with the fraction done, 0 … 1
/// @throws Interrupted
StabilityRun runStability(const StabilityTask& task, const std::function<void(double)>& progress);

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

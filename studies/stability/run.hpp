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

/// Run of one hard case on one engine, to be done.
struct StabilityTask {
  const Case* setup;
  const Case* original;  ///< the first variant of its file: what copies are compared with
  EngineEntry entry;
  const Packing* packing;         ///< of a case that prepares them; else empty
  std::filesystem::path scratch;  ///< the worker's
  std::string unprepared = {};    ///< why there is no packing, empty: there is
  bool inSpace = false;           ///< in a plane of space, its disks as spheres: in_space.hpp
};

/// Error of a run that is left out for want of time; it is no verdict on the engine.
class OutOfTime : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Does `work`; whatever the engine does becomes a verdict in `row`. @throws Interrupted
void judged(StabilityRun& row, const std::function<void()>& work);

/// Runs the task in a worker of its own. Whatever the engine does becomes a verdict.
/// @param progress  called with the fraction done, 0 … 1
/// @throws Interrupted
StabilityRun runStability(const StabilityTask& task, const std::function<void(double)>& progress);

/// A case as engines get it, whatever its kind.
template <int D>
struct HardSceneOf {
  const Case* setup = nullptr;
  SceneOf<D> scene;
  double duration = 0.0;  ///< how long it is watched [s]
};
using HardScene = HardSceneOf<2>;

/// The scene of a case, and for how long it says.
/// @param packing  prepared, or empty: then the case's first is made
/// @throws BadInput
template <int D = 2>
HardSceneOf<D> plainScene(const Case& setup, const Packing& packing);

}  // namespace crossgrain::inline studies

#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <span>

#include "averaging/rings.hpp"
#include "averaging/weights.hpp"
#include "cases/case.hpp"
#include "cases/packing.hpp"
#include "results/run.hpp"
#include "studies/core/engine_access.hpp"

namespace crossgrain::inline studies {

/// The rings in the plane that a case averages over.
Rings ringsOf(const Case& setup);

/// Weights of these names, with the case's kernel width.
std::vector<Weight> weightsOf(const Case& setup, std::span<const std::string> names);

/// Task of one engine on one packing, and where its files go.
struct FlowTask {
  const Case* setup;
  EngineEntry entry;
  int packingIndex;
  const Packing* packing;
  double dt;                         ///< the case's time step [s]
  std::filesystem::path scratch;     ///< the worker's
  std::filesystem::path snapshots;   ///< HDF5 file of kept snapshots
  std::filesystem::path unfinished;  ///< folder of what is kept while it runs
  std::string key;                   ///< everything that the run depends on
  bool keepsStrip = false;           ///< whether the first packing is drawn as it moves
};

/// Lets the packing settle and averages over the case's rotations, or the time of its [average].
/// @param progress  called with the fraction done, 0 … 1
/// @throws EngineFailure, UnsupportedScene, BadInput, Interrupted
template <int D = 2>
FlowRun runFlow(const FlowTask& task, const std::function<void(double)>& progress);

/// The same in folders that go with it: nothing is kept, and no unfinished run is gone on with.
/// @param dt  the case's time step [s]
FlowRun runWithoutFiles(const EngineEntry& entry, const Case& setup, int packingIndex,
                        const Packing& packing, double dt,
                        const std::function<void(double)>& progress);

}  // namespace crossgrain::inline studies

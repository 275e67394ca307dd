#pragma once

#include <filesystem>
#include <functional>

#include "cases/packing.hpp"
#include "results/stability.hpp"
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
};

/// Runs it in a worker of its own. Whatever the engine does is a verdict.
/// @param progress  called with the fraction done, 0 … 1
/// @throws Interrupted
StabilityRun runStability(const StabilityTask& task, const std::function<void(double)>& progress);

}  // namespace crossgrain::inline studies

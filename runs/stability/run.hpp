#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>

#include "cases/packing.hpp"
#include "runs/common/engine_access.hpp"

namespace crossgrain::inline runs {

/// What one engine is to do with one hard case.
struct StabilityTask {
  const Case* setup;
  const Case* original;  ///< the first variant of its file: what copies are held against
  EngineEntry entry;
  const Packing* packing;         ///< of a Couette case
  std::filesystem::path scratch;  ///< the worker's
};

/// Runs it in a worker of its own and returns an entry of results.json's "runs". Whatever the
/// engine does is a verdict: "stable", "degraded", "unstable" (also where it died, hung or returned
/// a NaN) or "refused" (it lacks what the case calls for).
/// @param progress  told the fraction done, 0 … 1
/// @throws Interrupted
nlohmann::json runStability(const StabilityTask& task, const std::function<void(double)>& progress);

}  // namespace crossgrain::inline runs

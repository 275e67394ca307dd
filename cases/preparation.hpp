#pragma once

#include <filesystem>
#include <functional>

#include "adapters/engine.hpp"
#include "cases/packing.hpp"

namespace crossgrain::inline cases {

/// Prepares packing `index` of a case as Lätzel (2003, section 3.3) does: disks on a dilute
/// triangular lattice with random velocities, wheel turning, ring shrinking from R_prepare to R_o,
/// then some rotations.
/// @param dt        the step, where [preparation] says none [s]
/// @param engine    does the work, on the scene as far as the case lets engines differ
/// @throws UnsupportedScene, EngineFailure, BadInput
/// @param progress  told the fraction done, 0 … 1
Packing preparePacking(const Case& setup, int index, double dt, Engine& engine,
                       const std::function<void(double)>& progress);

/// The folder of prepared packings: CROSSGRAIN_CACHE, else the user's cache folder.
std::filesystem::path packingCache();

std::filesystem::path packingCacheFile(const std::string& hash);

/// The packing from the user's file, the cache, or preparePacking() (then cached).
/// @param engine  the in-house one; where the case names another to prepare packings, that is
///                started instead
/// @throws as preparePacking()
Packing packingOf(const Case& setup, int index, double dt, Engine& engine,
                  const std::function<void(double)>& progress);

}  // namespace crossgrain::inline cases

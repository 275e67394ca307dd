#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "adapters/engine.hpp"
#include "adapters/engine_entry.hpp"
#include "cases/case.hpp"
#include "cases/packing.hpp"

namespace crossgrain::inline cases {

/// Sites of a triangular lattice of the given constant with `inner` <= r <= `outer`, line by line.
std::vector<Vec2> latticeSites(double constant, double inner, double outer);

/// How the preparation of packing `index` begins. @throws BadInput where no engine could run it
Scene preparationStart(const Case& setup, int index, double dt);

/// Prepares packing `index` of a case as Lätzel (2003, section 3.3) does: disks on a dilute
/// triangular lattice with random velocities, wheel turning, ring shrinking from R_prepare to R_o,
/// then some rotations.
/// @param dt        the step, where [preparation] says none [s]
/// @param engine    does the work, on the scene as far as the case lets engines differ
/// @throws UnsupportedScene, EngineFailure, BadInput
/// @param progress  called with the fraction done, 0 … 1
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

/// The engine that `preparation.engine` names to prepare packings; null where that is the in-house
/// one, which callers bring along.
const EngineEntry* ownPreparer(const Case& setup);

/// Starts it. @throws BadInput if it is not installed, EngineFailure
std::unique_ptr<Engine> startPreparer(const EngineEntry& entry, const Case& setup,
                                      const std::filesystem::path& scratch);

/// Origin of a packing: its maker's name, version and settings; empty for the in-house
/// engine. The version is asked for once in the life of this program.
/// @throws as startPreparer()
std::string preparerKey(const Case& setup);

}  // namespace crossgrain::inline cases

#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "adapters/engine_entry.hpp"
#include "cases/case.hpp"

namespace crossgrain::inline cases {

/// The engine that `preparation.engine` names to prepare packings; null where that is the in-house
/// one, which callers bring along.
const EngineEntry* ownPreparer(const Case& setup);

/// Starts it. @throws BadInput if it is not installed, EngineFailure
std::unique_ptr<Engine> startPreparer(const EngineEntry& entry, const Case& setup,
                                      const std::filesystem::path& scratch);

/// What a packing owes to who prepared it: name, version and settings; empty for the in-house
/// engine. The version is asked for once in the life of this program.
/// @throws as startPreparer()
std::string preparerKey(const Case& setup);

}  // namespace crossgrain::inline cases

#pragma once

#include <string>
#include <vector>

#include "adapters/engine_entry.hpp"
#include "adapters/grain.hpp"

namespace crossgrain::inline runs {

/// Adds an engine of the user's own to the registry and, behind it, its mirror: the in-house engine
/// with the conventions that the engine declares. The engine is started once to be asked; one that
/// does not start, or has no soft law, gets no mirror, and says so itself where it is used.
/// @returns its name
std::string addStranger(EngineEntry entry);

/// The same mirror for an engine that came with the program as a file, unless it has one; for
/// "all", for each of them that can be started.
void addMirrorOfShelved(const std::string& name);

/// Conventions as such a mirror's worker is told them, "lever_arm=radius,contact_point", and back.
std::vector<std::string> conventionsInWords(const LawConventionSets& conventions);
LawConventionSets conventionsFromWords(const std::vector<std::string>& words);

}  // namespace crossgrain::inline runs

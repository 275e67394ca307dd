#pragma once

#include <cstddef>
#include <deque>
#include <string>

#include "adapters/engine_entry.hpp"

namespace crossgrain {

/// All engines known to this build, in the order of the reports, and those that were added. The
/// first is the in-house one.
const std::deque<EngineEntry>& engineRegistry();

/// How many of its first are of this build; those that were added come after them.
std::size_t builtInEngines();

/// From then on the engine can be named as any other. @pre no thread looks at the registry; there
/// is none of that name
void addEngine(EngineEntry entry);

/// nullptr if there is none of that name
const EngineEntry* findEngine(const std::string& name);

}  // namespace crossgrain

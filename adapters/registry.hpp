#pragma once

#include <string>
#include <vector>

#include "adapters/engine_entry.hpp"

namespace crossgrain {

/// All engines known to this build, in the order of the reports.
const std::vector<EngineEntry>& engineRegistry();

/// nullptr if there is none of that name
const EngineEntry* findEngine(const std::string& name);

}  // namespace crossgrain

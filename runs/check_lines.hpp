#pragma once

#include <string>
#include <vector>

#include "adapters/registry.hpp"
#include "cases/case.hpp"

namespace crossgrain {

/// What `check` says of an engine and a case, line by line: that it can run it and with which time
/// step, every deviation, and the effects called for that it does not simulate. The engine has
/// loaded the scene then, so that `check` and the reports of runs tell the same; of a scene without
/// disks yet, or one that no engine can start from, it is what is known before.
/// @throws UnsupportedScene in the engine's own words, BadInput for a setting
std::vector<std::string> checkLines(Engine& engine, const EngineEntry& entry, const Case& setup,
                                    const Scene& scene);

}  // namespace crossgrain

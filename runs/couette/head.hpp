#pragma once

#include <nlohmann/json.hpp>

#include "adapters/scene.hpp"
#include "cases/case.hpp"

namespace crossgrain::inline runs {

/// What results.json says of a Couette case whatever is done with it: head, cell, averaging,
/// effects, rings.
/// @param disks  of one packing
nlohmann::json couetteHead(const std::string& kind, const Case& setup, const std::string& command,
                           const Disks& disks);

}  // namespace crossgrain::inline runs

#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "cases/case.hpp"
#include "runs/options.hpp"

namespace crossgrain {

/// Runs the sweep of every variant and time step of a collision case on every engine and scores the
/// whole curve against the oracle of the same planar problem.
/// @param variants  one case per variant, from one file or several
/// @return results.json, kind "collide"
/// @throws BadInput, UnsupportedScene, Interrupted
nlohmann::json collideEngines(const std::vector<Case>& variants, const RunCommand& command);

}  // namespace crossgrain

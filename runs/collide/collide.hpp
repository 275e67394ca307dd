#pragma once

#include <string>
#include <vector>

#include "cases/case.hpp"
#include "results/collision.hpp"
#include "runs/common/run_store.hpp"

namespace crossgrain::inline runs {

/// Runs the sweep of every variant and time step of a collision case on every engine and scores the
/// whole curve against the oracle of the same planar problem. Finished sweeps are kept in the store
/// at once, and taken up.
/// @param variants  one case per variant, from one file or several
/// @throws BadInput, UnsupportedScene, Interrupted
CollideResults collideEngines(const std::vector<Case>& variants, const RunCommand& command,
                              RunStore& store);

/// What that would run, for people. Engines are asked for their version; nothing is computed.
/// @throws BadInput, Interrupted
std::string collidePlan(const std::vector<Case>& variants, const RunCommand& command,
                        RunStore& store);

}  // namespace crossgrain::inline runs

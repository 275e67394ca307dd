#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "cases/case.hpp"
#include "cases/collision_scene.hpp"
#include "oracle/collision_oracle.hpp"
#include "runs/collide/score.hpp"
#include "runs/common/engine_access.hpp"

namespace crossgrain::inline runs {

/// What the oracle says of each start; absent where the law has no limit of small steps.
struct OracleCurve {
  std::vector<std::optional<CollisionEnd>> ends;
  std::string reason;  ///< why there is none
};
OracleCurve oracleCurve(const Case& setup, const std::vector<CollisionStart>& starts);

/// Long enough for every collision of a sweep to be over: contacts last about t_c, a rigid engine's
/// a few of its own steps [s].
double sweepEnd(const Case& setup, double dt, double engineStep);

Outcomes outcomesOf(const OracleCurve& oracle);

/// Those that an engine can be held against: where the law has no limit of small time steps there
/// is none.
Outcomes referenceOf(const OracleCurve& oracle);

/// Why the law has no limit of small time steps at the k-th start, in a clause; empty where it has.
std::string noLimitReason(const Case& setup, const std::vector<CollisionStart>& starts,
                          const OracleCurve& oracle, std::size_t k);

/// A table of results.json, {name: [one value per start]}: Ψ_i, v_n and all that is known of the
/// outcomes; null where one has none, and no column where all have none. Of the oracle's,
/// `limitless` marks points that have no limit of small time steps.
nlohmann::json columnsOf(const std::vector<CollisionStart>& starts, const Outcomes& outcomes);

/// One engine on one sweep: an entry of results.json's "curves".
/// @param look  step by step at the contacts, for the largest overlap and the energy's whereabouts,
///              where the engine has contacts to look at; the outcome is the same
/// @throws EngineFailure, UnsupportedScene, BadInput
nlohmann::json runSweep(Engine& engine, const EngineEntry& entry, const Case& setup, double dt,
                        const std::vector<CollisionStart>& starts, const OracleCurve& oracle,
                        bool look);

}  // namespace crossgrain::inline runs

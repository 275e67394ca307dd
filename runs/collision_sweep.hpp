#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "cases/case.hpp"
#include "cases/collision_oracle.hpp"
#include "cases/collision_scene.hpp"
#include "runs/engine_access.hpp"

namespace crossgrain {

/// What the oracle says of each start; absent where the law has no limit of small steps.
struct OracleCurve {
  std::vector<std::optional<CollisionEnd>> ends;
  std::string reason;  ///< why there is none
};
OracleCurve oracleCurve(const Case& setup, const std::vector<CollisionStart>& starts);

/// Puts what is known of a collision's end into a row of results.json, each name followed by
/// `suffix`; null where absent.
void describe(nlohmann::json& row, const std::optional<CollisionEnd>& end,
              const std::string& suffix);

/// One engine on one sweep: an entry of results.json's "curves".
/// @throws EngineFailure, UnsupportedScene, BadInput
nlohmann::json runSweep(Engine& engine, const EngineEntry& entry, const Case& setup, double dt,
                        const std::vector<CollisionStart>& starts, const OracleCurve& oracle);

/// The order of convergence p of a curve's rms error ∝ dt^p, from two or more time steps:
/// an entry of results.json's "orders". @param curves  of one engine and one variant
std::optional<nlohmann::json> convergenceOrder(const std::vector<const nlohmann::json*>& curves);

}  // namespace crossgrain

#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "runs/collide/sweep.hpp"

namespace crossgrain::inline runs {

/// What all collisions of one case are held against: the case's own law, whatever a setting makes
/// of it, so that an error says how far off the case a setting is.
struct CollisionReference {
  std::vector<CollisionStart> starts;
  OracleCurve oracle;
};

/// A collision's numbers over the starts, by the names of their quantities [their unit].
using CollisionNumbers = std::map<std::string, std::vector<std::optional<double>>>;

/// Where an engine's collisions go to with small steps: its law may be another than the case's.
struct CollisionLimit {
  std::string setting;    ///< what it was found by: an oracle, or so small a step
  CollisionNumbers ends;  ///< empty: it was not found
  /// By how much `ends` may be off, and by how much they are off the case's law: the engine's model
  /// error. In the units of the case's errors.
  std::map<std::string, double> error, model;
  std::string reason;  ///< why it was not found
};

/// The oracle of the law that the engine declares; of a law without one the engine itself at
/// `collisionReference` steps per t_c, known as well as that is the same at half of them.
/// @param fine, coarse  the collision at both steps [s]
/// @throws EngineFailure, UnsupportedScene, BadInput
CollisionLimit collisionLimit(Engine& engine, const EngineEntry& entry, const Case& fine,
                              const Case& coarse, const CollisionReference& reference);

/// √(mean of squares) of the differences, in that unit; absent where a start has only one of both
/// numbers, or none has both.
std::optional<double> rmsDifference(const std::vector<std::optional<double>>& numbers,
                                    const std::vector<std::optional<double>>& from, double unit);

/// What errors of that quantity are in units of, as those of `collide` [its unit].
double unitOf(const CollisionReference& reference, QuantityId quantity);

/// Of the pairs of a sweep.
std::vector<std::optional<double>> numbersOf(const CollisionTable& table, QuantityId quantity);

}  // namespace crossgrain::inline runs

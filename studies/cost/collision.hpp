#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "studies/cost/collision_pairs.hpp"
#include "studies/cost/study.hpp"

namespace crossgrain::inline studies {

/// Quantities with an error against the case's law; against the engine's own limit: ownOf().
inline constexpr QuantityId collisionMeasures[] = {QuantityId::psiF, QuantityId::en};

/// Collisions' numbers, over pairs and their starts one after the other, by the names of their
/// quantities [their unit].
using CollisionNumbers = std::map<std::string, std::vector<std::optional<double>>>;

/// Where an engine's collisions go to with small steps: its law may be another than the case's.
struct CollisionLimit {
  std::string setting;    ///< source of the limit: an oracle, or a small step
  CollisionNumbers ends;  ///< empty: it was not found
  /// By how much `ends` may be off, and by how much they are off the case's law: the engine's model
  /// error, each of the pair for which it is largest. In the units of the case's errors.
  std::map<std::string, double> error, model;
  std::string reason;  ///< why it was not found
};

void fields(auto& io, CollisionLimit& limit) {
  FIELDS(io, limit.setting, limit.ends, limit.error, limit.model, limit.reason);
}

/// The oracle of the law that the engine declares; of a law without one the engine itself at
/// `collisionReference` steps per t_c, known as well as that is the same at half of them.
/// @param fine, coarse  the collision at both steps [s]
/// @throws EngineFailure, UnsupportedScene, BadInput
CollisionLimit collisionLimit(Engine& engine, const EngineEntry& entry, const Case& fine,
                              const Case& coarse, const CollisionReference& reference);

/// An error over many collisions of a pair, in the unit of their curve.
struct CurveError {
  double rms = 0.0;
  double low = 0.0, high = 0.0;  ///< 95 % interval of it, as collisions are a sample of phases
  double worst = 0.0;            ///< of a single one
};

/// √(mean of squares) of the differences, in that unit; absent where a start has only one of both
/// numbers, or none has both. The interval is Student's, of the mean of the squares.
std::optional<CurveError> curveError(const std::vector<std::optional<double>>& numbers,
                                     const std::vector<std::optional<double>>& from, double unit);

/// A round of one setting on one engine: the time of one sweep of the first pair, over so many
/// copies that it is at least `cost.timed`; of the first round also the errors of Ψ_f and e_n, of
/// the pair and the step of the cycle (cycleStep()) for which the rms is largest, and the largest
/// of a single collision: {rms, low, high, worst} by measure. The rms decides on advice, not the
/// worst: a flow's collisions begin at every phase alike, and their errors have either sign and
/// mean 0, so that the effect of many scales with the rms; the worst belongs to a vanishing share
/// of phases. Collisions that do not part, or part faster than they met, are failed. The same
/// against the engine's own limit, where it has one.
/// @throws EngineFailure, UnsupportedScene, BadInput
CostRun runCollisions(Engine& engine, const EngineEntry& entry, const CostSetting& setting,
                      const CollisionReference& reference, const CollisionLimit& own,
                      std::size_t round);

/// Points of all rounds; those against the own limit are refused, with its reason, where there is
/// none.
std::vector<CostPoint> collisionPoints(const EngineEntry& entry, const CostSetting& setting,
                                       const CollisionLimit& own, const std::vector<CostRun>& runs);

/// Collisions of every pair of the cell, against the oracle of the case's law and against the
/// engine's own limit of small steps.
std::unique_ptr<ErrorKind> collisionErrors(CostStudy& study);

}  // namespace crossgrain::inline studies

#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "studies/collide/sweep.hpp"
#include "studies/cost/study.hpp"

namespace crossgrain::inline studies {

/// The collision that stands for a Couette case: two of its small disks and its law, head on with
/// spins, Ψ_i = 0 … psi_max at one speed. Its step is the case's.
Case collisionOf(const Case& setup);

/// What all collisions of one case are compared with: the case's own law, whatever a setting makes
/// of it, so that an error says how far off the case a setting is.
struct CollisionReference {
  std::vector<CollisionStart> starts;
  OracleCurve oracle;
};

CollisionReference collisionReference(const Case& setup);

/// What is measured of collisions against the case's law; against the engine's own limit, ownOf().
inline constexpr QuantityId collisionMeasures[] = {QuantityId::psiF, QuantityId::en};

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

void fields(auto& io, CollisionLimit& limit) {
  io("setting", limit.setting);
  io("ends", limit.ends);
  io("error", limit.error);
  io("model", limit.model);
  io("reason", limit.reason);
}

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

/// One setting on one engine: points for Ψ_f (rms over the curve, and over where in a step the
/// pairs touch, in units of the curve's range) and e_n (rms in units of its magnitude). Timed over
/// so many copies of the sweep that the time is at least `cost.timed`, the shortest of
/// `cost.repeats`. Collisions that do not part, or part faster than they met, are failed. The same
/// against the engine's own limit; where it has none these are refused, with its reason.
/// @throws EngineFailure, UnsupportedScene, BadInput
std::vector<CostPoint> measureCollision(Engine& engine, const EngineEntry& entry,
                                        const CostSetting& setting,
                                        const CollisionReference& reference,
                                        const CollisionLimit& own);

/// Two disks that collide, against the oracle of the case's law and against the engine's own limit
/// of small steps.
std::unique_ptr<ErrorKind> collisionErrors(CostStudy& study);

}  // namespace crossgrain::inline studies

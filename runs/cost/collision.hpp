#pragma once

#include <vector>

#include "runs/collide/sweep.hpp"
#include "runs/cost/collision_limit.hpp"
#include "runs/cost/settings.hpp"

namespace crossgrain::inline runs {

/// The collision that stands for a Couette case: two of its small disks and its law, head on with
/// spins, Ψ_i = 0 … psi_max at one speed. Its step is the case's.
Case collisionOf(const Case& setup);

CollisionReference collisionReference(const Case& setup);

/// What is measured of them against the case's law; against the engine's own limit, as ownOf().
inline constexpr QuantityId collisionMeasures[] = {QuantityId::psiF, QuantityId::en};

/// The largest stable step of a contact, 2/ω with ω² = k_n/m₁₂ [s]: what a symplectic integrator
/// bears of an undamped oscillator.
double stabilityLimit(const Case& setup);

/// Sweeps whose pairs touch at different fractions of a step: the dashpot's jump at touch errs by
/// how far it is from a step, so that one phase alone says little of a setting.
inline constexpr int collisionPhases = 8;

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

}  // namespace crossgrain::inline runs

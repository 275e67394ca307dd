#pragma once

#include <optional>
#include <vector>

#include "cases/case.hpp"
#include "cases/collision_scene.hpp"
#include "oracle/collision_quantities.hpp"
#include "results/collision.hpp"
#include "results/collision_score.hpp"
#include "studies/core/engine_access.hpp"

namespace crossgrain::inline studies {

/// One outcome per collision of a sweep; absent where the pair did not part or there is no oracle.
/// An oracle's may say that they do not part (CollisionEnd::parted).
using Outcomes = std::vector<std::optional<CollisionOutcome>>;

/// Unit of a quantity's errors.
struct ErrorUnit {
  ErrorUnitKind kind = ErrorUnitKind::range;
  double value = 1.0;  ///< in the quantity's own unit
};

/// The range of the oracle's curve, so that no part of it is favoured; where that is below a tenth
/// of the curve's largest magnitude, as e_n of a linear law, that magnitude; 1 for a curve that is
/// zero throughout. (Energies are scored in units of the energy before, not by this.)
/// @param zero  what is no larger is 0, as the sum of opposite spins to rounding
ErrorUnit errorUnit(const std::vector<double>& oracle, double zero = 0.0);
/// The same of numbers by the speed of approach.
inline constexpr double oracleIsGoodTo = 1e-11;

/// Whether at least half of the outcomes are there: fewer are no curve to judge by.
bool mostAreKnown(const Outcomes& outcomes);

/// For each quantity that both the engine and the oracle have, its largest and rms error over the
/// whole curve; and whether it held, within the case's margins, where there are any. A sweep holds
/// where every quantity with a margin does and all pairs parted but those that stick by the oracle.
/// Where the oracle lacks more than half of the collisions nothing is judged: the range of what is
/// left is no unit either.
/// @param units     a score whose units are taken, where it has them: margins are of the scene's
///                  curve
/// @param rounding  how far rounding of places can take an outcome, by the speed of approach [-]:
///                  what is beyond a margin by no more is not judged. Absent: not at all
CurveScore scoreSweep(const Case& setup, const std::vector<CollisionStart>& starts,
                      const Outcomes& found, const Outcomes& oracle,
                      const CurveScore* units = nullptr,
                      std::optional<double> rounding = std::nullopt);

/// The order of convergence p of each quantity's rms error ∝ dt^p, from two or more time steps;
/// absent where there is none. Case and variant are left to be filled in.
/// @param curves  of one engine and one variant
std::optional<ConvergenceOrder> convergenceOrder(const std::vector<CollisionCurve>& curves);

/// Largest deviation from its own scheme that an engine of double precision is allowed, in units of
/// d and v_n. Rounding gives 1e-14 of d and 3e-13 of v_n (overlaps of d/100 in positions of d's
/// size, some hundred steps); k_n off by 1e-9 is 1e-9 of v_n.
constexpr double ownSchemeLimit = 1e-12;

/// One head-on impact of the case's two bodies, step by step, against the discrete oracle of the
/// engine's own scheme and declared law (oracle/impact.hpp): free flight, contact and free
/// flight again. Tells a fault from truncation, at any time step.
///
/// The speed is not the case's but such that the overlap is a hundredth of the sum of radii,
/// where rounded positions give the force to 1e-14 (of an undamped law); a linear law is the same
/// at all speeds. The bodies touch a quarter of a step after a step, so that before and after are
/// not alike, and a wall stands still. Coulomb's law without a spring is frictionless there, as
/// nothing slips.
/// @throws EngineFailure, UnsupportedScene, BadInput
SchemeScore schemeScore(Engine& engine, const EngineEntry& entry, const Case& setup, double dt);

}  // namespace crossgrain::inline studies

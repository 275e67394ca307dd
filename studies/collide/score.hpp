#pragma once

#include <optional>
#include <vector>

#include "cases/case.hpp"
#include "cases/collision_scene.hpp"
#include "oracle/collision_quantities.hpp"
#include "results/collision.hpp"

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

}  // namespace crossgrain::inline studies

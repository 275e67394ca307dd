#pragma once

#include "adapters/contact_law.hpp"
#include "cases/collision_scene.hpp"

namespace crossgrain {

/// Two disks, free but for each other.
struct CollidingPair {
  double radius[2];   ///< [m]
  double mass[2];     ///< [kg]
  double inertia[2];  ///< [kg m²]
};

/// The outcome of a head-on collision with spin, from the planar two-body problem in continuous
/// time: the linear law with any of its tangential laws and conventions, the normal turning with
/// the pair. Integrated with an adaptive Runge–Kutta–Prince–Dormand (8, 9) step to 1e-13 per step
/// (GSL); every change between stick and slip, of v_t's sign and of compression is an event,
/// located to rounding. Rigid laws: Walton's law in closed form, rigidOutcome().
/// @throws std::invalid_argument for an overdamped pair, which never parts, and for conventions
/// whose
///         force jumps with every step so that they have no limit of small steps
CollisionEnd oracleOutcome(const ContactLaw& law, const CollidingPair& pair,
                           const CollisionStart& start);

/// Ψ_f = max(−e_t0 Ψ_i, Ψ_i − (1 + 1/q)(1 + e_n) µ) for Ψ_i > 0, odd in Ψ_i (Walton 1992;
/// Luding 1998). @param inverseInertiaFactor 1/q = (a_i²/J_i + a_j²/J_j) m₁₂
CollisionEnd rigidOutcome(double en, double et0, double mu, double inverseInertiaFactor,
                          double psi);

/// e_n of the linear law with frozen normal (Lätzel 2003, section 4.1): exp(−η π/ω) where tension
/// is allowed, exp(−(η/ω)(π − atan2(2ηω, ω² − η²))) where it is cut.
double restitutionOfLinearLaw(const ContactLaw& law, double reducedMass);

/// The constant of the sliding asymptote Ψ_f = Ψ_i − constant: (1 + 1/q)(1 + e) µ with e of the cut
/// law where the bound is µ max(f_n, 0), tension or not.
double slidingConstant(const ContactLaw& law, const CollidingPair& pair);

}  // namespace crossgrain

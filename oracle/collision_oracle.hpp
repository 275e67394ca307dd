#pragma once

#include "adapters/contact_law.hpp"
#include "oracle/collision_end.hpp"

namespace crossgrain::inline oracle {

/// The outcome of a collision, from the planar two-body problem in continuous time: any soft law
/// with any of its tangential laws and conventions, the normal turning with the pair. Integrated
/// with Runge–Kutta–Prince–Dormand (8, 9) steps of at most t_c/400 (GSL), whose own error is below
/// rounding; where a law that stiffens is not smooth, at δ = 0, steps shrink until it is again.
/// Every change between stick and slip, of v_t's sign and of compression is an event, located to
/// rounding. The energies lost are integrated beside the motion. Rigid laws: rigidOutcome().
/// @throws std::invalid_argument for an overdamped pair, which never parts, and for conventions
///         whose force jumps with every step so that they have no limit of small steps
CollisionEnd oracleOutcome(const ContactLaw& law, const CollidingPair& pair,
                           const CollisionStart& start);

/// Whether the law jumps at this start: spring and dashpot at |Ψ_i| = µγ_n/γ_t, where the outcome
/// is another on either side and rounding decides which one an engine finds
/// (oracle/two_body_events.cpp has the derivation).
bool jumpsAtTouch(const ContactLaw& law, const CollidingPair& pair, const CollisionStart& start);

/// Whether a step of `dt` misses the slip that a contact begins with under a law that jumps at Ψ_j
/// = µγ_n/γ_t: above Ψ_j the dashpots alone exceed the bound at the first touch, and the slip goes
/// on until v_t = 0. But the bound rises by µ k_n v_n per time, so that a contact that is evaluated
/// first when µ(γ_n + k_n t) > (γ_t + share·k_t t) Ψ_i sticks: within a step the jump lies anywhere
/// between Ψ_j and the Ψ_i where both are equal at t = dt. `share` of v_t t is what the law has
/// stretched its spring by then: 0, ½ or 1 by its spring_update.
bool stepMissesSlip(const ContactLaw& law, const CollidingPair& pair, const CollisionStart& start,
                    double dt);

/// Walton's law, an impulse at the first touch: Ψ_f = max(−e_t0 Ψ_i, Ψ_i − (1 + 1/q)(1 + e_n) µ)
/// for Ψ_i > 0, odd in Ψ_i (Walton 1992; Luding 1998), 1 + 1/q = tangentialCompliance()·m₁₂. It
/// has no duration, no overlap, and does not separate sticking's loss from sliding's.
CollisionEnd rigidOutcome(const ContactLaw& law, const CollidingPair& pair,
                          const CollisionStart& start);

/// e_n of the linear law with frozen normal (Lätzel 2003, section 4.1): exp(−η π/ω) where tension
/// is allowed, exp(−(η/ω)(π − atan2(2ηω, ω² − η²))) where it is cut.
double restitutionOfLinearLaw(const ContactLaw& law, double reducedMass);

/// The same of any law where it has a closed form: rigid and undamped ones, and Hertz' with
/// critical dampers, which is that of a linear law with the share β = γ_n/(2 √(5/6)) of critical
/// damping: exp(−π β/√(1 − β²)) where tension is allowed (Antypov and Elliott 2011).
std::optional<double> closedRestitution(const ContactLaw& law, double reducedMass);

/// The constant of the sliding asymptote Ψ_f = Ψ_i − constant: (1 + 1/q)(1 + e) µ with e of the cut
/// law where the bound is µ max(f_n, 0), tension or not. Absent without friction or a known e.
std::optional<double> slidingConstant(const ContactLaw& law, const CollidingPair& pair);

}  // namespace crossgrain::inline oracle

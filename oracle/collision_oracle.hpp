#pragma once

#include "law/contact_law.hpp"
#include "oracle/collision_end.hpp"

namespace crossgrain::inline oracle {

/// The outcome of a collision, from the two-body problem in continuous time: any soft law with any
/// of its tangential laws and conventions, the normal turning with the pair. Integrated with
/// Runge–Kutta–Prince–Dormand (8, 9) steps of at most t_c/400 (GSL), whose own error is below
/// rounding; where a law that stiffens is not smooth, at δ = 0, steps shrink until it is again.
/// Every change between stick and slip, of v_t's sign and of compression is an event, located to
/// rounding. The energies lost are integrated beside the motion. Rigid laws: rigidOutcome().
/// Rolling resistance and cohesion as in law/contact_law.hpp; a pair that coheres may not part
/// (CollisionEnd::parted).
/// Of a law in space: spheres that have no spin out of the plane of impact stay in it, and are the
/// plane's problem (docs/dimensions.md, section 4); others are vectorOutcome().
/// @throws std::invalid_argument for an overdamped pair, which never parts, for conventions whose
///         force jumps with every step so that they have no limit of small steps, and as
///         vectorOutcome()
CollisionEnd oracleOutcome(const ContactLaw& law, const CollidingPair& pair,
                           const CollisionStart& start);

/// The same of two spheres, or of a sphere and a plane, whose slip, force, spins and springs are
/// vectors, whatever their spins. oracleOutcome() chooses it, and checks the conventions.
/// @throws std::invalid_argument for conventions whose limit is of the plane alone, and where a
///         slip's end has none
CollisionEnd vectorOutcome(const ContactLaw& law, const CollidingPair& pair,
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

/// The same of spheres in space, whose slip is a vector v_t: Σ(1/m + a²/J) is the same in all
/// directions of the tangent plane, so the impulse P_t lies along −v_t, v_t keeps its line, and
/// with Ψ_i = |v_t|/v_n the impact is the plane's. ω′ = ω − (a/J) n × P_t of both, so that ω·n
/// stays.
CollisionEnd rigidOutcomeInSpace(const ContactLaw& law, const CollidingPair& pair,
                                 const CollisionStart& start);

/// e_n of the linear law with frozen normal (Lätzel 2003, section 4.1): exp(−η π/ω) where tension
/// is allowed, exp(−(η/ω)(π − atan2(2ηω, ω² − η²))) where it is cut.
double restitutionOfLinearLaw(const ContactLaw& law, double reducedMass);

/// The same of any law where it has a closed form: rigid and undamped ones (elasto-plastic with one
/// k₂, and cohesion that loses nothing, too), and Hertz' with
/// critical dampers, which is that of a linear law with the share β = γ_n/(2 √(5/6)) of critical
/// damping: exp(−π β/√(1 − β²)) where tension is allowed (Antypov and Elliott 2011).
std::optional<double> closedRestitution(const ContactLaw& law, double reducedMass);

/// e_n of an undamped elasto-plastic contact, head on at that speed: with the largest overlap
/// δ_m = v √(m₁₂/k_n), k₂ of it, δ₀ = (1 − k_n/k₂) δ_m and δ_min = (k₂ − k_n) δ_m/(k₂ + k_c), from
/// the areas under its lines, e² = k_n/k₂ − k_c δ_min δ₀/(k_n δ_m²); √(k_n/k₂) without a pull
/// (Walton and Braun 1986). An impact beyond δ* is elastic from there on: it loses what one to δ*
/// does, e² = 1 − (δ*/δ_m)² (1 − e*²). 0: it sticks.
double elastoPlasticRestitution(const ContactLaw& law, const CollidingPair& pair, double speed);

/// The loss of a touch under JKR, from δ = 0 on approach to where the bond ends, in units of F_po
/// a_p²/R₁₂: of U/(F_po a_p²/R₁₂) = 2/5 y¹⁰ − 4/3 y⁷ + 2/3 y⁴, the integral of the force, between
/// y³ = 4/3 (δ = 0) and y = 1 (the largest pull) or y³ = 1/3 (the end of the branch):
///   8/15 (4/3)^⅓ − 4/15 = 0.3203, or 8/15 (4/3)^⅓ + 4/45 (1/3)^⅓ = 0.6486,
/// the latter 7.09 (w⁵ R₁₂⁴/E*²)^⅓ (Thornton and Ning 1998).
double jkrLossFactor(JkrEnd end);

/// The speed below which an undamped head-on impact sticks, ½ m₁₂ v² = loss per touch [m/s]: of
/// JKR; 0 of other laws without a loss; absent of elasto-plastic ones, whose loss follows the
/// speed.
std::optional<double> stickingSpeed(const ContactLaw& law, const CollidingPair& pair);

/// The constant of the sliding asymptote Ψ_f = Ψ_i − constant: (1 + 1/q)(1 + e) µ with e of the cut
/// law where the bound is µ max(f_n, 0), tension or not. Absent without friction or a known e.
std::optional<double> slidingConstant(const ContactLaw& law, const CollidingPair& pair);

}  // namespace crossgrain::inline oracle

#pragma once

#include <optional>

#include "law/contact_law.hpp"
#include "oracle/collision_oracle.hpp"

namespace crossgrain::inline oracle {

/// From wanted restitutions and a wanted contact time to the constants of the linear law, and back.
/// All of it with the normal frozen, which is the limit of slow impacts (error O(v t_c/a)).
/// oracle/calibration.md derives the equations.
///
///   normal:     η = γ_n/(2 m₁₂),    ω² = k_n/m₁₂ − η²       (Lätzel 2003, section 4.1)
///   tangential: η_t = K γ_t/(2 m₁₂), ω_t² = K k_t/m₁₂ − η_t²  while the contact sticks
///
/// f_n falls to zero at t_s = 2 atan2(ω, η)/ω, which is where a contact without tension ends
/// (Schwager & Pöschel 2007). With the Coulomb bound µ max(f_n, 0) it is also where friction ends,
/// tension or not.

/// Mass of a pair against forces along the normal, and how much lighter it is along the tangent.
struct ReducedPair {
  double mass;  ///< m₁₂ = 1/(1/m_i + 1/m_j) [kg]
  double K;  ///< 1 + (a_i²/J_i + a_j²/J_j) m₁₂: dv_t/dt = K f_t/m₁₂; 3 for disks, 7/2 for spheres
};

/// A wall is a body of infinite mass and moment of inertia.
ReducedPair reduced(const CollidingPair& pair);

/// Sets k_n and γ_n so that the pair has restitution e_n and contact time t_c [s] (until f_n = 0
/// where law.conventions.tension is cut, else until the disks part).
///   γ_n = −2 m₁₂ ln(e_n)/t_c,  k_n = m₁₂ (φ² + ln² e_n)/t_c²
/// with φ = ω t_c: π with tension; cut: φ = 2ψ, the root of 2ψ cot ψ = −ln e_n.
/// @throws std::invalid_argument unless 0 < e_n ≤ 1, or exp(−2) < e_n ≤ 1 where tension is cut
void calibrateNormal(ContactLaw& law, double en, double contactTime, double reducedMass);

/// The same from a wanted k_n [N/m] instead of t_c: t_c = √(m₁₂ (φ² + ln² e_n)/k_n), which is
/// π/√(k_n/m₁₂ − (γ_n/2m₁₂)²) with tension.
void calibrateDamping(ContactLaw& law, double en, double kn, double reducedMass);

/// Sets k_t and γ_t of law.tangential, whose k_n and γ_n are set, so that a contact that never
/// slips has v_t after = −e_t0 v_t before. e_t0 and t_s fix one number:
///   spring:        γ_t = 0, ω_t t_s = arccos(−e_t0)
///   springDashpot: ω_t t_s = π is chosen, so that η_t t_s = −ln e_t0
/// @throws std::invalid_argument unless −1 < e_t0 ≤ 1 (spring), 0 < e_t0 ≤ 1 (springDashpot); for
///         other laws
void calibrateTangential(ContactLaw& law, double et0, const ReducedPair& pair);

/// E [Pa] and ν of two equal bodies.
struct HertzMaterial {
  double young, poisson;
};

/// Of two equal bodies with the k_n and k_t of Hertz' law: k_t/k_n = 3 (1 − ν)/(2 − ν),
/// k_n = 2/3 E/(1 − ν²). Any ν serves without a spring: 0.
HertzMaterial hertzMaterial(const ContactLaw& law);

/// The simplest tangential law that has those of k_t, γ_t and µ that are > 0.
TangentialLaw tangentialLawOf(const ContactLaw& constants);

/// Meaning of a law for a pair.
struct ImpliedImpact {
  double enAllowed, enCut;       ///< e_n with tension and without [-]
  double contactTime;            ///< t_c: t_s where the law cuts tension, else π/ω [s]
  double halfPeriod;             ///< π/ω, of which [run] steps_per_contact is counted [s]
  double omega;                  ///< ω [rad/s]
  double dampingRatio;           ///< γ_n over critical damping, 2 √(k_n m₁₂) [-]
  double overlapPerSpeed;        ///< δ_max/v_n [s]
  std::optional<double> et0;     ///< without slip [-]; absent without friction, and where friction
                                 ///< goes on under tension (bounds µ|f_n| and µ f_n)
  std::optional<double> omegaT;  ///< ω_t [rad/s]; absent if overdamped or no spring
  std::optional<double> dampingRatioT;          ///< γ_t over critical; absent without a spring
  std::optional<double> slidingConstant;        ///< Ψ_i − Ψ_f while sliding: K (1 + e_cut) µ
  std::optional<double> firstTouchSticksToPsi;  ///< µ γ_n/γ_t where spring_reset is total: from a
                                                ///< larger |Ψ_i| on it slips until v_t = 0, and
                                                ///< e_t0 does not hold
  std::optional<double> stickingEndsAtPsi;  ///< Ψ* = K (1 + e_cut) µ/(1 + e_t0) of Walton's law
};

/// @throws std::invalid_argument for a rigid law and for an overdamped pair
ImpliedImpact impliedImpact(const ContactLaw& law, const CollidingPair& pair);

/// Inertia that turns against a contact's rolling spring and dashpot, I θ̈ + G θ̇ + K θ = 0 with K =
/// k_r L² (or as RollingStiffness says): a disk that rolls on a plane without slip, I = J + m a²,
/// or the relative spin of a pair whose centres are held, 1/I = 1/J_i + 1/J_j [kg m²].
double rollingInertia(const CollidingPair& pair);

/// Sets k_r and γ_r so that this oscillates at a frequency [Hz], its amplitude falling as e^(−λt):
///   K = I ((2π f)² + λ²), G = 2 I λ, γ_r = G/rollingDamperUnit().
/// @param decay  λ [1/s]
void calibrateRolling(ContactLaw& law, const CollidingPair& pair, double frequency, double decay);

/// The same back. @throws std::invalid_argument for what does not oscillate
struct ImpliedRolling {
  double frequency;  ///< [Hz]
  double decay;      ///< λ [1/s]
};
ImpliedRolling impliedRolling(const ContactLaw& law, const CollidingPair& pair);

/// µ_r with which a disk rests on inclines up to that angle, tan β = µ_r L/a with L at a plane: m g
/// sin β a is what turns it, µ_r L m g cos β what holds it. @param angle  β [rad], < π/2
double rollingCoefficientOf(const ContactLaw& law, double angle);
double restAngle(const ContactLaw& law);

/// w of law.cohesion, DMT or JKR, with that largest pull F_po [N]: F/(2π R₁₂), F/(3/2 π R₁₂).
double workOfAdhesion(const ContactLaw& law, double pullOff, double reducedRadius);

/// −v_t(t)/v_t(0) of the oscillator dv_t/dt = −2η_t v_t − Ω_t² ξ, dξ/dt = v_t, ξ(0) = 0, damped
/// below, at or above critical (η_t = Ω_t).
/// @param undamped Ω_t [rad/s]
double stickingRestitution(double etaT, double undamped, double t);

}  // namespace crossgrain::inline oracle

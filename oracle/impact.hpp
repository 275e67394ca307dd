#pragma once

#include "law/contact_reference.hpp"
#include "oracle/collision_end.hpp"

namespace crossgrain::inline oracle {

/// The linear law as a pair of that mass sees it, its dampers turned into constant ones: γ k
/// (Damper:: viscoelastic) or γ √(m₁₂ k) (critical). Other laws: unchanged. @param reducedMass m₁₂
/// [kg]
ContactLaw withConstantDampers(ContactLaw law, double reducedMass);

/// Duration of a contact of the linear law with tension, t_c = π/ω with ω² = k_n/m₁₂ − η² and
/// η = γ_n/(2 m₁₂) (Lätzel 2003, section 4.1; facts: 2.18 ms for two small disks) [s].
/// @param reducedMass m₁₂ [kg]
/// @throws std::invalid_argument for other laws, and an overdamped one
double contactTime(const ContactLaw& law, double reducedMass);

/// The elastic part of an impact, of any soft law.
struct Impact {
  double reducedMass;    ///< m₁₂ [kg]
  double reducedRadius;  ///< R₁₂ [m]
  double speed;          ///< v_n [m/s]
};

/// Deepest overlap without damping, where the work of f_el is the kinetic energy [m]. Hertz:
/// (15 m₁₂ v²/(16 E₁₂ √R₁₂))^(2/5).
/// @throws std::invalid_argument for a rigid law, and a polynomial one that gives way
double deepestOverlap(const ContactLaw& law, const Impact& impact);

/// ∫ f_el dδ: what the normal spring of a soft law holds at an overlap [J].
/// @param reducedRadius  R₁₂; linear and polynomial laws do not ask for it [m]
double elasticEnergy(const ContactLaw& law, double reducedRadius, double overlap);

/// Of contacts that cohere, in units of impactTime(): what lasts longer counts as a pair that does
/// not part.
constexpr double longestContact = 10.0;

/// How long an impact lasts [s]: contactTime() of a linear law; of one that stiffens its elastic
/// part, T = 2 ∫ dδ/√(v² − 2 W(δ)/m₁₂), for Hertz 2.9432 δ_max/v (Johnson 1985, Eq. 11.24).
/// Under DMT and JKR that of bodies which also come with what their attraction gives them, F_po
/// over the overlap that balances it: else the slowest would seem to take for ever.
double impactTime(const ContactLaw& law, const Impact& impact);

/// Two bodies at the end of a step, along the line of their centres.
struct DiscreteMotion {
  double gap;       ///< of their surfaces, < 0 while they overlap [m]
  double halfStep;  ///< dgap/dt half a step earlier, with which the step led here [m/s]
  double velocity;  ///< dgap/dt that the scheme shows at this time [m/s]
};

/// How they begin, at t = 0.
struct DiscreteStart {
  double gap;          ///< [m]
  double velocity;     ///< < 0 on approach [m/s]
  double reducedMass;  ///< m₁₂ [kg]
  double dt;           ///< [s]
  /// The bodies, of laws that look at radii: Hertz' and those of cohesion
  CollidingPair pair = {};
};

/// A head-on impact, not as it is but as a time-stepping scheme has it: free
/// flight, spring, dashpot, cohesion, tension cut, step by step in extended precision (2⁻⁶⁴). An
/// engine that runs this scheme must hold to it to rounding, at any time step: what is left of its
/// distance from the continuous solution is truncation, and no bug.
///
/// All schemes of law.conventions.integrator are one recursion with a_k = f(x_k, w_k)/m₁₂,
///   u_{k+1/2} = u_{k−1/2} + a_k dt,  x_{k+1} = x_k + u_{k+1/2} dt
/// (Störmer's; Verlet 1967; Hairer, Lubich and Wanner 2003, section 1). They differ in
///   the first kick  u_{1/2} = v_0 + a_0 dt/2 of both Verlets, v_0 + a_0 dt of semi-implicit Euler;
///   what is shown   v_k = u_{k−1/2} + a_k dt/2 of both, so that they are one scheme in two forms;
///                   v_k = u_{k−1/2} of Euler, whose velocity of a step is the one that led to it;
///   what damps, w_k of law.conventions.dampingVelocity:
///     lagged     u_{k−1/2}; always of Euler
///     predicted  u_{k−1/2} + a_{k−1} dt/2
///     implicit   u_{k−1/2} + a_k dt/2, hence f = (−k_n x − γ_n u_{k−1/2})/(1 + γ_n dt/(2 m₁₂))
///     and v_0 itself in a_0.
/// Of what a contact remembers, JKR's bond holds from the first step with an overlap to the last
/// within its range; δ_max is that of the steps.
/// @returns steps + 1 of them, the start first
/// @throws std::invalid_argument for a rigid law
std::vector<DiscreteMotion> discreteImpact(const ContactLaw& law, const DiscreteStart& start,
                                           std::size_t steps);

}  // namespace crossgrain::inline oracle

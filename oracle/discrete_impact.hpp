#pragma once

#include <cstddef>
#include <vector>

#include "oracle/collision_end.hpp"

namespace crossgrain::inline oracle {

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

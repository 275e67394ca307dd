#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cases/case.hpp"

namespace crossgrain::inline cases {

/// The bodies that give way most readily in a case, as bounds over all pairs.
struct LightestPair {
  double normal = 0.0;      ///< m₁₂: dv_n/dt = f_n/m₁₂ [kg]
  double tangential = 0.0;  ///< 1/(1/m₁₂ + a_i²/J_i + a_j²/J_j): dv_t/dt = f_t/it [kg]
};
/// That the case's own numbers allow; of the two bodies in a collision.
LightestPair lightestPair(const Case& c);
/// Of these disks, which walls as heavy as can be surround.
LightestPair lightestPair(const Disks& disks, bool rotation);

/// m₁₂ of the lightest pair of disks that the case's own numbers allow, the one with the shortest
/// contact [kg]; that of the two bodies in a collision.
double lightestReducedMass(const Case& c);

/// [run] dt, else the contact time of the lightest pair divided by steps_per_contact [s].
/// Of a collision: the first of its sweeps.
double timeStep(const Case& c);

/// The shortest and the longest impact of a collision case: they differ where the contact time
/// depends on the speed, and there are several [s]. Zero for a rigid law.
struct ImpactTimes {
  double shortest = 0.0, longest = 0.0;
};
ImpactTimes impactTimes(const Case& c);

/// The time step of each sweep of a collision: the shortest impact's time divided by each of
/// steps_per_contact, or the one [run] dt of a rigid law [s].
std::vector<double> collisionTimeSteps(const Case& c);

/// How long a cell is shrunk and sheared until its packing is prepared [s].
double preparationTime(const Case& c);

/// Time steps that this takes, of [preparation] dt or, without one, of timeStep().
double preparationSteps(const Case& c);

/// t_c of the lightest pair under the law that makes it shortest [s].
/// @throws std::invalid_argument for a law that has none
double shortestContact(const Case& c);

/// At the start, of the two fastest of an assembly's disks and walls against each other; of a cell
/// the wheel's rim [m/s].
double startingSpeed(const Case& setup);

/// How long the lightest pair touches at that speed, under the law that makes it shortest [s].
/// @pre startingSpeed() > 0
double fastestImpactTime(const Case& setup);

/// t_c of the lightest pair that a case's own numbers allow [s]; absent for a law that has none,
/// and where the disks are a packing file's.
std::optional<double> pairContactTime(const Case& setup);

/// How long a time step a contact of the lightest pair bears, of the case's own scheme. Each of its
/// terms alone is an oscillator, m ẍ + γ ẋ + k x = 0: along the normal m = m₁₂, along the tangent,
/// while it sticks, m = 1/(1/m₁₂ + Σ a²/J), of spring and dashpot or of the viscous law. With
/// ω² = k/m and η = γ/(2m), Störmer's scheme makes of it (and velocity Verlet, the same steps; and
/// semi-implicit Euler, the same with lagged velocities)
///   dv = −(ω² ξ + 2η u) dt,  v(t + dt/2) = v(t − dt/2) + dv,  x(t + dt) = x(t) + v(t + dt/2) dt
/// with u the dashpot's velocity, v(t − dt/2) (lagged), that and dv(t − dt)/2 (predicted) or that
/// and dv(t)/2 (implicit), and ξ = x along the normal. The tangential spring sums up u dt (lagged
/// also where u is implicit) with or without that of this step, or with half of it
/// (SpringUpdate). A solution that changes its sign with every step, dv ∝ (−1)ⁿ, neither grows nor
/// dies where
///   c σ ω²dt² + 4 s η dt = 4:  s = 1 (lagged), 2 (predicted), 0 (implicit);  σ = 1, of a
///   tangential spring stretched before, midpoint or after 1, 0, −1;  c = 1, of it and a predicted
///   u 2, dt = 2/(s η + √(s² η² + c σ ω²)),
/// and beyond grows. No spring bears ω dt > 2 either, but beside an implicit dashpot with σ < 1:
/// stretched after the force, with a lagged u, it has z² − (2 − h) z + 1 − h + ω²dt² = 0 with
/// h = 2η dt, stable for ω²dt² < h < 2 + ω²dt²/2 only. The smaller of both is the limit: what is
/// within may still be unstable slowly, what is beyond is so for certain.
/// Disks with several contacts bear less: six of them 1/√6 of it without dashpots.
struct PairStepLimit {
  double dt;         ///< [s]
  const char* term;  ///< "normal", "tangential", "rolling"
  double stiffness;  ///< k of that term [N/m]
  double damping;    ///< γ of it [kg/s]
  double mass;       ///< m of it [kg]
};

/// Of the term that bears least. Absent for a rigid law, whose impulses have no such limit, and for
/// collisions, whose steps are shares of their contact time. A law that stiffens is taken where an
/// impact is deepest: at the wheel's rim speed, or with the relative speed of the two fastest of an
/// assembly's disks and walls at its start; absent where all of them rest.
/// @param lightest  where it is known better than from the case
std::optional<PairStepLimit> pairStepLimit(const Case& setup,
                                           std::optional<LightestPair> lightest = {});

/// "run.dt = 1 s: beyond the 0.00139 s that the normal spring of the lightest contact bears (…)",
/// empty if it is not.
std::string unstableStepFault(const Case& setup, double dt, const std::string& key,
                              std::optional<LightestPair> lightest = {});

/// "the time step of … is beyond what a disk with six contacts bears, 1/√6 of what one does": as
/// many as a triangular lattice has; empty if it is not.
std::string riskyStepFault(const Case& setup, double dt);

}  // namespace crossgrain::inline cases

#pragma once

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

}  // namespace crossgrain::inline cases

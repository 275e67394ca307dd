#pragma once

#include <vector>

#include "cases/case.hpp"

namespace crossgrain {

/// Duration of a contact of the linear law with tension, t_c = π/ω with ω² = k_n/m₁₂ − η² and
/// η = γ_n/(2 m₁₂) (Lätzel 2003, section 4.1; facts: 2.18 ms for two small disks) [s].
/// @param reducedMass m₁₂ [kg]
/// @throws std::invalid_argument for a rigid law, which has none, and an overdamped one
double contactTime(const ContactLaw& law, double reducedMass);

/// m₁₂ of the lightest pair of disks that the case's own numbers allow, the one with the shortest
/// contact [kg]; that of the two bodies in a collision.
double lightestReducedMass(const Case& c);

/// [run] dt, else the contact time of the lightest pair divided by steps_per_contact [s].
/// Of a collision: the first of its sweeps.
double timeStep(const Case& c);

/// The time step of each sweep of a collision: t_c divided by each of steps_per_contact, or the one
/// [run] dt of a rigid law [s].
std::vector<double> collisionTimeSteps(const Case& c);

}  // namespace crossgrain

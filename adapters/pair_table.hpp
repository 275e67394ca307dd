#pragma once

#include <functional>
#include <vector>

#include "adapters/engine.hpp"

namespace crossgrain {

/// The constants that a law has: springs and dashpots of a soft one, restitutions of a rigid one,
/// and those of tangential forces as far as it has such forces; 0 of what it does not have.
PairCoefficients coefficientsOf(const ContactLaw& law);

/// One row for each kind of pair that the scene can bring together: each two of its distinct disks
/// (radius, mass and material), and each of them with a wall, of each material that walls have.
/// @param coefficients  of the pairs of that law and reduced mass [kg]; their name is set here
template <int D>
std::vector<PairCoefficients> pairTable(
    const SceneOf<D>& scene,
    const std::function<PairCoefficients(const ContactLaw& law, double reducedMass)>& coefficients);

/// The same where the law makes no difference.
std::vector<PairCoefficients> pairTable(
    const Scene& scene, const std::function<PairCoefficients(double reducedMass)>& coefficients);

}  // namespace crossgrain

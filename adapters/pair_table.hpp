#pragma once

#include <functional>
#include <vector>

#include "adapters/engine.hpp"

namespace crossgrain {

/// One row for each kind of pair that the scene can bring together: each two of its distinct disks
/// (radius and mass), and each of them with a wall.
/// @param fill  sets the coefficients of one row from the pair's reduced mass [kg]
std::vector<PairCoefficients> pairTable(
    const Scene& scene, const std::function<void(PairCoefficients& row, double reducedMass)>& fill);

}  // namespace crossgrain

#pragma once

#include <string>

#include "adapters/scene.hpp"

namespace crossgrain::inline cases {

/// Numbers of a scene that no double is good enough for, beginning with a colon; empty: nothing.
///
/// A place 10¹⁰ diameters of the smallest disk from the origin is exact to 10⁻⁶ of one
/// (ε = 1.1·10⁻¹⁶), as little as a contact overlaps; differences and squares of such places are
/// numbers still. What moves by more than 10⁴ of them in a step (|v| dt, |ω| a dt of a surface,
/// |g| dt²) meets nothing on its way: soft contacts last many steps, so that in a right scene it is
/// below one. Masses and moments of inertia have reciprocals, and energies are finite.
template <int D>
std::string beyondNumbers(const SceneOf<D>& scene);

}  // namespace crossgrain::inline cases

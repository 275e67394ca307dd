#pragma once

#include <cstdint>
#include <vector>

#include "adapters/scene.hpp"
#include "stability/placement.hpp"

namespace crossgrain::inline stability {

/// Units in which a scene is expressed anew: every length of it is multiplied by `length`, and so
/// on.
struct Units {
  double length = 1.0, mass = 1.0, time = 1.0;

  /// What a quantity of dimension L^l M^m T^t is multiplied by.
  double of(int l, int m, int t) const;
  bool operator==(const Units&) const = default;
};

/// What may be done to a scene without any change of what happens in it.
struct Transform {
  Placement placement = {};             ///< mirrored and turned
  Units units = {};                     ///< expressed in other units
  std::vector<std::size_t> order = {};  ///< disk k is disk order[k] of the scene; empty: as it was
};

/// Constants of a law in other units, by dimensional analysis of the equations that they stand in:
/// a force is m ẍ, M L T⁻².
///   k_n δ, k_t ξ            k: M T⁻²            (Lätzel 2003, Eqs. 4.9, 4.22)
///   k_n √R δ^(3/2), k_t √(Rδ) ξ, Hertz and Mindlin: a modulus, M L⁻¹ T⁻²
///                                               (Johnson 1985, Eqs. 4.22, 7.43)
///   k_n δ² + k_n3 δ³        M L⁻¹ T⁻², M L⁻² T⁻²  (Lätzel 2003, Fig. 4.4)
///   γ v                     γ: M T⁻¹
///   γ S v, S a stiffness    γ: T                (Brilliantov et al. 1996)
///   γ √(m S) v              γ: 1                (Tsuji et al. 1992)
///   µ, e_n, e_t0            1
ContactLaw inUnits(ContactLaw law, const Units& units);

/// A scene in other units: beside its law
///   x, a: L · v: L T⁻¹ · m: M · J: M L² · ω, Ω, angular frequencies: T⁻¹ · g: L T⁻² · dt: T,
///   and of the bottom plate (Eqs. 4.27–4.29) k_b: M T⁻², γ_b: M T⁻¹, µ_b and τ_M: 1.
Scene inUnits(Scene scene, const Units& units);

/// Mirrored and turned about the origin with everything in it: walls, their motion, gravity, spins.
/// The placement's offset and boost are left alone.
/// @pre placement.offset and placement.boost are 0
Scene placed(Scene scene, const Placement& placement);

/// Disks numbered otherwise. @pre a permutation of them
Scene renumbered(Scene scene, const std::vector<std::size_t>& order);

Scene transformed(const Scene& scene, const Transform& by);

/// Where disks of the transformed scene would be in the scene, numbered as there [m].
std::vector<Vec2> placesBack(const Transform& by, const std::vector<Vec2>& position);
/// The same of spins [rad/s].
std::vector<double> spinsBack(const Transform& by, const std::vector<double>& spin);

/// An order without a system, the same for the same number.
std::vector<std::size_t> shuffledOrder(std::size_t disks, std::uint64_t seed);

/// Disks moved as far as rounding may move them when a scene is expressed otherwise: each
/// coordinate of a position by ± ε(|x| + a), of a velocity by ± ε|v|, spins by ± ε|ω|. A turned
/// vector's coordinates come from three rounded operations, half an ε each, of numbers as large as
/// |x|.
/// @param epsilon  of the numbers that an engine steps with
Disks nudged(Disks disks, double epsilon, std::uint64_t seed);

/// The farthest that anything of a scene is from the origin [m].
double extentOf(const Scene& scene);

}  // namespace crossgrain::inline stability

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

  /// Factor of a quantity of dimension L^l M^m T^t.
  double of(int l, int m, int t) const;
  bool operator==(const Units&) const = default;
};

/// Transformations of a scene without any change of what happens in it.
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
template <int D>
SceneOf<D> inUnits(SceneOf<D> scene, const Units& units);

/// Mirrored and turned about the origin with everything in it: walls, their motion, gravity, spins.
/// The placement's offset and boost are left alone.
/// @pre placement.offset and placement.boost are 0; turnsBox() where the scene has a periodic box
template <int D>
SceneOf<D> placed(SceneOf<D> scene, const Placement& placement);

/// A direction mirrored and turned, and back. In space x → −x is a mirror as well, and the turn is
/// about (1, 1, 1), so that 120° take x to y, y to z and z to x.
inline Vec2 placedDirection(const Placement& placement, const Vec2& direction) {
  return placement.turned(direction);
}
Vec3 placedDirection(const Placement& placement, const Vec3& direction);
inline Vec2 directionBack(const Placement& placement, const Vec2& direction) {
  return placement.turnedBack(direction);
}
Vec3 directionBack(const Placement& placement, const Vec3& direction);

/// Whether a placement takes axes to axes, as a box of them has to stay one.
template <int D>
bool turnsBox(const Placement& placement);

/// Disks numbered otherwise. @pre a permutation of them
template <int D>
SceneOf<D> renumbered(SceneOf<D> scene, const std::vector<std::size_t>& order);

template <int D>
SceneOf<D> transformed(const SceneOf<D>& scene, const Transform& by);

/// Where disks of the transformed scene would be in the scene, numbered as there [m].
template <int D>
std::vector<VecOf<D>> placesBack(const Transform& by, const std::vector<VecOf<D>>& position);
/// The same of spins [rad/s].
template <int D = 2>
std::vector<SpinOf<D>> spinsBack(const Transform& by, const std::vector<SpinOf<D>>& spin);

/// An order without a system, the same for the same number.
std::vector<std::size_t> shuffledOrder(std::size_t disks, std::uint64_t seed);

/// Disks moved as far as rounding may move them when a scene is expressed otherwise: each
/// coordinate of a position by ± ε(|x| + a), of a velocity by ± ε|v|, spins by ± ε|ω|. A turned
/// vector's coordinates come from three rounded operations, half an ε each, of numbers as large as
/// |x|.
/// @param epsilon  of the numbers that an engine steps with
template <int D>
DisksOf<D> nudged(DisksOf<D> disks, double epsilon, std::uint64_t seed);

/// The farthest that anything of a scene is from the origin [m].
template <int D>
double extentOf(const SceneOf<D>& scene);

}  // namespace crossgrain::inline stability

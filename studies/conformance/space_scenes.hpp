#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "studies/conformance/check_context.hpp"

/// Parts of scenes of equal bodies, most of them spheres in space.
namespace crossgrain::conformance {

inline constexpr double radius = 0.005, mass = 1.309e-3;  ///< [m, kg]

/// Linear, with a spring and dampers; e_n = 0.8.
inline ContactLaw dampedLaw(int dimension) {
  ContactLaw law;
  law.dimension = dimension;
  law.kn = 1e5;
  law.gn = 1.15;
  law.kt = 2e5 / 7.0;
  law.gt = 0.33;
  law.mu = 0.5;
  law.en = 0.8;
  law.conventions.leverArm = LeverArm::overlapMiddle;
  return law;
}

/// A scene without bodies, its law as the engine has it.
inline SpaceScene emptySpace(const CheckContext& c, const char* name) {
  SpaceScene scene;
  scene.name = name;
  scene.law = followed(c.can, dampedLaw(3));
  scene.dt = 4e-6;
  return scene;
}

/// How far single precision takes what is left of an impact of two such at that speed, by a part of
/// it: what a contact of half an oscillation walks (check_context.hpp), by its depth v √(m₁₂/k_n).
/// @param place  as far as they are from the origin [m]
inline double roundedImpact(const CheckContext& c, double place, double speed) {
  const double swing = std::sqrt(0.5 * mass / dampedLaw(3).kn);  // 1/ω [s]
  const double steps = std::max(std::numbers::pi * swing / c.effective.dt, 1.0);
  return roundedInContact(c.can, place, steps) / (speed * swing);
}

/// A solid disk or sphere.
template <int D>
void addBody(SceneOf<D>& scene, const VecOf<D>& place, const VecOf<D>& velocity,
             const SpinOf<D>& spin) {
  addRound<D>(scene, radius, mass, D == 2 ? solidDisk : 0.4, place, velocity, spin);
}

}  // namespace crossgrain::conformance

#pragma once

#include "cases/case.hpp"
#include "oracle/collision_oracle.hpp"

/// Two small disks of the thesis (Lätzel 2003, Tables 3.1 and 4.1).
namespace test {

inline constexpr double radius = 3.7e-3;
inline constexpr double mass = 0.275e-3;
inline constexpr double contactTime = 2.18e-3;  ///< π/ω, rounded [s]

inline crossgrain::ContactLaw thesisLaw() {
  crossgrain::ContactLaw law;
  law.kn = 352.1;
  law.gn = 0.19;
  law.kt = 267.1;
  law.gt = 0.15;
  law.mu = 0.44;
  return law;
}

inline crossgrain::CollidingPair smallPair() {
  const double inertia = 0.5 * mass * radius * radius;
  return {{radius, radius}, {mass, mass}, {inertia, inertia}};
}

/// A small disk and one of three times its radius, twenty times its mass and another inertia
/// factor.
inline crossgrain::CollidingPair unequalPair() {
  crossgrain::CollidingPair pair = smallPair();
  pair.radius[1] = 3.0 * radius;
  pair.mass[1] = 20.0 * mass;
  pair.inertia[1] = 0.4 * pair.mass[1] * pair.radius[1] * pair.radius[1];
  return pair;
}

inline crossgrain::Case smallPairCase() {
  crossgrain::Case setup;
  setup.name = "pair";
  setup.kind = crossgrain::CaseKind::collision;
  setup.law = thesisLaw();
  for (const int side : {0, 1}) {
    setup.collision.radius[side] = radius;
    setup.collision.mass[side] = mass;
  }
  return setup;
}

}  // namespace test

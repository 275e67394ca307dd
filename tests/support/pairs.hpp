#pragma once

#include "cases/case.hpp"
#include "oracle/collision_end.hpp"
#include "tests/support/laws.hpp"
#include "tests/support/thesis.hpp"

/// Pairs of disks that collide.
namespace crossgrain::test {

/// Two small disks of the thesis.
inline CollidingPair smallPair() {
  return {{smallRadius, smallRadius}, {smallMass, smallMass}, {smallInertia, smallInertia}};
}

/// A small disk and one of three times its radius, twenty times its mass and another inertia
/// factor.
inline CollidingPair unequalPair() {
  CollidingPair pair = smallPair();
  pair.radius[1] = 3.0 * smallRadius;
  pair.mass[1] = 20.0 * smallMass;
  pair.inertia[1] = 0.4 * pair.mass[1] * pair.radius[1] * pair.radius[1];
  return pair;
}

/// Two small disks under the thesis' law, as a case has them.
inline Case smallPairCase() {
  Case setup{.name = "pair", .source = Collision(), .law = thesisLaw()};
  for (const int side : {0, 1}) {
    collisionIn(setup).radius[side] = smallRadius;
    collisionIn(setup).mass[side] = smallMass;
  }
  return setup;
}

}  // namespace crossgrain::test

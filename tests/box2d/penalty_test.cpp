// Tests of the penalty engine alone: the conformance suite compares its forces, loads, plate
// and materials with the in-house engine, and its impacts with the oracles.
#include <gtest/gtest.h>

#include "tests/box2d/scenes.hpp"

namespace crossgrain::test {
namespace {

constexpr double fine = smallContactTime / 1000.0;
constexpr double slow = 1e-4;  // [m/s]: overlaps of 1e-7 m, and the normal stays where it is

Scene onePair(const ContactLaw& law, double psi, double dt) {
  Scene scene{.law = law, .dt = dt};
  addPair(scene, Vec2::Zero(), slow, psi, 1e-9);
  return scene;
}

/// Without dashpots and sliding all that the motion lacks is in the two springs.
TEST(Box2dPenalty, EnergyIsInMotionAndSprings) {
  ContactLaw law = box2dLaw(TangentialLaw::spring);
  law.gn = law.gt = 0.0;
  law.mu = 100.0;
  const Scene scene = onePair(law, 1.0, fine);
  const auto engine = makeBox2dPenalty();
  const auto sum = [](const Snapshot& at) { return at.energies->kinetic + at.energies->elastic; };
  const Snapshot before = runTo(*engine, scene, 0.0);
  engine->advance(0.25 * smallContactTime);
  const Snapshot within = engine->snapshot(ContactReport::instant);
  EXPECT_LT(within.energies->kinetic, 0.8 * before.energies->kinetic);
  EXPECT_NEAR(sum(within), sum(before), 5e-3 * sum(before));
}

TEST(Box2dPenalty, SlowDiskMoves) {
  Scene scene{.law = box2dLaw(), .dt = 4e-5};
  addDisk(scene, smallRadius, smallMass, Vec2(0.2, 0), Vec2(1e-6, 0));
  const auto engine = makeBox2dPenalty();
  const double t = engine->load(scene, {}).dt * 25000;
  engine->advance(t);
  EXPECT_NEAR(engine->snapshot(ContactReport::none).position[0].x(), 0.2 + 1e-6 * t, 1e-12);
}

TEST(Box2dPenalty, RefusesRigidContacts) {
  Scene scene = onePair(rigidLaw(0.5, 0.0, 0.4), 0.0, fine);
  EXPECT_THROW(makeBox2dPenalty()->load(scene, {}), UnsupportedScene);
}

}  // namespace
}  // namespace crossgrain::test

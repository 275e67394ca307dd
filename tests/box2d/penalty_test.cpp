#include <gtest/gtest.h>

#include <algorithm>

#include "tests/box2d/scenes.hpp"

namespace crossgrain::test {
namespace {

constexpr double fine = smallContactTime / 1000.0;
constexpr double slow = 1e-4;  // [m/s]: overlaps of 1e-7 m, and the normal stays where it is

Scene onePair(const ContactLaw& law, double psi, double dt) {
  Scene scene;
  scene.law = law;
  scene.dt = dt;
  addPair(scene, Vec2::Zero(), slow, psi, 1e-9);
  return scene;
}

TEST(Box2dPenalty, RestitutionWithTensionAndCut) {
  const auto engine = makeBox2dPenalty();
  for (const auto& [tension, en] : {std::pair{Tension::allow, 0.2223}, {Tension::cut, 0.3408}}) {
    Scene scene = onePair(box2dLaw(), 0.0, fine);
    scene.law.conventions.tension = tension;
    const Outcome got = outcome(runTo(*engine, scene, 3.0 * smallContactTime), 0, slow);
    EXPECT_NEAR(got.en, en, 0.01 * en);
  }
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

TEST(Box2dPenalty, KeepsMomentumAndWithContactPointArmsAngularMomentum) {
  Scene scene;
  scene.law = box2dLaw();
  scene.law.conventions.leverArm = LeverArm::contactPoint;
  scene.dt = 4e-5;
  addDisk(scene, smallRadius, smallMass, Vec2(0, 0), Vec2(0.1, 0.02), 8.0);
  addDisk(scene, largeRadius, largeMass, Vec2(8.3e-3, 2e-3), Vec2(-0.05, 0), -3.0);
  const auto momentum = [&](const Snapshot& at) {
    return Vec2(smallMass * at.velocity[0] + largeMass * at.velocity[1]);
  };
  const auto angular = [&](const Snapshot& at) {
    double sum = 0.0;
    for (std::size_t i = 0; i < 2; ++i)
      sum += scene.disks.mass[i] * cross(at.position[i], at.velocity[i]) +
             scene.disks.inertia[i] * (*at.spin)[i];
    return sum;
  };
  const auto engine = makeBox2dPenalty();
  const Snapshot before = runTo(*engine, scene, 0.0);
  engine->advance(0.02);
  const Snapshot after = engine->snapshot(ContactReport::none);
  EXPECT_GT((after.velocity[0] - before.velocity[0]).norm(), 0.05);  // they did collide
  EXPECT_NEAR((momentum(after) - momentum(before)).norm(), 0.0, 1e-13 * momentum(before).norm());
  // x × v of the semi-implicit Euler scheme is exact for central forces; 1e-12: rounding.
  EXPECT_NEAR(angular(after), angular(before), 1e-12 * std::abs(angular(before)));
}

TEST(Box2dPenalty, ContactsAndWallForcesAreThoseOfTheMoment) {
  Scene scene;
  scene.law = box2dLaw();
  scene.dt = 4e-5;
  addDisk(scene, smallRadius, smallMass, Vec2(0, 0), Vec2(0.1, 0.03), 5.0);
  scene.bodies = {diskWall(Vec2(smallRadius + wallRadius - 1e-5, 0), wallRadius)};
  scene.bodies[0].centre = Vec2(0, 0.1);
  const auto engine = makeBox2dPenalty();
  const Snapshot start = runTo(*engine, scene, 0.0);
  ASSERT_EQ(start.contacts->size(), 1u);
  // By hand: δ = 1e-5 m, n = −x, v_n = −0.1 m/s, v_t = −0.03 − a·5 = −0.0485 m/s, ξ = 0.
  const double normal = thesis.kn * 1e-5 + thesis.gn * 0.1;
  const double tangential = std::min(thesis.gt * 0.0485, thesis.mu * normal);
  EXPECT_NEAR(start.contacts->overlap[0], 1e-5, 1e-15);
  EXPECT_NEAR(start.contacts->normalForce[0], normal, 1e-12);
  EXPECT_NEAR(start.contacts->tangentialForce[0], tangential, 1e-12);
  // On i: (−f_n, −f_t), as z × n = −y; on the wall the opposite, at the wall disk's own centre.
  EXPECT_NEAR((*start.bodies[0].force - Vec2(normal, tangential)).norm(), 0.0, 1e-12);
  EXPECT_NEAR(
      *start.bodies[0].torque,
      (smallRadius + wallRadius - 1e-5) * tangential + 0.1 * normal - wallRadius * tangential,
      1e-14);
  engine->advance(4e-5);
  const Snapshot next = engine->snapshot(ContactReport::instant);
  EXPECT_NEAR(next.velocity[0].x(), 0.1 - 4e-5 * normal / smallMass, 1e-15);
  EXPECT_EQ(next.contactTime, next.positionTime);
}

TEST(Box2dPenalty, SlowDiskMoves) {
  Scene scene;
  scene.law = box2dLaw();
  scene.dt = 4e-5;
  addDisk(scene, smallRadius, smallMass, Vec2(0.2, 0), Vec2(1e-6, 0));
  const auto engine = makeBox2dPenalty();
  const double t = engine->load(scene, {}).dt * 25000;
  engine->advance(t);
  EXPECT_NEAR(engine->snapshot(ContactReport::none).position[0].x(), 0.2 + 1e-6 * t, 1e-12);
}

// Bound µ_b m g holds all the time: v falls by µ_b g t, ω by (4/3) µ_b g t/a (torque (2/3) a µ_b m
// g on ½ m a²).
TEST(Box2dPenalty, BottomPlateBrakes) {
  Scene scene;
  scene.law = box2dLaw();
  scene.dt = 4e-5;
  scene.bottom = thesisBottom<BottomPlate>(2e-3);
  addDisk(scene, smallRadius, smallMass, Vec2(0, 0), Vec2(0.01, 0), 10.0);
  const auto engine = makeBox2dPenalty();
  const Snapshot after = runTo(*engine, scene, 0.2);
  EXPECT_NEAR(after.velocity[0].x(), 0.01 - 2e-3 * 9.81 * 0.2, 1e-6);
  EXPECT_NEAR((*after.spin)[0], 10.0 - 4.0 / 3.0 * 2e-3 * 9.81 / smallRadius * 0.2, 1e-6);
}

TEST(Box2dPenalty, RefusesRigidContacts) {
  Scene scene = onePair(rigidLaw(0.5, 0.0, 0.4), 0.0, fine);
  EXPECT_THROW(makeBox2dPenalty()->load(scene, {}), UnsupportedScene);
}

TEST(Box2dPenalty, PairsOfMaterials_HaveTheirOwnLaws) {
  Scene scene;
  scene.law = box2dLaw();
  scene.law.gn = 0.0;
  scene.dt = 4e-5;
  addDisk(scene, smallRadius, smallMass, {0.0, smallRadius - 1e-5}, Vec2::Zero());
  addDisk(scene, smallRadius, smallMass, {2.0 * smallRadius - 1e-5, smallRadius - 1e-5},
          Vec2::Zero());
  scene.bodies = {planeWall({0.0, 0.0}, {0.0, 1.0})};
  ContactLaw soft = scene.law, hard = scene.law, mixed = scene.law;
  hard.kn = 4.0 * soft.kn;
  mixed.kn = 2.0 * soft.kn;
  scene.materials = Materials{{"soft", "hard"}, {0, 1}, {1}, {soft, mixed, mixed, hard}};
  const auto engine = makeBox2dPenalty();
  const Snapshot start = runTo(*engine, scene, 0.0);
  ASSERT_EQ(start.contacts->size(), 3u);
  for (std::size_t k = 0; k < 3; ++k) {
    const bool bothHard = start.contacts->i[k] == 1;
    EXPECT_NEAR(start.contacts->normalForce[k], (bothHard ? 4.0 : 2.0) * soft.kn * 1e-5, 1e-9);
  }
}

}  // namespace
}  // namespace crossgrain::test

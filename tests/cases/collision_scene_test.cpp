#include "cases/collision_scene.hpp"
#include "oracle/collision_end.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/pairs.hpp"

namespace {

using namespace crossgrain;

TEST(CollisionScene, Pairs_HeadOn_WithPsi) {
  Case setup = test::smallPairCase();
  collisionIn(setup).radius[1] = 2.0 * test::smallRadius;
  collisionIn(setup).mass[1] = 8.0 * test::smallMass;
  const Scene scene = collisionScene(setup, {{0.5, 0.1}, {3.0, 0.2}}, 1e-4);
  ASSERT_EQ(scene.disks.size(), 4u);
  for (std::size_t k = 0; k < 2; ++k) {
    const double vn = k == 0 ? 0.1 : 0.2, psi = k == 0 ? 0.5 : 3.0;
    const std::size_t i = 2 * k, j = i + 1;
    const Vec2 apart = scene.disks.position[i] - scene.disks.position[j];
    const Vec2 velocity = scene.disks.velocity[i] - scene.disks.velocity[j];
    const double reach = 3.0 * test::smallRadius;
    EXPECT_NEAR(apart.norm(), reach + 0.5 * 1e-4 * vn, 1e-15);  // touch half a step after the start
    EXPECT_NEAR(velocity.dot(apart.normalized()), -vn, 1e-15);
    const double slip = -(scene.disks.radius[i] * scene.disks.spin[i] +
                          scene.disks.radius[j] * scene.disks.spin[j]);
    EXPECT_NEAR(slip, psi * vn, 1e-14);
    const Vec2 momentum = scene.disks.mass[i] * scene.disks.velocity[i] +
                          scene.disks.mass[j] * scene.disks.velocity[j];
    EXPECT_NEAR(momentum.norm(), 0.0, 1e-18);
  }
}

/// One disk of a kind is enough for the kind.
TEST(PairsOf, CellOfOneDisk_HasThatKindAndTheWall) {
  Case setup = test::smallPairCase();
  setup.source = Couette();
  couetteIn(setup).particles.small = 1;
  couetteIn(setup).particles.large = 0;
  couetteIn(setup).particles.smallRadius = couetteIn(setup).cell.wallRadius = test::smallRadius;
  couetteIn(setup).particles.smallMass = test::smallMass;
  const auto names = [&] {
    std::vector<std::string> all;
    for (const NamedPair& pair : pairsOf(setup)) all.push_back(pair.name);
    return all;
  };
  EXPECT_EQ(names(), (std::vector<std::string>{"small-small", "small-wall"}));
  std::swap(couetteIn(setup).particles.small, couetteIn(setup).particles.large);
  EXPECT_EQ(names(), (std::vector<std::string>{"large-large", "large-wall"}));
}

TEST(CollisionScene, Oblique_NoSpin_TouchesOnTheAxis) {
  Case setup = test::smallPairCase();
  collisionIn(setup).mass[1] = 8.0 * test::smallMass;
  const double dt = 1e-4;
  const Scene scene = collisionScene(setup, {{2.0, 0.1, Approach::oblique}}, dt);
  const Vec2 velocity = scene.disks.velocity[0] - scene.disks.velocity[1];
  EXPECT_NEAR(velocity.x(), -0.1, 1e-15);
  EXPECT_NEAR(velocity.y(), 0.2, 1e-15);  // z × n is +y
  EXPECT_EQ(scene.disks.spin, (std::vector<double>{0.0, 0.0}));
  const Vec2 touch = scene.disks.position[0] - scene.disks.position[1] + 0.5 * dt * velocity;
  EXPECT_NEAR(touch.x(), 2.0 * test::smallRadius, 1e-16);
  EXPECT_NEAR(touch.y(), 0.0, 1e-16);
}

TEST(CollisionScene, End_AtSeparation_WithItsNormal) {
  // Disks of radius 1 that parted at (2, 0) with velocity (0.3, 0.4) and spin −0.5 each, 10 s ago.
  Case setup = test::smallPairCase();
  collisionIn(setup).radius[0] = collisionIn(setup).radius[1] = 1.0;
  const CollisionStart start{1.0, 0.5};
  const Scene scene = collisionScene(setup, {start}, 1e-4);
  Snapshot after;
  after.position = {Vec2(2.0 + 3.0, 4.0), Vec2(0.0, 0.0)};
  after.velocity = {Vec2(0.3, 0.4), Vec2(0.0, 0.0)};
  after.spin = {{-0.5, -0.5}};
  after.positionTime = 10.5;
  const auto end = collisionEnd(scene, after, 0, start);
  ASSERT_TRUE(end);
  EXPECT_NEAR(end->en, 0.3 / 0.5, 1e-12);
  EXPECT_NEAR(end->psi, (0.4 + 1.0) / 0.5, 1e-12);
  EXPECT_NEAR(*end->beta, -2.8, 1e-12);
  EXPECT_NEAR(end->centrePsi, 0.8, 1e-12);
  EXPECT_FALSE(end->et);
  EXPECT_NEAR(end->reboundAngle, std::atan2(4.0, 3.0), 1e-12);
  EXPECT_EQ(end->spin[1], -0.5);
  // They touched half a step after the start and parted 10 s before what is seen at 10.5 s.
  EXPECT_NEAR(*end->duration, 0.5 - 0.5e-4, 1e-12);
  EXPECT_FALSE(end->maxOverlap);
  EXPECT_FALSE(end->lost);
}

TEST(CollisionScene, End_OfATouchingPair_IsAbsent) {
  const CollisionStart start{1.0, 0.5};
  const Scene scene = collisionScene(test::smallPairCase(), {start}, 1e-4);
  Snapshot after;
  after.position = {Vec2(1.9 * test::smallRadius, 0.0), Vec2(0.0, 0.0)};
  after.velocity = {Vec2(0.1, 0.0), Vec2(0.0, 0.0)};
  EXPECT_FALSE(collisionEnd(scene, after, 0, start));
  after.position[0].x() = 2.1 * test::smallRadius;
  after.velocity[0].x() = -0.1;  // still approaching
  EXPECT_FALSE(collisionEnd(scene, after, 0, start));
}

}  // namespace

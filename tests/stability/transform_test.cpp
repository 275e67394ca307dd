// A scene told otherwise, by numbers that can be followed on paper.
#include "stability/transform.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace {

using namespace crossgrain;

/// Two disks, one paddle, gravity downwards.
Scene small() {
  Scene scene;
  scene.disks.radius = {1.0, 2.0};
  scene.disks.mass = {3.0, 4.0};
  scene.disks.inertia = {5.0, 6.0};
  scene.disks.position = {{1.0, 2.0}, {-3.0, 4.0}};
  scene.disks.velocity = {{3.0, 4.0}, {0.0, 2.0}};
  scene.disks.spin = {5.0, -4.0};
  WallBody paddle;
  paddle.centre = {7.0, 0.0};
  paddle.planes = {{{7.0, 1.0}, {1.0, 0.0}}};
  paddle.motion.velocity = {0.0, 2.0};
  paddle.motion.angularVelocity = 3.0;
  scene.bodies.push_back(paddle);
  scene.gravity = {0.0, -10.0};
  scene.dt = 0.5;
  return scene;
}

/// x → −x, then a quarter turn: (x, y) → (−x, y) → (−y, −x).
const Transform mirrored{.placement = {.mirror = true, .turn = 0.5 * std::numbers::pi}};

TEST(Transform, AMirroredSceneTurnsTheOtherWay) {
  const Scene scene = transformed(small(), mirrored);
  EXPECT_EQ(scene.disks.position, (std::vector<Vec2>{{-2.0, -1.0}, {-4.0, 3.0}}));
  EXPECT_EQ(scene.disks.velocity, (std::vector<Vec2>{{-4.0, -3.0}, {-2.0, 0.0}}));
  EXPECT_EQ(scene.disks.spin, (std::vector<double>{-5.0, 4.0}));
  const WallBody& paddle = scene.bodies.front();
  EXPECT_EQ(paddle.centre, Vec2(0.0, -7.0));
  EXPECT_EQ(paddle.planes.front().point, Vec2(-1.0, -7.0));
  EXPECT_EQ(paddle.planes.front().normal, Vec2(0.0, -1.0));
  EXPECT_EQ(paddle.motion.velocity, Vec2(-2.0, 0.0));
  EXPECT_EQ(paddle.motion.angularVelocity, -3.0);
  EXPECT_EQ(scene.gravity, Vec2(10.0, 0.0));
}

TEST(Transform, ATurnedSceneTurnsAsBefore) {
  const Scene scene = placed(small(), {.turn = 0.5 * std::numbers::pi});  // (x, y) → (−y, x)
  EXPECT_EQ(scene.disks.position, (std::vector<Vec2>{{-2.0, 1.0}, {-4.0, -3.0}}));
  EXPECT_EQ(scene.disks.spin, (std::vector<double>{5.0, -4.0}));
  EXPECT_EQ(scene.bodies.front().motion.angularVelocity, 3.0);
}

TEST(Transform, InOtherUnitsNumbersAreOthers) {
  // Twice the length, three times the mass, four times the time.
  const Scene scene = inUnits(small(), {.length = 2.0, .mass = 3.0, .time = 4.0});
  EXPECT_EQ(scene.disks.radius, (std::vector<double>{2.0, 4.0}));
  EXPECT_EQ(scene.disks.mass, (std::vector<double>{9.0, 12.0}));
  EXPECT_EQ(scene.disks.inertia, (std::vector<double>{60.0, 72.0}));  // · 3 · 2²
  EXPECT_EQ(scene.disks.position, (std::vector<Vec2>{{2.0, 4.0}, {-6.0, 8.0}}));
  EXPECT_EQ(scene.disks.velocity, (std::vector<Vec2>{{1.5, 2.0}, {0.0, 1.0}}));  // · 2/4
  EXPECT_EQ(scene.disks.spin, (std::vector<double>{1.25, -1.0}));                // / 4
  EXPECT_EQ(scene.gravity, Vec2(0.0, -1.25));                                    // · 2/4²
  EXPECT_EQ(scene.dt, 2.0);
}

TEST(Transform, WhatComesOutIsTakenBack) {
  Transform by = mirrored;
  by.units = {.length = 2.0, .time = 4.0};
  by.order = {1, 0};
  const Scene scene = transformed(small(), by);
  EXPECT_EQ(scene.disks.radius, (std::vector<double>{4.0, 2.0}));
  EXPECT_EQ(scene.disks.position, (std::vector<Vec2>{{-8.0, 6.0}, {-4.0, -2.0}}));
  EXPECT_EQ(scene.disks.spin, (std::vector<double>{1.0, -1.25}));
  EXPECT_EQ(placesBack(by, scene.disks.position), small().disks.position);
  EXPECT_EQ(spinsBack(by, scene.disks.spin), small().disks.spin);
}

TEST(Transform, NudgedByTheSizeOfWhatIsRounded) {
  Disks disks;
  disks.radius = {1.0};
  disks.position = {{3.0, 4.0}};  // 5 m off the origin
  disks.velocity = {{0.0, 2.0}};
  disks.spin = {-4.0};
  const Disks nudged = crossgrain::nudged(disks, 0.125, 1);
  const Vec2 moved = nudged.position[0] - disks.position[0];
  const Vec2 pushed = nudged.velocity[0] - disks.velocity[0];
  EXPECT_EQ(std::abs(moved.x()), 0.75);  // 0.125 · (5 + 1)
  EXPECT_EQ(std::abs(moved.y()), 0.75);
  EXPECT_EQ(std::abs(pushed.x()), 0.25);
  EXPECT_EQ(std::abs(pushed.y()), 0.25);
  EXPECT_EQ(std::abs(nudged.spin[0] + 4.0), 0.5);
}

TEST(Transform, FarthestIsADisksRimOrAWallsPoint) {
  Scene scene = small();
  EXPECT_DOUBLE_EQ(extentOf(scene), std::hypot(7.0, 1.0));  // the plane's, beyond 5 + 2
  scene.bodies.clear();
  EXPECT_DOUBLE_EQ(extentOf(scene), 7.0);
}

}  // namespace

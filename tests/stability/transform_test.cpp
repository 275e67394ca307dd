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
  WallBody paddle{.centre = {7.0, 0.0}, .planes = {{{7.0, 1.0}, {1.0, 0.0}}}};
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

TEST(Transform, InOtherUnitsWallsMoveAsFast) {
  Scene scene = small();
  WallBody& wall = scene.bodies.front();
  wall.diskPosition = {{1.0, 3.0}};
  wall.diskRadius = {0.5};
  wall.motion.amplitude = {1.0, 0.5};
  wall.motion.frequency = 6.0;
  wall.motion.radialVelocity = 10.0;
  wall.motion.radialEnd = 7.0;
  const WallBody told = inUnits(scene, {.length = 2.0, .mass = 3.0, .time = 4.0}).bodies.front();
  EXPECT_EQ(told.centre, Vec2(14.0, 0.0));
  EXPECT_EQ(told.diskPosition.front(), Vec2(2.0, 6.0));
  EXPECT_EQ(told.diskRadius.front(), 1.0);
  EXPECT_EQ(told.planes.front().point, Vec2(14.0, 2.0));
  EXPECT_EQ(told.planes.front().normal, Vec2(1.0, 0.0));
  EXPECT_EQ(told.motion.velocity, Vec2(0.0, 1.0));  // · 2/4
  EXPECT_EQ(told.motion.angularVelocity, 0.75);     // / 4
  EXPECT_EQ(told.motion.amplitude, Vec2(2.0, 1.0));
  EXPECT_EQ(told.motion.frequency, 1.5);
  EXPECT_EQ(told.motion.radialVelocity, 5.0);
  EXPECT_EQ(told.motion.radialEnd, 28.0);
}

TEST(Transform, InOtherUnitsALawIsAsStiff) {
  Scene scene = small();
  scene.law.normal = NormalLaw::linear;
  scene.law.kn = scene.law.kt = 16.0;
  scene.law.gn = 8.0;
  scene.law.gt = 4.0;
  scene.bottom = BottomPlate{0.01, 32.0, 8.0, 0.1, 9.0, true};
  const Units units{.length = 2.0, .mass = 3.0, .time = 4.0};
  const Scene linear = inUnits(scene, units);
  EXPECT_EQ(linear.law.kn, 3.0);  // · 3/4²
  EXPECT_EQ(linear.law.kt, 3.0);
  EXPECT_EQ(linear.law.gn, 6.0);  // · 3/4
  EXPECT_EQ(linear.law.gt, 3.0);
  EXPECT_EQ(linear.bottom->kb, 6.0);
  EXPECT_EQ(linear.bottom->gb, 6.0);
  EXPECT_EQ(linear.bottom->gravity, 1.125);
  scene.law.normal = NormalLaw::hertz;
  scene.law.damper = Damper::viscoelastic;
  const ContactLaw hertz = inUnits(scene.law, units);
  EXPECT_EQ(hertz.kn, 1.5);  // · 3/(2 · 4²)
  EXPECT_EQ(hertz.kt, 1.5);
  EXPECT_EQ(hertz.gn, 32.0);  // · 4
  scene.law.normal = NormalLaw::polynomial;
  scene.law.damper = Damper::critical;
  scene.law.kn3 = 64.0;
  const ContactLaw polynomial = inUnits(scene.law, units);
  EXPECT_EQ(polynomial.kn, 1.5);
  EXPECT_EQ(polynomial.kn3, 3.0);  // · 3/(2² · 4²)
  EXPECT_EQ(polynomial.kt, 3.0);
  EXPECT_EQ(polynomial.gn, 8.0);
}

TEST(Transform, InOtherUnitsRollingAndCohesionAreAsStrong) {
  const Units units{.length = 2.0, .mass = 3.0, .time = 4.0};
  ContactLaw law{.rolling = RollingLaw::spring, .cohesion = CohesionLaw::area};
  law.kr = law.kc = law.w = law.kUnload = 16.0;
  law.gr = 8.0;
  law.muR = 0.5;
  const ContactLaw spring = inUnits(law, units);
  EXPECT_EQ(spring.kr, 3.0);  // N/m · 3/4²
  EXPECT_EQ(spring.gr, 6.0);  // kg/s · 3/4
  EXPECT_EQ(spring.muR, 0.5);
  EXPECT_EQ(spring.kc, 1.5);  // Pa · 3/(2 · 4²)
  EXPECT_EQ(spring.w, 3.0);
  EXPECT_EQ(spring.kUnload, 3.0);
  law.conventions.rollingStiffness = RollingStiffness::constant;
  law.conventions.rollingDamper = RollingDamper::critical;
  law.cohesion = CohesionLaw::elastoPlastic;
  const ContactLaw other = inUnits(law, units);
  EXPECT_EQ(other.kr, 12.0);  // N m · 3 · 2²/4²
  EXPECT_EQ(other.gr, 8.0);
  EXPECT_EQ(other.kc, 3.0);  // N/m
  law.rolling = RollingLaw::viscousByLoad;
  EXPECT_EQ(inUnits(law, units).muR, 1.0);  // s/m · 4/2
}

TEST(Transform, MaterialsGoWithTheirDisksAndLawsWithTheUnits) {
  Scene scene = small();
  scene.law.kn = 16.0;
  scene.materials = Materials{{"a", "b"}, {0, 1}, {1}, std::vector<ContactLaw>(4, scene.law)};
  scene.materials->laws[3].kn = 32.0;
  const Units units{.length = 2.0, .mass = 3.0, .time = 4.0};
  const Scene other = transformed(scene, {.units = units, .order = {1, 0}});
  EXPECT_EQ(other.materials->ofDisk, (std::vector<std::int32_t>{1, 0}));
  EXPECT_EQ(other.lawOf(0, 2).kn, 6.0);
  EXPECT_EQ(other.lawOf(1, 2).kn, 3.0);
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
  scene.disks.radius = {0.125};
  scene.disks.position = {{0.25, 0.0}};
  EXPECT_DOUBLE_EQ(extentOf(scene), 0.375);
}

TEST(Transform, InSpaceATurnByAThird_TakesAxesToAxes) {
  SpaceScene scene;
  scene.disks = {{1.0}, {1.0}, {1.0}, {{1, 2, 3}}, {{4, 5, 6}}, {{7, 8, 9}}};
  scene.box = {{0, -1, 0}, {10, 20, 30}, {true, false, false}};
  scene.gravity = {0, 0, -10};
  WallBodyOf<3>& drum = scene.bodies.emplace_back();
  drum.cylinders = {{{0, 1, 0}, {1, 0, 0}, 5.0}};
  drum.motion.angularVelocity = {2, 0, 0};
  const Placement third{.turn = 2.0 / 3.0 * std::numbers::pi};  // (x, y, z) → (z, x, y)
  const SpaceScene turned = placed(scene, third);
  EXPECT_EQ(turned.disks.position[0], Vec3(3, 1, 2));
  EXPECT_EQ(turned.disks.spin[0], Vec3(9, 7, 8));
  EXPECT_EQ(turned.gravity, Vec3(-10, 0, 0));
  EXPECT_EQ(turned.box->high, Vec3(30, 10, 20));
  EXPECT_EQ(turned.box->periodic, (std::array<bool, 3>{false, true, false}));
  EXPECT_EQ(turned.bodies[0].cylinders[0].axis, Vec3(0, 1, 0));
  EXPECT_EQ(turned.bodies[0].cylinders[0].point, Vec3(0, 0, 1));
  EXPECT_EQ(turned.bodies[0].motion.angularVelocity, Vec3(0, 2, 0));
  EXPECT_TRUE(turnsBox<3>(third));
  EXPECT_FALSE(turnsBox<3>({.turn = 1.0}));

  const SpaceScene inMirror = placed(scene, {.mirror = true});  // x → −x; spins are axial
  EXPECT_EQ(inMirror.disks.position[0], Vec3(-1, 2, 3));
  EXPECT_EQ(inMirror.disks.spin[0], Vec3(7, -8, -9));
  EXPECT_EQ(inMirror.box->low, Vec3(-10, -1, 0));

  for (const double turn : {1.0, 2.0 / 3.0 * std::numbers::pi}) {
    const Transform by{.placement = {.mirror = true, .turn = turn}};
    SpaceScene open = scene;
    open.box.reset();  // 1 rad turns no box
    const SpaceScene there = transformed(open, by);
    EXPECT_LE((placesBack(by, there.disks.position)[0] - Vec3(1, 2, 3)).norm(), 1e-15 * 8);
    EXPECT_LE((spinsBack<3>(by, there.disks.spin)[0] - Vec3(7, 8, 9)).norm(), 1e-15 * 16);
  }
}

}  // namespace

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "tests/box2d/scenes.hpp"

namespace crossgrain::test {
namespace {

constexpr double approach = 0.1;  // [m/s], far above the default impact_speed

Scene onePair(const ContactLaw& law, double vn, double psi, double gap = 1.3e-4) {
  Scene scene;
  scene.law = law;
  addPair(scene, Vec2::Zero(), vn, psi, gap);
  return scene;
}

TEST(Box2dImpulse, SoftLawRunsWithItsOwnRestitution) {
  const auto engine = makeBox2dImpulse();
  for (const auto& [tension, en] : {std::pair{Tension::allow, 0.2223}, {Tension::cut, 0.3408}}) {
    Scene scene = onePair(box2dLaw(), approach, 0.5);
    scene.law.conventions.tension = tension;
    const EffectiveParameters effective = engine->load(scene, {});
    ASSERT_EQ(effective.pairs.size(), 1u);
    EXPECT_NEAR(effective.pairs[0].en, en, 1e-4);
    EXPECT_NEAR(effective.pairs[0].et0, 0.11, 0.02);
    EXPECT_EQ(effective.deviations.at(0).name, "normal");
    engine->advance(0.02);
    const Outcome got = outcome(engine->snapshot(ContactReport::none), 0, approach);
    EXPECT_NEAR(got.en, en, 1e-3);
    EXPECT_NEAR(got.psiF, -0.5 * effective.pairs[0].et0, 5e-3);
  }
}

TEST(Box2dImpulse, SlowContactsGetNoTangentialRestitution) {
  const auto engine = makeBox2dImpulse();
  const double slow = 0.004;
  const Scene scene = onePair(rigidLaw(0.3, 0.5, thesis.mu), slow, 0.5, 2e-6);
  const Outcome byDefault = outcome(runTo(*engine, scene, 0.02), 0, slow);
  EXPECT_NEAR(byDefault.psiF, 0.0, 2e-3);
  EXPECT_EQ(engine->stats().counters.at("impacts"), 0.0);
  const Settings always = {{"impact_speed", 0.0}};
  EXPECT_NEAR(outcome(runTo(*engine, scene, 0.02, always), 0, slow).psiF, -0.25, 2e-3);
  EXPECT_EQ(engine->stats().counters.at("impacts"), 1.0);
}

TEST(Box2dImpulse, WhatRestsUnderGravityDoesNotRebound) {
  // At 5×10⁻⁴ s gravity gives 4.9 mm/s a step. A disk on a floor stays; one that falls from 4 mm
  // meets it with 0.28 m/s and rises to e_n² of the height.
  constexpr double en = 0.6, g = 9.81, height = 4e-3;
  Scene scene = onePair(rigidLaw(en, 0.0, thesis.mu), 0.0, 0.0);
  WallBody floor;
  floor.name = "floor";
  floor.planes.emplace_back();
  scene.bodies.push_back(floor);
  scene.gravity = {0.0, -g};
  scene.dt = 5e-4;
  const double a = scene.disks.radius[0];
  scene.disks.position = {{0.0, a}, {0.1, a + height}};
  scene.disks.velocity.assign(2, Vec2::Zero());
  const auto engine = makeBox2dImpulse();
  const EffectiveParameters effective = engine->load(scene, {});
  const auto threshold =
      std::ranges::find(effective.deviations, "restitution_threshold", &Deviation::name);
  ASSERT_NE(threshold, effective.deviations.end());
  EXPECT_NEAR(threshold->value, 2.0 * g * effective.dt, 1e-12);
  const double fall = std::sqrt(2.0 * height / g);
  double risen = 0.0;
  for (int k = 1; k <= 60; ++k) {
    engine->advance(fall * (1.1 + 0.02 * k));
    const Snapshot now = engine->snapshot(ContactReport::none);
    EXPECT_LT(now.velocity[0].norm(), 1e-6) << k;
    risen = std::max(risen, now.position[1].y() - a);
  }
  // Euler's fall is off by g t dt/2 each way.
  EXPECT_NEAR(risen, en * en * height, 0.1 * height);
}

/// Box2D's own way, the restitution of a velocity that holds the coming kick, gains g dt at every
/// bounce: 26 times its energy in this time.
TEST(Box2dImpulse, AnElasticBallRisesToItsHeightAgain) {
  constexpr double height = 12.6e-3;
  Scene scene = onePair(rigidLaw(1.0, 0.0, 0.0), 0.0, 0.0);
  scene.bodies.push_back(planeWall(Vec2::Zero(), Vec2::UnitY()));
  scene.gravity = {0.0, -9.81};
  const double a = scene.disks.radius[0];
  scene.disks.position = {{0.0, a + height}, {0.1, a}};
  scene.disks.velocity.assign(2, Vec2::Zero());
  const auto engine = makeBox2dImpulse();
  engine->load(scene, {});
  double highest = 0.0;
  for (int look = 1; look <= 4000; ++look) {
    engine->advance(5e-3 * look);
    const Snapshot now = engine->snapshot(ContactReport::none);
    if (look > 3900) highest = std::max(highest, now.position[0].y() - a);
  }
  EXPECT_NEAR(highest, height, 0.02 * height);
}

/// Force times interval is what the wall gave the disk, and likewise for the torque.
TEST(Box2dImpulse, AccumulatedImpulsesAreWhatTheDiskReceived) {
  Scene scene;
  scene.law = rigidLaw(0.6, 0.4, thesis.mu);
  addDisk(scene, smallRadius, smallMass, Vec2(0, 0), Vec2(approach, 0.03), 5.0);
  scene.bodies = {diskWall(Vec2(smallRadius + 1.35e-3, 1e-3), wallRadius)};
  const auto engine = makeBox2dImpulse();
  engine->load(scene, {});
  EXPECT_FALSE(engine->snapshot(ContactReport::instant).contacts);  // nothing has acted yet
  EXPECT_FALSE(engine->snapshot(ContactReport::none).bodies[0].force);

  const Snapshot before = engine->snapshot(ContactReport::none);
  engine->advance(0.01);
  const Snapshot after = engine->snapshot(ContactReport::accumulated);
  EXPECT_DOUBLE_EQ(after.contactInterval, 0.01);
  ASSERT_EQ(after.contacts->size(), 1u);
  EXPECT_EQ(after.contacts->i[0], 0);
  EXPECT_EQ(after.contacts->j[0], 1);
  const Vec2 gained = smallMass * (after.velocity[0] - before.velocity[0]);
  EXPECT_NEAR((gained + 0.01 * *after.bodies[0].force).norm(), 0.0, 1e-5 * gained.norm());

  const Vec2 centre = scene.bodies[0].centre;
  const auto angular = [&](const Snapshot& at) {
    return smallMass * cross(at.position[0] - centre, at.velocity[0]) +
           scene.disks.inertia[0] * (*at.spin)[0];
  };
  const double gainedAngular = angular(after) - angular(before);
  // 1e-3: the position solver moves the disk without an impulse.
  EXPECT_NEAR(gainedAngular, -0.01 * *after.bodies[0].torque, 1e-3 * std::abs(gainedAngular));

  // The pair's own forces: n has turned since, by less than a hundredth.
  const Vec2 n = after.contacts->normal[0];
  const Vec2 onDisk = 0.01 * (after.contacts->normalForce[0] * n +
                              after.contacts->tangentialForce[0] * perpendicular(n));
  EXPECT_NEAR((onDisk - gained).norm(), 0.0, 0.05 * gained.norm());

  EXPECT_EQ(engine->snapshot(ContactReport::accumulated).contactInterval, 0.0);
  engine->advance(0.02);
  EXPECT_EQ(engine->snapshot(ContactReport::accumulated).contacts->size(), 0u);
}

/// In contact all the time: each sum is of many impulses. While it slides a disk is borne by m g
/// and held back by µ m g.
TEST(Box2dImpulse, SumsOfALastingContactAreThoseOfEveryStep) {
  constexpr double g = 10.0, interval = 0.02;
  Scene scene{.law = rigidLaw(0.0, 0.0, thesis.mu), .gravity = {0.0, -g}};
  addDisk(scene, smallRadius, smallMass, Vec2(0, smallRadius), Vec2(1.0, 0.0));
  WallBody floor;
  floor.planes = {{{0.0, 0.0}, {0.0, 1.0}}};
  scene.bodies = {floor};
  const auto engine = makeBox2dImpulse();
  engine->load(scene, {});
  engine->advance(interval);  // it has settled
  const Vec2 before = engine->snapshot(ContactReport::accumulated).velocity[0];
  engine->advance(2.0 * interval);
  const Snapshot after = engine->snapshot(ContactReport::accumulated);
  ASSERT_EQ(after.contacts->size(), 1u);
  const double weight = smallMass * g;
  EXPECT_NEAR(after.contacts->normalForce[0], weight, 0.01 * weight);
  const double held = smallMass * (after.velocity[0] - before).x() / interval;
  EXPECT_NEAR(held, -thesis.mu * weight, 0.01 * weight);
  const Vec2 n = after.contacts->normal[0];
  EXPECT_NEAR(after.contacts->tangentialForce[0] * perpendicular(n).x(), held, 0.01 * weight);
}

/// A convex body at rest on a plane, or about to fall on it.
Scene onePlane(const ShapeOf<2>& shape, double en, double height) {
  Scene scene{.shapes = {shape}, .law = rigidLaw(en, 0.0, 0.5), .dt = 5e-4};
  const double mass = 0.5;
  scene.disks = {{shape.reach()},
                 {mass},
                 {mass * momentsPerMass(massOf(shape))},
                 {{0.0, height}},
                 {Vec2::Zero()},
                 {0.0},
                 {0},
                 {0.0}};
  scene.bodies = {planeWall(Vec2::Zero(), Vec2::UnitY())};
  return scene;
}

const ShapeOf<2> box{ShapeKind::polygon, {{-0.1, -0.05}, {0.1, -0.05}, {0.1, 0.05}, {-0.1, 0.05}}};
const ShapeOf<2> capsule{ShapeKind::capsule, {{-0.1, 0.0}, {0.1, 0.0}}, 0.05};

/// Box2D leaves overlaps of up to a slop, 0.005 of its unit of length, and pushes polygons out to
/// where their skins, of two slops, overlap by one.
TEST(Box2dImpulse, ABoxRestsWithinASlop_AndWithItsSkinASlopAbove) {
  for (const double skin : {0.0, 1.0}) {
    const auto engine = makeBox2dImpulse();
    Scene scene = onePlane(box, 0.0, 0.05);
    scene.gravity = {0.0, -9.81};
    const EffectiveParameters effective = engine->load(scene, {{"skin", skin}});
    const double slop = std::ranges::find(effective.deviations, "slop", &Deviation::name)->value;
    const auto declared = std::ranges::find(effective.deviations, "skin", &Deviation::name);
    ASSERT_EQ(declared != effective.deviations.end(), skin > 0.0);
    if (skin > 0.0) {
      EXPECT_NEAR(declared->value, 2.0 * slop, 1e-6 * slop);
    }
    engine->advance(2.0);
    engine->snapshot(ContactReport::accumulated);
    engine->advance(2.5);
    const Snapshot at = engine->snapshot(ContactReport::accumulated);
    const double bottom = at.position[0].y() - 0.05;
    EXPECT_LT(bottom, skin > 0.0 ? 1.1 * slop : 1e-3 * slop);
    EXPECT_GT(bottom, skin > 0.0 ? 0.9 * slop : -1.1 * slop);
    EXPECT_NEAR((*at.turn)[0], 0.0, 1e-5);
    ASSERT_EQ(at.contacts->size(), 1u);
    EXPECT_NEAR(at.contacts->normalForce[0], 0.5 * 9.81, 1e-3);
    EXPECT_NEAR(at.contacts->point[0].x(), at.position[0].x(), 1e-3);  // the middle of two corners
    EXPECT_NEAR(at.contacts->rollingTorque[0], 0.0, 1e-3);
    EXPECT_NEAR(at.bodies[0].force->y(), -0.5 * 9.81, 1e-3);
  }
}

/// Both corners at once, by the solver for two points: one after the other would turn the box.
TEST(Box2dImpulse, WhatFallsFlatReboundsWithoutTurning) {
  for (const ShapeOf<2>& shape : {box, capsule}) {
    const auto engine = makeBox2dImpulse();
    Scene scene = onePlane(shape, 0.5, 0.05 + 1e-5);
    scene.disks.velocity[0].y() = -1.0;
    const Snapshot after = runTo(*engine, scene, 0.01);
    EXPECT_NEAR(after.velocity[0].y(), 0.5, 1e-5);
    EXPECT_NEAR((*after.spin)[0], 0.0, 1e-4);
  }
}

/// The end of a capsule is round at every turn; its middle rectangle stands out nowhere.
TEST(Box2dImpulse, ACapsuleMeetsAPlaneWhereItIsRound) {
  for (const double turn : {0.0, 0.02, 0.5, 1.2, std::numbers::pi / 2.0, -2.5}) {
    const auto engine = makeBox2dImpulse();
    const double height = 0.1 * std::abs(std::sin(turn)) + 0.05;
    Scene scene = onePlane(capsule, 0.0, height + 1e-4);
    scene.disks.turn[0] = turn;
    scene.disks.velocity[0].y() = -0.1;
    engine->load(scene, {});
    engine->advance(5e-4);
    EXPECT_EQ(engine->snapshot(ContactReport::instant).contacts->size(), 0u) << turn;
    engine->advance(2.5e-3);
    EXPECT_EQ(engine->snapshot(ContactReport::accumulated).contacts->size(), 1u) << turn;
  }
}

TEST(Box2dImpulse, RefusesWhatItCannotDo) {
  const auto engine = makeBox2dImpulse();
  Scene scene = onePair(box2dLaw(), approach, 0.5);
  scene.bottom = thesisBottom<BottomPlate>();
  EXPECT_THROW(engine->load(scene, {}), UnsupportedScene);
  EXPECT_THROW(engine->load(onePair(box2dLaw(), approach, 0.5), {{"impct_speed", 0.1}}),
               std::invalid_argument);

  const SceneLimits limits = engine->capabilities().limits;
  Scene convex = onePlane(box, 0.5, 1.0);
  EXPECT_NO_THROW(engine->load(convex, {}));
  convex.law.et0 = 0.3;
  EXPECT_THROW(engine->load(convex, {}), UnsupportedScene);
  convex.shapes[0].rounding = 0.01;
  EXPECT_EQ(beyondLimits(limits, convex, false),
            std::vector<std::string>{"has polygons with sharp corners, not rounded ones"});
  EXPECT_THROW(makeBox2dPenalty()->load(onePlane(box, 0.5, 1.0), {}), UnsupportedScene);
}

}  // namespace
}  // namespace crossgrain::test

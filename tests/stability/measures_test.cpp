// Each measure on a series made by hand, whose figure can be read off.
#include "stability/measures.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace {

using namespace crossgrain;

/// Two disks of radius 1 m and mass 2 kg, k_n = 100 N/m, and what they did.
struct Series {
  Recording run;

  Series() {
    Disks& disks = run.scene.disks;
    disks.radius = {1.0, 1.0};
    disks.mass = {2.0, 2.0};
    disks.inertia = {1.0, 1.0};
    disks.position = {{0.0, 0.0}, {10.0, 0.0}};
    disks.velocity = {{1.0, 0.0}, {-1.0, 0.0}};
    disks.spin = {0.0, 0.0};
    run.scene.law.kn = 100.0;
    run.scene.law.tangential = TangentialLaw::none;
    run.effective.dt = 1.0;
    run.effective.integrator = "position_verlet";
    look(0.0, disks.position[0], disks.position[1], disks.velocity[0], disks.velocity[1]);
  }

  Snapshot& look(double t, Vec2 x0, Vec2 x1, Vec2 v0 = {1.0, 0.0}, Vec2 v1 = {-1.0, 0.0}) {
    Snapshot now;
    now.positionTime = now.velocityTime = now.contactTime = t;
    now.position = {x0, x1};
    now.velocity = {v0, v1};
    run.snapshots.push_back(now);
    return run.snapshots.back();
  }

  void addPlane(Motion motion = {}) {
    WallBody body;
    body.planes.push_back({{0.0, -1.0}, {0.0, 1.0}});
    body.motion = motion;
    run.scene.bodies.push_back(body);
  }

  std::vector<double> curve(const char* measure) const {
    return stabilityMeasure(measure).curve(run);
  }
  double last(const char* measure) const { return curve(measure).back(); }
};

TEST(StabilityMeasures, EnergyCountsMotionAndSprings) {
  Series at;  // starts with 2 · ½ · 2 kg · (1 m/s)² = 2 J
  at.look(1.0, {0, 0}, {1.9, 0}, {1.0, 0}, {0.0, 0});  // 1 J + ½ · 100 · 0.1² J = 1.5 J
  at.look(2.0, {0, 0}, {9.0, 0}, {2.0, 0}, {0.0, 0});  // 4 J
  EXPECT_EQ(at.curve("energy_gain").size(), 3u);
  EXPECT_NEAR(at.curve("energy_gain")[1], 0.0, 1e-15);
  EXPECT_NEAR(at.curve("energy_drift")[1], 0.25, 1e-12);
  EXPECT_NEAR(at.curve("energy_gain")[2], 1.0, 1e-12);
}

/// An engine need not report constants of pairs: k_t is then the scene's.
TEST(StabilityMeasures, EnergyOfTangentialSprings_IsThatOfTheLawWithoutPairs) {
  Series at;
  at.run.scene.law.tangential = TangentialLaw::spring;
  at.run.scene.law.mu = 1.0;
  at.run.scene.law.kt = 50.0;
  at.run.effective.effects = {Effect::tangentialSpring};
  at.look(1.0, {0, 0}, {2.0, 0}, {1.0, 0}, {0.0, 0}).contacts.emplace();  // 1 J of 2 J
  Contacts& contacts = *at.run.snapshots.back().contacts;
  contacts.i = {0};
  contacts.j = {1};
  contacts.tangentialForce = {-10.0};  // ½ · 10²/50 J = 1 J
  EXPECT_NEAR(at.last("energy_drift"), 0.0, 1e-12);
  at.run.effective.pairs.resize(1);
  at.run.effective.pairs.front().kn = 100.0;
  at.run.effective.pairs.front().kt = 100.0;  // ½ J
  EXPECT_NEAR(at.last("energy_drift"), 0.25, 1e-12);
  at.run.effective.effects.clear();
  EXPECT_NEAR(at.last("energy_drift"), 0.5, 1e-12);
}

TEST(StabilityMeasures, EnergyOfSpinsAndOfFalling) {
  Series at;
  at.run.scene.gravity = {0.0, -10.0};  // scale: 2 J + 2 · 2 kg · 10 m/s² · 1 m = 42 J
  Snapshot& now = at.look(1.0, {0, -0.05}, {10, 0.0});  // fell by 0.05 m: 1 J lost
  now.spin = {std::sqrt(2.0), 0.0};                     // ½ · 1 · 2 = 1 J gained
  EXPECT_NEAR(at.last("energy_drift"), 0.0, 1e-12);
  now.spin = {0.0, 2.0};  // 2 J
  EXPECT_NEAR(at.last("energy_gain"), 1.0 / 42.0, 1e-12);
}

TEST(StabilityMeasures, LeapfrogPositionsAreTakenBackToTheVelocities) {
  Series at;
  Snapshot& now = at.look(1.0, {0.5, 0}, {1.5, 0}, {1.0, 0}, {-1.0, 0});
  now.velocityTime = 0.5;  // where the disks were at x = 0 and 2: just touching
  EXPECT_NEAR(at.last("energy_drift"), 0.0, 1e-12);
  now.velocityTime = 1.0;  // overlap 1 m: 50 J
  EXPECT_NEAR(at.last("energy_gain"), 25.0, 1e-9);
}

TEST(StabilityMeasures, ImpulsesInPlaceOfSpringsHoldNoEnergy) {
  Series at;
  at.run.effective.deviations.push_back({"normal", 0.5, "-", "rigid contacts"});
  at.look(1.0, {0, 0}, {1.0, 0});
  EXPECT_NEAR(at.last("energy_drift"), 0.0, 1e-12);
}

// A start with an overlap of 0.1 m: 0.5 J in springs beside 2 J of motion.
TEST(StabilityMeasures, OverlapOfAStart_IsLostByASpringAndNotByAnImpulse) {
  Series at;
  at.run.snapshots.clear();
  at.look(0.0, {0, 0}, {1.9, 0});
  at.look(1.0, {-1, 0}, {9, 0});  // 2 J: what the springs held is gone
  EXPECT_NEAR(at.last("energy_drift"), 0.5 / 2.5, 1e-12);
  at.run.effective.deviations.push_back({"normal", 0.5, "-", "rigid contacts"});
  EXPECT_EQ(at.last("energy_drift"), 0.0);
  at.look(2.0, {-1, 0}, {9, 0}, {0, 0}, {-1.0, 0});  // 1 J: half of the motion, too
  EXPECT_NEAR(at.last("energy_drift"), 1.0 / 2.5, 1e-12);
  at.look(3.0, {-1, 0}, {9, 0}, {-2.0, 0}, {-1.0, 0});  // 5 J: more than the springs held
  EXPECT_NEAR(at.last("energy_gain"), 2.5 / 2.5, 1e-12);
}

TEST(StabilityMeasures, WorkOfWallsIsNotAGain) {
  Series at;
  Motion motion;
  motion.kind = Motion::Kind::translating;
  motion.velocity = {0.0, 0.5};
  at.addPlane(motion);
  at.run.snapshots.clear();
  // The disks push the wall down with 4 N while it rises by 0.5 m: 2 J go in, energy 2 J → 4 J.
  for (const double t : {0.0, 1.0}) {
    Snapshot& now = at.look(t, {0, 10}, {10, 10}, {std::sqrt(1.0 + 2.0 * t), 0}, {-1.0, 0});
    BodySnapshot wall;
    wall.velocity = {0.0, 0.5};
    wall.force = Vec2(0.0, -4.0);
    now.bodies.push_back(wall);
  }
  EXPECT_NEAR(at.last("energy_drift"), 0.0, 1e-12);
  at.run.snapshots[1].bodies[0].force.reset();  // not told: no figure
  EXPECT_TRUE(at.curve("energy_gain").empty());
}

TEST(StabilityMeasures, TheLedgerIsTakenAtItsWord) {
  Series at;
  EXPECT_TRUE(at.curve("ledger_residual").empty());
  for (Snapshot& now : at.run.snapshots) now.ledger = EnergyLedger{};
  at.run.snapshots[0].ledger->initial = at.run.snapshots[0].ledger->kinetic = 4.0;
  Snapshot& now = at.look(1.0, {0, 0}, {9, 0});
  now.ledger = EnergyLedger{};
  now.ledger->initial = 4.0;
  now.ledger->kinetic = 5.0;
  now.ledger->workOfWalls = 3.0;
  now.ledger->lostSliding = 1.0;  // 5 + 1 − 4 − 3 = −1 J
  EXPECT_NEAR(at.last("ledger_residual"), 0.25, 1e-12);
  EXPECT_NEAR(at.last("energy_drift"), 0.5, 1e-12);  // 5 − 3 − 4 = −2 J
}

TEST(StabilityMeasures, MomentumIsThatBeyondGravity) {
  Series at;
  at.look(1.0, {0, 0}, {9, 0}, {1.0, 0.0}, {-0.5, 0.0});  // Δp = 1, Σ m|v| at most 4
  EXPECT_NEAR(at.last("momentum_drift"), 0.25, 1e-12);
  at.run.scene.gravity = {0.25, 0.0};  // M g t = 1
  EXPECT_NEAR(at.last("momentum_drift"), 0.0, 1e-12);
  at.look(2.0, {0, 0}, {8, 0}, {1.0, 0.0}, {0.0, 0.0});  // Δp = 2 = M g t
  EXPECT_NEAR(at.last("momentum_drift"), 0.0, 1e-12);
}

TEST(StabilityMeasures, AngularMomentumIsAboutTheMovingCentre) {
  Series at;
  at.run.scene.disks.velocity = {{0.0, -1.0}, {0.0, 1.0}};
  at.run.snapshots.clear();
  at.look(0.0, {0, 0}, {10, 0}, {0.0, -1.0}, {0.0, 1.0});  // L = 2 · 2 · 5 · 1 = 20 kg m²/s
  at.look(1.0, {3, 2}, {13, 2}, {3.0, 1.0}, {3.0, 3.0});   // the same, travelling
  EXPECT_NEAR(at.last("angular_momentum_drift"), 0.0, 1e-12);
  at.look(2.0, {0, 0}, {10, 0}, {0.0, -1.0}, {0.0, 1.0}).spin = {6.0, 0.0};
  EXPECT_NEAR(at.last("angular_momentum_drift"), 6.0 / 24.0, 1e-12);  // scale Σ m (|x| + a)|v|
}

TEST(StabilityMeasures, OverlapIsByTheSmallerRadiusAndKnowsWalls) {
  Series at;
  at.run.scene.disks.radius = {1.0, 0.5};
  at.look(1.0, {0, 0}, {1.25, 0});  // 0.25 m deep
  EXPECT_NEAR(at.last("max_overlap"), 0.5, 1e-12);
  at.addPlane();                    // at y = −1
  at.look(2.0, {0, -0.9}, {5, 5});  // 0.9 m into the plane, of radius 1
  EXPECT_NEAR(at.last("max_overlap"), 0.9, 1e-12);
}

TEST(StabilityMeasures, RestBeginsWhereTheCaseSays) {
  Series at;
  at.run.settle = 0.5;
  at.look(1.0, {0, 0}, {10, 0}, {5.0, 0}, {0, 0});
  at.look(2.0, {1, 0}, {10, 0}, {0, 0}, {0, 0});      // rest begins here
  at.look(4.0, {1, 0}, {10, 3.0}, {0, 0}, {1.0, 0});  // 1 J of 2 J; 3 m = 1.5 d in 2 s
  EXPECT_EQ(at.curve("kinetic_at_rest")[1], 0.0);
  EXPECT_NEAR(at.last("kinetic_at_rest"), 0.5, 1e-12);
  EXPECT_NEAR(at.last("creep"), 0.75, 1e-12);
  EXPECT_EQ(at.last("time_to_rest"), 4.0);
}

// 0.5 m of a diameter of 2 m is how contacts settle; what falls and then rests has not stood.
TEST(StabilityMeasures, WhatStandsAndFallsBeforeRestIsAskedFor_DoesNotStand) {
  for (const double by : {0.5, 6.0}) {
    Series at;
    at.run.settle = 0.5;
    at.run.stands = true;
    at.look(0.0, {0, 0}, {10, 0});
    at.look(1.0, {0, 0}, {10, by});
    at.look(2.0, {0, 0}, {10, by});
    EXPECT_NEAR(at.last("creep"), by < 1.0 ? 0.0 : 1.5, 1e-12);  // 6 m = 3 d in 2 s
  }
}

// A snapshot compared with itself alone gives no figure.
TEST(StabilityMeasures, RestOfOneSnapshot_HasNoFigure) {
  Series at;
  at.run.settle = 0.9;
  at.look(1.0, {0, 0}, {10, 0});
  at.look(2.0, {5, 0}, {15, 0});
  EXPECT_TRUE(at.curve("creep").empty());
  EXPECT_TRUE(at.curve("pile_angle_change").empty());
  Motion motion;
  motion.kind = Motion::Kind::oscillating;
  motion.frequency = 1.0;  // a cycle of 6.3 s in a run of 2 s
  at.addPlane(motion);
  EXPECT_TRUE(at.curve("ratchet").empty());
}

/// A filled triangle with base angles of 45°, then one pressed to half its height: atan ½.
void expectPileAngle(const Vec2& gravity) {
  Series at;
  at.run.scene.gravity = gravity;
  Disks& disks = at.run.scene.disks;
  disks = {};
  const Vec2 up = -gravity.normalized(), along = perpendicular(up);
  Snapshot steep, flat;
  for (int row = 0; row < 100; ++row)
    for (int k = -(100 - row); k <= 100 - row; ++k) {
      disks.radius.push_back(0.5);
      disks.mass.push_back(1.0);
      steep.position.push_back(k * along + row * up);
      flat.position.push_back(k * along + 0.5 * row * up);
    }
  flat.positionTime = 1.0;
  at.run.snapshots = {steep, flat};
  const double change = 45.0 - std::atan(0.5) * 180.0 / std::numbers::pi;
  EXPECT_NEAR(at.last("pile_angle_change"), change, 0.2);  // rows are not a continuum
}

TEST(StabilityMeasures, PileAngleIsThatOfTheTriangle) {
  expectPileAngle({0.0, -10.0});
  expectPileAngle({-0.5, 0.0});  // weak, and sideways: so lies the pile
}

TEST(StabilityMeasures, GoingThroughIsToldFromBouncing) {
  Series at;
  at.look(1.0, {4.5, 0}, {5.5, 0});                   // deep in each other
  at.look(2.0, {4.0, 0}, {6.0, 0}, {2, 0}, {-2, 0});  // and back
  EXPECT_EQ(at.last("tunnelled"), 0.0);
  at.look(3.0, {6.0, 0.1}, {4.0, 0}, {2, 0}, {-2, 0});  // changed sides, passing close
  EXPECT_EQ(at.last("tunnelled"), 1.0);
  Series past;
  past.look(1.0, {10.0, 2.5}, {0.0, 0});  // changed sides at 2.5 m
  EXPECT_EQ(past.last("tunnelled"), 0.0);
}

/// A disk that turns with a drum by 120° between two snapshots has gone through no neighbour.
TEST(StabilityMeasures, GoingRoundEachOther_IsNotGoingThrough) {
  Series at;
  for (const double t : {1.0, 2.0, 3.0}) {
    const double angle = 2.0 * std::numbers::pi / 3.0 * t;
    const Vec2 arm(std::cos(angle), std::sin(angle)),
        velocity = 2.0 * std::numbers::pi / 3.0 * Vec2(-arm.y(), arm.x());
    at.look(t, arm, -arm, velocity, -velocity);
  }
  EXPECT_EQ(at.last("tunnelled"), 0.0);
}

/// A box of 0.2 m and a wall of 2 × 0.1 m, upright at x = 0, that are seen at x_0 and y_0 of the
/// box.
struct BoxAndWall : Series {
  BoxAndWall() {
    run.snapshots.clear();
    run.scene.shapes = {{ShapeKind::polygon, {{-0.1, -0.1}, {0.1, -0.1}, {0.1, 0.1}, {-0.1, 0.1}}},
                        {ShapeKind::polygon, {{-0.05, -1}, {0.05, -1}, {0.05, 1}, {-0.05, 1}}}};
    run.scene.disks.shape = {0, 1};
    run.scene.disks.radius = {std::hypot(0.1, 0.1), std::hypot(0.05, 1.0)};
    run.scene.disks.turn = {0.0, 0.0};
  }
  void see(double x, double y = 0.0, double turn = 0.0, double speed = 1.0) {
    const auto t = static_cast<double>(run.snapshots.size());
    look(t, {x, y}, {0, 0}, {speed, 0}, {0, 0}).turn = {turn, 0.0};
  }
};

TEST(StabilityMeasures, BoxGoesThroughAWall) {
  for (const double end : {0.4, 0.06}) {  // out on the other side, or deep inside beyond its middle
    BoxAndWall at;
    at.see(-0.4);
    EXPECT_EQ(at.last("tunnelled"), 0.0);
    at.see(end);
    EXPECT_EQ(at.last("tunnelled"), 1.0) << end;
  }
  BoxAndWall sinks;  // slowly, and comes out behind
  for (const double x : {-0.2, -0.12, -0.04, 0.04, 0.12, 0.2}) sinks.see(x);
  EXPECT_EQ(sinks.curve("tunnelled"), (std::vector<double>{0, 0, 0, 1, 1, 1}));
}

/// Centres change sides, or come near each other, and nothing went through.
TEST(StabilityMeasures, BoxThatReboundsSlidesOrPassesByAWall_IsNotThroughIt) {
  BoxAndWall rebounds;
  for (const double x : {-0.4, -0.06, -0.4}) rebounds.see(x);
  EXPECT_EQ(rebounds.last("tunnelled"), 0.0);
  BoxAndWall slides;
  for (const double y : {-0.5, -0.1, 0.1, 0.5}) slides.see(-0.15, y);
  EXPECT_EQ(slides.last("tunnelled"), 0.0);
  BoxAndWall over;  // above its upper end
  for (const double x : {-0.4, 0.4}) over.see(x, 1.11);
  EXPECT_EQ(over.last("tunnelled"), 0.0);
}

TEST(StabilityMeasures, FallenBodiesAreTurnedByHalfARightAngle) {
  BoxAndWall at;
  for (const double turn : {0.0, -0.7, -0.8, -0.1}) at.see(-3.0, 0.0, turn);
  EXPECT_EQ(at.curve("fallen"), (std::vector<double>{0, 0, 1, 0}));
  EXPECT_EQ(at.curve("standing"), (std::vector<double>{0, 0, 0, 2}));
  Series disks;
  EXPECT_TRUE(disks.curve("fallen").empty());
  EXPECT_TRUE(disks.curve("standing").empty());
}

/// Disks that stay together have e_n = 0: far from an elastic law's 1, and next to nothing from
/// that of dampers at 0.95 of critical, exp(−π 0.95/√(1 − 0.95²)).
TEST(StabilityMeasures, RestitutionOfDisksThatDoNotPartIsZero) {
  Series at;
  at.run.collisions = {{0.0, 2.0, Approach::spin}};
  at.look(1.0, {0, 0}, {1.9, 0}, {0, 0}, {0, 0});
  at.run.law = at.run.scene.law;
  at.run.law.gn = 0.0;
  EXPECT_NEAR(at.last("restitution_error"), 1.0, 1e-9);
  at.run.law.gn = 0.95 * 2.0 * std::sqrt(100.0 * 1.0);  // k_n = 100 N/m, m₁₂ = 1 kg
  const double damped = std::exp(-std::numbers::pi * 0.95 / std::sqrt(1.0 - 0.95 * 0.95));
  EXPECT_NEAR(at.last("restitution_error"), damped, 1e-3 * damped);
}

/// Two collisions of an elastic law: one gives back all of the speed, the other half of it.
TEST(StabilityMeasures, RestitutionIsThatOfTheWorstOfSeveral) {
  Series at;
  at.run.scene.disks.radius.assign(4, 1.0);
  at.run.scene.disks.mass.assign(4, 2.0);
  at.run.scene.disks.inertia.assign(4, 1.0);
  at.run.collisions.assign(2, {0.0, 2.0, Approach::spin});
  at.run.law = at.run.scene.law;
  at.run.law.gn = 0.0;
  Snapshot& now = at.look(1.0, {10, 0}, {0, 0}, {1.0, 0}, {-1.0, 0});
  now.position.insert(now.position.end(), {{10, 50}, {0, 50}});
  now.velocity.insert(now.velocity.end(), {{0.5, 0}, {-0.5, 0}});
  const std::vector<double> errors = restitutionErrors(at.run);
  ASSERT_EQ(errors.size(), 2u);
  EXPECT_NEAR(errors[0], 0.0, 1e-9);
  EXPECT_NEAR(errors[1], 0.5, 1e-9);
  EXPECT_EQ(at.last("restitution_error"), errors[1]);
}

TEST(StabilityMeasures, OneDiskGoesThroughAWallDisk) {
  Series at;
  at.run.scene.disks.radius.pop_back();
  WallBody wall{.diskPosition = {{5.0, 0.0}}, .diskRadius = {1.0}};
  at.run.scene.bodies.push_back(wall);
  for (Snapshot& now : at.run.snapshots) now.position.pop_back();
  at.look(1.0, {4.5, 0.0}, {}).position.pop_back();
  EXPECT_EQ(at.last("tunnelled"), 0.0);
  at.look(2.0, {5.5, 0.1}, {}).position.pop_back();
  EXPECT_EQ(at.last("tunnelled"), 1.0);
}

TEST(StabilityMeasures, BehindAWallIsThroughItAndOutside) {
  Series at;
  at.addPlane();
  at.look(1.0, {0, -0.5}, {10, 0});  // touches
  EXPECT_EQ(at.last("tunnelled"), 0.0);
  at.look(2.0, {0, -1.5}, {10, -3});  // both centres behind y = −1
  EXPECT_EQ(at.last("escaped"), 2.0);
  at.look(3.0, {0, 0.5}, {10, -3});
  EXPECT_EQ(at.last("escaped"), 1.0);    // at once
  EXPECT_EQ(at.last("tunnelled"), 2.0);  // ever
}

TEST(StabilityMeasures, RatchetIsPerCycle) {
  Series at;
  Motion motion;
  motion.kind = Motion::Kind::oscillating;
  motion.frequency = std::numbers::pi;  // a cycle of 2 s
  at.addPlane(motion);
  at.run.snapshots.clear();
  for (int k = 0; k <= 8; ++k)  // sways by 1 m within a cycle, drifts by 0.1 m each
    at.look(k, {k % 2 + 0.05 * k, 0}, {10, 0});
  EXPECT_NEAR(at.last("ratchet"), 0.1 / 2.0, 1e-12);
  at.run.scene.bodies.clear();
  EXPECT_TRUE(at.curve("ratchet").empty());  // nothing oscillates

  motion.frequency = std::numbers::pi / 2.0;  // a cycle of 4 s: all of four looks after the first
  at.addPlane(motion);
  at.run.snapshots.clear();
  for (const double x : {0.0, 1.0, 2.0, 1.0, 0.3})
    at.look(static_cast<double>(at.run.snapshots.size()), {x, 0}, {10, 0});
  EXPECT_NEAR(at.last("ratchet"), 0.3 / 2.0, 1e-12);
}

TEST(StabilityMeasures, CopiesAreTakenBack) {
  Series original, copy;
  original.look(2.0, {1, 2}, {3, 4});
  Placement& moved = copy.run.placement;
  moved.mirror = true;
  moved.turn = std::numbers::pi / 2.0;
  moved.offset = {100.0, 0.0};
  moved.boost = {0.0, 10.0};
  copy.run.snapshots.clear();
  copy.look(0.0, {100, 0}, {100, -10});
  // (1, 2) → mirrored (−1, 2) → turned (−2, −1) → shifted by (100, 20); (3, 4) → (96, 17).
  copy.look(2.0, {98, 19}, {96, 17});
  for (const double distance : copiesDiffer(original.run, copy.run))
    EXPECT_NEAR(distance, 0.0, 1e-12);
  copy.run.snapshots[1].position[1].x() += 0.5;
  EXPECT_NEAR(copiesDiffer(original.run, copy.run)[1], 0.25, 1e-12);
}

TEST(StepLimit, OfOneContactAndOfARow) {
  Series pair;
  pair.run.scene.disks.position[1] = {1.9, 0.0};
  // Against each other: ω² = k (1/m + 1/m) = 100, so 2/ω = 0.2 s.
  EXPECT_NEAR(theoreticalStepLimit(pair.run.scene), 0.2, 1e-9);
  EXPECT_NEAR(coordinationStepLimit(pair.run.scene), 0.2, 1e-12);

  Scene row = pair.run.scene;  // three in a row: ω² = 3 k/m; the middle one has two contacts
  row.disks.radius.push_back(1.0);
  row.disks.mass.push_back(2.0);
  row.disks.position.emplace_back(3.8, 0.0);
  EXPECT_NEAR(theoreticalStepLimit(row), 2.0 / std::sqrt(150.0), 1e-9);
  EXPECT_NEAR(coordinationStepLimit(row), 2.0 / std::sqrt(200.0), 1e-12);
  EXPECT_LE(coordinationStepLimit(row), theoreticalStepLimit(row));
}

TEST(StepLimit, AndEnergy_OfMaterials_AreThoseOfTheirPair) {
  Series pair;
  pair.run.snapshots.front().position[1] = {1.9, 0.0};
  Scene& scene = pair.run.scene;
  scene.disks.position[1] = {1.9, 0.0};
  scene.materials = Materials{{"a", "b"}, {0, 1}, {}, std::vector<ContactLaw>(4, scene.law)};
  for (const std::size_t mixed : {1u, 2u}) scene.materials->laws[mixed].kn *= 4.0;
  EXPECT_NEAR(theoreticalStepLimit(scene), 0.1, 1e-9);
  EXPECT_NEAR(coordinationStepLimit(scene), 0.1, 1e-12);
  EXPECT_NEAR(energyOf(pair.run, pair.run.snapshots.front()).elastic, 0.5 * 400.0 * 0.01, 1e-12);
}

// ---- In space -----------------------------------------------------------------------------------

/// Spheres of radius 1 m and mass 2 kg, q = 0.4.
SpaceRecording spheres(std::size_t count) {
  SpaceRecording run;
  DisksOf<3>& all = run.scene.disks;
  all.radius.assign(count, 1.0);
  all.mass.assign(count, 2.0);
  all.inertia.assign(count, 0.8);
  all.position.assign(count, Vec3::Zero());
  all.velocity.assign(count, Vec3::Zero());
  all.spin.assign(count, Vec3::Zero());
  run.scene.law.kn = 100.0;
  run.scene.law.tangential = TangentialLaw::none;
  run.effective.dt = 1.0;
  return run;
}

SpaceSnapshot& look(SpaceRecording& run, double t, std::vector<Vec3> position,
                    std::vector<Vec3> velocity) {
  SpaceSnapshot& now = run.snapshots.emplace_back();
  now.positionTime = now.velocityTime = now.contactTime = t;
  now.position = std::move(position);
  now.velocity = std::move(velocity);
  return now;
}

std::vector<double> curveOf(const SpaceRecording& run, const char* measure) {
  return stabilityMeasure(measure).of(run);
}

TEST(SpaceMeasures, EnergyAndMomenta_AreThoseOfVectors) {
  SpaceRecording run = spheres(2);
  run.scene.disks.velocity = {{0, 0, 1}, {0, 0, -1}};
  look(run, 0.0, {{0, 0, 0}, {0, 9, 0}}, run.scene.disks.velocity);  // 2 J, L_x = −18 kg m²/s
  SpaceSnapshot& now = look(run, 1.0, {{0, 0, 0}, {0, 0, 1.9}}, {{0, 0, 1}, {0, 0, 0}});
  now.spin = {{0, 0, 0}, {0.6, 0, 0.8}};  // 1 J + 0.5 J + 0.4 J of a unit spin
  EXPECT_NEAR(curveOf(run, "energy_drift")[1], 0.05, 1e-12);
  EXPECT_NEAR(curveOf(run, "momentum_drift")[1], 0.5, 1e-12);  // 2 of 4 kg m/s
  // Σ m (|x| + a)|v| = 2 · 2 · 5.5; L = 0.8 (0.6, 0, 0.8) now, (−18, 0, 0) then.
  EXPECT_NEAR(curveOf(run, "angular_momentum_drift")[1], std::hypot(18.48, 0.64) / 22.0, 1e-12);
}

TEST(SpaceMeasures, Cylinder_IsAWallFromInside) {
  SpaceRecording run = spheres(1);
  run.scene.bodies.push_back({.cylinders = {{{0, 5, 0}, {1, 0, 0}, 3.0}}});
  look(run, 0.0, {{7, 5, 0}}, {{0, 0, 0}});
  look(run, 1.0, {{7, 5, 2.25}}, {{0, 0, 0}});  // R − s = 0.75
  look(run, 2.0, {{7, 1.5, 0}}, {{0, 0, 0}});   // outside
  EXPECT_NEAR(curveOf(run, "max_overlap")[1], 0.25, 1e-12);
  EXPECT_EQ(curveOf(run, "tunnelled"), (std::vector<double>{0, 0, 1}));
  EXPECT_EQ(curveOf(run, "escaped"), (std::vector<double>{0, 0, 1}));
}

TEST(SpaceMeasures, PairAcrossABorder_TouchesAndIsNotCrossed) {
  SpaceRecording run = spheres(2);
  run.scene.box = {{0, 0, 0}, {10, 10, 10}, {true, false, false}};
  look(run, 0.0, {{0.5, 0, 0}, {9.5, 0, 0}}, {{1, 0, 0}, {-1, 0, 0}});
  look(run, 1.0, {{5.4, 0, 0}, {4.6, 5, 0}}, {{1, 0, 0}, {-1, 0, 0}});
  EXPECT_NEAR(curveOf(run, "max_overlap")[0], 1.0, 1e-12);
  EXPECT_EQ(curveOf(run, "tunnelled")[1], 0.0);
  look(run, 2.0, {{4.6, 0, 0}, {5.4, 0.1, 0}}, {{1, 0, 0}, {-1, 0, 0}});
  look(run, 3.0, {{5.4, 0, 0}, {4.6, 0.1, 0}}, {{1, 0, 0}, {-1, 0, 0}});
  EXPECT_EQ(curveOf(run, "tunnelled")[3], 1.0);
}

TEST(SpaceMeasures, PileAngle_IsThatOfTheCone) {
  SpaceRecording run = spheres(6);
  // Moments of a cone of r = 2 and h = 1: 3/20 r² = 0.6 along x and y, 3/80 h² = 0.0375 along z.
  const double x = std::sqrt(1.8), z = std::sqrt(0.1125);
  const std::vector<Vec3> cone = {{x, 0, 0},  {-x, 0, 0}, {0, x, 0},
                                  {0, -x, 0}, {0, 0, z},  {0, 0, -z}};
  std::vector<Vec3> flat = cone;
  for (Vec3& place : flat) place.z() = 0.0;
  const std::vector<Vec3> still(6, Vec3::Zero());
  look(run, 0.0, cone, still);
  look(run, 1.0, flat, still);
  EXPECT_NEAR(curveOf(run, "pile_angle_change")[1], std::atan(0.5) * 180.0 / std::numbers::pi,
              1e-9);
}

TEST(SpaceMeasures, CopiesAreComparedByTheirWays) {
  SpaceRecording here = spheres(1), there = spheres(1);
  there.scene.disks.position = {{100, 0, 0}};
  look(here, 0.0, {{0, 0, 0}}, {{1, 0, 0}});
  look(here, 1.0, {{1, 0, 0}}, {{1, 0, 0}});
  look(there, 0.0, {{100, 0, 0}}, {{1, 0, 0}});
  look(there, 1.0, {{101, 0.5, 0}}, {{1, 0, 0}});
  EXPECT_EQ(copiesDiffer(here, there), (std::vector<double>{0.0, 0.25}));
}

TEST(StepLimit, OfTwoSpheres_IsThatOfTheirContact) {
  SpaceRecording run = spheres(2);
  run.scene.disks.position = {{0, 0, 0}, {1.1, 1.1, 1.1}};
  EXPECT_NEAR(theoreticalStepLimit(run.scene), 2.0 / std::sqrt(100.0), 1e-9);  // m₁₂ = 1 kg
}

/// A gas that cools by Haff's law, of the rate that the measure's equations give by hand.
TEST(StabilityMeasures, HaffsLaw_IsThatOfKineticTheory) {
  SpaceRecording run = spheres(2);
  run.law = run.scene.law;
  run.law.gn = 2.0;  // e = exp(−π/√(4·100/4 − 1)) = exp(−π/√99), m₁₂ = 1 kg
  run.law.conventions.tension = Tension::allow;
  run.scene.box = {{0, 0, 0}, {10, 10, 10}, {true, true, true}};
  const double e = std::exp(-std::numbers::pi / std::sqrt(99.0)),
               phi = 8.0 / 3.0 * std::numbers::pi / 1e3;
  // T_0 = Σ m v²/(3 Σ m) = 1/3; ω = 4 √(π/3) n d² χ with n d² = 0.008.
  const double often =
      4.0 * std::sqrt(std::numbers::pi / 3.0) * 0.008 * (1.0 - phi / 2.0) / std::pow(1.0 - phi, 3);
  const double tau = 6.0 / ((1.0 - e * e) * often);
  const auto at = [&](double t, double v) {
    look(run, t, {{0, 0, 0}, {5, 5, 5}}, {{0, 0, v}, {0, 0, -v}});
  };
  at(0.0, 1.0);
  at(2.0 * tau, 1.0 / 3.0);
  at(3.0 * tau, 1.0 / 3.0);  // where it should be 1/4
  const std::vector<double> errors = curveOf(run, "haff_error");
  EXPECT_NEAR(errors[1], 0.0, 1e-6);
  EXPECT_NEAR(errors[2], 0.25, 1e-6);
  run.scene.box->periodic[0] = false;
  EXPECT_TRUE(curveOf(run, "haff_error").empty());
}

// A disk on a plane: m = 2 kg, g = 10 m/s², steps of 1 s.
TEST(StabilityMeasures, WallForces_AreWhatTheDisksGet) {
  Series at;
  at.run.scene.gravity = {0.0, -10.0};
  at.run.scene.disks = {{1.0}, {2.0}, {1.0}, {{0, 0}}, {{0, 0}}, {0.0}};
  at.addPlane();
  at.run.snapshots.clear();
  const auto seen = [&](double t, double vy, double spin, Vec2 force, double torque) {
    Snapshot& now = at.look(t, {3, 0}, {0, 0}, {0, vy});
    now.position.resize(1);
    now.velocity.resize(1);
    now.spin = {spin};
    BodySnapshot body;
    body.force = force;
    body.torque = torque;
    now.bodies = {body};
  };
  seen(0.0, 0.0, 0.0, {0, 0}, 0.0);
  seen(1.0, 0.0, 0.0, {0, -20}, -60.0);  // at rest: the plane bears it, x × F = 3 · −20
  seen(2.0, 0.0, 0.0, {0, -20}, -60.0);
  EXPECT_NEAR(at.last("wall_balance"), 0.0, 1e-12);
  seen(2.0, 0.0, 0.0, {0, -20}, -60.0);  // the next sample's first look, at the same step
  EXPECT_NEAR(at.last("wall_balance"), 0.0, 1e-12);
  seen(3.0, 10.0, 0.0, {0, -60}, -180.0);  // (20 + 60)/2 − 20 = 20 N s
  EXPECT_NEAR(at.last("wall_balance"), 0.0, 1e-12);
  auto other = at;
  other.run.snapshots.back().bodies[0].force = Vec2(0, -20);
  other.run.snapshots.back().bodies[0].torque = -60.0;
  EXPECT_NEAR(other.last("wall_balance"), 20.0 / 80.0, 1e-12);  // of twice 20 + 20 N s
  at.run.snapshots.back().bodies[0].torque = 0.0;
  EXPECT_NEAR(at.last("wall_balance"), 90.0 / (60.0 * 3.0 + 30.0), 1e-12);
  other = at;
  other.run.effective.effects = {Effect::friction};  // on spins that are held: L says nothing
  EXPECT_NEAR(other.last("wall_balance"), 0.0, 1e-12);
  other.run.effective.effects = {Effect::friction, Effect::rotation};
  EXPECT_EQ(other.last("wall_balance"), at.last("wall_balance"));
  at.run.snapshots.back().bodies[0].torque.reset();
  EXPECT_TRUE(at.curve("wall_balance").empty());
}

TEST(StabilityMeasures, WhatRestsAndWakes_IsSeen) {
  Series at;
  at.run.snapshots.clear();
  at.look(0.0, {0, 0}, {9, 0}, {1, 0}, {0, 0});  // 1 J
  for (int k = 1; k <= burstSteps; ++k) at.look(k, {0, 0}, {9, 0}, {1e-5, 0}, {0, 0});
  EXPECT_EQ(at.last("wakes"), 0.0);
  at.look(9.0, {0, 0}, {9, 0}, {0.1, 0}, {0, 0});
  EXPECT_NEAR(at.last("wakes"), 0.01, 1e-12);
  Series swing = at;
  at.run.snapshots.erase(at.run.snapshots.begin() + 1);  // seven steps are no rest
  EXPECT_TRUE(at.curve("wakes").empty());
  // A swing that turns back over those steps, as slow in each, was seen 1000 s before: at 7/2 e-5
  // m/s more in 7 s it is at 0.005 m/s by then, 2.5e-5 of the energy.
  for (int k = 1; k <= burstSteps; ++k) {
    Snapshot& now = swing.run.snapshots[static_cast<std::size_t>(k)];
    now.positionTime = now.velocityTime = 1000.0 + k;
    now.velocity[0].x() = 5e-6 * (k - 4.5);
  }
  EXPECT_TRUE(swing.curve("wakes").empty());
}

}  // namespace

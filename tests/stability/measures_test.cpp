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

// What is compared with itself alone is nothing that was seen.
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
  at.look(1.0, {4.5, 0}, {5.5, 0});  // deep in each other
  at.look(2.0, {4.0, 0}, {6.0, 0});  // and back
  EXPECT_EQ(at.last("tunnelled"), 0.0);
  at.look(3.0, {6.0, 0.1}, {4.0, 0});  // changed sides, passing close
  EXPECT_EQ(at.last("tunnelled"), 1.0);
  Series past;
  past.look(1.0, {10.0, 2.5}, {0.0, 0});  // changed sides at 2.5 m
  EXPECT_EQ(past.last("tunnelled"), 0.0);
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
  WallBody wall;
  wall.diskPosition = {{5.0, 0.0}};
  wall.diskRadius = {1.0};
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

}  // namespace

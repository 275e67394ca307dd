// Walls move as prescribed, whatever pushes on them, and the law sees them move.
#include "tests/conformance/conformance.hpp"

namespace crossgrain::test {
namespace {

constexpr double arm = 0.1;     // of the wall disk that pushes [m]
constexpr double push = 0.1;    // its speed when it meets the disk [m/s]
constexpr double end = 0.0101;  // the disk has been pushed away by then [s]

Motion motionOf(Motion::Kind kind) {
  Motion motion;
  motion.kind = kind;
  motion.angularVelocity = push / arm;
  motion.velocity = {0.0, push};
  motion.frequency = 3.0;
  motion.amplitude = {0.0, push / motion.frequency};
  motion.radialVelocity = -push;
  motion.radialEnd = 0.5;
  return motion;
}

/// A wall of two disks, one of which runs into a disk at rest.
Scene pushingWall(const ContactLaw& law, Motion::Kind kind) {
  const Vec2 member(arm, 0.0);
  const Vec2 towards = kind == Motion::Kind::radial ? Vec2(-1.0, 0.0) : Vec2(0.0, 1.0);
  Scene scene = emptyScene(law, 200.0);
  scene.bodies = {wallOf("wall", Vec2::Zero(), {member, Vec2(-0.03, 0.04)}, motionOf(kind))};
  addDisk(scene, smallRadius, smallMass, member + (2.0 * smallRadius + Encounter::gap) * towards,
          Vec2::Zero());
  return scene;
}

void expectPrescribed(const Scene& scene, const Snapshot& now, const Tolerance& relative) {
  const WallBody& body = scene.bodies[0];
  const BodyState state = stateAt(body.motion, body.centre, now.positionTime);
  const Tolerance length = {relative.relative * arm, 0.0, relative.why};
  EXPECT_TRUE(close(now.bodies[0].angle, state.angle, relative));
  EXPECT_TRUE(close(now.bodies[0].centre, state.centre, length));
  EXPECT_TRUE(close(now.bodies[0].velocity, state.velocity, relative));
  EXPECT_TRUE(close(now.bodies[0].angularVelocity, state.angularVelocity, relative));
  ASSERT_EQ(now.wallPosition.size(), body.diskPosition.size());
  for (std::size_t k = 0; k < body.diskPosition.size(); ++k)
    EXPECT_TRUE(close(now.wallPosition[k], memberPosition(state, body.centre, body.diskPosition[k]),
                      length));
}

void expectPush(Engine& engine, const Scene& scene, const Tolerance& prescribed) {
  Snapshot now;
  for (const double t : {0.2 * end, 0.5 * end, end}) {
    engine.advance(t);
    now = engine.snapshot(ContactReport::none);
    expectPrescribed(scene, now, prescribed);
  }
  const Vec2 towards = (scene.disks.position[0] - scene.bodies[0].diskPosition[0]).normalized();
  const double expected = (1.0 + restitutionOf(scene.law, smallMass)) * push;
  const Tolerance scheme = {0.0, 0.02, "a first-order scheme, and a wall that hardly turns"};
  EXPECT_TRUE(close(now.velocity[0].dot(towards), expected, scheme));
}

constexpr const char* closedForm = "the closed form, rounded";

TEST_P(Conformance, RotatingWallPushes) {
  if (const auto why = refused(pushingWall(law(), Motion::Kind::rotating))) GTEST_SKIP() << *why;
  expectPush(engine(), scene_, byPrecision(1e-12, 1e-5, closedForm));
}

TEST_P(Conformance, TranslatingWallPushes) {
  if (const auto why = refused(pushingWall(law(), Motion::Kind::translating))) GTEST_SKIP() << *why;
  expectPush(engine(), scene_, byPrecision(1e-12, 1e-5, closedForm));
}

TEST_P(Conformance, OscillatingWallPushes) {
  if (const auto why = refused(pushingWall(law(), Motion::Kind::oscillating))) GTEST_SKIP() << *why;
  expectPush(engine(), scene_, byPrecision(1e-12, 1e-5, closedForm));
}

TEST_P(Conformance, ShrinkingWallPushes) {
  if (const auto why = refused(pushingWall(law(), Motion::Kind::radial))) GTEST_SKIP() << *why;
  expectPush(engine(), scene_, byPrecision(1e-12, 1e-5, closedForm));
}

TEST_P(Conformance, ShrinkingWallStops) {
  Scene scene = pushingWall(law(), Motion::Kind::radial);
  scene.disks.position[0] = {1.0, 1.0};
  scene.bodies[0].motion.radialEnd = 0.4321 * end;
  if (const auto why = refused(scene)) GTEST_SKIP() << *why;
  for (const double t : {0.43 * end, 0.44 * end, end})
    expectPrescribed(scene_, at(t), byPrecision(1e-12, 1e-5, closedForm));
}

/// Three turns and a half: the angle is Ωt, not what is left of it after whole turns.
TEST_P(Conformance, WheelKeepsItsAngle) {
  Scene scene = pushingWall(law(), Motion::Kind::rotating);
  scene.disks.position[0] = {1.0, 1.0};
  scene.bodies[0].motion.angularVelocity = 220.0;
  if (const auto why = refused(scene)) GTEST_SKIP() << *why;
  for (const double t : {0.03, 0.1})
    expectPrescribed(scene_, at(t), byPrecision(1e-12, 1e-5, closedForm));
}

/// A disk that falls straight onto a turning wheel is taken along and turned the other way.
TEST_P(Conformance, TurningWheelDragsADisk) {
  Scene scene = pushingWall(law(), Motion::Kind::rotating);
  scene.disks.position[0] = {arm + 2.0 * smallRadius + Encounter::gap, 0.0};
  scene.disks.velocity[0] = {-push, 0.0};
  if (const auto why = refused(scene)) GTEST_SKIP() << *why;
  const Snapshot after = at(end);
  EXPECT_GT(after.velocity[0].x(), 0.0);
  EXPECT_GT(after.velocity[0].y(), 0.1 * push);
  EXPECT_LT(spinsOf(scene, after)[0], -0.1 * push / smallRadius);
}

/// The law sees spins as a_i ω_i + a_j ω_j: of two equal disks it does not matter which one spins,
/// be it a wall.
TEST_P(Conformance, WallsSpinIsFelt) {
  constexpr double omega = 30.0;
  std::vector<Snapshot> after;
  for (const bool ofWall : {true, false}) {
    Scene scene = emptyScene(law(), 50.0);
    scene.bodies = {
        wallOf("post", Vec2::Zero(), {Vec2::Zero()}, ofWall ? rotating(omega) : Motion{})};
    addDisk(scene, smallRadius, smallMass, {2.0 * smallRadius + Encounter::gap, 0.0}, {-push, 0.0},
            ofWall ? 0.0 : omega);
    if (const auto why = refused(scene)) GTEST_SKIP() << *why;
    after.push_back(at(end));
  }
  const Tolerance rounding = byPrecision(1e-9, 1e-4, "roundings");
  EXPECT_GT(after[0].velocity[0].y(), 0.1 * push) << "the wall turns left and takes it along";
  EXPECT_TRUE(close(after[1].velocity[0], after[0].velocity[0], rounding));
  EXPECT_TRUE(close(spinsOf(scene_, after[1])[0] - omega, spinsOf(scene_, after[0])[0], rounding));
}

}  // namespace
}  // namespace crossgrain::test

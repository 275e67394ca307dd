// Walls move as prescribed, whatever pushes on them, and the law sees them move.
#include <limits>

#include "runs/conformance/check_list.hpp"
#include "runs/conformance/exam.hpp"

namespace crossgrain::conformance::walls {
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

void expectPrescribed(Exam& it, const Scene& scene, const Snapshot& now,
                      const Tolerance& relative) {
  const WallBody& body = scene.bodies[0];
  const BodyState state = stateAt(body.motion, body.centre, now.positionTime);
  const Tolerance length = {relative.relative * arm, 0.0, relative.why};
  it.expect(close(now.bodies[0].angle, state.angle, relative), "the body's angle [rad]");
  it.expect(close(now.bodies[0].centre, state.centre, length), "the body's centre [m]");
  it.expect(close(now.bodies[0].velocity, state.velocity, relative), "the body's velocity [m/s]");
  it.expect(close(now.bodies[0].angularVelocity, state.angularVelocity, relative),
            "the body's angular velocity [rad/s]");
  it.requireEqual(now.wallPosition.size(), body.diskPosition.size(), "wall disks shown");
  for (std::size_t k = 0; k < body.diskPosition.size(); ++k)
    it.expect(close(now.wallPosition[k], memberPosition(state, body.centre, body.diskPosition[k]),
                    length),
              "a wall disk's place [m]");
}

void expectPush(Exam& it, const Scene& scene, const Tolerance& prescribed) {
  Snapshot now;
  for (const double t : {0.2 * end, 0.5 * end, end}) {
    it.engine().advance(t);
    now = it.engine().snapshot(ContactReport::none);
    expectPrescribed(it, scene, now, prescribed);
  }
  const WallBody& body = scene.bodies[0];
  const Vec2 towards = body.planes.empty()
                           ? (scene.disks.position[0] - body.diskPosition[0]).normalized()
                           : body.planes[0].normal;
  const double expected = (1.0 + restitutionOf(scene.law, smallMass)) * push;
  const Tolerance scheme = {0.0, 0.02, "a first-order scheme, and a wall that hardly turns"};
  it.expect(close(now.velocity[0].dot(towards), expected, scheme),
            "the speed of the disk that was pushed [m/s]");
}

constexpr const char* closedForm = "the closed form, rounded";

void rotatingWallPushes(Exam& it) {
  it.load(pushingWall(it.law(), Motion::Kind::rotating));
  it.examined(wallMotion(Motion::Kind::rotating));
  it.examined(toString(Effect::movingWalls));
  expectPush(it, it.scene, it.byPrecision(1e-12, 1e-5, closedForm));
}

void translatingWallPushes(Exam& it) {
  it.load(pushingWall(it.law(), Motion::Kind::translating));
  it.examined(wallMotion(Motion::Kind::translating));
  it.examined(toString(Effect::movingWalls));
  expectPush(it, it.scene, it.byPrecision(1e-12, 1e-5, closedForm));
}

void oscillatingWallPushes(Exam& it) {
  it.load(pushingWall(it.law(), Motion::Kind::oscillating));
  it.examined(wallMotion(Motion::Kind::oscillating));
  it.examined(toString(Effect::movingWalls));
  expectPush(it, it.scene, it.byPrecision(1e-12, 1e-5, closedForm));
}

void shrinkingWallPushes(Exam& it) {
  it.load(pushingWall(it.law(), Motion::Kind::radial));
  it.examined(wallMotion(Motion::Kind::radial));
  it.examined(toString(Effect::movingWalls));
  expectPush(it, it.scene, it.byPrecision(1e-12, 1e-5, closedForm));
}

void shrinkingWallStops(Exam& it) {
  Scene scene = pushingWall(it.law(), Motion::Kind::radial);
  scene.disks.position[0] = {1.0, 1.0};
  scene.bodies[0].motion.radialEnd = 0.4321 * end;
  it.load(scene);
  for (const double t : {0.43 * end, 0.44 * end, end})
    expectPrescribed(it, it.scene, it.at(t), it.byPrecision(1e-12, 1e-5, closedForm));
}

/// Three turns and a half: the angle is Ωt, not what is left of it after whole turns, and a disk
/// far from it flies on as before.
void wheelKeepsItsAngle(Exam& it) {
  Scene scene = pushingWall(it.law(), Motion::Kind::rotating);
  scene.disks.position[0] = {1.0, 1.0};
  scene.bodies[0].motion.angularVelocity = 220.0;
  scene.disks.velocity[0] = {0.31, -0.17};
  it.load(scene);
  for (const double t : {0.03, 0.1}) {
    const Snapshot now = it.at(t);
    expectPrescribed(it, it.scene, now, it.byPrecision(1e-12, 1e-5, closedForm));
    const double steps = static_cast<double>(it.engine().stats().steps);
    const Tolerance rounding = it.byPrecision(0.5 * std::numeric_limits<double>::epsilon() * steps,
                                              1e-5, "half a bit of every addition");
    it.expect(
        close(now.position[0],
              Vec2(scene.disks.position[0] + now.positionTime * scene.disks.velocity[0]), rounding),
        "the position of a disk that nothing touches [m]");
  }
}

/// The same arm and speed as of the wall disks: the plane's point under the disk pushes it.
void turningPlanePushes(Exam& it) {
  Scene scene = emptyScene(it.law(), 200.0);
  scene.bodies = {planeWall(Vec2::Zero(), {0.0, 1.0})};
  scene.bodies[0].motion = motionOf(Motion::Kind::rotating);
  addDisk(scene, smallRadius, smallMass, {arm, smallRadius + Encounter::gap}, Vec2::Zero());
  it.loadWithinLimits(scene);
  it.examined(planeMotion(Motion::Kind::rotating));
  expectPush(it, scene, it.byPrecision(1e-12, 1e-5, closedForm));
}

void oscillatingPlanePushes(Exam& it) {
  it.needs(planeMotion(Motion::Kind::oscillating));
  Scene scene = emptyScene(it.law(), 200.0);
  scene.bodies = {planeWall(Vec2::Zero(), {0.0, 1.0})};
  scene.bodies[0].motion = motionOf(Motion::Kind::oscillating);
  addDisk(scene, smallRadius, smallMass, {0.0, smallRadius + Encounter::gap}, Vec2::Zero());
  it.loadWithinLimits(scene);
  it.examined(planeMotion(Motion::Kind::oscillating));
  expectPush(it, scene, it.byPrecision(1e-12, 1e-5, closedForm));
}

/// A gap wider than a disk, and nothing but the plane moves: who lists pairs that may touch has to
/// see planes come.
void planeComesFromAfar(Exam& it) {
  constexpr double speed = 5.0 * push, gap = 2.5 * smallRadius;
  Scene scene = emptyScene(it.law(), 200.0);
  scene.bodies = {planeWall(Vec2::Zero(), {0.0, 1.0})};
  scene.bodies[0].motion = motionOf(Motion::Kind::translating);
  scene.bodies[0].motion.velocity = {0.0, speed};
  addDisk(scene, smallRadius, smallMass, {0.0, smallRadius + gap}, Vec2::Zero());
  it.loadWithinLimits(scene);
  it.equal(it.at(0.9 * gap / speed).velocity[0].norm(), 0.0, "its speed before the plane is there");
  const Snapshot after = it.at(gap / speed + end);
  const double expected = (1.0 + restitutionOf(scene.law, smallMass)) * speed;
  const Tolerance scheme = {0.0, 0.02, "a first-order scheme"};
  it.expect(close(after.velocity[0].y(), expected, scheme),
            "the speed of the disk that was pushed [m/s]");
}

/// A disk that falls straight onto a turning wheel is taken along and turned the other way.
void turningWheelDragsADisk(Exam& it) {
  Scene scene = pushingWall(it.law(), Motion::Kind::rotating);
  scene.disks.position[0] = {arm + 2.0 * smallRadius + Encounter::gap, 0.0};
  scene.disks.velocity[0] = {-push, 0.0};
  it.load(scene);
  const Snapshot after = it.at(end);
  it.above(after.velocity[0].x(), 0.0, "the speed at which it rebounds");
  it.above(after.velocity[0].y(), 0.1 * push, "the speed at which it is taken along");
  it.below(spinsOf(scene, after)[0], -0.1 * push / smallRadius, "its spin");
}

/// The law sees spins as a_i ω_i + a_j ω_j: of two equal disks it does not matter which one spins,
/// be it a wall.
void wallsSpinIsFelt(Exam& it) {
  constexpr double omega = 30.0;
  std::vector<Snapshot> after;
  for (const bool ofWall : {true, false}) {
    Scene scene = emptyScene(it.law(), 50.0);
    scene.bodies = {
        wallOf("post", Vec2::Zero(), {Vec2::Zero()}, ofWall ? rotating(omega) : Motion{})};
    addDisk(scene, smallRadius, smallMass, {2.0 * smallRadius + Encounter::gap, 0.0}, {-push, 0.0},
            ofWall ? 0.0 : omega);
    it.load(scene);
    after.push_back(it.at(end));
  }
  const Tolerance rounding = it.byPrecision(1e-9, 1e-4, "roundings");
  it.above(after[0].velocity[0].y(), 0.1 * push, "the wall turns left and takes it along");
  it.expect(close(after[1].velocity[0], after[0].velocity[0], rounding),
            "the velocity, whichever of the two spins [m/s]");
  it.expect(close(spinsOf(it.scene, after[1])[0] - omega, spinsOf(it.scene, after[0])[0], rounding),
            "the change of spin, whichever of the two spins [rad/s]");
}

}  // namespace
std::span<const Check> checks() {
  static constexpr std::array list = {
      Check{"RotatingWallPushes", "a rotating wall moves as prescribed and pushes",
            rotatingWallPushes},
      Check{"TranslatingWallPushes", "a translating wall moves as prescribed and pushes",
            translatingWallPushes},
      Check{"OscillatingWallPushes", "an oscillating wall moves as prescribed and pushes",
            oscillatingWallPushes},
      Check{"ShrinkingWallPushes", "a shrinking wall moves as prescribed and pushes",
            shrinkingWallPushes},
      Check{"ShrinkingWallStops", "a shrinking wall stops when it is to", shrinkingWallStops},
      Check{"WheelKeepsItsAngle", "a wheel's angle counts whole turns, which change nothing else",
            wheelKeepsItsAngle},
      Check{"TurningPlanePushes", "a turning plane moves as prescribed and pushes",
            turningPlanePushes},
      Check{"OscillatingPlanePushes", "an oscillating plane moves as prescribed and pushes",
            oscillatingPlanePushes},
      Check{"PlaneComesFromAfar", "a plane that comes from afar pushes a disk at rest",
            planeComesFromAfar},
      Check{"TurningWheelDragsADisk", "a turning wheel drags a disk along", turningWheelDragsADisk},
      Check{"WallsSpinIsFelt", "the law feels a wall's spin as a disk's", wallsSpinIsFelt},
  };
  return list;
}

}  // namespace crossgrain::conformance::walls

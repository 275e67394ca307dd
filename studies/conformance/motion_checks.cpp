// One disk: alone, on the bottom plate, pushed by a wall that moves as prescribed.
#include <algorithm>
#include <cmath>
#include <limits>

#include "oracle/collision_oracle.hpp"
#include "studies/conformance/check_context.hpp"

namespace crossgrain::conformance {
namespace {

constexpr const char* roundings = "roundings of the additions";

// ---- free motion --------------------------------------------------------------------------------

constexpr double flight = 0.05;  // [s]

Scene oneDisk(const ContactLaw& law) {
  return sceneOf(law, {}, {{{0.002, -0.001}, {0.31, -0.17}, 5.0}}, 20.0);
}

void fliesStraight(CheckContext& context) {
  for (const Precision precision : context.can.precisions) {
    Scene scene = oneDisk(context.law());
    scene.precision = precision;
    context.load(scene);
    context.examine(precisionNamed(precision));
    const Snapshot after = context.at(flight);
    const Vec2 flown = after.positionTime * scene.disks.velocity[0];
    const double allowed = precision == Precision::float32 ? 1e-5 : 1e-12;
    const Tolerance rounding = {allowed, allowed, "roundings of the additions, of the distance"};
    context.equal(context.effective.precision, toString(precision), "the precision");
    context.near(Vec2(after.position[0] - scene.disks.position[0]), flown, rounding,
                 "the way flown [m]");
    context.near(after.velocity[0], scene.disks.velocity[0], rounding, "the velocity [m/s]");
    context.near(spinsOf(scene, after)[0], 5.0, rounding, "the spin [rad/s]");
    if (after.contacts) context.equal(after.contacts->size(), 0u, "contacts of a disk alone");
    // Engines of impulses bound what a step may move, and some take steps of their own. In others
    // nothing bounds speeds; here a step is a hundredth of a radius.
    if (context.rigid()) continue;
    scene.disks.velocity[0] *= 1e3;
    scene.dt *= 1e-3;
    context.load(scene);
    const Snapshot fast = context.at(500.0 * context.effective.dt);
    context.near(fast.velocity[0], scene.disks.velocity[0],
                 {0.0, allowed, "roundings of the additions"}, "the velocity of a fast one [m/s]");
    context.near(Vec2(fast.position[0] - scene.disks.position[0]),
                 Vec2(fast.positionTime * scene.disks.velocity[0]),
                 {allowed, allowed, rounding.why}, "the way that a fast one flew [m]");
  }
}

/// How gravity is off by what a disk gains from one snapshot to the next: in size, in direction, or
/// empty where neither alone explains it, or where it is not by so much for so long that the disk's
/// velocity is wrong.
/// @param wrong  how far that is off in the end
std::string gravityOff(const Scene& scene, std::size_t i, const Snapshot& was, const Snapshot& now,
                       const Vec2& wrong) {
  const Vec2 gained = (now.velocity[i] - was.velocity[i]) / (now.velocityTime - was.velocityTime);
  const double size = scene.gravity.norm(), off = (gained - scene.gravity).norm();
  const double part = gained.dot(scene.gravity) / (size * size) - 1.0;
  const std::string whose = i == 0 ? "" : ", of large disks";
  // It has been off since the first of the two snapshots at the latest, at most since load.
  const double since = (gained - scene.gravity).dot(wrong) / (off * off);
  const bool accounts =
      (wrong - since * (gained - scene.gravity)).norm() <= explainedLeaves * wrong.norm() &&
      since >= (1.0 - explainedLeaves) * (now.velocityTime - was.velocityTime) &&
      since <= (1.0 + explainedLeaves) * now.velocityTime;
  if (!accounts) return {};
  if ((gained - (1.0 + part) * scene.gravity).norm() <= explainedLeaves * off)
    return text("gravity", percentOf(part), whose);
  if (std::abs(gained.norm() - size) <= explainedLeaves * off)
    return text("gravity has another direction", whose);
  return {};
}

/// Whether a disk went from one snapshot to the next as under one constant force: at its mean
/// velocity. Only then is a wrong velocity gravity's doing.
bool fellEvenly(std::size_t i, const Snapshot& was, const Snapshot& now, const Tolerance& allowed) {
  const double time = now.positionTime - was.positionTime;
  const Vec2 way = now.position[i] - was.position[i];
  const Vec2 even = 0.5 * time * (was.velocity[i] + now.velocity[i]);
  return (way - even).norm() <= allowed.absolute + allowed.relative * even.norm();
}

/// Two disks of an age of `end` are where a constant force takes them.
/// @param part  of speeds and gravity: as far as bodies get, some engines have a box
/// @param from  gravity is worked out from what they gain since then [s]
void expectFall(CheckContext& context, double part, double from, double end,
                const Tolerance& rounding, const std::string& when) {
  Scene scene = oneDisk(context.law());
  addDisk(scene, largeRadius, largeMass, {0.2, -0.001}, {-0.17, 0.31}, 5.0);
  scene.gravity = part * Vec2(1.5, -9.81);
  for (Vec2& velocity : scene.disks.velocity) velocity *= part;
  const Snapshot was = context.run(scene, from), after = context.at(end);
  const double t = after.positionTime;
  for (std::size_t i = 0; i < scene.disks.size(); ++i) {
    const Vec2& velocity = scene.disks.velocity[i];
    const Vec2 expected = scene.disks.position[i] + t * velocity + 0.5 * t * t * scene.gravity;
    // Second-order schemes are exact for a constant force; Euler's, whose velocity lags, is off by
    // ½ g t dt.
    Tolerance scheme = rounding;
    if (context.effective.velocityLag != 0.0)
      scheme.absolute =
          std::max(rounding.absolute, 0.5001 * scene.gravity.norm() * t * context.effective.dt);
    const std::string which = i == 0 ? when : ", of a large disk" + when;
    context.near(after.position[i], expected, scheme, "the position [m]" + which);
    const std::size_t before = context.faults.size();
    const Vec2 falling = velocity + after.velocityTime * scene.gravity;
    context.near(after.velocity[i], falling, rounding, "the velocity [m/s]" + which);
    const bool fell = context.faults.size() > before && fellEvenly(i, was, after, scheme);
    const std::string off =
        fell ? gravityOff(scene, i, was, after, after.velocity[i] - falling) : "";
    if (!off.empty()) context.suspect(off + when);
    context.near(spinsOf(scene, after)[i], 5.0, rounding, "the spin [rad/s]" + which);
  }
}

/// A small disk and a large one, soon and, more slowly, after two seconds.
void fallsFreely(CheckContext& context) {
  expectFall(context, 1.0, 0.0, flight, context.byPrecision(1e-12, 1e-5, roundings), "");
  context.examine(toString(Effect::gravity));
  expectFall(context, 0.01, 1.5, 2.0,
             context.byPrecision(1e-10, 1e-3, "roundings of some twenty thousand additions"),
             ", 2 s after load");
}

/// Everything slides at once, γ_b v > µ_b m g: the disk loses µ_b g t of its speed and, where the
/// plate brakes spins, µ_b m g (2/3) a / (½ m a²) · t = (4/3)(µ_b g/a) t of its spin. Once more
/// where things weigh a tenth, and under a plate that takes two seconds for it.
void bottomPlateBrakesADisk(CheckContext& context) {
  constexpr double soon = 0.02, late = 2.0;
  struct Plate {
    bool spin;
    double weight, end;
  };
  for (const auto& [spin, weight, end] : {Plate{false, 1.0, soon},
                                          {true, 1.0, soon},
                                          {false, 0.1, soon},
                                          {false, soon / late, late}}) {
    Scene scene = oneDisk(context.law());
    scene.disks.spin[0] = 30.0;
    scene.bottom = thesisBottom<BottomPlate>(0.05, spin);
    scene.bottom->gravity *= weight;
    const Snapshot after = context.run(scene, end);
    context.examine(toString(spin ? Effect::bottomSpinFriction : Effect::bottomFriction));
    const double deceleration = scene.bottom->mu * scene.bottom->gravity;
    const double lost = deceleration * after.velocityTime;
    const Vec2& velocity = scene.disks.velocity[0];
    const Vec2 expected = velocity * (1.0 - lost / velocity.norm());
    const double dt = context.effective.dt, way = after.velocityTime * velocity.norm();
    const double rounded = 2.0 * roundedInFlight(context.can, way, 1.0) / dt;
    const Tolerance step = {deceleration * dt + rounded, 0.0,
                            "whether the plate acts in the first half step"};
    const bool held = context.faults.empty();
    context.near(after.velocity[0], expected, step,
                 text("the velocity [m/s]", end == late     ? ", 2 s after load"
                                            : weight != 1.0 ? ", where things weigh a tenth"
                                                            : ""));
    if (held && !context.faults.empty() && weight != 1.0)
      context.suspect(end == late ? "the bottom plate brakes otherwise late after load"
                                  : "the bottom plate has another gravity than the scene's");
    const double turns = 2.0 / 3.0 / context.inertiaFactor();
    const double slower = spin ? turns * lost / smallRadius : 0.0;
    const Tolerance turn = {turns * step.absolute / smallRadius, 0.0, step.why};
    context.near(spinsOf(scene, after)[0], 30.0 - slower, turn, "the spin [rad/s]");
  }
}

/// Nothing slides: with F = −k_b x − γ_b v the plate has m v' = F and J ω' = −(2/3) a (τ_m |F| +
/// γ_b a ω) (Lätzel 2003, Eqs. 4.27 to 4.29, signs such that it brakes), here by small steps.
void bottomPlateHoldsASlowDisk(CheckContext& context) {
  constexpr double end = 1e-3, speed = 4e-4, spin = 0.1;  // bounds are at 9e-4 m/s, 0.24 rad/s
  Scene scene = sceneOf(context.law(), {}, {{Vec2::Zero(), {speed, 0.0}, spin}}, fineSteps);
  scene.bottom = thesisBottom<BottomPlate>(0.05);
  scene.bottom->tauM = 0.5;
  const Snapshot after = context.run(scene, end);
  constexpr int steps = 20000;
  const double dt = after.velocityTime / steps;
  const BottomPlate& plate = *scene.bottom;
  double x = 0.0, v = speed, omega = spin;
  for (int k = 0; k < steps; ++k) {
    const double force = -plate.kb * x - plate.gb * v;
    const double brake = plate.tauM * std::abs(force) + plate.gb * omega * smallRadius;
    v += dt * force / smallMass;
    x += dt * v;
    omega -= dt * 2.0 / 3.0 * smallRadius * brake / context.scene.disks.inertia[0];
  }
  const Tolerance scheme = {0.0, 0.02, "a first-order scheme at t_c/400"};
  context.near(after.velocity[0].x(), v, {0.02 * speed, 0.0, scheme.why}, "the velocity [m/s]");
  context.near(spinsOf(scene, after)[0], omega, {0.02 * spin, 0.0, scheme.why}, "the spin [rad/s]");
}

// ---- walls that move ----------------------------------------------------------------------------

constexpr double arm = 0.1;         // of the wall disk that pushes [m]
constexpr double push = 0.1;        // its speed when it meets the disk [m/s]
constexpr double pushEnd = 0.0101;  // the disk has been pushed away by then [s]

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

/// A wall of two disks, one of which runs into a disk at rest; or a plane through the origin that
/// runs into one above it, when it turns at the same arm.
Scene pushing(const ContactLaw& law, Motion::Kind kind, bool plane) {
  const Motion motion = motionOf(kind);
  if (plane)
    return sceneOf(law, {planeWall(Vec2::Zero(), {0.0, 1.0}, motion)},
                   {{{kind == Motion::Kind::rotating ? arm : 0.0, smallRadius + Encounter::gap}}},
                   200.0);
  const Vec2 member(arm, 0.0);
  const Vec2 towards = kind == Motion::Kind::radial ? Vec2(-1.0, 0.0) : Vec2(0.0, 1.0);
  return sceneOf(law, {wallOf("wall", Vec2::Zero(), {member, Vec2(-0.03, 0.04)}, motion)},
                 {{member + (2.0 * smallRadius + Encounter::gap) * towards}}, 200.0);
}

/// Relative error of a sum over that many steps: half a bit for every addition.
double roundedSum(double steps) {
  return 0.5 * std::numeric_limits<double>::epsilon() * steps;
}

void expectPrescribed(CheckContext& context, const Snapshot& now) {
  const WallBody& body = context.scene.bodies[0];
  Tolerance relative = context.byPrecision(1e-12, 1e-5, "the closed form, rounded");
  // An engine may have its time from adding up steps, and turns with it.
  const double turns = std::max(1.0, std::abs(body.motion.angularVelocity) * now.positionTime);
  const auto steps = static_cast<double>(context.engine.stats().steps);
  const double summed = turns * roundedSum(steps);
  for (double* part : {&relative.absolute, &relative.relative}) *part += summed;
  const Tolerance length = {relative.relative * arm, 0.0, relative.why};
  const BodyState state = stateAt(body.motion, body.centre, now.positionTime);
  const BodySnapshot& found = now.bodies[0];
  context.near(found.angle, state.angle, relative, "the body's angle [rad]");
  context.near(found.centre, state.centre, length, "the body's centre [m]");
  context.near(found.velocity, state.velocity, relative, "the body's velocity [m/s]");
  context.near(found.angularVelocity, state.angularVelocity, relative,
               "the body's angular velocity [rad/s]");
  context.requireEqual(now.wallPosition.size(), body.diskPosition.size(), "wall disks shown");
  for (std::size_t k = 0; k < body.diskPosition.size(); ++k)
    context.near(now.wallPosition[k], memberPosition(state, body.centre, body.diskPosition[k]),
                 length, "a wall disk's place [m]");
}

/// In the loaded scene the wall moves as prescribed, and the disk leaves with (1 + e_n) its speed.
void expectPush(CheckContext& context) {
  Snapshot now;
  for (const double t : {0.2 * pushEnd, 0.5 * pushEnd, pushEnd}) {
    context.engine.advance(t);
    now = context.engine.snapshot(ContactReport::none);
    expectPrescribed(context, now);
  }
  const Scene& scene = context.scene;
  const WallBody& body = scene.bodies[0];
  const Vec2 towards = body.planes.empty()
                           ? (scene.disks.position[0] - body.diskPosition[0]).normalized()
                           : body.planes[0].normal;
  const double expected = (1.0 + closedRestitution(scene.law, smallMass).value()) * push;
  const Tolerance scheme = {0.0, 0.02, "a first-order scheme, and a wall that hardly turns"};
  context.near(now.velocity[0].dot(towards), expected, scheme,
               "the speed of the disk that was pushed [m/s]");
}

template <Motion::Kind kind, bool plane>
void wallPushes(CheckContext& context) {
  if (plane && kind == Motion::Kind::oscillating) context.needs(planeMotion(kind));
  Scene scene = pushing(context.law(), kind, plane);
  plane ? context.loadWithinLimits(scene) : context.load(scene);
  context.examine(plane ? planeMotion(kind) : wallMotion(kind));
  if (!plane) context.examine(toString(Effect::movingWalls));
  expectPush(context);
  scene.disks.position[0] = {1.0, 1.0};  // out of the way
  // A second and more after load: nothing that repeats itself does so with the second.
  if (kind == Motion::Kind::oscillating) {
    context.loadWithinLimits(scene);
    expectPrescribed(context, context.at(1.23));
  }
  if (kind == Motion::Kind::radial) {  // and it stops when it is to
    scene.bodies[0].motion.radialEnd = 0.4321 * pushEnd;
    context.load(scene);
    for (const double t : {0.43 * pushEnd, 0.44 * pushEnd, pushEnd})
      expectPrescribed(context, context.at(t));
  }
}

/// Three turns and a half: the angle is Ωt, not what is left of it after whole turns, and a disk
/// far from it flies on as before.
void wheelKeepsItsAngle(CheckContext& context) {
  Scene scene = pushing(context.law(), Motion::Kind::rotating, false);
  scene.disks.position[0] = {1.0, 1.0};
  scene.bodies[0].motion.angularVelocity = 220.0;
  scene.disks.velocity[0] = {0.31, -0.17};
  context.load(scene);
  for (const double t : {0.03, 0.1}) {
    const Snapshot now = context.at(t);
    expectPrescribed(context, now);
    const auto steps = static_cast<double>(context.engine.stats().steps);
    const Tolerance rounding =
        context.byPrecision(roundedSum(steps), roundedInFlight(context.can, 1.0, steps),
                            "half a bit of every addition");
    context.near(now.position[0],
                 Vec2(scene.disks.position[0] + now.positionTime * scene.disks.velocity[0]),
                 rounding, "the position of a disk that nothing touches [m]");
  }
}

/// A gap wider than a disk, and nothing but the wall moves: neighbour lists have to see walls come.
template <bool plane>
void wallComesFromAfar(CheckContext& context) {
  constexpr double speed = 5.0 * push, gap = 2.5 * smallRadius;
  Scene scene = pushing(context.law(), Motion::Kind::translating, plane);
  scene.bodies[0].motion.velocity = {0.0, speed};
  scene.disks.position[0].y() += gap - Encounter::gap;
  context.loadWithinLimits(scene);
  context.equal(context.at(0.9 * gap / speed).velocity[0].norm(), 0.0,
                "its speed before the wall is there");
  const Snapshot after = context.at(gap / speed + pushEnd);
  const double expected = (1.0 + closedRestitution(scene.law, smallMass).value()) * speed;
  context.near(after.velocity[0].y(), expected, {0.0, 0.02, "a first-order scheme"},
               "the speed of the disk that was pushed [m/s]");
}

/// A disk that falls straight onto a turning wheel is taken along and turned the other way; so it
/// is by a wheel whose centre is elsewhere.
void turningWheelDragsADisk(CheckContext& context) {
  Scene scene = pushing(context.law(), Motion::Kind::rotating, false);
  scene.disks.position[0] = {arm + 2.0 * smallRadius + Encounter::gap, 0.0};
  scene.disks.velocity[0] = {-push, 0.0};
  const Snapshot after = context.run(scene, pushEnd);
  context.above(after.velocity[0].x(), 0.0, "the speed at which it rebounds");
  context.above(after.velocity[0].y(), 0.1 * push, "the speed at which it is taken along");
  context.below(spinsOf(scene, after)[0], -0.1 * push / smallRadius, "its spin");
  const DiskState here = statesOf(scene, after)[0];
  const Vec2 by(0.3, -0.2);
  const DiskState there = statesOf(scene, context.run(shifted(scene, by), pushEnd))[0];
  const std::size_t before = context.faults.size();
  context.sameMotion(there, here,
                     context.byPrecision(1e-6, 1e-2, "rounding of places 0.36 m from the origin"),
                     ", by a wheel whose centre is not the origin");
  // A surface that is faster by Ω × `by`, some times `push`, drags otherwise by a part of `push`.
  if (context.faults.size() > before && (there.velocity - here.velocity).norm() > 0.1 * push)
    context.suspectPart("the velocity of walls is about the origin and not about their centres");
}

/// The law sees spins as a_i ω_i + a_j ω_j: of two equal disks it does not matter which one spins,
/// be it a wall.
void wallsSpinIsFelt(CheckContext& context) {
  constexpr double omega = 30.0;
  const auto pushed = [&](const Motion& wall, double spin) {
    const Scene scene = sceneOf(context.law(), {postAt(Vec2::Zero(), wall)},
                                {{{2.0 * smallRadius + Encounter::gap, 0.0}, {-push, 0.0}, spin}});
    return statesOf(scene, context.run(scene, pushEnd))[0];
  };
  const DiskState byWall = pushed(rotating(omega), 0.0), byDisk = pushed(Motion{}, omega);
  const Tolerance rounding = context.byPrecision(1e-9, 1e-4, "roundings");
  context.above(byWall.velocity.y(), 0.1 * push, "the wall turns left and takes it along");
  context.near(byDisk.velocity, byWall.velocity, rounding,
               "the velocity, whichever of the two spins [m/s]");
  context.near(byDisk.spin - omega, byWall.spin, rounding,
               "the change of spin, whichever of the two spins [rad/s]");
}

}  // namespace

Checks freeMotionChecks() {
  return {
      {"FliesStraight", "a disk alone flies straight", fliesStraight, 2, true},
      inBoth(
          {"FallsFreely", "disks of two sizes fall freely, for two seconds", fallsFreely, 2, true}),
      {"BottomPlateBrakesADisk", "the bottom plate brakes a disk", bottomPlateBrakesADisk},
      {"BottomPlateHoldsASlowDisk",
       "where nothing slides the bottom plate acts as its equations say",
       bottomPlateHoldsASlowDisk},
  };
}

Checks wallChecks() {
  using Kind = Motion::Kind;
  return {
      inBoth({"RotatingWallPushes", "a rotating wall moves as prescribed and pushes",
              wallPushes<Kind::rotating, false>}),
      {"TranslatingWallPushes", "a translating wall moves as prescribed and pushes",
       wallPushes<Kind::translating, false>},
      {"OscillatingWallPushes", "an oscillating wall moves as prescribed and pushes",
       wallPushes<Kind::oscillating, false>},
      {"ShrinkingWallPushes", "a shrinking wall moves as prescribed and pushes",
       wallPushes<Kind::radial, false>},
      {"WheelKeepsItsAngle", "a wheel's angle counts whole turns, which change nothing else",
       wheelKeepsItsAngle},
      {"TurningPlanePushes", "a turning plane moves as prescribed and pushes",
       wallPushes<Kind::rotating, true>},
      {"OscillatingPlanePushes", "an oscillating plane moves as prescribed and pushes",
       wallPushes<Kind::oscillating, true>},
      {"PlaneComesFromAfar", "a plane that comes from afar pushes a disk at rest",
       wallComesFromAfar<true>},
      {"WallDiskComesFromAfar", "so does a wall disk", wallComesFromAfar<false>},
      {"TurningWheelDragsADisk", "a turning wheel drags a disk along, wherever it is",
       turningWheelDragsADisk},
      {"WallsSpinIsFelt", "the law feels a wall's spin as a disk's", wallsSpinIsFelt},
  };
}

}  // namespace crossgrain::conformance

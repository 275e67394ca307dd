// One disk: alone, on the bottom plate, pushed by a wall that moves as prescribed. And collisions
// far from the origin, late and of many disks, compared with the same near it, soon and of two.
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "adapters/audit.hpp"
#include "oracle/collision_oracle.hpp"
#include "runs/conformance/check_context.hpp"
#include "runs/conformance/meeting.hpp"

namespace crossgrain::conformance {
namespace {

constexpr const char* roundings = "roundings of the additions";

// ---- free motion --------------------------------------------------------------------------------

constexpr double flight = 0.05;  // [s]

Scene oneDisk(const ContactLaw& law) {
  Scene scene = emptyScene(law, 20.0);
  addDisk(scene, smallRadius, smallMass, {0.002, -0.001}, {0.31, -0.17}, 5.0);
  return scene;
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
    context.equal(context.realised.precision, toString(precision), "the precision");
    context.near(Vec2(after.position[0] - scene.disks.position[0]), flown, rounding,
                 "the way flown [m]");
    context.near(after.velocity[0], scene.disks.velocity[0], rounding, "the velocity [m/s]");
    context.near(spinsOf(scene, after)[0], 5.0, rounding, "the spin [rad/s]");
    if (after.contacts) context.equal(after.contacts->size(), 0u, "contacts of a disk alone");
  }
}

void fallsFreely(CheckContext& context) {
  Scene scene = oneDisk(context.law());
  scene.gravity = {1.5, -9.81};
  const Snapshot after = context.run(scene, flight);
  context.examine(toString(Effect::gravity));
  const double t = after.positionTime;
  const Vec2 expected =
      scene.disks.position[0] + t * scene.disks.velocity[0] + 0.5 * t * t * scene.gravity;
  const Tolerance rounding = context.byPrecision(1e-12, 1e-5, roundings);
  // Second-order schemes are exact for a constant force; Euler's, whose velocity lags, is off by
  // ½ g t dt.
  const Tolerance scheme =
      context.realised.velocityLag == 0.0
          ? rounding
          : Tolerance{0.5001 * scene.gravity.norm() * t * context.realised.dt, 0.0, "first order"};
  context.near(after.position[0], expected, scheme, "the position [m]");
  context.near(after.velocity[0],
               Vec2(scene.disks.velocity[0] + after.velocityTime * scene.gravity), rounding,
               "the velocity [m/s]");
  context.near(spinsOf(scene, after)[0], 5.0, rounding, "the spin [rad/s]");
}

/// Everything slides at once, γ_b v > µ_b m g: the disk loses µ_b g t of its speed and, where the
/// plate brakes spins, µ_b m g (2/3) a / (½ m a²) · t = (4/3)(µ_b g/a) t of its spin.
void bottomPlateBrakesADisk(CheckContext& context) {
  for (const bool spin : {false, true}) {
    Scene scene = oneDisk(context.law());
    scene.disks.spin[0] = 30.0;
    scene.bottom = thesisBottom<BottomPlate>(0.05, spin);
    const Snapshot after = context.run(scene, 0.02);
    context.examine(toString(spin ? Effect::bottomSpinFriction : Effect::bottomFriction));
    const double deceleration = scene.bottom->mu * scene.bottom->gravity;
    const double lost = deceleration * after.velocityTime;
    const Vec2& velocity = scene.disks.velocity[0];
    const Vec2 expected = velocity * (1.0 - lost / velocity.norm());
    const Tolerance step = {deceleration * context.realised.dt, 0.0,
                            "whether the plate acts in the first half step"};
    context.near(after.velocity[0], expected, step, "the velocity [m/s]");
    const double slower = spin ? 4.0 / 3.0 * lost / smallRadius : 0.0;
    const Tolerance turn = {4.0 / 3.0 * step.absolute / smallRadius, 0.0, step.why};
    context.near(spinsOf(scene, after)[0], 30.0 - slower, turn, "the spin [rad/s]");
  }
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

/// A plane through the origin that runs into a disk at rest above it.
/// @param x    of the disk [m]
/// @param gap  between them [m]
Scene pushingPlane(const ContactLaw& law, Motion::Kind kind, double x, double gap) {
  Scene scene = emptyScene(law, 200.0);
  scene.bodies = {planeWall(Vec2::Zero(), {0.0, 1.0})};
  scene.bodies[0].motion = motionOf(kind);
  addDisk(scene, smallRadius, smallMass, {x, smallRadius + gap}, Vec2::Zero());
  return scene;
}

void expectPrescribed(CheckContext& context, const Snapshot& now) {
  const Tolerance relative = context.byPrecision(1e-12, 1e-5, "the closed form, rounded");
  const Tolerance length = {relative.relative * arm, 0.0, relative.why};
  const WallBody& body = context.scene.bodies[0];
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

/// Of what is loaded: the wall moves as prescribed, and the disk leaves with (1 + e_n) its speed.
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

template <Motion::Kind kind>
void wallPushes(CheckContext& context) {
  context.load(pushingWall(context.law(), kind));
  context.examine(wallMotion(kind));
  context.examine(toString(Effect::movingWalls));
  expectPush(context);
}

void shrinkingWallStops(CheckContext& context) {
  Scene scene = pushingWall(context.law(), Motion::Kind::radial);
  scene.disks.position[0] = {1.0, 1.0};
  scene.bodies[0].motion.radialEnd = 0.4321 * pushEnd;
  context.load(scene);
  for (const double t : {0.43 * pushEnd, 0.44 * pushEnd, pushEnd})
    expectPrescribed(context, context.at(t));
}

/// Three turns and a half: the angle is Ωt, not what is left of it after whole turns, and a disk
/// far from it flies on as before.
void wheelKeepsItsAngle(CheckContext& context) {
  Scene scene = pushingWall(context.law(), Motion::Kind::rotating);
  scene.disks.position[0] = {1.0, 1.0};
  scene.bodies[0].motion.angularVelocity = 220.0;
  scene.disks.velocity[0] = {0.31, -0.17};
  context.load(scene);
  for (const double t : {0.03, 0.1}) {
    const Snapshot now = context.at(t);
    expectPrescribed(context, now);
    const auto steps = static_cast<double>(context.engine.stats().steps);
    const Tolerance rounding = context.byPrecision(
        0.5 * std::numeric_limits<double>::epsilon() * steps, 1e-5, "half a bit of every addition");
    context.near(now.position[0],
                 Vec2(scene.disks.position[0] + now.positionTime * scene.disks.velocity[0]),
                 rounding, "the position of a disk that nothing touches [m]");
  }
}

/// The same arm and speed as of the wall disks: the plane's point under the disk pushes it.
void turningPlanePushes(CheckContext& context) {
  context.loadWithinLimits(
      pushingPlane(context.law(), Motion::Kind::rotating, arm, Encounter::gap));
  context.examine(planeMotion(Motion::Kind::rotating));
  expectPush(context);
}

void oscillatingPlanePushes(CheckContext& context) {
  context.needs(planeMotion(Motion::Kind::oscillating));
  context.loadWithinLimits(
      pushingPlane(context.law(), Motion::Kind::oscillating, 0.0, Encounter::gap));
  context.examine(planeMotion(Motion::Kind::oscillating));
  expectPush(context);
}

/// A gap wider than a disk, and nothing but the plane moves: neighbour lists have to see planes
/// come.
void planeComesFromAfar(CheckContext& context) {
  constexpr double speed = 5.0 * push, gap = 2.5 * smallRadius;
  Scene scene = pushingPlane(context.law(), Motion::Kind::translating, 0.0, gap);
  scene.bodies[0].motion.velocity = {0.0, speed};
  context.loadWithinLimits(scene);
  context.equal(context.at(0.9 * gap / speed).velocity[0].norm(), 0.0,
                "its speed before the plane is there");
  const Snapshot after = context.at(gap / speed + pushEnd);
  const double expected = (1.0 + closedRestitution(scene.law, smallMass).value()) * speed;
  context.near(after.velocity[0].y(), expected, {0.0, 0.02, "a first-order scheme"},
               "the speed of the disk that was pushed [m/s]");
}

/// A disk that falls straight onto a turning wheel is taken along and turned the other way.
void turningWheelDragsADisk(CheckContext& context) {
  Scene scene = pushingWall(context.law(), Motion::Kind::rotating);
  scene.disks.position[0] = {arm + 2.0 * smallRadius + Encounter::gap, 0.0};
  scene.disks.velocity[0] = {-push, 0.0};
  const Snapshot after = context.run(scene, pushEnd);
  context.above(after.velocity[0].x(), 0.0, "the speed at which it rebounds");
  context.above(after.velocity[0].y(), 0.1 * push, "the speed at which it is taken along");
  context.below(spinsOf(scene, after)[0], -0.1 * push / smallRadius, "its spin");
}

/// The law sees spins as a_i ω_i + a_j ω_j: of two equal disks it does not matter which one spins,
/// be it a wall.
void wallsSpinIsFelt(CheckContext& context) {
  constexpr double omega = 30.0;
  const auto pushed = [&](const Motion& wall, double spin) {
    Scene scene = emptyScene(context.law(), coarseSteps);
    scene.bodies = {wallOf("post", Vec2::Zero(), {Vec2::Zero()}, wall)};
    addDisk(scene, smallRadius, smallMass, {2.0 * smallRadius + Encounter::gap, 0.0}, {-push, 0.0},
            spin);
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

// ---- far away, late and of many -----------------------------------------------------------------

/// A disk slips on a plane, on a wall disk and on another disk, wherever the engine has that.
/// @param change  makes a meeting the other one
void expectTheSameElsewhere(CheckContext& context, const ContactLaw& law, double speed,
                            const Tolerance& psi, const std::string& when,
                            const std::function<void(Meeting&)>& change) {
  // Fractions of a step at which they touch. Single precision does not keep the phase over a long
  // flight, and what impulses do may depend on it: then any of several will do.
  const std::vector<double> phases =
      context.single() ? std::vector{0.1, 0.3, 0.5, 0.7, 0.9} : std::vector{0.5};
  int count = 0;
  std::string why;
  for (const Partner partner : {Partner::plane, Partner::wallDisk, Partner::disk}) {
    Meeting here;
    here.law = law;
    here.partner = partner;
    here.steps = coarseSteps;
    here.starts = {{3.0, speed}};
    std::vector<MeetingResult> wanted;
    for (const double phase : phases) {
      here.flight = phase;
      if (const auto one = meet(context, here, &why); one && one->ends.front())
        wanted.push_back(*one);
    }
    if (wanted.empty()) continue;
    Meeting there = here;
    change(there);
    const auto found = meet(context, there, &why);
    context.require(found.has_value(), text("refuses", when, " what it runs elsewhere: ", why));
    const auto distance = [&](const MeetingResult& one) {
      const auto &is = found->ends.front(), &was = one.ends.front();
      return is ? std::abs(is->psi - was->psi) : 0.0;
    };
    const MeetingResult& nearest = *std::ranges::min_element(wanted, {}, distance);
    Tolerance allowed = psi;
    for (const MeetingResult& one : wanted)
      allowed.absolute =
          std::max(allowed.absolute, std::abs(one.ends.front()->psi - nearest.ends.front()->psi));
    expectTheSame(context, there, *found, nearest, allowed, when);
    ++count;
  }
  if (count == 0) context.skip(why.empty() ? "none of these collisions ends" : why);
}

/// Rounding of a place x to ε x moves a contact that is 70 µm deep by that part of it in each of
/// fifty steps, which a slip magnifies a few times.
void farIsAsNear(CheckContext& context) {
  const double place = context.single() ? 1.0 : 10.0;  // [m]
  expectTheSameElsewhere(
      context, context.law(), Encounter::speed,
      context.byPrecision(1e-6, 0.1, "rounding of places so far from the origin"),
      text(", ", place, " m from the origin"), [&](Meeting& there) {
        there.place = {place, -0.7 * place};
      });
  context.examine(farPlaces);
}

/// Two seconds of flight before the same collision. The law is a twenty-fifth as stiff, the
/// restitution the same, so that a step is five times as long.
void lateIsAsEarly(CheckContext& context) {
  constexpr double late = 2.0;  // [s]
  ContactLaw soft = context.law();
  soft.kn /= 25.0;
  soft.kt /= 25.0;
  for (double* constant : {&soft.gn, &soft.gt}) {
    if (soft.damper == Damper::constant) *constant /= 5.0;
    if (soft.damper == Damper::viscoelastic) *constant *= 5.0;
  }
  const double dt = emptyScene(soft, coarseSteps).dt;
  expectTheSameElsewhere(context, soft, 0.01,
                         context.byPrecision(1e-6, 0.1, "a flight of 2 cm, rounded in every step"),
                         text(", ", late, " s after load"),
                         // At the same phase of a step: of the engine's own, where it has one.
                         [&](Meeting& there) {
                           const double step = context.realised.dt;
                           there.flight += std::round(late / step) * step / dt;
                         });
  context.examine(lateTimes);
}

/// 150 pairs, far apart: every one does what one alone does, and a snapshot in the midst of it has
/// all contacts.
void manyAreAsFew(CheckContext& context) {
  const Scene one = encounterScene(crookedEncounter(), context.law(), coarseSteps);
  const std::vector<DiskState> alone = statesOf(one, context.run(one, Encounter::end));
  Scene many = emptyScene(context.law(), coarseSteps);
  constexpr int columns = 15, rows = 10;
  constexpr double apart = 8.0 * largeRadius;
  for (int k = 0; k < columns * rows; ++k)
    for (const int i : {0, 1})
      addDisk(many, one.disks.radius[i], one.disks.mass[i],
              one.disks.position[i] + Vec2(apart * (k % columns), apart * (k / columns)),
              one.disks.velocity[i], one.disks.spin[i]);
  context.load(many);
  const double touch = Encounter::gap / Encounter::speed;
  const Snapshot middle = context.at(touch + 0.4 * smallContactTime);
  if (context.contactReport() != ContactReport::none) {
    const AuditBasis basis = auditBasis(context.scene, context.can, context.realised);
    const std::string why = whyUnsound(middle, basis, middle.positionTime);
    context.expect(why.empty(), why);
  }
  const std::vector<DiskState> states = statesOf(many, context.at(Encounter::end));
  context.requireEqual(states.size(), many.disks.size(), "positions shown");
  const Tolerance part = context.byPrecision(1e-6, 0.1, "rounding of places");
  const double wanted = (alone[0].position - alone[1].position).norm();
  for (std::size_t k = 0; k < states.size(); k += 2) {
    const std::string which = text(" of pair ", k / 2, " of ", states.size() / 2);
    context.near((states[k].position - states[k + 1].position).norm(), wanted,
                 {part.absolute * smallRadius, 0.0, part.why}, "the distance [m]" + which);
    for (const std::size_t i : {0, 1}) context.sameMotion(states[k + i], alone[i], part, which);
  }
  context.examine(manyDisks);
}

/// Pressed between two posts, a disk hangs on its two tangential springs, ξ = m g/(2 k_t) from
/// where they were relaxed. Another falls past it for 2700 steps and 70 mm, through more than
/// a hundred lists of neighbours: none may lose the springs' state, and no step the other's
/// velocity.
void springsHoldWhileAnotherFalls(CheckContext& context) {
  const ContactLaw law = context.law();
  if (law.normal != NormalLaw::linear || law.tangential != TangentialLaw::springDashpot)
    context.skip("has no linear law with tangential spring and dashpot");
  constexpr double gravity = 9.81, depth = 0.02 * smallRadius, end = 0.12;
  constexpr double post = 2.0 * smallRadius - depth;
  Scene scene = emptyScene(law, coarseSteps);
  scene.gravity = {gravity, 0.0};
  scene.bodies = {wallOf("posts", Vec2::Zero(), {{0.0, post}, {0.0, -post}})};
  addDisk(scene, smallRadius, smallMass, {0.0, 20.0 * smallRadius}, Vec2::Zero());
  addDisk(scene, smallRadius, smallMass, Vec2::Zero(), Vec2::Zero());
  context.load(scene);
  const double stretch = smallMass * gravity / (2.0 * law.kt);
  for (const double t : {0.25 * end, 0.5 * end, 0.75 * end, end}) {
    const Snapshot now = context.at(t);
    const std::string when = text(" after ", context.engine.stats().steps, " steps");
    // Rounded posts and arms that follow the overlap make two per cent.
    context.atMost(now.position[1].x() / stretch, 1.2,
                   "sag of a disk that springs hold, in m g/(2 k_t)," + when);
    const double fallen = 0.5 * gravity * now.positionTime * now.positionTime;
    const Tolerance scheme = {0.51 * gravity * now.positionTime * context.realised.dt, 1e-5,
                              "first order, or single precision"};
    context.near(now.position[0].x(), fallen, scheme, "the way fallen [m]" + when);
  }
  context.examine(toString(Effect::tangentialSpring));
}

}  // namespace

Checks freeMotionChecks() {
  static constexpr Check list[] = {
      {"FliesStraight", "a disk alone flies straight", fliesStraight},
      {"FallsFreely", "a disk falls freely", fallsFreely},
      {"BottomPlateBrakesADisk", "the bottom plate brakes a disk", bottomPlateBrakesADisk},
  };
  return list;
}

Checks wallChecks() {
  using Kind = Motion::Kind;
  static constexpr Check list[] = {
      {"RotatingWallPushes", "a rotating wall moves as prescribed and pushes",
       wallPushes<Kind::rotating>},
      {"TranslatingWallPushes", "a translating wall moves as prescribed and pushes",
       wallPushes<Kind::translating>},
      {"OscillatingWallPushes", "an oscillating wall moves as prescribed and pushes",
       wallPushes<Kind::oscillating>},
      {"ShrinkingWallPushes", "a shrinking wall moves as prescribed and pushes",
       wallPushes<Kind::radial>},
      {"ShrinkingWallStops", "a shrinking wall stops when it is to", shrinkingWallStops},
      {"WheelKeepsItsAngle", "a wheel's angle counts whole turns, which change nothing else",
       wheelKeepsItsAngle},
      {"TurningPlanePushes", "a turning plane moves as prescribed and pushes", turningPlanePushes},
      {"OscillatingPlanePushes", "an oscillating plane moves as prescribed and pushes",
       oscillatingPlanePushes},
      {"PlaneComesFromAfar", "a plane that comes from afar pushes a disk at rest",
       planeComesFromAfar},
      {"TurningWheelDragsADisk", "a turning wheel drags a disk along", turningWheelDragsADisk},
      {"WallsSpinIsFelt", "the law feels a wall's spin as a disk's", wallsSpinIsFelt},
  };
  return list;
}

Checks reachChecks() {
  static constexpr Check list[] = {
      {"FarIsAsNear", "a collision far from the origin is as one near it", farIsAsNear},
      {"LateIsAsEarly", "a collision two seconds after load is as one at once", lateIsAsEarly},
      {"ManyAreAsFew", "each of 150 pairs does what one alone does", manyAreAsFew},
      {"SpringsHoldWhileAnotherFalls",
       "springs hold a disk while another falls past it, and it falls freely",
       springsHoldWhileAnotherFalls},
  };
  return list;
}

}  // namespace crossgrain::conformance

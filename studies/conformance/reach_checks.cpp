// Checks that place, time, speed and number do not matter: collisions far from the origin, late,
// fast and of many disks compared with the same near it, soon, slow and of two; and scenes that go
// on as they are.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <span>

#include "adapters/audit.hpp"
#include "stability/transform.hpp"
#include "studies/conformance/check_context.hpp"
#include "studies/conformance/meeting.hpp"

namespace crossgrain::conformance {
namespace {

constexpr std::array everyPartner = {Partner::plane, Partner::wallDisk, Partner::disk};

/// A disk slips on a plane, on a wall disk and on another disk, wherever the engine has that.
/// @param change  makes a meeting the other one
void expectTheSameElsewhere(CheckContext& context, const ContactLaw& law,
                            const CollisionStart& start, const Tolerance& psi,
                            const std::string& when, const std::function<void(Meeting&)>& change,
                            std::span<const Partner> partners = everyPartner) {
  // Fractions of a step at which they touch. Single precision does not keep the phase over a long
  // flight, and what impulses do may depend on it: then any of several will do.
  const std::vector<double> phases =
      context.single() ? std::vector{0.1, 0.3, 0.5, 0.7, 0.9} : std::vector{0.5};
  int count = 0;
  std::string why;
  for (const Partner partner : partners) {
    Meeting here;
    here.law = law;
    here.partner = partner;
    here.steps = coarseSteps;
    here.starts = {start};
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
  const double place = context.single() ? 1.0 : 60.0;  // [m]
  expectTheSameElsewhere(
      context, context.law(), {3.0, Encounter::speed},
      context.byPrecision(1e-6, 0.1, "rounding of places so far from the origin"),
      text(", ", place, " m from the origin"), [&](Meeting& there) {
        there.place = {place, -0.7 * place};
      });
  context.examine(farPlaces);
}

/// A twenty-fifth as stiff with the same restitution, so that a step is five times as long.
ContactLaw softer(const ContactLaw& law) {
  return inUnits(law, {.time = 5.0});
}

/// More than 16 bits count.
constexpr double manySteps = 70'000.0;

/// Two seconds of flight before the same collision; and, of soft disks in double precision, 70 000
/// steps before one on a plane.
/// In a step a place x, which v dt is added to, is rounded by 2⁻⁵³ x at most, the same way for as
/// long as x has one power of two: after n steps a right engine touches within 2⁻⁵⁴ n² of a step of
/// when it should, here 3e-7. A step is 1.5 % of such a contact's duration, and moves Ψ_f and e_n
/// less: 4e-9, and 1e-6 after a million steps. In single precision it is 2⁻²⁵ n² of a step, 3 in
/// two seconds and 150 here.
void lateIsAsEarly(CheckContext& context) {
  constexpr double late = 2.0;  // [s]
  const ContactLaw soft = softer(context.law());
  const double dt = emptyScene(soft, coarseSteps).dt;
  const Tolerance rounded =
      context.byPrecision(1e-6, 0.1, "a flight of centimetres, rounded in every step");
  // At the same phase of a step: of the engine's own, where it has one.
  const auto flies = [&](double steps) {
    return [&, steps](Meeting& there) {
      const double step = context.effective.dt;
      there.flight += (steps > 0.0 ? steps : std::round(late / step)) * step / dt;
    };
  };
  const CollisionStart start = {3.0, 0.01};
  expectTheSameElsewhere(context, soft, start, rounded, text(", ", late, " s after load"),
                         flies(0.0));
  constexpr std::array onAPlane = {Partner::plane};
  if (!context.single() && !context.rigid() &&
      std::ranges::count(declaredBy(context.can), planes) > 0)
    expectTheSameElsewhere(context, soft, start, rounded,
                           text(", ", manySteps, " steps after load"), flies(manySteps), onAPlane);
  context.examine(lateTimes);
}

/// A small disk and a large one, each on two rollers that turn and turn it: once they have settled
/// nothing changes any more: weights are in balance with f_n. (Where the plate or rolling
/// resistance brakes the disks as well it does not hold for every engine that is right.)
Scene rollers(const CheckContext& context) {
  Scene scene = emptyScene(softer(context.law()), coarseSteps);
  scene.gravity = {0.0, -9.81};
  constexpr double rate = 10.0;  // rad/s
  for (const bool isLarge : {false, true}) {
    const double radius = isLarge ? largeRadius : smallRadius, reach = radius + smallRadius;
    const Vec2 middle(isLarge ? 8.0 * largeRadius : 0.0, 0.0);
    for (const double side : {-0.6, 0.6}) {
      const Vec2 centre = middle + Vec2(side * reach, 0.0);
      scene.bodies.push_back(postAt(centre, rotating(rate), text("roller", scene.bodies.size())));
    }
    addDisk(scene, radius, isLarge ? largeMass : smallMass, middle + Vec2(0.0, 0.8 * reach),
            Vec2::Zero(), -rate * smallRadius / radius);
  }
  return scene;
}

/// Disks on rollers that are at rest, or spin steadily, after 0.9 s do the same at 2 s.
void rollersGoOn(CheckContext& context) {
  context.needs(toString(Effect::movingWalls));
  context.needs(toString(Effect::rotation));
  constexpr double early = 0.9, late = 2.0;  // [s]; e-folding times are some 10 ms
  const Scene scene = context.simplified(rollers(context));
  const std::vector<DiskState> was = statesOf(scene, context.run(scene, early));
  const std::vector<DiskState> now = statesOf(scene, context.at(late));
  const Tolerance part =
      context.rigid()
          ? Tolerance{0.05, 0.0, "impulses hold disks to within the engine's own slop"}
          : context.byPrecision(1e-6, 1e-2, "what the beginning has left, and roundings");
  for (std::size_t i = 0; i < now.size(); ++i) {
    context.above(-was[i].spin, 0.5 * -scene.disks.spin[i], "the spin that rollers keep up");
    context.sameState(
        now[i], was[i], part,
        text(" of disk ", i, " on rollers, ", late, " s after load and ", early, " s"));
  }
  context.examine(lateTimes);
}

/// The same law in another unit of time: a hundred times as fast, ten thousand times as stiff.
void fastIsAsSlow(CheckContext& context) {
  if (context.rigid()) context.skip("has no stiffness that a unit of time could change");
  constexpr double times = 100.0;
  const Scene slow = encounterScene(crookedEncounter(), context.law(), coarseSteps);
  const Scene fast = inUnits(slow, {.time = 1.0 / times});
  const std::vector<DiskState> wanted = statesOf(slow, context.run(slow, Encounter::end));
  std::vector<DiskState> found = statesOf(fast, context.run(fast, Encounter::end / times));
  const Tolerance part = context.byPrecision(1e-9, 1e-4, "roundings of another unit of time");
  for (std::size_t i = 0; i < found.size(); ++i) {
    found[i].velocity /= times;
    found[i].spin /= times;
    context.sameState(found[i], wanted[i], part, text(" of disk ", i, ", 100 times as fast"));
  }
}

/// Flights of some hundred steps, in each of which a disk goes further than lists of neighbours are
/// wide within twenty; and so fast past a partner that it glances off that six steps do.
void fastDisksAreNotMissed(CheckContext& context) {
  if (context.rigid()) context.skip("finds rigid disks that overlap by what they go in a step");
  const Tolerance rounding = context.byPrecision(1e-6, 0.1, "rounding of places");
  constexpr std::array other = {Partner::disk};
  for (const double steps : {200.0, 207.0, 214.0}) {
    const auto later = [&](Meeting& there) { there.flight += steps; };
    const std::string after = text(", after a flight of ", steps, " steps at ");
    expectTheSameElsewhere(context, context.law(), {3.0, 2.0}, rounding, after + "2 m/s", later);
    expectTheSameElsewhere(context, context.law(), {3.0, 6.0, Approach::oblique}, rounding,
                           after + "19 m/s", later, other);
  }
}

/// Checks 520 pairs, far apart: each moves as one alone, and a snapshot in the middle has all
/// contacts.
void manyAreAsFew(CheckContext& context) {
  const Scene one = encounterScene(crookedEncounter(), context.law(), coarseSteps);
  const std::vector<DiskState> alone = statesOf(one, context.run(one, Encounter::end));
  Scene many = emptyScene(context.law(), coarseSteps);
  constexpr int columns = 26, rows = 20;
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
    const AuditBasis basis = auditBasis(context.scene, context.can, context.effective);
    const std::string why = auditFault(middle, basis, middle.positionTime);
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

/// Two spinning disks that touch after a flight, falling or not.
/// @param velocity  of both [m/s]  @param apart  how long before they touch [s]
void addSlowPair(Scene& scene, const Vec2& middle, const Vec2& velocity, double apart) {
  constexpr double speed = 0.01;  // [m/s], of each
  for (const double side : {1.0, -1.0})
    addDisk(scene, smallRadius, smallMass, middle + Vec2(0.0, side * (smallRadius + speed * apart)),
            velocity - Vec2(0.0, side * speed), 3.0 * speed / smallRadius);
}

/// How one of two disks moves by the other, which gravity does not enter.
DiskState motionOf(const Scene& scene, const Snapshot& now, std::size_t i, std::size_t j) {
  const std::vector<DiskState> states = statesOf(scene, now);
  DiskState motion = states.at(i);
  motion.velocity -= states.at(j).velocity;
  return motion;
}

/// Pressed between two posts, a disk hangs on its two tangential springs, ξ = m g/(2 k_t) from
/// where they were relaxed. Another falls past it, or is thrown up and comes back, through more
/// than a hundred lists of neighbours: none may lose the springs' state, and no step the other's
/// velocity. In double precision two more fall that meet shortly before the end, as two that meet
/// at once (lateIsAsEarly() has how far roundings take them apart).
void expectSpringsToHold(CheckContext& context, const ContactLaw& law, double gravity, double speed,
                         double end) {
  constexpr double depth = 0.02 * smallRadius, post = 2.0 * smallRadius - depth;
  constexpr double before = 2000.0;  // steps before the end, forty contacts
  const Scene empty = emptyScene(law, coarseSteps);
  const bool pair = !context.single() && end > 2.0 * before * empty.dt;
  DiskState wanted{};
  double apart = 0.0;  // [s]
  if (pair) {
    Scene soon = empty;
    addSlowPair(soon, Vec2::Zero(), Vec2::Zero(), 0.5 * soon.dt);
    wanted = motionOf(soon, context.run(soon, 200.0 * soon.dt), 0, 1);
    const double step = context.effective.dt;
    apart = (std::round(end / step) - before) * step + 0.5 * empty.dt;
  }
  Scene scene = empty;
  scene.gravity = {gravity, 0.0};
  scene.bodies = {wallOf("posts", Vec2::Zero(), {{0.0, post}, {0.0, -post}})};
  addDisk(scene, smallRadius, smallMass, {0.0, 20.0 * smallRadius}, {-speed, 0.0});
  addDisk(scene, smallRadius, smallMass, Vec2::Zero(), Vec2::Zero());
  if (pair) addSlowPair(scene, {0.0, -0.1}, {-speed, 0.0}, apart);
  context.load(scene);
  const double stretch = smallMass * gravity / (2.0 * law.kt);
  Snapshot now;
  for (const double t : {0.25 * end, 0.5 * end, 0.75 * end, end}) {
    now = context.at(t);
    const std::string when = text(" after ", context.engine.stats().steps, " steps");
    // Rounded posts and arms that follow the overlap make two per cent.
    context.atMost(now.position[1].x() / stretch, 1.2,
                   "sag of a disk that springs hold, in m g/(2 k_t)," + when);
    const double past = now.positionTime;
    const double fallen = 0.5 * gravity * past * past - speed * past;
    const auto steps = static_cast<double>(context.engine.stats().steps);
    const double rounded = roundedInFlight(context.can, post + std::abs(fallen), steps);
    const Tolerance scheme = {
        0.51 * gravity * past * context.effective.dt + 1e-5 * speed * past + rounded, 1e-5,
        "first order, or single precision"};
    context.near(now.position[0].x(), fallen, scheme, "the way fallen [m]" + when);
  }
  if (!pair) return;
  const auto faults = context.faults.size();
  context.sameMotion(
      motionOf(scene, now, 2, 3), wanted,
      {2e-7, 0.0, "a millionth of the approach, for roundings of a long flight"},
      text(" of a disk after it met another, ", context.engine.stats().steps, " steps after load"));
  if (faults == 0 && !context.faults.empty())
    context.suspect("two disks meet otherwise late after load");
}

/// For 2700 steps and 70 mm; and for three seconds and 30 cm, more steps than 16 bits count.
void springsHoldWhileAnotherFalls(CheckContext& context) {
  const ContactLaw law = context.law();
  if (law.normal != NormalLaw::linear || law.tangential != TangentialLaw::springDashpot)
    context.skip("has no linear law with tangential spring and dashpot");
  expectSpringsToHold(context, law, 9.81, 0.0, 0.12);
  expectSpringsToHold(context, law, 0.2, 0.2, 3.05);
  context.examine(toString(Effect::tangentialSpring));
}

}  // namespace

Checks reachChecks() {
  return {
      {"FarIsAsNear", "a collision far from the origin is as one near it", farIsAsNear},
      {"LateIsAsEarly", "a collision long after load is as one at once", lateIsAsEarly},
      {"RollersGoOn", "disks that rollers turn still do after two seconds what they did before",
       rollersGoOn, 2, false, PlaneFrame::flat},
      {"FastIsAsSlow", "a collision a hundred times as fast is the same in another unit of time",
       fastIsAsSlow},
      {"FastDisksAreNotMissed", "a disk that comes from afar and fast meets what it would meet",
       fastDisksAreNotMissed},
      {"ManyAreAsFew", "each of 520 pairs does what one alone does", manyAreAsFew},
      {"SpringsHoldWhileAnotherFalls",
       "springs hold a disk while others fall past it, for three seconds, and meet in the end",
       springsHoldWhileAnotherFalls},
  };
}

}  // namespace crossgrain::conformance

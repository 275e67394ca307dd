// Scenes of a few bodies, each of a kind that engines are known to get wrong in one line: the
// in-house engine, with the law that the engine declares and at its time step, does the same.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "adapters/audit.hpp"
#include "adapters/declared_law.hpp"
#include "oracle/collision_oracle.hpp"
#include "oracle/impact.hpp"
#include "studies/conformance/check_context.hpp"
#include "studies/lockstep/rules.hpp"
#include "studies/lockstep/terms.hpp"

namespace crossgrain::conformance {
namespace {

/// Where each disk is at one time after the other, by t_c [m/s].
using Places = std::vector<std::vector<double>>;

/// Velocity and rim's speed of each disk [m/s].
using Motions = std::vector<std::vector<double>>;

struct Course {
  Places places;
  Motions last;                   ///< at the last time
  std::optional<Snapshot> first;  ///< at the first, as it was asked for
};

/// @param report  contacts that the first snapshot has
Course courseOf(Engine& engine, const Scene& scene, const std::vector<double>& times,
                ContactReport report = ContactReport::none) {
  Course course{Places(scene.disks.size()), {}, {}};
  for (const double t : times) {
    engine.advance(t);
    course.last.clear();
    const Snapshot shown = engine.snapshot(course.first ? ContactReport::none : report);
    if (!course.first) course.first = shown;
    const std::vector<DiskState> now = statesOf(scene, shown);
    for (std::size_t i = 0; i < now.size(); ++i) {
      const Vec2 place = now[i].position / smallContactTime;
      course.places[i].insert(course.places[i].end(), {place.x(), place.y()});
      course.last.push_back(
          {now[i].velocity.x(), now[i].velocity.y(), now[i].spin * scene.disks.radius[i]});
    }
  }
  return course;
}

double farthestOfAll(const std::vector<std::vector<double>>& one,
                     const std::vector<std::vector<double>>& other) {
  double most = 0.0;
  for (std::size_t i = 0; i < one.size(); ++i) most = std::max(most, farthest(one[i], other[i]));
  return most;
}

/// A disk that is elsewhere, or in the end moves otherwise, than under the in-house engine by more
/// than a thousandth of k_n moves any (lockstep's rule for one law) is a fault. Velocities of half
/// a step before are compared of disks that nothing pushes in the end.
/// @param times  when they are compared [s]
/// @param which  "in a corner"
void expectAsInHouse(CheckContext& context, const Scene& wanted, const std::vector<double>& times,
                     const std::string& which) {
  if (context.inHouse())
    context.skip("it is the in-house engine, and would be compared with itself");
  try {
    context.load(context.simplified(wanted));
  } catch (const UnsupportedScene& unsupported) {
    context.skip(unsupported.what());
  }
  const Scene& ran = context.scene;
  const double dt = context.effective.dt;
  const auto law = declaredLaw(context.can, ran, context.effective, 0.5 * smallMass);
  if (!law || !law->soft()) context.skip("the in-house engine does not have its law");
  const Course found = courseOf(context.engine, ran, times, context.contactReport());
  if (found.first->contacts) {
    const std::string why = auditFault(
        *found.first, auditBasis(ran, context.can, context.effective), found.first->positionTime);
    context.expect(why.empty(), text(which, ": ", why));
  }
  const auto inHouse = engineRegistry().front().make();
  const auto mirrored = [&](double stiffer, const std::vector<double>& when) {
    Scene scene = context.mirrored(*law);
    changeReference(scene.law, stiffer);
    inHouse->load(scene, {});
    return courseOf(*inHouse, scene, when);
  };
  const Course same = mirrored(0.0, times), stiffer = mirrored(lockstepSameLaw, times);
  const Motions before = mirrored(0.0, {times.back() - dt}).last;
  // Flights in single precision end elsewhere; an impact answers another moment of touch with 1 %.
  const double place = farthestPlace(ran);
  const double rounded = roundedInFlight(context.can, place, times.back() / dt) / smallContactTime +
                         roundedInFlight(context.can, place, 1.0) / dt +
                         context.byPrecision(1e-9, 0.02, "").relative * Encounter::speed;
  const double limit = std::max({rounded, farthestOfAll(stiffer.places, same.places),
                                 farthestOfAll(stiffer.last, same.last)});
  for (std::size_t i = 0; i < same.last.size(); ++i) {
    double off = farthest(found.places[i], same.places[i]);
    if (context.effective.velocityLag == 0.0 || farthest(before[i], same.last[i]) <= 0.1 * limit)
      off = std::max(off, farthest(found.last[i], same.last[i]));
    context.expect(off <= limit, text(which, ": disk ", i,
                                      " is off the in-house engine with its "
                                      "law by ",
                                      fmt::format("{:.3g} m/s, allowed {:.3g}", off, limit),
                                      " (a thousandth of k_n)"));
  }
}

/// Several scenes: those that the engine refuses are left out, unless it refuses all.
class Several {
 public:
  explicit Several(CheckContext& context) : context_(context) {}
  void expect(const Scene& scene, const std::vector<double>& times, const std::string& which) {
    try {
      expectAsInHouse(context_, scene, times, which);
      any_ = true;
    } catch (const Skipped& skipped) {
      reason_ = skipped.reason;
    }
  }
  /// @throws Skipped
  void end() const {
    if (!any_) context_.skip(reason_);
  }

 private:
  CheckContext& context_;
  bool any_ = false;
  std::string reason_;
};

constexpr double pace = Encounter::speed, ahead = Encounter::gap;

// ---- several at once ----------------------------------------------------------------------------

/// So many disks close in on one that is so many times as large as they are.
Scene cagedScene(const ContactLaw& law, int count, double times) {
  Scene scene = emptyScene(law, coarseSteps);
  addDisk(scene, times * smallRadius, times * smallMass, Vec2::Zero(), {0.02, -0.01}, 7.0);
  for (int k = 0; k < count; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / count;
    const Vec2 out(std::cos(angle), std::sin(angle));
    addDisk(scene, smallRadius, smallMass,
            ((times + 1.0) * smallRadius + ahead * (1.0 + 0.1 * k)) * out,
            -pace * out + 0.3 * pace * perpendicular(out), 5.0 * k);
  }
  return scene;
}

/// A disk meets a ring, and another the larger of a wall's two disks.
Scene mixedScene(const ContactLaw& law) {
  Scene scene = encounterScene(crookedEncounter(), law, coarseSteps);
  scene.disks.inertia[1] *= 2.0;
  const Vec2 place(0.1, 0.0), larger = place + Vec2(0.05, 0.0);
  scene.bodies = {wallOf("posts", place, {place, larger})};
  scene.bodies[0].diskRadius[1] = largeRadius;
  addDisk(scene, smallRadius, smallMass, larger + Vec2(0.0, largeRadius + smallRadius + ahead),
          {0.5 * pace, -pace}, 10.0);
  return scene;
}

/// A disk of a hundredth of the mass of the one that it meets, five steps a contact. With as little
/// of the dashpots, so that these do not overshoot.
Scene lightScene(ContactLaw law) {
  if (law.damper == Damper::constant)
    for (double* constant : {&law.gn, &law.gt}) *constant *= 0.1;
  Encounter pair = crookedEncounter();
  pair.masses[0] = 0.01 * smallMass;
  return encounterScene(pair, law, coarseSteps);
}

/// Two disks that are ten times as large as forty around them meet.
Scene largeAmongSmallScene(const ContactLaw& law) {
  constexpr double times = 10.0, reach = times * smallRadius;
  Scene scene = emptyScene(law, coarseSteps);
  for (int k = 0; k < 40; ++k)
    addDisk(scene, smallRadius, smallMass,
            {(k % 8 - 20.0) * 3.0 * smallRadius, (k / 8 + 20.0) * 3.0 * smallRadius}, Vec2::Zero());
  for (const double side : {-1.0, 1.0})
    addDisk(scene, reach, times * times * smallMass,
            {side * (reach + 0.5 * ahead), 0.1 * side * smallRadius}, {-0.5 * side * pace, 0.0},
            1.0);
  return scene;
}

void severalActAtOnce(CheckContext& context) {
  const ContactLaw law = context.law();
  Several scenes(context);
  const std::vector<double> soon = {0.3 * Encounter::end, Encounter::end};
  const WallBody wall = planeWall(Vec2::Zero(), Vec2::UnitX());
  const WallBody floor = planeWall(Vec2::Zero(), Vec2::UnitY(), {}, "floor");
  WallBody both = wall;
  both.planes.push_back(floor.planes.front());
  const WallBody left = postAt({-smallRadius, smallRadius}, {}, "left"),
                 below = postAt({smallRadius, -smallRadius}, {}, "below");
  // A disk that slips into a corner touches two at once: each contact has a spring of its own.
  constexpr double corner = smallRadius + ahead;
  using Bodies = std::vector<WallBody>;
  for (const auto& [bodies, where] :
       {std::pair(Bodies{both}, "in a corner of two planes of one body"),
        {Bodies{wall, floor}, "in a corner of two bodies' planes"},
        {Bodies{floor, left}, "between a plane and a wall disk"},
        {Bodies{left, below}, "between the wall disks of two bodies"}})
    scenes.expect(sceneOf(law, bodies, {{{corner, corner}, {-pace, -0.9 * pace}, 20.0}}), soon,
                  where);
  // It spins on one of them as it meets the other.
  const Vec2 first(-1.2 * smallRadius, 0.0), second(1.2 * smallRadius, -0.4 * ahead);
  scenes.expect(sceneOf(law, {wallOf("notch", Vec2::Zero(), {first, second})},
                        {{{0.0, 1.6 * smallRadius + ahead}, {0.0, -pace}, 20.0}}),
                soon, "between two wall disks of one body");
  scenes.expect(cagedScene(law, 6, 1.0), soon, "one disk that six others touch");
  scenes.expect(cagedScene(law, 12, 3.5), soon, "a large disk that twelve small ones touch");
  scenes.expect(mixedScene(law), soon,
                "a ring that a disk meets, and the larger of a wall's two disks");
  scenes.expect(lightScene(law), soon, "a disk a hundred times as light as the other");
  scenes.expect(largeAmongSmallScene(law), {0.01, 0.04},
                "two large disks that meet among small ones");
  // One disk catches up with another twelve radii outside of where any was at the start.
  constexpr double fast = 10.0 * pace;
  scenes.expect(sceneOf(law, {},
                        {{Vec2::Zero(), {fast, 0.0}, 3.0},
                         {{-14.0 * smallRadius, 0.5 * smallRadius}, {2.0 * fast, 0.0}, -4.0}}),
                {0.03, 0.06}, "two disks that meet outside of the start's box");
  // It slides and swings from one to the other, so fast that the dashpot of the first pulls it,
  // γ_n v = 1.3 k_n δ, while they still overlap: where the bound is 0 no spring grows.
  constexpr double squeezed = 2e-5, inside = smallRadius - squeezed;  // [m]
  constexpr double swing = 1.3 * thesis.kn * squeezed / thesis.gn;
  scenes.expect(sceneOf(law,
                        {planeWall(Vec2::Zero(), Vec2::UnitY()),
                         planeWall({0.0, 2.0 * inside}, {0.0, -1.0}, {}, "ceiling")},
                        {{{0.0, inside}, {0.2 * pace, swing}, 10.0}}),
                soon, "squeezed between planes of which one pulls");
  scenes.end();
}

// ---- walls under way ----------------------------------------------------------------------------

/// A disk flies to a plane that turns about another point than its own: by then both the normal and
/// the point have turned by more than a radian.
Scene turnedPlaneScene(const ContactLaw& law, const Vec2& by) {
  constexpr double omega = 20.0, meets = 0.06;  // [rad/s, s]
  const Vec2 away(std::sin(omega * meets), -std::cos(omega * meets));
  return shifted(
      sceneOf(law, {planeWall({0.0, -smallRadius - pace * meets}, Vec2::UnitY(), rotating(omega))},
              {{Vec2::Zero(), pace * away}}),
      by);
}

/// A ring about another place than the origin shrinks: one of its disks pushes a disk, and another
/// runs into one that has stopped a moment ago.
Scene shrinkingRingScene(const ContactLaw& law, const Vec2& by) {
  constexpr double ring = 0.1, shrinks = 0.004;  // [m, s]
  const Vec2 pushing(-0.03, 0.04), inwards = -pushing.normalized();
  Motion shrinking;
  shrinking.kind = Motion::Kind::radial;
  shrinking.radialVelocity = -pace;
  shrinking.radialEnd = shrinks;
  const double reach = 2.0 * smallRadius + 2.0 * pace * shrinks + 2.0 * ahead;
  return shifted(sceneOf(law, {wallOf("ring", Vec2::Zero(), {Vec2(ring, 0.0), pushing}, shrinking)},
                         {{{ring - reach, 0.0}, {pace, 0.3 * pace}, 8.0},
                          {pushing + (2.0 * smallRadius + ahead) * inwards,
                           0.2 * pace * perpendicular(inwards)}}),
                 by);
}

void wallsUnderWayAct(CheckContext& context) {
  const ContactLaw law = context.law();
  const Vec2 elsewhere(0.3, -0.2);
  Several scenes(context);
  // Quickly: what touches the disk is the plane's point under it, not under its centre.
  scenes.expect(sceneOf(law, {planeWall(Vec2::Zero(), Vec2::UnitY(), rotating(20.0))},
                        {{{1.5 * smallRadius, smallRadius + ahead}, {0.0, -pace}}}),
                {0.003, 0.01}, "on a plane that turns");
  scenes.expect(turnedPlaneScene(law, elsewhere), {0.062, 0.07}, "on a plane that has turned");
  scenes.expect(sceneOf(law, {postAt(elsewhere, rotating(-20.0))},
                        {{elsewhere + Vec2(2.0 * smallRadius + ahead, 0.0), {-pace, 0.0}}}),
                {0.003, 0.01}, "on a post that turns clockwise");
  scenes.expect(shrinkingRingScene(law, elsewhere), {0.003, 0.008, 0.016},
                "at a ring that shrinks, and has stopped");
  scenes.end();
}

// ---- the bottom plate ---------------------------------------------------------------------------

/// Two disks of different masses that slide until they rest, one of them turning, and one that the
/// plate holds on a slope; two fast ones fly apart meanwhile, so that lists of neighbours are made
/// anew. The later in the list the farther left.
void plateBrakesEachByItself(CheckContext& context) {
  constexpr double mu = 0.2, apart = 6.0 * largeRadius, fast = 20.0 * pace;
  Scene scene = emptyScene(context.law(), coarseSteps);
  scene.bottom = thesisBottom<BottomPlate>(mu);
  scene.bottom->tauM = 0.01;
  scene.gravity = {0.0, -0.3 * mu * scene.bottom->gravity};
  addDisk(scene, largeRadius, largeMass, {2.0 * apart, 0.0}, {pace, 0.0});
  addDisk(scene, smallRadius, smallMass, {apart, 0.0}, {pace, 0.0}, 30.0);
  addDisk(scene, smallRadius, smallMass, {0.0, 0.0}, Vec2::Zero());
  addDisk(scene, smallRadius, smallMass, {-apart, 0.0}, {0.0, fast});
  addDisk(scene, smallRadius, smallMass, {-2.0 * apart, 0.0}, {0.0, -fast});
  if (const auto why = context.refusal(scene)) context.skip(*why);
  expectAsInHouse(context, scene, {0.02, 0.06, 0.12}, "on the bottom plate");
  scene.disks.spin.assign(scene.disks.size(), 0.1);  // τ_m |F| brakes it, F as large as if it held
  expectAsInHouse(context, scene, {1e-3}, "on the bottom plate, where disks slide and hardly turn");
  // On a plate without torques: about a spin of 0 their signs would be roundings'.
  scene = sceneOf(
      context.law(), {},
      {{{0.0, 0.99 * smallRadius}, {pace, 0.0}}, {{0.0, -0.99 * smallRadius}, {pace, 0.0}}});
  scene.bottom = thesisBottom<BottomPlate>(mu, false);
  expectAsInHouse(context, scene, {1e-3, 0.02}, "two that touch on the bottom plate");
}

// ---- slow ---------------------------------------------------------------------------------------

/// A disk that has rested on a plane for long rises with it, and one that comes so slowly that it
/// dips in by less than an atom leaves as others do: nothing is frozen, and no overlap too small.
void slowIsNotAtRest(CheckContext& context) {
  if (context.rigid()) context.skip("holds rigid disks to within its own slop");
  if (context.single()) context.skip("single precision rounds what is so slow away");
  constexpr double slow = 1e-7;  // [m/s]
  const ContactLaw law = context.law();
  const Tolerance scheme = {0.0, 0.02, "a first-order scheme, and where in a step it touches"};
  Scene touch = sceneOf(law, {postAt(Vec2::Zero())}, {}, 4.0 * coarseSteps);
  const double place = 2.0 * smallRadius + 0.5 * touch.dt * slow;
  addDisk(touch, smallRadius, smallMass, {place, 0.0}, {-slow, 0.0});
  if (const auto restitution = closedRestitution(law, smallMass)) {
    // Hertz' contacts last the longer the slower they are, ∝ v^(-1/5).
    const double lasts = impactTime(law, {smallMass, 0.5 * smallRadius, slow});
    const Snapshot after = context.run(touch, 3.0 * lasts);
    context.near(after.velocity[0].x(), *restitution * slow, scheme,
                 "the speed at which a disk leaves that came at 0.1 µm/s [m/s]");
  }
  Motion rising;
  rising.kind = Motion::Kind::translating;
  rising.velocity = {0.0, slow};
  Scene rest =
      sceneOf(law, {planeWall(Vec2::Zero(), Vec2::UnitY(), rising)}, {{{0.0, smallRadius}}});
  rest.gravity = {0.0, -9.81};
  if (!simulates(context.can, Effect::gravity) || context.refusal(rest)) return;
  const double later = 0.25, end = 0.5;  // [s]; e-folding times are some 4 ms
  const double was = context.at(later).position[0].y(), now = context.at(end).position[0].y();
  context.near((now - was) / (end - later), slow, scheme,
               "the speed of a disk on a plane that rises at 0.1 µm/s [m/s]");
}

}  // namespace

Checks sceneChecks() {
  return {
      {"SeveralActAtOnce",
       "what touches a disk at once acts at once, whatever it is: the in-house engine does the "
       "same",
       severalActAtOnce},
      {"WallsUnderWayAct", "walls that turn or have stopped act with the velocity that they have",
       wallsUnderWayAct},
      {"PlateBrakesEachByItself",
       "the bottom plate brakes each disk by its own weight, until it rests and from then on",
       plateBrakesEachByItself},
      {"SlowIsNotAtRest", "nothing is too slow or too slight to be felt", slowIsNotAtRest},
  };
}

}  // namespace crossgrain::conformance

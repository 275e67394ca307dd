// Two bodies meet once: conservation laws and restitution; and the same collision mirrored, turned,
// shifted and renumbered.
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

#include "oracle/collision_oracle.hpp"
#include "stability/recording.hpp"
#include "stability/transform.hpp"
#include "studies/conformance/check_context.hpp"
#include "studies/conformance/conformance_scenes.hpp"

namespace crossgrain::conformance {
namespace {

const Tolerance restitution = {0.0, 0.02, "a first-order scheme at t_c/400"};

Vec2 momentum(const Scene& scene, const Snapshot& now) {
  Vec2 sum = Vec2::Zero();
  for (std::size_t i = 0; i < now.velocity.size(); ++i)
    sum += scene.disks.mass[i] * now.velocity[i];
  return sum;
}

void headOnCollision(CheckContext& context) {
  Encounter unequal;  // masses 1 : 10 of one material
  unequal.radii[1] = std::sqrt(10.0) * smallRadius;
  unequal.masses[1] = 10.0 * smallMass;
  unequal.drift = {0.013, -0.021};
  for (const Encounter& pair : {Encounter{}, unequal}) {
    const Scene scene = encounterScene(pair, context.law(), fineSteps);
    const Snapshot before = context.run(scene, 0.0);
    context.examine(toString(Effect::normalDamping));
    const Snapshot after = context.at(Encounter::end);
    const Vec2 distance = after.position[0] - after.position[1];
    const Vec2 velocity = after.velocity[0] - after.velocity[1];
    context.above(distance.norm(), pair.radii[0] + pair.radii[1], "their distance in the end");
    context.above(velocity.dot(distance), 0.0, "the speed at which they part");
    context.near(momentum(scene, after), momentum(scene, before),
                 context.byPrecision(1e-12, 1e-5, "both disks get the same impulse",
                                     pair.reducedMass() * Encounter::speed),
                 "momentum [kg m/s]");
    context.below(kineticEnergy(context.scene.disks, after),
                  kineticEnergy(context.scene.disks, before), "kinetic energy after a collision");
    context.near(velocity.x() / Encounter::speed,
                 closedRestitution(scene.law, pair.reducedMass()).value(), restitution, "e_n");
    // Nothing slides, so nothing turns.
    const Tolerance turn =
        context.byPrecision(1e-12, 1e-5, "head on, without spin", Encounter::speed / smallRadius);
    for (const double spin : spinsOf(scene, after))
      context.near(spin, 0.0, turn, "a spin after it [rad/s]");
  }
}

/// A disk that touches a plane there after a short flight straight at it.
Scene thrownAt(const ContactLaw& law, const Vec2& point, const Vec2& normal, const Vec2& touching) {
  return sceneOf(law, {planeWall(point, normal)},
                 {{touching + Encounter::gap * normal, -Encounter::speed * normal}}, fineSteps);
}

/// It comes back with e_n of its speed.
void expectRebound(CheckContext& context, const Vec2& normal) {
  const Snapshot after = context.at(Encounter::end);
  const double en = closedRestitution(context.scene.law, smallMass).value();
  context.near(after.velocity[0], Vec2(en * Encounter::speed * normal), restitution,
               "the velocity after it [m/s]");
}

/// Near its point and far from it: planes have no ends.
void planeDoesNotYield(CheckContext& context) {
  for (const double point : {0.5, -30.0}) {
    context.load(thrownAt(context.law(), {point, 0.0}, Vec2::UnitY(), {0.001, smallRadius}));
    const std::size_t before = context.faults.size();
    expectRebound(context, Vec2::UnitY());
    if (context.faults.size() > before && before == 0 && point < 0.0)
      context.suspect(text("planes end within ", -point, " m of their point"));
  }
}

/// A disk that flies into a corner touches both of its planes at once, whichever comes first.
void cornersHaveNoFirstPlane(CheckContext& context) {
  context.needs(planes);
  if (context.rigid()) context.skip("lets contacts collide one after the other");
  std::vector<DiskState> states;
  for (const bool swapped : {false, true}) {
    WallBody corner = planeWall(Vec2::Zero(), Vec2::UnitX());
    corner.planes.push_back({Vec2::Zero(), Vec2::UnitY()});
    if (swapped) std::swap(corner.planes[0], corner.planes[1]);
    constexpr double place = smallRadius + Encounter::gap;
    const Scene scene =
        sceneOf(context.law(), {corner},
                {{{place, place}, {-Encounter::speed, -0.9 * Encounter::speed}, 20.0}});
    states.push_back(statesOf(scene, context.run(scene, Encounter::end))[0]);
  }
  context.sameState(states[1], states[0],
                    context.byPrecision(1e-9, 1e-4, "sums in another order, magnified"),
                    ", of a corner whose planes come in the other order");
}

void slantingPlaneDoesNotYield(CheckContext& context) {
  const Vec2 normal(0.6, 0.8), point(0.3, -0.4);  // 0.14 m below the origin
  const Vec2 touching = point + 0.2 * Vec2(-0.8, 0.6) + smallRadius * normal;
  context.loadWithinLimits(thrownAt(context.law(), point, normal, touching));
  context.examine(slantingPlanes);
  expectRebound(context, normal);
}

/// Bodies that a disk is thrown to and fro between.
enum class Between { posts, planes, disks };

/// A disk that is thrown to and fro, with friction that loads the springs. Disks that it is thrown
/// between are a million times as heavy.
Scene toAndFro(const ContactLaw& law, Between what) {
  constexpr double post = 2.0 * smallRadius + Encounter::gap, plane = smallRadius + Encounter::gap;
  Scene scene = sceneOf(law, {}, {{{0.0, 0.0004}, {-Encounter::speed, 0.0}, 20.0}});
  if (what == Between::posts)
    scene.bodies = {wallOf("posts", Vec2::Zero(), {{-post, 0.0}, {post, 0.0}})};
  if (what == Between::planes) {
    scene.bodies = {planeWall({-plane, 0.0}, Vec2::UnitX())};
    scene.bodies[0].planes.push_back({{plane, 0.0}, -Vec2::UnitX()});
  }
  if (what == Between::disks)
    for (const double side : {-post, post})
      addDisk(scene, smallRadius, 1e6 * smallMass, {side, 0.0}, Vec2::Zero());
  return scene;
}

/// A run that starts from a moment of free flight goes on as the run did that it was taken from.
void expectNoMemory(CheckContext& context, Scene scene, const std::string& where) {
  std::vector<std::size_t> changes;  // steps after which contacts begin or end
  const auto touches = [](const Snapshot& now) { return now.contacts && now.contacts->size() > 0; };
  const std::vector<Snapshot> seen =
      context.watch(4.0 * Encounter::end, [&](const std::vector<Snapshot>& so) {
        const std::size_t k = so.size() - 1;
        if (so.size() > 1 && touches(so[k]) != touches(so[k - 1])) changes.push_back(k);
        return changes.size() > 7;  // two bounces after the first three
      });
  context.require(changes.size() >= 5,
                  text("it is to touch one ", where,
                       ", the other, and the first again: ", changes.size(), ", below 5"));
  const auto restarted = [&](std::size_t from, std::size_t to) {
    scene.disks.position = seen[from].position;
    scene.disks.velocity = seen[from].velocity;
    scene.disks.spin = spinsOf(scene, seen[from]);
    context.load(scene);
    return statesOf(scene, context.at(static_cast<double>(to - from) * context.effective.dt))[0];
  };
  const auto state = [&](std::size_t k) { return statesOf(scene, seen[k])[0]; };
  const Tolerance rounding = context.byPrecision(1e-9, 1e-3, "roundings, magnified by two bounces");
  const std::size_t end = seen.size() - 1;
  const std::size_t flight = (changes[3] + changes[4]) / 2;  // a step of it
  const DiskState wanted = state(end), resumed = restarted(flight, end);
  const std::size_t before = context.faults.size();
  context.sameMotion(resumed, wanted, rounding, text(", between ", where, "s"));
  const ContactLaw& law = context.scene.law;
  if (context.faults.size() == before || !law.springs() || !law.soft()) return;
  // Where it does not even go on from before the first touch, something else is wrong: what
  // snapshots show, or the step. Nor is it a memory of the contact where the two do the same until
  // a while after they meet again: a spring that is there acts at once.
  const std::size_t bounced = (changes[1] + changes[2]) / 2;
  const DiskState once = state(bounced), first = restarted(changes[0] / 2, bounced);
  const double speed = rounding.absolute * Encounter::speed;
  const auto same = [&](const DiskState& one, const DiskState& other) {
    return (one.velocity - other.velocity).norm() <= speed &&
           std::abs(one.spin - other.spin) <= speed / smallRadius;
  };
  const std::size_t met = std::min(changes[4] + 3, end);
  if (same(first, once) && !same(restarted(flight, met), state(met)))
    context.suspect(text("what a contact remembers (its spring) outlives it, at a ", where,
                         " that is met again"));
}

void freeFlightRemembersNothing(CheckContext& context) {
  context.needsContacts();
  // Without dashpots the spring is longest when they part, and felt at once when they meet; with
  // them a spring that goes on while nothing touches grows where the dashpot pushes already.
  ContactLaw undamped = fullLaw();
  undamped.tangential = TangentialLaw::spring;
  undamped.gn = 0.0;
  undamped.en = 1.0;
  ContactLaw damped = fullLaw();
  damped.gn *= 0.2;  // the fourth bounce is to have some speed left
  damped.en = 0.95;
  std::vector<ContactLaw> laws = {followed(context.can, undamped), followed(context.can, damped)};
  const std::vector<RollingLaw> rolling = rollingLaws(context.can);
  if (std::ranges::count(rolling, RollingLaw::spring) > 0 && laws.front().soft()) {
    laws.push_back(withRolling(laws.front(), RollingLaw::spring));
    laws.back().gr = 0.0;
    laws.back().muR = 1e3;  // as long as it is when they part
  }
  std::string why;
  bool any = false;
  for (const ContactLaw& law : laws)
    for (const auto& [what, name] : {std::pair(Between::posts, "wall disk"),
                                     {Between::planes, "plane"},
                                     {Between::disks, "disk"}}) {
      const Scene scene = toAndFro(law, what);
      if (const auto refusal = context.refusal(scene)) {
        why = *refusal;
      } else {
        any = true;
        expectNoMemory(context, scene, name);
      }
    }
  if (!any) context.skip(why);
}

// ---- the same, transformed ----------------------------------------------------------------------

constexpr const char* magnified = "rounding of the positions, which the stiff contact magnifies";

/// The mirrored or turned scene moves as the image of the scene.
template <bool mirror>
void imageGivesTheImage(CheckContext& context) {
  const Placement placement{mirror, mirror ? 0.0 : 0.5 * std::numbers::pi};
  const Scene scene = encounterScene(crookedEncounter(), context.law(), coarseSteps);
  const std::vector<DiskState> original = statesOf(scene, context.run(scene, Encounter::end));
  const Scene image = placed(scene, placement);
  const std::vector<DiskState> found = statesOf(image, context.run(image, Encounter::end));
  for (std::size_t i = 0; i < scene.disks.size(); ++i)
    context.sameState(
        found[i],
        {placement.turned(original[i].position), placement.turned(original[i].velocity),
         (mirror ? -1.0 : 1.0) * original[i].spin},
        context.byPrecision(1e-9, 1e-4, magnified), text(" of disk ", i));
}

/// Disks that each meet a wall disk of their own: an engine that resolves contacts one after the
/// other, or several at once, has nothing to choose.
Scene landings(const ContactLaw& law) {
  constexpr double apart = 6.0 * smallRadius;
  std::vector<Vec2> posts;
  std::vector<SmallDisk> disks;
  for (int k = 0; k < 12; ++k) {
    const Vec2 post = {apart * (k % 4), apart * (k / 4)};
    const double angle = 0.4 + 0.15 * k;
    const Vec2 outwards(std::cos(angle), std::sin(angle));
    posts.push_back(post);
    disks.push_back({post + (2.0 * smallRadius + Encounter::gap) * outwards,
                     -Encounter::speed * outwards, 3.0 * k - 15.0});
  }
  return sceneOf(law, {wallOf("posts", Vec2::Zero(), posts)}, disks);
}

/// Force of the one contact that each disk has, by its number [N].
std::map<std::size_t, Vec2> forces(const Snapshot& now) {
  std::map<std::size_t, Vec2> force;
  for (std::size_t c = 0; now.contacts && c < now.contacts->size(); ++c)
    force[static_cast<std::size_t>(now.contacts->i[c])] = now.contacts->force(c);
  return force;
}

void renumberedSceneGivesTheRenumberedResult(CheckContext& context) {
  const Scene scene = landings(context.law());
  std::vector<std::size_t> backwards(scene.disks.size());
  std::iota(backwards.rbegin(), backwards.rend(), std::size_t{0});
  const Scene other = renumbered(scene, backwards);
  context.load(scene);
  const std::vector<Snapshot> original = context.watch(Encounter::end);
  context.load(other);
  const std::vector<Snapshot> found = context.watch(Encounter::end);
  context.requireEqual(found.size(), original.size(), "the number of steps");
  double largest = 0.0;
  for (const Snapshot& now : original)
    for (const auto& [disk, force] : forces(now)) largest = std::max(largest, force.norm());
  const Tolerance part = context.byPrecision(1e-9, 1e-4, magnified);
  for (std::size_t k = 0; k < original.size(); ++k) {
    const auto states = statesOf(other, found[k]), wanted = statesOf(scene, original[k]);
    const auto force = forces(found[k]), wantedForce = forces(original[k]);
    context.requireEqual(force.size(), wantedForce.size(), "the number of contacts");
    for (std::size_t i = 0; i < backwards.size(); ++i) {
      const std::string disk = text(" of disk ", backwards[i], " numbered ", i);
      context.sameState(states[i], wanted[backwards[i]], part, disk);
      const auto pushed = wantedForce.find(backwards[i]);
      if (pushed == wantedForce.end()) continue;
      context.require(force.contains(i), "no contact" + disk);
      context.near(force.at(i), pushed->second, {part.absolute * largest, 0.0, part.why},
                   "the force [N]" + disk);
    }
  }
}

}  // namespace

Checks collisionChecks() {
  return {
      {"HeadOnCollision", "two disks head on: momentum, energy, restitution", headOnCollision},
      {"PlaneDoesNotYield", "a plane does not yield, and has no ends", planeDoesNotYield},
      {"CornersHaveNoFirstPlane", "both planes of a corner act, whichever comes first",
       cornersHaveNoFirstPlane},
      {"SlantingPlaneDoesNotYield", "nor does one along no axis", slantingPlaneDoesNotYield},
      {"FreeFlightRemembersNothing", "a contact that ended leaves nothing behind",
       freeFlightRemembersNothing},
  };
}

Checks symmetryChecks() {
  return {
      {"MirroredSceneGivesTheMirroredResult", "a mirrored scene gives the mirrored result",
       imageGivesTheImage<true>},
      {"RotatedSceneGivesTheRotatedResult", "a turned scene gives the turned result",
       imageGivesTheImage<false>},
      {"RenumberedSceneGivesTheRenumberedResult",
       "disks numbered otherwise do the same: none is another for its number",
       renumberedSceneGivesTheRenumberedResult},
  };
}

}  // namespace crossgrain::conformance

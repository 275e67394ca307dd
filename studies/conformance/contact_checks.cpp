// The contacts that an engine shows, and whether those forces are the ones that it applied.
#include <algorithm>
#include <cmath>
#include <set>

#include "adapters/audit.hpp"
#include "adapters/declared_law.hpp"
#include "law/law_options.hpp"
#include "stability/recording.hpp"
#include "studies/conformance/check_context.hpp"
#include "studies/conformance/conformance_scenes.hpp"
#include "studies/core/mirrors.hpp"

namespace crossgrain::conformance {
namespace {

/// Centres of disks and wall disks at the time of a snapshot's contacts.
std::vector<Vec2> centresAt(double t, const std::vector<Snapshot>& seen) {
  const auto nearest = std::ranges::min_element(
      seen, {}, [t](const Snapshot& now) { return std::abs(now.positionTime - t); });
  std::vector<Vec2> centres = nearest->position;
  centres.insert(centres.end(), nearest->wallPosition.begin(), nearest->wallPosition.end());
  return centres;
}

/// Sum of the contact forces on one disk or wall disk.
Vec2 forceOn(const Snapshot& now, std::int32_t id) {
  Vec2 sum = Vec2::Zero();
  for (std::size_t c = 0; now.contacts && c < now.contacts->size(); ++c) {
    if (now.contacts->i[c] == id) sum += now.contacts->force(c);
    if (now.contacts->j[c] == id) sum -= now.contacts->force(c);
  }
  return sum;
}

/// The arm of f_t about the centre of a disk that overlaps one of the same radius by δ.
double armOf(const ContactLaw& law, double overlap) {
  return law.conventions.leverArm == LeverArm::radius ? smallRadius : smallRadius - 0.5 * overlap;
}

/// A mean over an interval is shown with the normal of its end, which has turned by this since.
double turnWithin(double interval) {
  return interval * Encounter::speed / smallRadius;
}

/// In space, a spring that follows its normal to first order leaves the tangent plane by
/// (ξ·n′)(1 − cos θ), about θ³/2 of it, with each turn by θ: by Θ θ²/2 over a turn Θ.
double offPlane(const CheckContext& context, double dt) {
  if (!context.inSpace) return 0.0;
  const auto can =
      capabilitiesOf(context.entry, 60.0);  // as a plane in space it has no such option
  if (!can) return 0.0;
  const auto how = can->lawOptions.find("spring_turn");
  if (how == can->lawOptions.end() || how->second.front() != "first_order") return 0.0;
  return 0.5 * turnWithin(Encounter::end) * turnWithin(dt) * turnWithin(dt);
}

/// Two disks that hit a wall disk, a plane and each other.
Scene allKindsOfContact(const ContactLaw& law, bool withPlane) {
  Scene scene = emptyScene(law, coarseSteps);
  addDisk(scene, smallRadius, smallMass, {0.0, 0.0}, {0.03, 0.0}, 8.0);
  addDisk(scene, largeRadius, largeMass, {0.0083, 0.0005}, {-0.08, 0.01}, -3.0);
  scene.bodies = {wallOf("post", {-0.0076, 0.001}, {{-0.0076, 0.001}, {-0.02, 0.0}})};
  if (withPlane) {
    scene.bodies.push_back(planeWall({0.0, -0.0045}, {0.0, 1.0}));
    scene.disks.velocity[1].y() = -0.06;
  }
  return scene;
}

/// Every step of a heap on a turning wheel, and of an impact, which parts under cohesion, too.
void snapshotsAreSound(CheckContext& context) {
  context.needsContacts();
  std::vector<std::pair<Scene, double>> scenes = {
      {context.busy(), busyEnd}, {allKindsOfContact(context.law(), false), 2.0 * Encounter::end}};
  for (const ContactLaw& law : resistingLaws(context.can))
    if (law.coheres()) scenes.emplace_back(allKindsOfContact(law, false), 2.0 * Encounter::end);
  for (std::size_t k = 0; k < scenes.size(); ++k) {
    const auto& [scene, end] = scenes[k];
    if (!context.loads(scene, k < 2)) continue;  // the other laws have their own checks
    const AuditBasis basis = auditBasis(context.scene, context.can, context.effective);
    const double dt = context.effective.dt;
    const auto last = std::llround(end / dt);
    for (long long step = 0; step <= last; ++step) {
      const double reached = context.engine.advance(static_cast<double>(step) * dt);
      const std::string why =
          auditFault(context.engine.snapshot(context.contactReport()), basis, reached);
      if (!why.empty()) context.fault(text("at t = ", reached, " s ", why));
    }
    const std::string cost = statsFault(context.engine.stats(), dt, static_cast<double>(last) * dt);
    context.expect(cost.empty(), cost);
  }
}

/// The same, compared with the law that the engine declares.
void forcesAreThoseOfTheLaw(CheckContext& context) {
  context.needsContacts();
  std::vector<Scene> scenes = {context.busy()};
  for (const ContactLaw& law : resistingLaws(context.can))
    scenes.push_back(context.simplified(busyScene(law)));
  for (const Scene& scene : scenes) {
    if (!context.loads(scene, &scene == &scenes.front())) continue;
    const AuditBasis basis = auditBasis(context.scene, context.can, context.effective);
    const auto law = declaredLaw(context.can, context.scene, context.effective, 0.5 * smallMass);
    if (!law) context.skip("declares no law with known constants");
    for (const Snapshot& now : context.watch(busyEnd)) {
      const std::string why = lawFault(now, basis, *law);
      if (!why.empty()) context.fault(text("at t = ", now.contactTime, " s ", why));
    }
  }
}

/// i < j, n from j to i at the contact's own time, δ = a_i + a_j − distance; of a plane n is its
/// normal and δ = a_i − distance.
template <bool withPlane>
void contactsSayWhereTheyAre(CheckContext& context) {
  context.needsContacts();
  const Scene scene = allKindsOfContact(context.law(), withPlane);
  context.load(scene);
  if (!withPlane)
    context.examine(context.can.instantContacts ? instantContacts : accumulatedContacts);
  std::vector<double> radii = scene.disks.radius;
  radii.insert(radii.end(), 2, smallRadius);  // of the wall disks; the plane is number 4
  const std::vector<Snapshot> seen = context.watch(2.0 * Encounter::end);
  const Tolerance length = context.byPrecision(1e-12, 1e-6, "roundings", smallRadius);
  std::set<std::size_t> partners;
  for (const Snapshot& now : seen) {
    if (!now.contacts) continue;
    const std::vector<Vec2> centres = centresAt(now.contactTime, seen);
    for (std::size_t c = 0; c < now.contacts->size(); ++c) {
      const auto i = static_cast<std::size_t>(now.contacts->i[c]);
      const auto j = static_cast<std::size_t>(now.contacts->j[c]);
      context.require(i < j, "the ids of a contact, i before j");
      partners.insert(j);
      const bool disk = j < centres.size();
      Vec2 normal;
      double overlap;
      if (disk) {
        const Vec2 apart = centres[i] - centres[j];
        normal = apart.normalized();
        overlap = radii[i] + radii[j] - apart.norm();
      } else {
        const Plane& plane = scene.bodies.back().planes.at(0);
        normal = plane.normal;
        overlap = radii[i] - (centres[i] - plane.point).dot(normal);
      }
      const std::string which = text(" of ", i, " with ", j);
      context.near(now.contacts->normal[c], normal,
                   {length.absolute / smallRadius, 0.0, length.why}, "the normal" + which);
      context.near(now.contacts->overlap[c], overlap, length, "the overlap [m]" + which);
      if (!context.rigid())
        context.above(now.contacts->overlap[c], 0.0, "the overlap of soft disks that touch [m]");
    }
  }
  if (withPlane) {
    context.expect(partners.contains(4), "it never shows a contact with a plane");
  } else {
    context.expect(partners.contains(1) && partners.upper_bound(1) != partners.end(),
                   "it never shows a contact of two disks, or none with a wall disk");
  }
}

void slidingFlagsMarkTheBound(CheckContext& context) {
  if (!context.can.slidingFlags) context.skip("has no sliding flags");
  context.examine(slidingFlags);
  ContactLaw cut = fullLaw();
  cut.conventions.tension = Tension::cut;  // where it can: then every convention's bound is µ f_n
  Encounter pair = crookedEncounter();
  const Tolerance rounding = context.byPrecision(1e-12, 1e-5, "roundings");
  int sliding = 0, sticking = 0;
  enum class Slip { little, much, thenNone };
  for (const Slip slip : {Slip::little, Slip::much, Slip::thenNone}) {
    // A rigid impact slides or sticks, as a whole; and a spring alone, bounded by µ |f_n|, hardly
    // slides.
    if (slip == Slip::much && context.rigid()) pair.spins[0] = 100.0;
    if (slip == Slip::much && !context.rigid()) cut.mu *= 0.1;
    if (slip == Slip::thenNone) {
      if (context.rigid()) continue;
      cut.mu = fullLaw().mu;
      pair = {};
      for (double& spin : pair.spins) spin = 12.0;  // Ψ = 0.9
    }
    const ContactLaw law = followed(context.can, cut);
    context.load(encounterScene(pair, law, coarseSteps));
    Vec2 before = Vec2::Zero();
    for (const Snapshot& now : context.watch(Encounter::end)) {
      if (!now.contacts || now.contacts->size() == 0) continue;
      // A force at its bound along the last step's tangent is shorter by 1 − cos Δφ along this one.
      const Vec2 normal = (now.position[1] - now.position[0]).normalized();
      const double turn = before.isZero(0.0) ? 0.0 : (normal - before).squaredNorm();
      before = normal;
      context.requireEqual(now.contacts->sliding.size(), 1u, "sliding flags of one contact");
      const double ft = std::abs(now.contacts->tangentialForce[0]);
      const double fn = now.contacts->normalForce[0];
      const bool pushed = law.conventions.coulombBound == CoulombBound::compression;
      const double bound = law.mu * (pushed ? std::max(fn, 0.0) : std::abs(fn));
      if (now.contacts->sliding[0]) {
        context.near(ft, bound,
                     {0.0, rounding.relative + turn, "roundings, and a normal that turns"},
                     "|f_t| of a contact that slides [N]");
      } else if (law.conventions.dashpot == Dashpot::inside) {
        context.atMost(ft, bound * (1.0 + rounding.relative), "|f_t| of a contact that sticks");
      }
      ++(now.contacts->sliding[0] ? sliding : sticking);
    }
  }
  context.above(sliding, 0, "contacts that slide");
  context.above(sticking, 0, "contacts that stick");
}

/// The engine's law, and the same that resists rolling in each way that the engine has.
std::vector<ContactLaw> lawsOfLoads(CheckContext& context) {
  std::vector<ContactLaw> laws = {context.law()};
  if (laws.front().soft())
    for (const RollingLaw kind : rollingLaws(context.can))
      laws.push_back(withRolling(laws.front(), kind));
  return laws;
}

/// M on i and −M on j, each beside −l f_t [N m]; absent where the engine does not show whose M is.
/// @param law  of two disks of the small radius
std::optional<double> torqueOn(const Snapshot& now, std::int32_t id, const ContactLaw& law) {
  double sum = 0.0;
  for (std::size_t c = 0; now.contacts && c < now.contacts->size(); ++c) {
    const Contacts& all = *now.contacts;
    if (law.rolls() && all.rollingTorque.empty()) return std::nullopt;
    sum -= all.tangentialForce[c] * armOf(law, all.overlap[c]);
    if (law.rolls()) sum += (all.i[c] == id ? 1.0 : -1.0) * all.rollingTorque[c];
  }
  return sum;
}

/// Newton's second law: over each step m Δv/Δt lies between the forces that the engine shows before
/// and after it, whichever of the two, or their mean, the scheme uses; over the whole collision the
/// impulses add up, of forces and of torques.
void expectThoseThatAct(CheckContext& context, const Scene& scene, const std::string& which) {
  const std::vector<Snapshot> seen = context.watch(Encounter::end);
  const double dt = context.effective.dt;
  const double relative = context.byPrecision(1e-12, 1e-5, "").relative +
                          turnWithin(seen.back().contactInterval) + offPlane(context, dt);
  double largest = 0.0;
  for (const Snapshot& now : seen) largest = std::max(largest, forceOn(now, 0).norm());
  context.require(largest > 0.0, "no contact force is ever shown");

  for (const std::int32_t id : {0, 1}) {
    Vec2 impulse = Vec2::Zero();
    std::optional<double> angularImpulse = 0.0;
    for (std::size_t k = 1; k < seen.size(); ++k) {
      const Snapshot &was = seen[k - 1], &now = seen[k];
      const double lapse = now.velocityTime - was.velocityTime;
      context.require(lapse > 0.0, "velocities of two steps are said to be of one time");
      const Vec2 acting = scene.disks.mass[id] / lapse * (now.velocity[id] - was.velocity[id]);
      const Vec2 before = forceOn(was, id), after = forceOn(now, id);
      for (const int axis : {0, 1}) {
        const auto [low, high] = std::minmax({before[axis], after[axis]});
        context.atLeast(acting[axis], low - relative * largest,
                        "m Δv/Δt against the smaller of the forces before and after the step");
        context.atMost(acting[axis], high + relative * largest,
                       "m Δv/Δt against the larger of the forces before and after the step");
      }
      impulse += dt * after;
      const auto torque = torqueOn(now, id, scene.law);
      angularImpulse =
          torque && angularImpulse ? std::optional(*angularImpulse + dt * *torque) : std::nullopt;
    }
    const double unit = scene.disks.mass[id] * Encounter::speed;
    const Tolerance sum = {relative * unit, 0.0, "roundings, and a normal that turns"};
    const Vec2 gained = seen.back().velocity[id] - seen.front().velocity[id];
    const double spun = spinsOf(scene, seen.back())[id] - spinsOf(scene, seen.front())[id];
    context.near(impulse, Vec2(scene.disks.mass[id] * gained), sum,
                 "the sum of forces over time against the change of momentum [kg m/s]" + which);
    if (angularImpulse)
      context.near(
          *angularImpulse, context.scene.disks.inertia[id] * spun,
          {sum.absolute * smallRadius, 0.0, sum.why},
          "the sum of torques over time against the change of angular momentum [kg m²/s]" + which);
  }
}

void contactForcesAreThoseThatAct(CheckContext& context) {
  context.needsContacts();
  Encounter pair = crookedEncounter();
  pair.radii[1] = pair.radii[0];  // every engine's contact point is then in the middle
  for (const ContactLaw& law : lawsOfLoads(context)) {
    const Scene scene = encounterScene(pair, law, coarseSteps);
    if (context.loads(scene, !law.rolls()))
      expectThoseThatAct(context, scene,
                         law.rolls() ? ", rolling = " + lawOptionValue(law, "rolling") : "");
  }
}

/// Means over the time since the last snapshot, times that time, are the change of a disk's
/// momentum.
void accumulatedContactsAreImpulses(CheckContext& context) {
  context.needs(accumulatedContacts);
  const Scene scene = encounterScene(crookedEncounter(), context.law(), coarseSteps);
  context.load(scene);
  context.examine(accumulatedContacts);
  const auto snapshotAt = [&](double t) {
    context.engine.advance(t);
    return context.engine.snapshot(ContactReport::accumulated);
  };
  const Snapshot start = snapshotAt(0.0);
  Snapshot last = start;
  Vec2 impulse = Vec2::Zero();
  // Every other step: the normal shown is that of the end.
  const double lapse = 2.0 * context.effective.dt;
  for (double t = lapse; t < Encounter::end; t += lapse) {
    last = snapshotAt(t);
    impulse += last.contactInterval * forceOn(last, 0);
  }
  const double unit = scene.disks.mass[0] * Encounter::speed;
  const Vec2 change = scene.disks.mass[0] * (last.velocity[0] - start.velocity[0]);
  const double relative = context.byPrecision(1e-12, 1e-5, "").relative + 2.0 * turnWithin(lapse);
  context.above(change.norm(), 0.1 * unit, "the change of momentum by a collision [kg m/s]");
  context.near(impulse, change, {relative * unit, 0.0, "roundings, and a normal that turns"},
               "the sum of accumulated forces times their intervals [kg m/s]");
}

/// Checks that the ledger is closed: energy in no term of it is of the scheme's order.
void energyLedgerIsClosed(CheckContext& context) {
  context.needs(energyLedger);
  double left[2] = {};
  for (const int k : {0, 1}) {
    Scene scene = encounterScene(crookedEncounter(), context.law(), k == 0 ? 100.0 : 400.0);
    scene.energyLedger = true;
    const Snapshot after = context.run(scene, Encounter::end);
    context.examine(energyLedger);
    context.require(after.ledger.has_value(), "it declares an energy ledger, and shows none");
    context.near(after.ledger->kinetic, kineticEnergy(context.scene.disks, after),
                 context.byPrecision(1e-9, 1e-4, "roundings of the additions"),
                 "its kinetic energy [J]");
    left[k] = std::abs(residual(*after.ledger)) / after.ledger->initial;
  }
  context.atMost(left[0], 0.02, "part of the energy that it does not account for, at t_c/100");
  context.atMost(left[1], std::max(0.5 * left[0], 1e-9),
                 "the same at t_c/400, which is to be less");
}

/// The force and torque on the first body are those of its contacts, step by step.
/// @param torqueOf  contact c on the body, whose force on the body is given, with the centres then
/// @param reach     how far from the body's centre forces act [m]
/// @returns the numbers of what is touched; empty where the engine refuses a law that rolls
std::optional<std::set<std::int32_t>> expectLoads(CheckContext& context, const Scene& scene,
                                                  double reach, const auto& torqueOf) {
  if (!context.loads(scene, !scene.law.rolls())) return std::nullopt;
  const bool rolls = context.effective.effects.contains(Effect::rollingResistance);
  const std::vector<Snapshot> seen = context.watch(Encounter::end);
  const double relative = context.byPrecision(1e-12, 1e-5, "").relative +
                          2.0 * turnWithin(seen.back().contactInterval) +
                          offPlane(context, context.effective.dt);
  // As large as what is added up: in the end springs and dashpots cancel.
  double largest = 0.0;
  for (const Snapshot& now : seen)
    for (std::size_t c = 0; now.contacts && c < now.contacts->size(); ++c)
      largest = std::max(largest, now.contacts->force(c).norm());
  const Tolerance sum = {relative * largest, 0.0, "roundings, and a normal that turns"};
  std::set<std::int32_t> touched;
  for (const Snapshot& now : seen) {
    if (!now.contacts) continue;
    touched.insert(now.contacts->j.begin(), now.contacts->j.end());
    const BodySnapshot& body = now.bodies[0];
    if (!body.force || !body.torque) context.skip("shows no wall loads");
    // An engine need not know whose torque it is.
    const bool unknown = rolls && now.contacts->size() > 0 && now.contacts->rollingTorque.empty();
    const std::vector<Vec2> centres = centresAt(now.contactTime, seen);
    Vec2 force = Vec2::Zero();
    double torque = 0.0;
    for (std::size_t c = 0; c < now.contacts->size(); ++c) {
      const Vec2 onBody = -now.contacts->force(c);
      force += onBody;
      torque += torqueOf(*now.contacts, c, onBody, centres);
      if (!now.contacts->rollingTorque.empty()) torque -= now.contacts->rollingTorque[c];
    }
    const std::string when = text(" at t = ", now.contactTime, " s");
    context.near(*body.force, force, sum, "the force [N]" + when);
    if (!unknown)
      context.near(*body.torque, torque, {reach * sum.absolute, 0.0, sum.why},
                   "the torque [N m]" + when);
  }
  return touched;
}

void wallLoadsAreThoseOfTheirContacts(CheckContext& context) {
  context.needsContacts();
  const Vec2 centre(0.01, -0.02);
  constexpr double wheelRadius = 0.025;
  const auto direction = [](double angle) { return Vec2(std::cos(angle), std::sin(angle)); };
  std::vector<Vec2> rim;
  for (const double angle : {-0.35, 0.0, 0.35})
    rim.push_back(centre + wheelRadius * direction(angle));
  const Vec2 between = direction(0.175);
  for (const ContactLaw& law : lawsOfLoads(context)) {
    const Scene scene = sceneOf(law, {wallOf("wheel", centre, rim, rotating(0.5))},
                                {{centre + 0.0308 * between, -Encounter::speed * between, 9.0}});
    const auto touched = expectLoads(
        context, scene, wheelRadius,
        [&](const Contacts& contacts, std::size_t c, const Vec2& force, const auto& centres) {
          return cross(centres[contacts.j[c]] - centre, force) -
                 armOf(scene.law, contacts.overlap[c]) * contacts.tangentialForce[c];
        });
    if (touched)
      context.equal(touched->size(), 2u, "wall disks touched by a disk that falls between two");
  }
}

/// f_n and f_t act on the plane where it is nearest to the disk's centre, or half the overlap
/// behind that where the engine has its contact points in the middle of overlaps.
void planeLoadsAreThoseOfTheirContacts(CheckContext& context) {
  context.needsContacts();
  for (const ContactLaw& law : lawsOfLoads(context)) {
    WallBody body = planeWall({0.2, -smallRadius - Encounter::gap}, {0.0, 1.0});
    body.centre = {-0.01, 0.003};
    const Scene scene = sceneOf(law, {body}, {{Vec2::Zero(), {0.02, -Encounter::speed}, 9.0}});
    const LawConventions& how = scene.law.conventions;
    const bool inside = how.leverArm != LeverArm::radius && how.planeArm == PlaneArm::middle;
    const auto touched = expectLoads(
        context, scene, 0.01,
        [&](const Contacts& contacts, std::size_t c, const Vec2& force, const auto& centres) {
          Vec2 foot(centres[0].x(), body.planes[0].point.y());
          if (inside) foot.y() -= 0.5 * contacts.overlap[c];
          return cross(foot - body.centre, force);
        });
    if (touched) context.expect(!touched->empty(), "it never shows a contact with the plane");
  }
}

}  // namespace

Checks contactChecks() {
  return {
      {"SnapshotsAreSound", "snapshots can be true: times, places, contacts worked out again",
       snapshotsAreSound},
      inBoth({"ForcesAreThoseOfTheLaw", "the forces of contacts are those of the declared law",
              forcesAreThoseOfTheLaw}),
      {"ContactsSayWhereTheyAre", "contacts lie where the disks are",
       contactsSayWhereTheyAre<false>},
      {"ContactsWithPlanesSayWhereTheyAre", "contacts with planes lie where the disks are",
       contactsSayWhereTheyAre<true>},
      {"SlidingFlagsMarkTheBound", "sliding flags mark the Coulomb bound",
       slidingFlagsMarkTheBound},
      inBoth({"ContactForcesAreThoseThatAct", "the forces shown are those that act",
              contactForcesAreThoseThatAct}),
      {"AccumulatedContactsAreImpulses", "accumulated contacts are the impulses that acted",
       accumulatedContactsAreImpulses},
      {"EnergyLedgerIsClosed", "its energy ledger accounts for all energy", energyLedgerIsClosed},
      inBoth({"WallLoadsAreThoseOfTheirContacts",
              "a wall's force and torque are those of its contacts",
              wallLoadsAreThoseOfTheirContacts}),
      inBoth({"PlaneLoadsAreThoseOfTheirContacts",
              "a plane's force and torque are those of its contacts",
              planeLoadsAreThoseOfTheirContacts}),
  };
}

}  // namespace crossgrain::conformance

// Two bodies meet once, under every law that the engine declares: compared with the oracle, and a
// mirror with its peer.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <string>

#include "adapters/audit.hpp"
#include "adapters/declared_law.hpp"
#include "law/law_options.hpp"
#include "studies/conformance/check_context.hpp"
#include "studies/conformance/declared_laws.hpp"
#include "studies/conformance/meeting.hpp"

namespace crossgrain::conformance {
namespace {

/// Of each normal law the first kind of damper and every other, every tangential law, and tension
/// both ways, one after the other.
std::vector<ContactLaw> declaredLaws(const Capabilities& can) {
  std::vector<ContactLaw> laws;
  for (const std::string& normal : valuesOf(can, followed(can, fullLaw()), "normal")) {
    const ContactLaw base = lawOf(can, normal);
    laws.push_back(base);
    if (base.soft())
      for (const std::string& damper : valuesOf(can, base, "damper"))
        if (damper != lawOptionValue(base, "damper")) {
          laws.push_back(base);
          setDampers(laws.back(), damper);
        }
    for (const char* option : {"tangential", "tension"})
      for (const std::string& value : valuesOf(can, base, option))
        if (mattersTo(base, option) && value != lawOptionValue(base, option)) {
          laws.push_back(base);
          setLawOption(laws.back(), option, value);
        }
  }
  return laws;
}

std::string nameOf(const ContactLaw& law) {
  return text(lawOptionValue(law, "normal"), ", ", lawOptionValue(law, "tangential"),
              law.soft() ? text(", ", lawOptionValue(law, "damper"), " damper, tension ",
                                lawOptionValue(law, "tension"))
                         : "");
}

/// @param evidence  gets what came of it  @returns whether there was a reference
bool compared(CheckContext& context, Meeting meeting, Evidence& evidence) {
  const ContactLaw& law = meeting.law;
  if (!law.soft()) {
    // An impact acts at the end of a step in which an oblique disk has gone on, v_t dt, round the
    // other: slowly, so that the normal turns little.
    for (CollisionStart& start : meeting.starts) {
      start.vn *= 0.1;
      start.counterSpin *= 0.1;
    }
    meeting.wallVelocity *= 0.1;
  }
  std::string why;
  const auto result = meet(context, meeting, &why);
  const bool known = result && evidence.expectTheOracle(context, meeting, *result, nameOf(law));
  if (why.empty()) why = "there is no reference for " + nameOf(law);
  for (const char* option : {"normal", "damper", "tangential", "tension"}) {
    const std::string capability = text(option, " = ", lawOptionValue(law, option));
    if (!known) context.couldNotExamine(capability, why);
    if (known && mattersTo(law, option)) context.examine(capability);
  }
  if (!known) return false;
  for (const Effect effect :
       {Effect::friction, Effect::tangentialSpring, Effect::tangentialDamping, Effect::rotation})
    if (effectsOf(context.scene).contains(effect)) context.examine(toString(effect));
  if (!law.soft() && law.et0 != 0.0) context.examine(tangentialRestitution);
  return true;
}

/// Every law that the engine declares, between a small disk and that partner.
void followTheOracle(CheckContext& context, Meeting meeting) {
  bool any = false;
  std::map<NormalLaw, Evidence> evidence;
  for (const ContactLaw& law : declaredLaws(context.can)) {
    meeting.law = law;
    any = compared(context, meeting, evidence[law.normal]) || any;
  }
  for (const auto& [normal, one] : evidence) one.explain(context);
  if (!any) context.skip("it refuses all of its laws here, or there is no reference for them");
}

/// Spins that slide little and much, and the same slip by an oblique path.
std::vector<CollisionStart> startsOf(Approach approach, double counterSpin = 0.0) {
  std::vector<CollisionStart> starts;
  for (const double psi : {0.5, 3.0}) {
    starts.push_back({psi, Encounter::speed, approach});
    starts.back().counterSpin = counterSpin;
  }
  return starts;
}

std::vector<CollisionStart> allWays() {
  std::vector<CollisionStart> starts = startsOf(Approach::firstSpin);
  std::ranges::copy(startsOf(Approach::oblique), std::back_inserter(starts));
  return starts;
}

void frictionFollowsTheOracle(CheckContext& context) {
  followTheOracle(context, {.starts = startsOf(Approach::spin)});
}

/// Three times the radius and nine times the mass, spins that cancel in the slip: exchanging the
/// two disks' quantities shows.
void unequalDisksFollowTheOracle(CheckContext& context) {
  followTheOracle(context, {.radius = 3.0 * smallRadius,
                            .mass = 9.0 * smallMass,
                            .starts = startsOf(Approach::spin, 15.0)});
  context.examine(severalSizes);
}

/// A ring's, and a sphere's or a disk's: what a scene says, and not what all others have.
void inertiaIsTheScenes(CheckContext& context) {
  bool others = false, any = false;
  Evidence evidence;
  for (const double factor : {0.4, solidDisk, 1.0}) {
    if (factor == context.inertiaFactor() || !hasInertia(context.can.limits, factor)) continue;
    others = true;
    any = compared(
              context,
              {.law = context.law(), .inertiaFactor = factor, .starts = startsOf(Approach::spin)},
              evidence) ||
          any;
  }
  evidence.explain(context);
  if (!others) context.skip("declares no other moments of inertia");
  if (!any) context.skip("there is no reference for " + nameOf(context.law()));
}

void wallDisksFollowTheOracle(CheckContext& context) {
  followTheOracle(context, {.partner = Partner::wallDisk, .starts = allWays()});
  context.examine(wallMotion(Motion::Kind::fixed));
}

void planesFollowTheOracle(CheckContext& context) {
  context.needs(planes);
  followTheOracle(context, {.partner = Partner::plane, .starts = allWays()});
  context.examine(planes);
  context.examine(planeMotion(Motion::Kind::fixed));
}

/// What is relative is the same whether a plane moves along itself, towards the disk or away.
void movingPlanesFollowTheOracle(CheckContext& context) {
  context.needs(planeMotion(Motion::Kind::translating));
  bool any = false;
  for (const std::string& normal : valuesOf(context.can, context.law(), "normal")) {
    Evidence evidence;
    for (const Vec2& velocity : {Vec2(0.0, 1.5), Vec2(0.5, 0.0), Vec2(-0.5, 0.0)})
      any = compared(context,
                     {.law = lawOf(context.can, normal),
                      .partner = Partner::plane,
                      .starts = allWays(),
                      .wallVelocity = Encounter::speed * velocity},
                     evidence) ||
            any;
    evidence.explain(context);
  }
  if (!any) context.skip("it refuses planes that move, or there is no reference for its laws");
  context.examine(planeMotion(Motion::Kind::translating));
  context.examine(planesAlongThemselves);
}

// ---- mirrors ------------------------------------------------------------------------------------

/// A mirror is the in-house engine with a peer's conventions, and has to follow that peer: where it
/// does not, one of the two is wrong about what the peer does.
class MirrorPair {
 public:
  explicit MirrorPair(CheckContext& mirror) : context(mirror) {
    const EngineEntry* entry = findEngine(context.entry.mirrors);
    context.require(entry != nullptr, text("there is no engine '", context.entry.mirrors, "'"));
    if (entry->missing)
      if (const std::string why = entry->missing(); !why.empty()) context.skip(why);
    peer = context.start(*entry);
    settings = entry->settings;
    can = peer->capabilities();
    if (context.rigid() != (followed(can, fullLaw()).normal == NormalLaw::rigid))
      context.skip("its peer has another normal law");
  }

  /// Both run the encounter, and have the same velocities and spins in the end.
  void followThrough(const Scene& scene) {
    load(scene);
    peer->advance(Encounter::end);
    const auto theirs = statesOf(context.scene, peer->snapshot(ContactReport::none));
    const auto ours = statesOf(context.scene, context.at(Encounter::end));
    for (std::size_t i = 0; i < ours.size(); ++i)
      context.sameMotion(ours[i], theirs[i], allowed(), text(" of disk ", i));
  }

  void followThroughACollision(const ContactLaw& law) {
    // A position solver, which a mirror does not have, moves disks that overlap by more than its
    // slop.
    const double steps = context.rigid() ? 2000.0 : coarseSteps;
    Encounter encounter = crookedEncounter();
    for (const double obliqueness : {0.5, -1.0}) {
      encounter.obliqueness = obliqueness;
      followThrough(encounterScene(encounter, law, steps));
    }
  }

  /// Gravity and a moving wall act from the first step on. Only positions are compared: the two may
  /// show velocities of different times.
  void followThroughAHeap(const ContactLaw& law) {
    if (context.rigid())
      context.skip("lets contacts collide one by one, its peer solves them together");
    load(busyScene(law));
    for (const double t : {0.01 * busyEnd, 0.1 * busyEnd, 0.5 * busyEnd}) {
      peer->advance(t);
      const Snapshot theirs = peer->snapshot(ContactReport::none), ours = context.at(t);
      context.requireEqual(ours.positionTime, theirs.positionTime, "position_time of the mirror");
      const Tolerance length = {allowed().absolute * smallRadius, 0.0, allowed().why};
      for (std::size_t i = 0; i < ours.position.size(); ++i)
        context.near(ours.position[i], theirs.position[i], length,
                     text("disk ", i, " at t = ", t, " s [m]"));
    }
  }

  CheckContext& context;
  std::unique_ptr<Engine> peer;
  Capabilities can;   ///< of the peer
  Settings settings;  ///< of the peer

 private:
  Tolerance allowed() const {
    const double part = can.precisions.front() == Precision::float32 ? 1e-5 : 1e-6;
    return {part, 0.0, "roundings, and springs that turn to first or higher order"};
  }

  /// Each with its own conventions, at the peer's time step.
  void load(Scene scene) {
    scene.law = followed(can, scene.law);
    try {
      scene.dt = peer->load(context.withItsInertia(scene), settings).dt;
    } catch (const UnsupportedScene& refusal) {
      context.skip(refusal.what());
    }
    scene.law = followed(context.can, scene.law);
    context.load(scene);
    context.equal(context.effective.dt, scene.dt, "the time step of the mirror");
  }
};

void followsItsPeerThroughACollision(CheckContext& context) {
  MirrorPair(context).followThroughACollision(fullLaw());
}

void followsItsPeerThroughAHeap(CheckContext& context) {
  MirrorPair(context).followThroughAHeap(fullLaw());
}

void followsItsPeerOnAPlane(CheckContext& context) {
  MirrorPair(context).followThrough(landingScene(fullLaw(), coarseSteps));
}

void followsItsPeerByHertzLaw(CheckContext& context) {
  MirrorPair pair(context);
  if (std::ranges::count(pair.can.lawOptions.at("normal"), "hertz") == 0)
    context.skip("its peer has another normal law");
  pair.followThroughACollision(hertzLaw());
  pair.followThroughAHeap(hertzLaw());
  pair.followThrough(landingScene(hertzLaw(), coarseSteps));
}

// ---- forces by the law ----------------------------------------------------------------------

constexpr double cloudEnd = 0.01;  ///< [s]

/// 27 spheres that fly into each other and spin: they touch within 1.2 ms, and many still do at
/// cloudEnd.
SpaceScene cloudScene(const ContactLaw& law) {
  SpaceScene scene;
  scene.name = "a cloud of spheres";
  scene.law = law;
  scene.dt = emptyScene(law, coarseSteps).dt;
  const Eigen::Matrix3d frame =
      Eigen::AngleAxisd(0.7, Vec3(1.0, -1.0, 2.0).normalized()).toRotationMatrix();
  for (int k = 0; k < 27; ++k) {
    const Vec3 at(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
    const Vec3 place = 2.02 * smallRadius * (frame * at);
    scene.disks.radius.push_back(smallRadius);
    scene.disks.mass.push_back(smallMass);
    scene.disks.inertia.push_back(0.4 * smallMass * smallRadius * smallRadius);
    scene.disks.position.push_back(place);
    scene.disks.velocity.push_back(-8.0 * place + Vec3(0.0, 4.0, 2.0).cross(place));
    scene.disks.spin.push_back(Vec3(5 * at.y(), 10 - 3 * k, 7 * at.x()));
  }
  return scene;
}

/// The laws of the plane's checks in space: every normal law, and what resists rolling or coheres.
std::vector<ContactLaw> lawsInSpace(const Capabilities& can) {
  std::vector<ContactLaw> laws;
  for (const std::string& normal : valuesOf(can, followed(can, fullLaw()), "normal"))
    laws.push_back(lawOf(can, normal));
  std::ranges::copy(resistingLaws(can), std::back_inserter(laws));
  for (ContactLaw& law : laws) {
    law.dimension = 3;
    law = followed(can, law);
  }
  return laws;
}

void forcesInSpaceAreThoseOfTheLaw(CheckContext& c) {
  if (!c.can.instantContacts) c.skip("shows no contacts of one instant");
  std::string refused = "declares no law with known constants";
  std::size_t seen = 0;
  for (const ContactLaw& law : lawsInSpace(c.can)) {
    std::optional<SpaceScene> scene;
    try {
      scene = loaded(c, cloudScene(law));
    } catch (const Skipped& skip) {  // not every part need go with every law
      refused = skip.reason;
      continue;
    }
    const auto declared = declaredLaw(c.can, *scene, c.effective, 0.5 * smallMass);
    if (!declared) continue;
    const AuditBasisOf<3> basis = auditBasis(*scene, c.can, c.effective);
    const auto last = std::llround(cloudEnd / c.effective.dt);
    for (long long step = 0; step <= last; ++step) {
      const SpaceSnapshot now = shown<3>(c, static_cast<double>(step) * c.effective.dt);
      seen += now.contacts ? now.contacts->size() : 0;
      for (const std::string& why : {contactFault(now, basis), lawFault(now, basis, *declared)})
        if (!why.empty())
          c.fault(text("at t = ", now.contactTime,
                       " s of a law with rolling = ", lawOptionValue(law, "rolling"),
                       " and cohesion = ", lawOptionValue(law, "cohesion"), ": ", why));
    }
  }
  if (seen == 0 && c.faults.empty()) c.skip(refused);
}

}  // namespace

Checks lawChecks() {
  static constexpr Check list[] = {
      {"FrictionFollowsTheOracle", "every law follows the theory of two disks",
       frictionFollowsTheOracle},
      {"UnequalDisksFollowTheOracle", "so do disks of two sizes and masses",
       unequalDisksFollowTheOracle},
      {"InertiaIsTheScenes", "moments of inertia are those of the scene", inertiaIsTheScenes},
      {"WallDisksFollowTheOracle", "so does a disk on a wall disk", wallDisksFollowTheOracle},
      {"PlanesFollowTheOracle", "so does a disk on a plane, spinning and obliquely",
       planesFollowTheOracle},
      {"MovingPlanesFollowTheOracle", "and on a plane that moves along itself, towards it or away",
       movingPlanesFollowTheOracle},
      {"ForcesInSpaceAreThoseOfTheLaw",
       "forces of spheres are those of the declared law, each contact's within its bounds",
       forcesInSpaceAreThoseOfTheLaw, 3},
  };
  return list;
}

Checks mirrorChecks() {
  static constexpr Check list[] = {
      {"FollowsItsPeerThroughACollision", "a mirror follows its peer through a collision",
       followsItsPeerThroughACollision},
      {"FollowsItsPeerThroughAHeap", "a mirror follows its peer through a heap",
       followsItsPeerThroughAHeap},
      {"FollowsItsPeerOnAPlane", "a mirror follows its peer on a plane", followsItsPeerOnAPlane},
      {"FollowsItsPeerByHertzLaw", "a mirror follows its peer by Hertz' law",
       followsItsPeerByHertzLaw},
  };
  return list;
}

}  // namespace crossgrain::conformance

// Two bodies meet once, under every law that the engine declares: compared with the oracle, its
// conventions with the in-house engine that has them, and a mirror with its peer.
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <string>

#include "adapters/declared_law.hpp"
#include "adapters/law_options.hpp"
#include "studies/conformance/check_context.hpp"
#include "studies/conformance/meeting.hpp"
#include "studies/lockstep/rules.hpp"
#include "studies/lockstep/terms.hpp"

namespace crossgrain::conformance {
namespace {

/// Constants of dashpots that take away about as much, whatever they multiply: e_n is between 0.2
/// and 0.9.
void setDampers(ContactLaw& law, const std::string& damper) {
  setLawOption(law, "damper", damper);
  const bool linear = law.normal == NormalLaw::linear;
  switch (law.damper) {
    case Damper::constant:
      law.gn = linear ? thesis.gn : 0.03;  // [kg/s]; where k is 0 at the first touch, less
      law.gt = linear ? thesis.gt : 0.0;
      break;
    case Damper::viscoelastic:
      law.gn = 3e-4;  // [s]
      law.gt = 2e-4;
      break;
    case Damper::critical:
      law.gn = 0.3;  // [-]
      law.gt = 0.2;
      break;
  }
}

ContactLaw lawOf(const Capabilities& can, const std::string& normal) {
  ContactLaw law = normal == "hertz" ? hertzLaw() : fullLaw();
  setLawOption(law, "normal", normal);
  if (law.normal == NormalLaw::polynomial) {  // as deep as the linear law, the cubic part a third
    law.kn = 8e6;                             // [N/m²]
    law.kn3 = 5e10;                           // [N/m³]
  }
  law = followed(can, law);
  if (law.soft()) setDampers(law, valuesOf(can, law, "damper").front());
  return law;
}

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

constexpr std::array oraclesOptions = {"normal", "damper", "tangential", "tension"};

/// @returns whether there was a reference
bool compared(CheckContext& context, Meeting meeting) {
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
  const bool known = result && expectTheOracle(context, meeting, *result, nameOf(law));
  if (why.empty()) why = "there is no reference for " + nameOf(law);
  for (const char* option : oraclesOptions) {
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
  for (const ContactLaw& law : declaredLaws(context.can)) {
    meeting.law = law;
    any = compared(context, meeting) || any;
  }
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
  for (const std::string& normal : valuesOf(context.can, context.law(), "normal"))
    for (const Vec2& velocity : {Vec2(0.0, 1.5), Vec2(0.5, 0.0), Vec2(-0.5, 0.0)})
      any = compared(context, {.law = lawOf(context.can, normal),
                               .partner = Partner::plane,
                               .starts = allWays(),
                               .wallVelocity = Encounter::speed * velocity}) ||
            any;
  if (!any) context.skip("it refuses planes that move, or there is no reference for its laws");
  context.examine(planeMotion(Motion::Kind::translating));
  context.examine(planesAlongThemselves);
}

// ---- conventions -------------------------------------------------------------------------------

/// An arm of v_t has a bearing wherever there are arms of f_t: it could be another one.
std::string bearingOf(const std::string& option) {
  return option == "velocity_arm" ? "lever_arm" : option;
}

/// Disks that stick, slip and roll on each other, on wall disks and, where the engine has planes,
/// on a plane; far enough apart not to meet, of several sizes.
Scene conventionsScene(const ContactLaw& law, bool withPlane) {
  Scene scene = emptyScene(law, coarseSteps);
  std::vector<Vec2> posts;
  const double apart = 12.0 * largeRadius;
  int k = 0;
  for (const double spin : {-60.0, -6.0, 12.0, 70.0}) {
    Encounter pair = crookedEncounter();
    pair.obliqueness = 0.3 * (k - 1.5);
    pair.spins[0] = spin;
    const Scene met = encounterScene(pair, law, coarseSteps);
    const Vec2 place(0.1, apart * k);
    for (const int i : {0, 1})
      addDisk(scene, met.disks.radius[i], met.disks.mass[i], met.disks.position[i] + place,
              met.disks.velocity[i], met.disks.spin[i]);
    const Vec2 post(0.2, apart * k);
    posts.push_back(post);
    addDisk(scene, largeRadius, largeMass,
            post + Vec2(smallRadius + largeRadius + Encounter::gap, 0.0), {-0.1, 0.03 * k}, spin);
    if (withPlane)
      addDisk(scene, smallRadius, smallMass, {smallRadius + Encounter::gap, apart * k},
              {-0.1, 0.04 * (k - 1)}, spin);
    ++k;
  }
  scene.bodies = {wallOf("posts", Vec2::Zero(), posts)};
  if (withPlane) scene.bodies.push_back(planeWall(Vec2::Zero(), Vec2::UnitX()));
  return scene;
}

/// Velocities and rims' speeds in the end, one after the other [m/s].
std::vector<double> motionAt(Engine& engine, const Scene& scene, double t) {
  engine.advance(t);
  const Snapshot now = engine.snapshot(ContactReport::none);
  const std::vector<double> spins = spinsOf(scene, now);
  std::vector<double> motion;
  for (std::size_t i = 0; i < now.velocity.size(); ++i)
    motion.insert(motion.end(),
                  {now.velocity[i].x(), now.velocity[i].y(), spins[i] * scene.disks.radius[i]});
  return motion;
}

double farthest(const std::vector<double>& one, const std::vector<double>& other) {
  double most = 0.0;
  for (std::size_t k = 0; k < one.size(); ++k) most = std::max(most, std::abs(one[k] - other[k]));
  return most;
}

/// Laws under which the option has a bearing, of those that the engine declares.
std::vector<ContactLaw> lawsFor(const Capabilities& can, const std::string& option,
                                const std::string& value) {
  std::vector<ContactLaw> laws;
  for (const std::string& normal : valuesOf(can, followed(can, fullLaw()), "normal"))
    for (const std::string& tension : valuesOf(can, fullLaw(), "tension"))
      for (const std::string& arm : valuesOf(can, fullLaw(), "lever_arm")) {
        ContactLaw law = lawOf(can, normal);
        if (!law.soft()) continue;
        setLawOption(law, "tension", tension);
        setLawOption(law, "lever_arm", arm);
        setLawOption(law, option, value);
        if (!mattersTo(law, bearingOf(option))) continue;
        for (const std::string& damper : valuesOf(can, law, "damper")) {
          laws.push_back(law);
          setDampers(laws.back(), damper);
        }
      }
  return laws;
}

/// Loads the scene of conventions under the first of these laws that the engine takes, with a plane
/// where it takes that. @returns whether there is one; @param why  gets the last refusal
bool loadedUnderAny(CheckContext& context, const std::vector<ContactLaw>& laws, bool withPlane,
                    std::string& why) {
  for (const ContactLaw& law : laws) {
    if (withPlane && !context.refusal(conventionsScene(law, true))) return true;
    const auto refusal = context.refusal(conventionsScene(law, false));
    if (!refusal) return true;
    why = *refusal;
  }
  return false;
}

/// What is loaded, under one value of a convention: the engine is compared with the in-house engine
/// that has it, and with those that have each other value.
/// @returns whether the law is known, so that it could be
bool expectConvention(CheckContext& context, Engine& inHouse, const LawOption& option,
                      const std::string& value) {
  const std::string name(option.name);
  const std::string capability = text(name, " = ", value);
  const Scene ran = context.scene;
  const auto declared = declaredLaw(context.can, ran, context.effective, 0.5 * smallMass);
  if (!declared || !declared->soft()) return false;
  const std::vector<double> found = motionAt(context.engine, ran, Encounter::end);
  const auto mirror = [&](std::string_view which, double stiffer) {
    Scene mirrored = ran;
    mirrored.law = *declared;
    mirrored.dt = context.effective.dt;
    mirrored.precision = Precision::float64;
    setLawOption(mirrored.law, name, which);
    changeReference(mirrored.law, stiffer);
    inHouse.load(mirrored, {});
    return motionAt(inHouse, mirrored, Encounter::end);
  };
  const std::vector<double> wanted = mirror(value, 0.0);
  const double limit = std::max(farthest(mirror(value, lockstepSameLaw), wanted),
                                context.byPrecision(1e-9, 1e-3, "").relative * Encounter::speed);
  const double off = farthest(found, wanted);
  bool known = true;  // from every other value
  std::string nearest;
  double least = off;
  for (const std::string_view other : option.values) {
    if (other == value || !mattersTo(ran.law, bearingOf(name))) continue;
    const std::vector<double> otherwise = mirror(other, 0.0);
    const double apart = farthest(otherwise, wanted);
    if (apart <= 1e-3 * limit) continue;  // another name of the same
    if (apart <= 2.0 * limit) {
      known = false;
      context.couldNotExamine(capability, text("hardly other than ", other, " here"));
    }
    if (const double left = farthest(found, otherwise); left < least) {
      least = left;
      nearest = other;
    }
  }
  if (known) context.examine(capability);
  if (off <= limit) return true;
  context.fault(text("under ", capability, " it is off the in-house engine by ",
                     fmt::format("{:.3g} m/s, allowed {:.3g}", off, limit),
                     " (a thousandth of k_n)"));
  if (!nearest.empty() && least <= limit)
    context.suspect(text("it has ", name, " = ", nearest, ", and declares ", value));
  return true;
}

/// The in-house engine from the same start, each value of the option in turn; that of the engine's
/// own declaration has to come nearest, and to within what a thousandth of k_n (lockstep's rule for
/// one law) moves. A value is examined where every other one leads elsewhere.
void conventionsAreThoseDeclared(CheckContext& context) {
  if (context.inHouse())
    context.skip("it is the in-house engine, and would be compared with itself");
  const auto inHouse = engineRegistry().front().make();
  const bool withPlane = !context.refusal(conventionsScene(context.law(), true));
  bool any = false;
  for (const LawOption& option : lawOptions()) {
    const std::string name(option.name);
    const auto values = context.can.lawOptions.find(name);
    if (std::ranges::count(oraclesOptions, name) > 0 || option.part != LawPart::contact ||
        values == context.can.lawOptions.end())
      continue;
    for (const std::string& value : values->second) {
      std::string why;
      if (loadedUnderAny(context, lawsFor(context.can, name, value), withPlane, why)) {
        any = expectConvention(context, *inHouse, option, value) || any;
      } else if (!why.empty()) {
        context.couldNotExamine(text(name, " = ", value), why);
      }
    }
  }
  if (!any) context.skip("it declares no convention of a soft law, or refuses the scenes");
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
      scene.dt = peer->load(scene, settings).dt;
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

}  // namespace

Checks lawChecks() {
  static constexpr Check list[] = {
      {"FrictionFollowsTheOracle", "every law follows the theory of two disks",
       frictionFollowsTheOracle},
      {"UnequalDisksFollowTheOracle", "so do disks of two sizes and masses",
       unequalDisksFollowTheOracle},
      {"WallDisksFollowTheOracle", "so does a disk on a wall disk", wallDisksFollowTheOracle},
      {"PlanesFollowTheOracle", "so does a disk on a plane, spinning and obliquely",
       planesFollowTheOracle},
      {"MovingPlanesFollowTheOracle", "and on a plane that moves along itself, towards it or away",
       movingPlanesFollowTheOracle},
      {"ConventionsAreThoseDeclared",
       "its conventions are those declared: the in-house engine with them does the same",
       conventionsAreThoseDeclared},
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

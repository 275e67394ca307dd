// Two bodies meet once, under every law that the engine declares: compared with the oracle, and its
// conventions with the in-house engine that has them.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "adapters/declared_law.hpp"
#include "adapters/law_options.hpp"
#include "oracle/collision_oracle.hpp"
#include "runs/conformance/check_list.hpp"
#include "runs/conformance/exam.hpp"
#include "runs/conformance/meeting.hpp"
#include "runs/lockstep/rules.hpp"
#include "runs/lockstep/terms.hpp"

namespace crossgrain::conformance::laws {
namespace {

/// The values that the engine declares of an option; of one that it does not list, the law's own.
std::vector<std::string> valuesOf(const Capabilities& can, const ContactLaw& law,
                                  const std::string& option) {
  const auto listed = can.lawOptions.find(option);
  if (listed == can.lawOptions.end()) return {lawOptionValue(law, option)};
  return listed->second;
}

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
  return said(lawOptionValue(law, "normal"), ", ", lawOptionValue(law, "tangential"),
              law.soft() ? said(", ", lawOptionValue(law, "damper"), " damper, tension ",
                                lawOptionValue(law, "tension"))
                         : "");
}

constexpr std::array oraclesOptions = {"normal", "damper", "tangential", "tension"};

/// @returns whether there was a reference
bool compared(Exam& it, Meeting meeting) {
  if (!meeting.law.soft()) {
    // An impact acts at the end of a step in which an oblique disk has gone on, v_t dt, round the
    // other: slowly, so that the normal turns little.
    for (CollisionStart& start : meeting.starts) {
      start.vn *= 0.1;
      start.counterSpin *= 0.1;
    }
    meeting.wallVelocity *= 0.1;
  }
  std::string why;
  const auto outcome = meet(it, meeting, &why);
  if (outcome && expectTheOracle(it, meeting, *outcome, nameOf(meeting.law))) {
    for (const Effect effect :
         {Effect::friction, Effect::tangentialSpring, Effect::tangentialDamping, Effect::rotation})
      if (effectsOf(it.scene).contains(effect)) it.examined(toString(effect));
    for (const char* option : oraclesOptions)
      if (mattersTo(meeting.law, option))
        it.examinedOption(option, lawOptionValue(meeting.law, option));
    if (!meeting.law.soft() && meeting.law.et0 != 0.0) it.examined(tangentialRestitution);
    return true;
  }
  if (why.empty()) why = "there is no reference for " + nameOf(meeting.law);
  for (const char* option : oraclesOptions)
    it.refusedToo(said(option, " = ", lawOptionValue(meeting.law, option)), why);
  return false;
}

/// Every law that the engine declares, between a small disk and that partner.
void followTheOracle(Exam& it, Meeting meeting) {
  bool any = false;
  for (const ContactLaw& law : declaredLaws(it.can)) {
    meeting.law = law;
    any = compared(it, meeting) || any;
  }
  if (!any) it.skip("it refuses all of its laws here, or there is no reference for them");
}

const std::vector<CollisionStart> spinning = {{0.5, Encounter::speed}, {3.0, Encounter::speed}};
const std::vector<CollisionStart> allWays = {{0.5, Encounter::speed, Approach::firstSpin},
                                             {3.0, Encounter::speed, Approach::firstSpin},
                                             {0.5, Encounter::speed, Approach::oblique},
                                             {3.0, Encounter::speed, Approach::oblique}};

void frictionFollowsTheOracle(Exam& it) {
  Meeting equal;
  equal.starts = spinning;
  followTheOracle(it, equal);
}

/// Three times the radius and nine times the mass, spins that cancel in the slip: what belongs to
/// one disk cannot be the other's.
void unequalDisksFollowTheOracle(Exam& it) {
  Meeting unequal;
  unequal.radius = 3.0 * smallRadius;
  unequal.mass = 9.0 * smallMass;
  for (CollisionStart start : spinning) {
    start.counterSpin = 15.0;
    unequal.starts.push_back(start);
  }
  followTheOracle(it, unequal);
  it.examined(severalSizes);
}

void wallDisksFollowTheOracle(Exam& it) {
  Meeting wall;
  wall.partner = Partner::wallDisk;
  wall.starts = allWays;
  followTheOracle(it, wall);
  it.examined(wallMotion(Motion::Kind::fixed));
}

void planesFollowTheOracle(Exam& it) {
  it.needs(planes);
  Meeting plane;
  plane.partner = Partner::plane;
  plane.starts = allWays;
  followTheOracle(it, plane);
  it.examined(planes);
  it.examined(planeMotion(Motion::Kind::fixed));
}

/// What is relative is the same whether a plane moves along itself, towards the disk or away.
void movingPlanesFollowTheOracle(Exam& it) {
  it.needs(planeMotion(Motion::Kind::translating));
  bool any = false;
  for (const std::string& normal : valuesOf(it.can, it.law(), "normal"))
    for (const Vec2& velocity : {Vec2(0.0, 1.5), Vec2(0.5, 0.0), Vec2(-0.5, 0.0)}) {
      Meeting plane;
      plane.law = lawOf(it.can, normal);
      plane.partner = Partner::plane;
      plane.starts = allWays;
      plane.wallVelocity = Encounter::speed * velocity;
      any = compared(it, plane) || any;
    }
  if (!any) it.skip("it refuses planes that move, or there is no reference for its laws");
  it.examined(planeMotion(Motion::Kind::translating));
  it.examined(planesAlongThemselves);
}

// ---- conventions -------------------------------------------------------------------------------

/// Disks that stick, slip and roll on each other, on wall disks and, where the engine has planes,
/// on a plane; far enough apart not to meet, of several sizes.
Scene conventionsScene(const ContactLaw& law, bool withPlane) {
  Scene scene = emptyScene(law, 50.0);
  std::vector<Vec2> posts;
  const double apart = 12.0 * largeRadius;
  int k = 0;
  for (const double spin : {-60.0, -6.0, 12.0, 70.0}) {
    Encounter pair = crookedEncounter();
    pair.obliqueness = 0.3 * (k - 1.5);
    pair.spins[0] = spin;
    const Scene met = encounterScene(pair, law, 50.0);
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
        // An arm of v_t has a bearing of its own where it is not that of f_t.
        if (!mattersTo(law, option == "velocity_arm" ? "lever_arm" : option)) continue;
        for (const std::string& damper : valuesOf(can, law, "damper")) {
          laws.push_back(law);
          setDampers(laws.back(), damper);
        }
      }
  return laws;
}

/// The in-house engine from the same start, each value of the option in turn; that of the engine's
/// own declaration has to come nearest, and to within what a thousandth of k_n (lockstep's rule for
/// one law) moves. A value is examined where every other one leads elsewhere.
void conventionsAreThoseDeclared(Exam& it) {
  const EngineEntry& own = engineRegistry().front();
  if (it.entry.name == own.name || !it.entry.mirrors.empty())
    it.skip("it is the in-house engine, and would be compared with itself");
  const auto inHouse = own.make();
  const bool planesToo = !it.refused(conventionsScene(it.law(), true));
  int count = 0;
  for (const LawOption& option : lawOptions()) {
    const std::string name(option.name);
    if (std::ranges::count(oraclesOptions, name) > 0 || !it.can.lawOptions.contains(name)) continue;
    for (const std::string& value : it.can.lawOptions.at(name)) {
      std::string why;
      const bool loaded =
          std::ranges::any_of(lawsFor(it.can, name, value), [&](const ContactLaw& law) {
            const auto refusal = planesToo ? it.refused(conventionsScene(law, true)) : std::nullopt;
            if (planesToo && !refusal) return true;
            if (const auto again = it.refused(conventionsScene(law, false)))
              why = *again;
            else
              return true;
            return false;
          });
      if (!loaded) {
        if (!why.empty()) it.refusedToo(said(name, " = ", value), why);
        continue;
      }
      const Scene ran = it.scene;
      const auto declared = declaredLaw(it.can, ran, it.realised, 0.5 * smallMass);
      if (!declared || !declared->soft()) continue;
      const std::vector<double> found = motionAt(it.engine(), ran, Encounter::end);
      const auto mirror = [&](const std::string& which, double stiffer) {
        Scene mirrored = ran;
        mirrored.law = *declared;
        mirrored.dt = it.realised.dt;
        mirrored.precision = Precision::float64;
        setLawOption(mirrored.law, name, which);
        changeYardstick(mirrored.law, stiffer);
        inHouse->load(mirrored, {});
        return motionAt(*inHouse, mirrored, Encounter::end);
      };
      const std::vector<double> wanted = mirror(value, 0.0);
      const double limit = std::max(farthest(mirror(value, lockstepSameLaw), wanted),
                                    it.byPrecision(1e-9, 1e-3, "").relative * Encounter::speed);
      const double off = farthest(found, wanted);
      ++count;
      bool known = true;  // from every other value
      std::string nearest;
      double least = off;
      for (const std::string_view other : option.values) {
        if (other == value || !mattersTo(ran.law, name == "velocity_arm" ? "lever_arm" : name))
          continue;
        const std::vector<double> otherwise = mirror(std::string(other), 0.0);
        if (farthest(otherwise, wanted) <= 1e-3 * limit) continue;  // another name of the same
        if (farthest(otherwise, wanted) <= 2.0 * limit) {
          known = false;
          it.refusedToo(said(name, " = ", value), said("hardly other than ", other, " here"));
        }
        if (const double left = farthest(found, otherwise); left < least) {
          least = left;
          nearest = other;
        }
      }
      if (known) it.examinedOption(name, value);
      if (off <= limit) continue;
      it.fault(said("under ", name, " = ", value, " it is off the in-house engine by ",
                    fmt::format("{:.3g} m/s, allowed {:.3g}", off, limit),
                    " (a thousandth of k_n)"));
      if (!nearest.empty() && least <= limit)
        it.suspect(said("it has ", name, " = ", nearest, ", and declares ", value));
    }
  }
  if (count == 0) it.skip("it declares no convention of a soft law, or refuses the scenes");
}

}  // namespace

std::span<const Check> checks() {
  static constexpr std::array list = {
      Check{"FrictionFollowsTheOracle", "every law follows the theory of two disks",
            frictionFollowsTheOracle},
      Check{"UnequalDisksFollowTheOracle", "so do disks of two sizes and masses",
            unequalDisksFollowTheOracle},
      Check{"WallDisksFollowTheOracle", "so does a disk on a wall disk", wallDisksFollowTheOracle},
      Check{"PlanesFollowTheOracle", "so does a disk on a plane, spinning and obliquely",
            planesFollowTheOracle},
      Check{"MovingPlanesFollowTheOracle",
            "and on a plane that moves along itself, towards it or away",
            movingPlanesFollowTheOracle},
      Check{"ConventionsAreThoseDeclared",
            "its conventions are those declared: the in-house engine with them does the same",
            conventionsAreThoseDeclared},
  };
  return list;
}

}  // namespace crossgrain::conformance::laws

// The conventions and constants of an engine's law, one after the other: the in-house engine that
// has them runs the same disks from the same start.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>

#include "adapters/declared_law.hpp"
#include "law/law_options.hpp"
#include "oracle/impact.hpp"
#include "results/lockstep_text.hpp"
#include "studies/causes/changes.hpp"
#include "studies/conformance/check_context.hpp"
#include "studies/conformance/conformance_scenes.hpp"
#include "studies/lockstep/rules.hpp"
#include "studies/lockstep/terms.hpp"

namespace crossgrain::conformance {
namespace {

/// Each has its oracle.
constexpr std::array oraclesOptions = {"normal", "damper", "tangential", "tension"};

/// An arm of v_t has a bearing wherever there are arms of f_t: it could be another one.
std::string bearingOf(const std::string& option) {
  return option == "velocity_arm" ? "lever_arm" : option;
}

/// Disks that stick, slip and roll on each other, on wall disks and, where the engine has planes,
/// on a plane; far enough apart not to meet, of several sizes.
Scene conventionsScene(const ContactLaw& law, bool withPlane, double steps = coarseSteps) {
  Scene scene = emptyScene(law, steps);
  std::vector<Vec2> posts;
  const double apart = 12.0 * largeRadius;
  int k = 0;
  for (const double spin : {-60.0, -6.0, 12.0, 70.0}) {
    Encounter pair = crookedEncounter();
    pair.obliqueness = 0.3 * (k - 1.5);
    pair.spins[0] = spin;
    const Scene met = encounterScene(pair, law, steps);
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

/// The law with the part that an option belongs to, in each way that the engine declares; as it is
/// where that is no part that a scene need not have.
std::vector<ContactLaw> withPart(const Capabilities& can, const ContactLaw& law,
                                 const LawOption& option) {
  std::vector<ContactLaw> laws;
  if (option.part == LawPart::contact) laws.push_back(law);
  if (option.part == LawPart::rolling)
    for (const RollingLaw kind : rollingLaws(can)) laws.push_back(withRolling(law, kind));
  if (option.part == LawPart::cohesion)
    for (const CohesionLaw kind : cohesionLaws(can)) {
      if (!goesWith(kind, law.normal)) continue;
      laws.push_back(withCohesion(law, kind));
      if (option.name == "cohesion_load") continue;
      for (const std::string& load : valuesOf(can, law, "cohesion_load")) {  // it may have its own
        laws.push_back(laws.back());
        setLawOption(laws.back(), "cohesion_load", load);
      }
    }
  return laws;
}

/// Laws under which the option has a bearing, of those that the engine declares.
std::vector<ContactLaw> lawsFor(const Capabilities& can, const LawOption& option,
                                const std::string& value) {
  const std::string name(option.name);
  std::vector<ContactLaw> laws, undamped;
  const auto add = [&](ContactLaw law) {
    if (lawOptionValue(law, name) != value || !mattersTo(law, bearingOf(name))) return;
    for (const std::string& damper : valuesOf(can, law, "damper")) {
      laws.push_back(law);
      setDampers(laws.back(), damper);
    }
    undamped.push_back(law);
    undamped.back().gn = undamped.back().gt = undamped.back().gr = 0.0;
    if (!mattersTo(undamped.back(), bearingOf(name))) undamped.pop_back();
  };
  for (const std::string& normal : valuesOf(can, followed(can, fullLaw()), "normal"))
    for (const std::string& tension : valuesOf(can, fullLaw(), "tension"))
      for (const std::string& arm : valuesOf(can, fullLaw(), "lever_arm")) {
        ContactLaw law = lawOf(can, normal);
        if (!law.soft()) continue;
        setLawOption(law, "tension", tension);
        setLawOption(law, "lever_arm", arm);
        // Constants of a part are in the units that its conventions say; its kind is one of them.
        if (name != "rolling" && name != "cohesion") setLawOption(law, name, value);
        for (const ContactLaw& whole : withPart(can, law, option)) add(whole);
      }
  // Laws without dashpots come last, for engines that have the part only without them.
  laws.insert(laws.end(), undamped.begin(), undamped.end());
  return laws;
}

/// How many steps a contact takes. Which step k₂ is of has no bearing in the limit of small ones:
/// in 50 of them its values are as far apart as a thousandth of k_n moves, in 15 six times as far.
double stepsFor(const LawOption& option) {
  return option.name == "unloading_stiffness" ? 15.0 : coarseSteps;
}

/// Loads the scene of conventions under the first of these laws that the engine takes, with a plane
/// where it takes that. @returns whether there is one; @param why  gets the last refusal
bool loadedUnderAny(CheckContext& context, const std::vector<ContactLaw>& laws, bool withPlane,
                    double steps, std::string& why) {
  for (const ContactLaw& law : laws) {
    if (withPlane && !context.refusal(conventionsScene(law, true, steps))) return true;
    const auto refusal = context.refusal(conventionsScene(law, false, steps));
    if (!refusal) return true;
    why = *refusal;
  }
  return false;
}

/// The in-house engine on the scene that another engine ran, with its law or another.
class Mirror {
 public:
  /// @param scene  CheckContext::mirrored()
  Mirror(Engine& inHouse, Scene scene) : inHouse_(inHouse), scene_(std::move(scene)) {}
  /// @param further  how far on its way each disk starts [m]
  std::vector<double> operator()(const auto& change, double further = 0.0) const {
    Scene scene = scene_;
    change(scene.law);
    for (std::size_t i = 0; i < scene.disks.size(); ++i)
      scene.disks.position[i] += further * scene.disks.velocity[i].normalized();
    inHouse_.load(scene, {});
    return motionAt(inHouse_, scene, Encounter::end);
  }

 private:
  Engine& inHouse_;
  Scene scene_;
};

/// The constant of that part of the law whose change explains the motion found, to within the
/// limit; empty: none does.
std::string constantOff(const Mirror& mirror, const ContactLaw& law, LawPart part,
                        const std::vector<double>& found, double limit) {
  std::string best;
  for (const LawConstant& constant : lawConstants()) {
    if (constant.part != part || law.*constant.value == 0.0) continue;
    double least = std::numeric_limits<double>::infinity(), factor = 1.0;
    const auto attempt = [&](double by) {
      const double left =
          farthest(found, mirror([&](ContactLaw& other) { other.*constant.value *= by; }));
      if (!(left < least)) return false;
      least = left;
      factor = by;
      return true;
    };
    for (const double by : {1.0, 0.25, 0.5, 0.75, 0.9, 1.1, 1.25, 1.5, 2.0}) attempt(by);
    for (double width = 0.125; width > 2e-4; width *= 0.5)
      if (!attempt(factor + width)) attempt(factor - width);
    if (!(least <= limit)) continue;
    limit = least;
    best = text(results::constantSymbol(std::string(constant.name)), " ",
                fmt::format("{:+.3g} %", 100.0 * (factor - 1.0)));
  }
  return best;
}

/// The constant of that part without which the law moves as found, to within the limit; empty:
/// none.
std::string constantMissing(const Mirror& mirror, const ContactLaw& law, LawPart part,
                            const std::vector<double>& found, double limit) {
  for (const LawConstant& constant : lawConstants()) {
    const bool stiffness = constant.value == &ContactLaw::kUnload;  // 0 of it is no law
    if (constant.part != part || law.*constant.value == 0.0 || stiffness) continue;
    if (farthest(found, mirror([&](ContactLaw& other) { other.*constant.value = 0.0; })) <= limit)
      return text(results::constantSymbol(std::string(constant.name)), " -100 %");
  }
  return {};
}

/// Kinds of one part of the law that were asked for, and those under which the engine moves as
/// without the part.
struct Absence {
  int kinds = 0, absent = 0;
  std::string said;                      ///< of the first of these
  std::function<std::string()> missing;  ///< finds the constant that is, of the first

  /// The missing part, or the missing constant where that is all there is of the part under one
  /// kind.
  std::string cause() const {
    if (absent < kinds)
      if (std::string constant = missing(); !constant.empty()) return constant;
    return said;
  }
};

/// By how much single precision moves what the scene of conventions ends with [m/s]: in the flight
/// before they meet it takes disks on or back, which touch earlier or later in a step then, and in
/// the contact it walks. 0 in double.
/// @param moved  what comes of disks that start so far on their way [m]
double roundedApart(const CheckContext& context, const ContactLaw& law,
                    const std::function<double(double)>& moved) {
  if (!context.single()) return 0.0;
  const double place = farthestPlace(context.scene);
  const double dt = context.effective.dt, flight = Encounter::gap / Encounter::speed;
  const double further = roundedInFlight(context.can, place, flight / dt);
  ContactLaw elastic = law;
  elastic.cohesion = CohesionLaw::none;
  const Impact impact{0.5 * smallMass, 0.5 * smallRadius, Encounter::speed};
  return std::max(moved(further), moved(-further)) +
         roundedInContact(context.can, place, impactTime(elastic, impact) / dt) /
             deepestOverlap(elastic, impact) * Encounter::speed;
}

/// Compares the loaded scene, under one value of a convention, with the in-house engine that has
/// this value, and with those that have each other value.
/// @param absence  counts, where the convention is the kind of a part
/// @param constant  gets what finds the constant that explains a difference, where no other value
///                  of this convention does
/// @returns whether the law is known, so that it could be
bool expectConvention(CheckContext& context, Engine& inHouse, const LawOption& option,
                      const std::string& value, Absence& absence,
                      std::function<std::string()>& constant) {
  const std::string name(option.name);
  const std::string capability = text(name, " = ", value);
  const Scene ran = context.scene;
  const auto declared = declaredLaw(context.can, ran, context.effective, 0.5 * smallMass);
  if (!declared || !declared->soft()) return false;
  const std::vector<double> found = motionAt(context.engine, ran, Encounter::end);
  const Mirror with(inHouse, context.mirrored(*declared));
  const auto mirror = [&](std::string_view which, double stiffer, double further = 0.0) {
    return with(
        [&](ContactLaw& law) {
          setLawOption(law, name, which);
          changeReference(law, stiffer);
        },
        further);
  };
  const std::vector<double> wanted = mirror(value, 0.0);
  const double limit = std::max(farthest(mirror(value, lockstepSameLaw), wanted),
                                context.byPrecision(1e-9, 1e-3, "").relative * Encounter::speed) +
                       roundedApart(context, *declared, [&](double further) {
                         return farthest(mirror(value, 0.0, further), wanted);
                       });
  const double off = farthest(found, wanted);
  bool known = true;  // from every other value
  std::string nearest;
  double least = off;
  for (const std::string_view other : option.values) {
    if (other == value || !mattersTo(ran.law, bearingOf(name))) continue;
    if (other != "none" && !constantsServe(ran.law, name, other)) continue;
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
  ++absence.kinds;
  if (off <= limit) return true;
  if (option.part == LawPart::contact) context.lawIsOff = true;
  context.fault(
      text("under ", capability, " it is off the in-house engine by ",
           fmt::format("{:.3g} m/s, allowed {:.3g}", off, limit),
           context.single() ? " (a thousandth of k_n, and rounding)" : " (a thousandth of k_n)"));
  const double leaves = std::min(limit, explainedLeaves * off);
  const bool explained = !nearest.empty() && least <= leaves;
  std::string said = text("it has ", name, " = ", nearest, ", and declares ", value);
  if (explained && nearest == "none" && absence.absent++ == 0) {
    absence.said = std::move(said);
    absence.missing = [with, law = *declared, part = option.part, found, leaves] {
      return constantMissing(with, law, part, found, leaves);
    };
  } else if (explained && nearest != "none") {
    option.part == LawPart::contact ? context.suspect(std::move(said))
                                    : context.suspectPart(std::move(said));
  } else if (!explained && option.part != LawPart::contact && !constant) {
    constant = [with, law = *declared, part = option.part, found, leaves] {
      return constantOff(with, law, part, found, leaves);
    };
  }
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
  // A constant is a cause only if no convention is one: twice the length is twice the bound.
  std::function<std::string()> constant;
  for (const LawOption& option : lawOptions()) {
    const std::string name(option.name);
    const auto values = context.can.lawOptions.find(name);
    if (std::ranges::count(oraclesOptions, name) > 0 || values == context.can.lawOptions.end())
      continue;
    Absence absence;
    for (const std::string& value : values->second) {
      std::string why;
      if (loadedUnderAny(context, lawsFor(context.can, option, value), withPlane, stepsFor(option),
                         why)) {
        any = expectConvention(context, *inHouse, option, value, absence, constant) || any;
      } else if (!why.empty()) {
        context.couldNotExamine(text(name, " = ", value), why);
      }
    }
    if (absence.absent > 0) context.suspectPart(absence.cause());
  }
  if (constant && !context.cause)
    if (std::string off = constant(); !off.empty()) context.suspectPart(std::move(off));
  if (!any) context.skip("it declares no convention of a soft law, or refuses the scenes");
}

}  // namespace

Checks conventionChecks() {
  return {
      {"ConventionsAreThoseDeclared",
       "its conventions are those declared: the in-house engine with them does the same",
       conventionsAreThoseDeclared},
  };
}

}  // namespace crossgrain::conformance

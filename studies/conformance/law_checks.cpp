// Two bodies meet once, under every law that the engine declares: compared with the oracle.
#include <algorithm>
#include <iterator>
#include <map>
#include <string>

#include "law/law_options.hpp"
#include "studies/conformance/check_context.hpp"
#include "studies/conformance/conformance_scenes.hpp"
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

/// @param evidence  gets the result  @returns whether there was a reference
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

/// Checks that moments of inertia are the scene's, not the usual one: a ring's, and a sphere's or a
/// disk's.
void inertiaIsTheScenes(CheckContext& context) {
  bool others = false, any = false;
  Evidence evidence;
  for (const double factor : {0.4, solidDisk, 1.0}) {
    if (factor == context.inertiaFactor() || !hasInertia(context.can.limits, factor)) continue;
    if (context.inSpace && factor == solidDisk) continue;  // stands for spheres there
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

/// The relative motion is the same whether a plane moves along itself, towards the disk or away.
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

}  // namespace

Checks lawChecks() {
  return {
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
  };
}

}  // namespace crossgrain::conformance

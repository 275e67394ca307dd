// Rolling resistance, cohesion and laws of pairs of materials, of engines that declare them: closed
// forms of two bodies, without the in-house engine.
#include <algorithm>
#include <cmath>

#include "adapters/declared_law.hpp"
#include "law/cohesion.hpp"
#include "law/law_options.hpp"
#include "oracle/collision_oracle.hpp"
#include "oracle/impact.hpp"
#include "studies/conformance/check_context.hpp"
#include "studies/conformance/conformance_scenes.hpp"

namespace crossgrain::conformance {
namespace {

const Tolerance firstOrderScheme = {0.0, 0.02, "a first-order scheme at t_c/400"};

/// Two small disks, head on, that turn against each other: their surfaces do not slip, and where
/// they roll nothing else acts on their spins.
constexpr double pairSpin = 40.0;  // of each [rad/s]
constexpr double pairMass = 0.5 * smallMass, pairRadius = 0.5 * smallRadius;

/// The first normal law of the engine, without dashpots.
ContactLaw withoutDashpots(const Capabilities& can, const std::string& normal) {
  ContactLaw law = lawOf(can, normal);
  law.gn = 0.0;
  return law;
}

/// The law of the loaded scene as the engine declares it.
ContactLaw declared(CheckContext& context) {
  return declaredLaw(context.can, context.scene, context.effective, pairMass)
      .value_or(context.scene.law);
}

std::string firstNormal(CheckContext& context) {
  return lawOptionValue(context.law(), "normal");
}

/// Two small disks, or one on a plane.
/// @param inertia  of each [kg m²]
CollidingPair smallPair(bool plane, double inertia) {
  if (plane) return diskOnWall(smallRadius, smallMass, inertia);
  return {{smallRadius, smallRadius}, {smallMass, smallMass}, {inertia, inertia}};
}

// ---- rolling ------------------------------------------------------------------------------------

/// ω_r after an impact by ω_r before it. J ω′ = ∓M of both; the impulse p of f_n is 2 m₁₂ v without
/// dashpots, (1 + e_n) m₁₂ v of rigid disks, the duration t_c. With 1/J the sum of both inverse
/// moments of inertia:
///   A  ω_r − µ_r L p/J,   B  exp(−γ_r L² t_c/J),   by load  exp(−µ_r L² p/J),
///   C  cos(t_c √(k_r/J)) while its spring holds.
double rollsOn(const ContactLaw& law, bool plane, double inertia, double spin) {
  const double mass = plane ? smallMass : pairMass;
  const double inverse = (plane ? 1.0 : 2.0) / inertia;
  const CollidingPair pair = smallPair(plane, inertia);
  const double length = rollingLength(law, pair);
  const double impulse = (law.soft() ? 2.0 : 1.0 + law.en) * mass * Encounter::speed;
  const double duration =
      law.soft() ? impactTime(law, {mass, plane ? smallRadius : pairRadius, Encounter::speed})
                 : 0.0;
  switch (law.rolling) {
    case RollingLaw::constantTorque:
      return spin - law.muR * length * impulse * inverse;
    case RollingLaw::viscous:
      return spin * std::exp(-law.gr * length * length * duration * inverse);
    case RollingLaw::viscousByLoad:
      return spin * std::exp(-law.muR * length * length * impulse * inverse);
    case RollingLaw::spring:
      return spin * std::cos(duration * std::sqrt(law.kr * rollingSquare(law, pair) * inverse));
    case RollingLaw::none:
      break;
  }
  return spin;
}

/// A disk that falls straight on a plane and turns; nothing slips against it without friction.
Scene turningOnPlane(const ContactLaw& law) {
  return sceneOf(law, {planeWall({0.2, 0.0}, Vec2::UnitY())},
                 {{{0.0, smallRadius + Encounter::gap}, {0.0, -Encounter::speed}, pairSpin}},
                 fineSteps);
}

void rollingFollowsItsClosedForms(CheckContext& context) {
  context.needs(toString(Effect::rollingResistance));
  bool any = false;
  for (const RollingLaw kind : rollingLaws(context.can)) {
    ContactLaw law = withRolling(withoutDashpots(context.can, firstNormal(context)), kind);
    const std::string name = "rolling = " + lawOptionValue(law, "rolling");
    if (kind == RollingLaw::spring) {
      law.gr = 0.0;
      law.muR = 1e3;  // never at its bound
    }
    Encounter pair;
    pair.spins[0] = pairSpin;
    pair.spins[1] = -pairSpin;
    // Nothing slips, with friction or without, as long as both have their torque.
    if (context.refusal(encounterScene(pair, frictionless(law), fineSteps)))
      if (const auto why = context.refusal(encounterScene(pair, law, fineSteps))) {
        context.couldNotExamine(name, *why);
        continue;
      }
    any = true;
    context.examine(toString(Effect::rollingResistance));
    const ContactLaw own = declared(context);
    const double inertia = context.scene.disks.inertia[0];
    const std::vector<double> spins = spinsOf(context.scene, context.at(Encounter::end));
    const double lost = pairSpin - 0.5 * rollsOn(own, false, inertia, 2.0 * pairSpin);
    const double first = pairSpin - spins[0], second = pairSpin + spins[1];
    const bool resists = std::abs(first) > 0.1 * lost;
    if (resists && std::abs(second) < 1e-3 * lost)
      context.suspectPart("the torque against rolling acts on the first of two disks alone");
    context.near(first, lost, firstOrderScheme,
                 name + ", the spin lost by the first of two disks [rad/s]");
    context.near(second, lost, firstOrderScheme,
                 name + ", the spin lost by the second of two disks [rad/s]");

    if (context.refusal(turningOnPlane(frictionless(law)))) continue;
    const double left = spinsOf(context.scene, context.at(Encounter::end))[0];
    const double lostOnPlane = pairSpin - rollsOn(own, true, inertia, pairSpin);
    if (resists && std::abs(pairSpin - left) < 1e-3 * lostOnPlane)
      context.suspectPart("nothing resists rolling at planes");
    context.near(pairSpin - left, lostOnPlane, firstOrderScheme,
                 name + ", the spin lost on a plane [rad/s]");
  }
  if (!any) context.skip("it refuses every law that resists rolling here");
}

/// Under its weight, along a slope of angle β (Ai et al. 2011; J = q m R²): at rest up to
/// tan β = µ_r L/R, then faster by g (sin β − µ_r L/R cos β)/(1 + q). Held for long it may be
/// steeper: what the first swing slipped is at rest then.
void rollingHoldsASlope(CheckContext& context) {
  context.needs(toString(Effect::rollingResistance));
  context.needs(planes);
  constexpr double gravity = 9.81, soon = 0.05, late = 2.0;
  constexpr double holding = 0.5, steep = 0.75, rolling = 2.0;  // times the steepest that holds
  const std::vector<RollingLaw> kinds = rollingLaws(context.can);
  if (std::ranges::count(kinds, RollingLaw::spring) == 0) context.skip("has no rolling spring");
  const ContactLaw base = lawOf(context.can, firstNormal(context));
  if (base.normal != NormalLaw::linear) context.skip("has no linear law");
  const ContactLaw law = withRolling(base, RollingLaw::spring);
  const double most = law.muR * rollingLength(law, smallPair(true, smallInertia)) / smallRadius;
  for (const auto& [part, end] : {std::pair(holding, soon), {rolling, soon}, {steep, late}}) {
    const double slope = std::atan(part * most);
    const double depth = smallMass * gravity * std::cos(slope) / law.kn;
    Scene scene =
        sceneOf(law, {planeWall({0.2, 0.0}, Vec2::UnitY())}, {{{0.0, smallRadius - depth}}}, 100.0);
    scene.gravity = gravity * Vec2(std::sin(slope), -std::cos(slope));
    context.load(scene);
    if (declared(context).kn != law.kn) context.skip("its contacts are stiffer than the scene's");
    const double speed = context.at(end).velocity[0].x();
    const double free = gravity * std::sin(slope) / (1.0 + context.inertiaFactor()) * soon;
    const bool held = context.faults.empty();
    if (part < 1.0)
      context.near(speed, 0.0, {0.02 * free, 0.0, "of the speed without resistance; springs swing"},
                   text("the speed on a slope that holds a disk [m/s]",
                        end == late ? ", 2 s after load" : ""));
    if (end == late && held && !context.faults.empty())
      context.suspectPart("the torque against rolling is another one late after load");
    if (part > 1.0)
      context.near(speed, (1.0 - most / std::tan(slope)) * free,
                   {0.03 * free, 0.0, "of the speed without resistance; springs swing"},
                   "the speed on a slope that does not hold it [m/s]");
  }
}

/// A disk that turns between two posts, held by all that contacts remember, while another flies by,
/// for which lists of neighbours are made anew: it does what it does alone.
void memoriesHoldWhileAnotherFliesBy(CheckContext& context) {
  if (context.rigid()) context.skip("has no contacts that remember anything");
  std::vector<ContactLaw> laws = resistingLaws(context.can);
  // First a law without memory and one of tangential springs alone: their faults are not the
  // rolling spring's.
  const ContactLaw springs = context.law();
  laws.insert(laws.begin(), {frictionless(springs), springs});
  bool memoryless = true, ordinary = true;
  constexpr double depth = 0.02 * smallRadius, end = 0.03, speed = 2.0;
  constexpr double post = 2.0 * smallRadius - depth;
  bool any = false;
  for (const ContactLaw& law : laws) {
    constexpr double path = 20.0 * smallRadius, beside = path + 2.005 * smallRadius;
    const auto states = [&](double passing) {
      const Scene scene =
          sceneOf(law, {wallOf("posts", Vec2::Zero(), {{0.0, post}, {0.0, -post}})},
                  {{{-0.03, path}, {passing, 0.0}},
                   {Vec2::Zero(), {0.02, 0.0}, 5.0},
                   // One of a pair of its own, in which the second is the one that turns.
                   {{0.1, 0.0}, {0.01, 0.0}, -3.0},
                   {{0.1, post}, {-0.01, 0.0}, 4.0},
                   // Near these it is in lists, before all others: what is kept by its place there
                   // moves on.
                   {{-0.02, beside}},
                   {{0.0, beside}},
                   {{0.02, beside}}});
      return context.refusal(scene) ? std::vector<DiskState>() : statesOf(scene, context.at(end));
    };
    const std::vector<DiskState> wanted = states(0.0), found = states(speed);
    if (wanted.empty() || found.empty()) continue;
    any = true;
    const std::size_t before = context.faults.size();
    for (const std::size_t i : {1, 2, 3})
      context.sameMotion(
          found[i], wanted[i],
          context.byPrecision(1e-9, 1e-3, "roundings of another order of sums"),
          text(" of disk ", i, " under rolling = ", lawOptionValue(law, "rolling"),
               ", cohesion = ", lawOptionValue(law, "cohesion"), " while another flies by"));
    if (context.faults.size() == before) continue;
    const std::vector<DiskState> again = states(0.0);  // unless loads remember, it is as before
    const bool afresh = std::ranges::equal(again, wanted, {}, &DiskState::spin, &DiskState::spin);
    memoryless = memoryless && afresh;
    const char* const lost =
        "springs are lost or turned round where lists of neighbours are made anew";
    if (memoryless && law == springs && law.springs()) context.suspect(lost);
    if (memoryless && ordinary && law.rolling == RollingLaw::spring)
      context.suspect(text("rolling ", lost));
    memoryless = memoryless && law.springs();
    ordinary = ordinary && !(law == springs);
  }
  if (!any) context.skip("it refuses what is held between posts");
}

// ---- cohesion -----------------------------------------------------------------------------------

/// Two small disks that meet head on at that speed.
Scene headOn(const ContactLaw& law, double speed) {
  Scene scene = encounterScene({}, law, fineSteps);
  for (Vec2& velocity : scene.disks.velocity) velocity *= speed / Encounter::speed;
  return scene;
}

/// How far apart surfaces are, and how fast they part.
struct Parting {
  double gap, speed;  ///< [m, m/s]
};

Parting partingOf(const Snapshot& now) {
  const Vec2 apart = now.position[0] - now.position[1];
  return {apart.norm() - 2.0 * smallRadius,
          (now.velocity[0] - now.velocity[1]).dot(apart.normalized())};
}

/// Contacts are shown from the first touch until they let go, pulling beyond their overlap.
void expectBond(CheckContext& context, const ContactLaw& law, double end) {
  double farthest = 0.0, first = 1.0;
  for (const Snapshot& now : context.watch(end)) {
    if (!now.contacts || now.contacts->size() == 0) continue;
    const double overlap = now.contacts->overlap.front();
    if (first > 0.5) first = overlap;
    if (now.contacts->normalForce.front() < 0.0) farthest = std::min(farthest, overlap);
  }
  const double reach = bondRange(law, pairRadius);
  if (farthest == 0.0)
    context.suspectPart("contacts of JKR's law let go where surfaces just touch");
  context.atLeast(first, -1e-3 * reach, "the overlap where a bond of JKR's begins [m]");
  context.near(farthest, -reach, {0.05 * reach, 0.0, "what two surfaces move in a step"},
               "the overlap where a bond of JKR's lets go [m]");
}

void cohesionFollowsItsClosedForms(CheckContext& context) {
  context.needs(toString(Effect::cohesion));
  bool any = false;
  for (const CohesionLaw kind : cohesionLaws(context.can))
    for (const std::string& normal : valuesOf(context.can, context.law(), "normal")) {
      const ContactLaw base = withoutDashpots(context.can, normal);
      if (!base.soft() || !goesWith(kind, base.normal)) continue;
      const ContactLaw law = withCohesion(base, kind);
      const std::string option = "cohesion = " + lawOptionValue(law, "cohesion"),
                        name = text(normal, " with ", option, ", ");
      const bool bonds = kind == CohesionLaw::jkr;
      const CollidingPair pair = smallPair(false, smallInertia);
      const double sticking = stickingSpeed(law, pair).value_or(0.0);
      const double speed = bonds ? 1.5 * sticking : Encounter::speed;
      const double end =
          Encounter::gap / speed + 5.0 * impactTime(law, {pairMass, pairRadius, speed});
      if (const auto why = context.refusal(headOn(law, speed))) {
        context.couldNotExamine(option, *why);
        continue;
      }
      any = true;
      context.examine(toString(Effect::cohesion));
      const ContactLaw own = declared(context);
      const Snapshot after = context.at(end);
      const Parting parted = partingOf(after);
      double restitution = 1.0;
      if (bonds) restitution = std::sqrt(1.0 - 1.0 / (1.5 * 1.5));
      if (kind == CohesionLaw::elastoPlastic)
        restitution = elastoPlasticRestitution(own, pair, speed);
      context.near(parted.speed / speed, restitution, firstOrderScheme, name + "e_n");
      // Nothing slips: without friction there is no convention that has no limit of small steps.
      if (kind == CohesionLaw::area || kind == CohesionLaw::dmt)
        context.near(after.positionTime - Encounter::gap / speed - parted.gap / parted.speed,
                     oracleOutcome(frictionless(own), pair, {0.0, speed}).duration.value(),
                     firstOrderScheme, name + "how long they touch [s]");
      if (!bonds) continue;
      if (context.contactReport() == ContactReport::instant) {
        context.load(headOn(law, speed));
        expectBond(context, own, end);
      }
      context.load(headOn(law, 0.5 * sticking));
      const double stuck = Encounter::gap / (0.5 * sticking);
      for (const double times : {2.0, 3.0, 4.0})
        context.atMost(partingOf(context.at(times * stuck)).gap, bondRange(own, pairRadius),
                       name + "the gap of disks that met at half the speed that sticks [m]");
    }
  if (!any) context.skip("it refuses every law with cohesion here");
}

// ---- materials ----------------------------------------------------------------------------------

/// Two of one material, one of each, two of the other, and of the one two at walls of the other and
/// of their own.
Scene fourEncounters(const ContactLaw& law) {
  constexpr double apart = 12.0 * smallRadius;
  const Disks met =
      encounterScene({.obliqueness = 0.4, .spins = {9.0, -4.0}}, law, coarseSteps).disks;
  std::vector<SmallDisk> disks;
  std::vector<WallBody> posts;
  for (int k = 0; k < 3; ++k)
    for (const std::size_t i : {0, 1})
      disks.push_back({met.position[i] + Vec2(0.0, apart * k), met.velocity[i], met.spin[i]});
  for (const int k : {3, 4}) {
    const Vec2 post(0.0, k * apart);
    posts.push_back(postAt(post, {}, k == 3 ? "post 3" : "post 4"));
    disks.push_back(
        {post + Vec2(2.0 * smallRadius + Encounter::gap, 0.0), {-Encounter::speed, 0.03}, 7.0});
  }
  return sceneOf(law, std::move(posts), disks);
}

/// Each pair does what it does where all are like it.
void materialsHaveTheirOwnLaws(CheckContext& context) {
  context.needs(toString(Effect::pairMaterials));
  ContactLaw one = context.law(), mixed = one, other = one;
  mixed.kn *= 1.3;
  mixed.mu *= 0.4;
  mixed.en *= 0.7;
  other.kn *= 0.6;
  other.gn *= 0.5;
  other.mu *= 1.5;
  Scene scene = fourEncounters(one);
  scene.materials =
      Materials{{"one", "other"}, {0, 0, 0, 1, 1, 1, 0, 0}, {1, 0}, {one, mixed, mixed, other}};
  const std::vector<DiskState> found = statesOf(scene, context.run(scene, Encounter::end));
  context.examine(toString(Effect::pairMaterials));
  const Tolerance rounding = context.byPrecision(1e-9, 1e-4, "roundings");
  const auto expectLike = [&](const ContactLaw& law, std::initializer_list<std::size_t> disks,
                              const char* which) {
    Scene alike = fourEncounters(law);
    alike.dt = scene.dt;
    const std::vector<DiskState> wanted = statesOf(scene, context.run(alike, Encounter::end));
    for (const std::size_t i : disks)
      context.sameMotion(found[i], wanted[i], rounding, text(" of disk ", i, ", ", which));
  };
  expectLike(one, {0, 1, 7}, "of one material");
  expectLike(mixed, {2, 3, 6}, "of one of each material");
  expectLike(other, {4, 5}, "of the other material");
}

}  // namespace

Checks resistanceChecks() {
  return {
      inBoth({"RollingFollowsItsClosedForms",
              "rolling resistance takes as much spin as closed forms say",
              rollingFollowsItsClosedForms}),
      {"RollingHoldsASlope", "a rolling spring holds a disk up to the slope that it can",
       rollingHoldsASlope},
      {"MemoriesHoldWhileAnotherFliesBy",
       "what contacts remember holds while lists of neighbours are made anew",
       memoriesHoldWhileAnotherFliesBy, 2, true},
      {"CohesionFollowsItsClosedForms", "cohesion costs and lasts as closed forms say",
       cohesionFollowsItsClosedForms},
      {"MaterialsHaveTheirOwnLaws", "each two materials have a law of their own",
       materialsHaveTheirOwnLaws},
  };
}

}  // namespace crossgrain::conformance

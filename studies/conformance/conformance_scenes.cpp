#include "studies/conformance/conformance_scenes.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "law/law_options.hpp"
#include "oracle/impact.hpp"
#include "studies/conformance/check_context.hpp"

namespace crossgrain::conformance {

ContactLaw fullLaw() {
  ContactLaw law = thesisLaw();
  law.en = 0.8;
  law.et0 = 0.3;
  return law;
}

ContactLaw frictionless(ContactLaw law) {
  law.tangential = TangentialLaw::none;
  law.mu = 0.0;
  return law;
}

Scene emptyScene(const ContactLaw& law, double steps) {
  Scene scene;
  scene.name = "conformance";
  scene.law = law;
  ContactLaw soft = law;
  if (!law.soft()) soft.normal = NormalLaw::linear;
  scene.dt = impactTime(soft, {0.5 * smallMass, 0.5 * smallRadius, Encounter::speed}) / steps;
  return scene;
}

WallBody wallOf(const std::string& name, const Vec2& centre, const std::vector<Vec2>& disks,
                const Motion& motion) {
  WallBody body;
  body.name = name;
  body.centre = centre;
  body.diskPosition = disks;
  body.diskRadius.assign(disks.size(), smallRadius);
  body.motion = motion;
  return body;
}

Encounter crookedEncounter() {
  Encounter pair;
  pair.radii[1] = largeRadius;
  pair.masses[1] = largeMass;
  pair.obliqueness = 0.5;
  pair.spins[0] = 6.0;
  pair.spins[1] = -2.5;
  pair.drift = {0.013, -0.021};
  return pair;
}

Scene encounterScene(const Encounter& pair, const ContactLaw& law, double steps) {
  Scene scene = emptyScene(law, steps);
  const double reach = pair.radii[0] + pair.radii[1];
  const Vec2 apart = reach * Vec2(std::cos(pair.obliqueness), std::sin(pair.obliqueness)) +
                     Vec2(Encounter::gap, 0.0);
  for (const int k : {0, 1}) {
    const double share =
        (k == 0 ? 1.0 : -1.0) * pair.masses[1 - k] / (pair.masses[0] + pair.masses[1]);
    addDisk(scene, pair.radii[k], pair.masses[k], share * apart,
            pair.drift - share * Vec2(Encounter::speed, 0.0), pair.spins[k]);
  }
  return scene;
}

Scene landingScene(const ContactLaw& law, double steps) {
  Scene scene = emptyScene(law, steps);
  scene.bodies = {planeWall({0.0, -1e-3}, {0.0, 1.0})};
  const double height = smallRadius - 1e-3 + Encounter::gap;
  addDisk(scene, smallRadius, smallMass, {0.0, height}, {0.05, -0.05}, 6.0);
  return scene;
}

Scene busyScene(const ContactLaw& law) {
  Scene scene = emptyScene(law, coarseSteps);
  scene.gravity = {0.0, -50.0};  // settles within a short run
  constexpr int count = 12;
  constexpr double wheelRadius = 0.02, column = 9.1e-3, row = 9.2e-3;
  std::vector<Vec2> rim, posts;
  for (int k = 0; k < count; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / count;
    rim.push_back(wheelRadius * Vec2(std::cos(angle), std::sin(angle)));
  }
  for (const double side : {-2.3, 2.3})
    for (int k = 0; k < 5; ++k) posts.emplace_back(side * column, 0.019 + 7.4e-3 * k);
  scene.bodies = {wallOf("wheel", Vec2::Zero(), rim, rotating(3.0)),
                  wallOf("posts", {0.0, 0.03}, posts)};
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 4; ++c) {
      const bool large = (r + c) % 3 == 0;
      addDisk(scene, large ? largeRadius : smallRadius, large ? largeMass : smallMass,
              {column * (c - 1.5), 0.0285 + row * r}, {0.02 * r, -0.1 * (r + 1)}, 5.0 - c);
    }
  return scene;
}

Scene plateScene(const ContactLaw& law) {
  Scene scene = busyScene(law);
  scene.bottom = thesisBottom<BottomPlate>();
  return scene;
}

Scene withMaterials(Scene scene) {
  scene.materials = Materials{{"one"},
                              std::vector<std::int32_t>(scene.disks.size()),
                              std::vector<std::int32_t>(scene.bodies.size()),
                              {scene.law}};
  return scene;
}

Scene shifted(Scene scene, const Vec2& by) {
  for (Vec2& position : scene.disks.position) position += by;
  for (WallBody& body : scene.bodies) {
    body.centre += by;
    for (Vec2& position : body.diskPosition) position += by;
    for (Plane& plane : body.planes) plane.point += by;
  }
  return scene;
}

namespace {

/// Values of an option of a part of the law that scenes need not have, as numbers of its enum.
template <typename Kind>
std::vector<Kind> kindsOf(const Capabilities& can, Effect effect, const std::string& option) {
  const auto support = can.effects.find(effect);
  if (support == can.effects.end() || support->second == Support::never) return {};
  const auto known = std::ranges::find(lawOptions(), option, &LawOption::name);
  const auto listed = can.lawOptions.find(option);
  std::vector<Kind> kinds;
  for (std::size_t k = 1; k < known->values.size(); ++k)  // the first is none
    if (listed == can.lawOptions.end() || std::ranges::count(listed->second, known->values[k]) > 0)
      kinds.push_back(static_cast<Kind>(k));
  return kinds;
}

/// A soft law that also resists rolling and coheres, as the engine does where it does.
ContactLaw resisting(const Capabilities& can, ContactLaw law) {
  const std::vector<RollingLaw> rolling = rollingLaws(can);
  law = withRolling(law, rolling.empty() ? RollingLaw::spring : rolling.back());
  std::vector<CohesionLaw> cohesion = cohesionLaws(can);
  std::erase_if(cohesion, [&](CohesionLaw kind) { return !goesWith(kind, law.normal); });
  return withCohesion(law, cohesion.empty() ? CohesionLaw::area : cohesion.front());
}

}  // namespace

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

ContactLaw withRolling(ContactLaw law, RollingLaw rolling) {
  const LawConventions& how = law.conventions;
  constexpr double length = 0.5 * smallRadius;  // R₁₂ [m]
  law.rolling = rolling;
  law.kr = law.gr = law.muR = 0.0;
  if (rolling == RollingLaw::viscous) law.gr = 0.5 * thesis.gt;
  if (rolling == RollingLaw::constantTorque) law.muR = 0.1;
  if (rolling == RollingLaw::viscousByLoad) law.muR = 5.0;  // [s/m]
  if (rolling == RollingLaw::spring) {
    law.muR = 0.2;
    law.kr = 0.1 * thesis.kt;
    if (how.rollingStiffness == RollingStiffness::constant) law.kr *= length * length;  // [N m]
    law.gr = how.rollingDamper == RollingDamper::critical ? 0.2 : 0.2 * thesis.gt;
  }
  return law;
}

ContactLaw withCohesion(ContactLaw law, CohesionLaw cohesion) {
  constexpr double circle = std::numbers::pi * smallRadius;  // 2π R₁₂ [m]
  law.cohesion = cohesion;
  law.kc = law.w = law.kUnload = law.plasticDepth = 0.0;
  if (cohesion == CohesionLaw::area) law.kc = 0.4 * thesis.kn / circle;  // [Pa]
  if (cohesion == CohesionLaw::dmt || cohesion == CohesionLaw::jkr)
    law.w = 5e-3 / circle;  // of F_po = 5 mN; an impact has 22 mN
  if (cohesion == CohesionLaw::elastoPlastic) {
    law.kUnload = 3.0 * law.kn;
    law.kc = 0.5 * law.kn;
    law.plasticDepth = 0.02;
  }
  return law;
}

std::vector<RollingLaw> rollingLaws(const Capabilities& can) {
  return kindsOf<RollingLaw>(can, Effect::rollingResistance, "rolling");
}

std::vector<CohesionLaw> cohesionLaws(const Capabilities& can) {
  return kindsOf<CohesionLaw>(can, Effect::cohesion, "cohesion");
}

bool goesWith(CohesionLaw cohesion, NormalLaw normal) {
  if (cohesion == CohesionLaw::jkr) return normal == NormalLaw::hertz;
  if (cohesion == CohesionLaw::elastoPlastic) return normal == NormalLaw::linear;
  return normal != NormalLaw::rigid;
}

std::vector<ContactLaw> resistingLaws(const Capabilities& can) {
  std::vector<ContactLaw> bases, laws;
  for (const std::string& normal : valuesOf(can, followed(can, fullLaw()), "normal"))
    if (const ContactLaw base = lawOf(can, normal); base.soft()) bases.push_back(base);
  if (bases.empty()) return {};
  const std::vector<RollingLaw> rolling = rollingLaws(can);
  for (const RollingLaw each : rolling) laws.push_back(withRolling(bases.front(), each));
  for (const CohesionLaw each : cohesionLaws(can)) {
    const auto base = std::ranges::find_if(
        bases, [&](const ContactLaw& law) { return goesWith(each, law.normal); });
    if (base == bases.end()) continue;
    laws.push_back(withCohesion(*base, each));
    for (const std::string& tension : valuesOf(can, laws.back(), "tension")) {
      ContactLaw other = laws.back();
      setLawOption(other, "tension", tension);
      if (mattersTo(other, "tension") && !(other == laws.back())) laws.push_back(other);
    }
    if (!rolling.empty()) laws.push_back(withRolling(laws.back(), rolling.back()));
  }
  return laws;
}

Scene fullScene(const Capabilities& can, const ContactLaw& law) {
  return withMaterials(plateScene(resisting(can, law.soft() ? law : fullLaw())));
}

}  // namespace crossgrain::conformance

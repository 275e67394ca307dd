#include "studies/conformance/declared_laws.hpp"

#include <algorithm>
#include <iterator>
#include <numbers>

#include "law/law_options.hpp"
#include "studies/conformance/check_context.hpp"

namespace crossgrain::conformance {
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

#include "oracle/impact.hpp"

#include <gsl/gsl_integration.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <stdexcept>

#include "law/cohesion.hpp"

namespace crossgrain::inline oracle {

ContactLaw withConstantDampers(ContactLaw law, double reducedMass) {
  if (law.normal != NormalLaw::linear) return law;
  law.gn = dampingOf(law.damper, law.gn, law.kn, reducedMass);
  law.gt = dampingOf(law.damper, law.gt, law.kt, reducedMass);
  law.damper = Damper::constant;
  return law;
}

double contactTime(const ContactLaw& law, double reducedMass) {
  if (law.normal == NormalLaw::rigid)
    throw std::invalid_argument("a rigid law has no contact time");
  if (law.normal != NormalLaw::linear)
    throw std::invalid_argument("its contact time depends on the speed of the impact");
  const double eta = withConstantDampers(law, reducedMass).gn / (2.0 * reducedMass);
  const double omegaSquared = law.kn / reducedMass - eta * eta;
  if (!(omegaSquared > 0.0))
    throw std::invalid_argument("an overdamped contact has no contact time");
  return std::numbers::pi / std::sqrt(omegaSquared);
}

double elasticEnergy(const ContactLaw& law, double reducedRadius, double overlap) {
  if (law.normal == NormalLaw::linear) return 0.5 * law.kn * overlap * overlap;
  if (law.normal == NormalLaw::hertz)
    return 0.4 * law.kn * std::sqrt(reducedRadius * overlap) * overlap * overlap;
  return (law.kn / 3.0 + law.kn3 / 4.0 * overlap) * overlap * overlap * overlap;
}

double deepestOverlap(const ContactLaw& law, const Impact& impact) {
  const double energy = 0.5 * impact.reducedMass * impact.speed * impact.speed;
  switch (law.normal) {
    case NormalLaw::linear:
      return std::sqrt(2.0 * energy / law.kn);
    case NormalLaw::hertz:
      return std::pow(energy / (0.4 * law.kn * std::sqrt(impact.reducedRadius)), 0.4);
    case NormalLaw::polynomial:
      break;
    case NormalLaw::rigid:
      throw std::invalid_argument("rigid disks do not overlap");
  }
  // A law that softens (k₃ < 0) pushes less than nothing beyond k₂/|k₃|.
  double outside = std::cbrt(3.0 * energy / law.kn);
  if (law.kn3 < 0.0) {
    outside = -law.kn / law.kn3;
    if (elasticEnergy(law, 0.0, outside) <= energy)
      throw std::invalid_argument("the polynomial law gives way under so fast an impact");
  }
  double inside = 0.0;
  while (outside - inside > 1e-15 * outside) {
    const double middle = 0.5 * (inside + outside);
    if (middle == inside || middle == outside) break;
    (elasticEnergy(law, 0.0, middle) < energy ? inside : outside) = middle;
  }
  return outside;
}

double impactTime(const ContactLaw& law, const Impact& asked) {
  if (!law.stiffens()) return contactTime(law, asked.reducedMass);
  Impact impact = asked;
  if (law.normal == NormalLaw::hertz && law.coheres()) {
    const double pull = pullOff(law, asked.reducedRadius);
    const double balance = std::pow(pull / (law.kn * std::sqrt(asked.reducedRadius)), 2.0 / 3.0);
    impact.speed =
        std::sqrt(impact.speed * impact.speed + 2.0 * pull * balance / impact.reducedMass);
  }
  const double deepest = deepestOverlap(law, impact);
  // δ = δ_max (1 − s²) takes the root's singularity out of T = 2 ∫ dδ/√(v² − 2 W/m₁₂).
  const auto integrand = [&](double s) {
    const double work = elasticEnergy(law, impact.reducedRadius, deepest * (1.0 - s * s));
    return 4.0 * deepest * s /
           std::sqrt(impact.speed * impact.speed - 2.0 * work / impact.reducedMass);
  };
  gsl_function function{
      [](double s, void* of) { return (*static_cast<const decltype(integrand)*>(of))(s); },
      const_cast<void*>(static_cast<const void*>(&integrand))};
  const std::unique_ptr<gsl_integration_cquad_workspace,
                        decltype(&gsl_integration_cquad_workspace_free)>
      workspace(gsl_integration_cquad_workspace_alloc(100), &gsl_integration_cquad_workspace_free);
  double time = 0.0;
  constexpr double nearlyZero = 1e-4;
  gsl_integration_cquad(&function, nearlyZero, 1.0, 0.0, 1e-9, workspace.get(), &time, nullptr,
                        nullptr);
  // Near s = 0 it is the quotient of two small numbers, and constant, as the force is there.
  return time + nearlyZero * integrand(nearlyZero);
}

}  // namespace crossgrain::inline oracle

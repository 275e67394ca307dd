#include "cases/stable_step.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "cases/time_step.hpp"
#include "oracle/impact.hpp"

namespace crossgrain::inline cases {

namespace {

/// dF/dδ of the elastic force at its deepest in an impact [N/m].
double tangentStiffness(const ContactLaw& law, const Impact& impact) {
  if (law.normal == NormalLaw::linear) return law.kn;
  const double deepest = deepestOverlap(law, impact);
  if (law.normal == NormalLaw::hertz)
    return 1.5 * law.kn * std::sqrt(impact.reducedRadius * deepest);
  return (2.0 * law.kn + 3.0 * law.kn3 * deepest) * deepest;
}

}  // namespace

std::optional<double> pairContactTime(const Case& setup) {
  if (setup.law.normal != NormalLaw::linear || setup.particles.file) return std::nullopt;
  try {
    return contactTime(setup.law, lightestReducedMass(setup));
  } catch (const std::invalid_argument&) {
    return std::nullopt;  // overdamped
  }
}

std::optional<PairStepLimit> pairStepLimit(const Case& setup, std::optional<double> lightest) {
  if (setup.kind == CaseKind::collision || !setup.law.soft()) return std::nullopt;
  const bool couette = setup.kind == CaseKind::couette;
  if (!couette && setup.law.stiffens()) return std::nullopt;  // at a speed that nobody knows
  const double mass = lightest ? *lightest : lightestReducedMass(setup);
  double stiffness = setup.law.kn;
  try {
    if (couette)
      stiffness =
          tangentStiffness(setup.law, {mass, setup.particles.smallRadius / 2.0,
                                       std::abs(setup.cell.omega) * setup.cell.innerRadius});
  } catch (const std::invalid_argument&) {  // a polynomial law that gives way so fast
    return std::nullopt;
  }
  if (!(stiffness > 0.0)) return std::nullopt;
  return PairStepLimit{2.0 * std::sqrt(mass / stiffness), stiffness, mass};
}

std::string whyUnstableStep(const Case& setup, double dt, const std::string& key,
                            std::optional<double> lightest) {
  const auto limit = pairStepLimit(setup, lightest);
  if (!limit || dt < limit->dt) return {};
  return fmt::format(
      "{} = {:g} s is beyond 2/ω = {:.3g} s of the stiffest, lightest contact (k = {:.4g} N/m, m₁₂ "
      "= {:.4g} kg): no soft law is stable there",
      key, dt, limit->dt, limit->stiffness, limit->reducedMass);
}

std::string whyRiskyStep(const Case& setup, double dt) {
  const auto limit = pairStepLimit(setup);
  if (!limit || dt < limit->dt / std::sqrt(6.0)) return {};
  return fmt::format(
      "the time step of {:.3g} s is beyond what a disk with six contacts bears, 2/(√6 ω) = {:.3g} "
      "s",
      dt, limit->dt / std::sqrt(6.0));
}

}  // namespace crossgrain::inline cases

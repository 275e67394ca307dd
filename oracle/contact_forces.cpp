#include "oracle/contact_forces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "oracle/cohesion.hpp"
#include "oracle/impact.hpp"

namespace crossgrain::inline oracle {

ContactForces::ContactForces(const ContactLaw& law, const CollidingPair& pair)
    : law_(law),
      pair_(pair),
      reach_(pair.radius[0] + pair.radius[1]),
      inverseMass_(1.0 / pair.mass[0] + 1.0 / pair.mass[1]),
      reducedRadius_(pair.reducedRadius()) {
  if (law.tangential == TangentialLaw::spring) law_.gt = 0.0;
  if (law.mu == 0.0) law_.tangential = TangentialLaw::none;
}

double ContactForces::elasticForce(double overlap) const {
  switch (law_.normal) {
    case NormalLaw::hertz:
      return law_.kn * std::sqrt(reducedRadius_ * std::max(overlap, 0.0)) * overlap;
    case NormalLaw::polynomial:
      return (law_.kn + law_.kn3 * overlap) * overlap * overlap;
    default:
      return law_.kn * overlap;
  }
}

/// f_el′ and f_el″.
Slope ContactForces::stiffness(double overlap) const {
  const double depth = std::max(overlap, 0.0);
  switch (law_.normal) {
    case NormalLaw::hertz: {
      const double root = std::sqrt(reducedRadius_ * depth);
      return {1.5 * law_.kn * root, depth > 0.0 ? 0.75 * law_.kn * root / depth : 0.0};
    }
    case NormalLaw::polynomial:
      return {(2.0 * law_.kn + 3.0 * law_.kn3 * depth) * depth,
              2.0 * law_.kn + 6.0 * law_.kn3 * depth};
    default:
      return {law_.kn, 0.0};
  }
}

Slope ContactForces::tangentialStiffness(double overlap) const {
  if (law_.normal != NormalLaw::hertz) return {law_.kt, 0.0};
  if (law_.cohesion == CohesionLaw::jkr) {  // k_t a, a = a_p y²
    const double unit = jkrUnit(law_, reducedRadius_), y = jkrRoot(overlap / unit);
    const double width = law_.kt * std::sqrt(unit * reducedRadius_);
    const double slope = std::max(4.0 * y * y * y - 4.0 / 3.0, 1e-12);  // of δ/unit by y
    return {width * y * y, 2.0 * width * y / (unit * slope)};
  }
  const double depth = std::max(overlap, 0.0);
  const double root = std::sqrt(reducedRadius_ * depth);
  return {law_.kt * root, depth > 0.0 ? 0.5 * law_.kt * root / depth : 0.0};
}

/// γ that multiplies the velocity [kg/s].
Slope ContactForces::damping(double constant, const Slope& stiffness) const {
  switch (law_.damper) {
    case Damper::viscoelastic:
      return {constant * stiffness.value, constant * stiffness.rate};
    case Damper::critical: {
      const double value = constant * std::sqrt(std::max(stiffness.value, 0.0) / inverseMass_);
      return {value, stiffness.value > 0.0 ? 0.5 * value * stiffness.rate / stiffness.value : 0.0};
    }
    default:
      return {constant, 0.0};
  }
}

double ContactForces::contactTime(double speed) const {
  return impactTime(law_, {pair_.reducedMass(), reducedRadius_, speed});
}

double ContactForces::stretchedShare() const {
  switch (law_.conventions.springUpdate) {
    case SpringUpdate::after:
      return 0.0;
    case SpringUpdate::midpoint:
      return 0.5;
    case SpringUpdate::before:
      break;
  }
  return 1.0;
}

double ContactForces::visibleLength() const {
  return 64.0 * std::numeric_limits<double>::epsilon() * reach_;
}

}  // namespace crossgrain::inline oracle

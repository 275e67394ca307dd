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

namespace {

using Extended = long double;

/// The law along the normal, with what the contact remembers from step to step.
class NormalContact {
 public:
  /// @param law  linear ones with constant dampers
  NormalContact(const ContactLaw& law, const DiscreteStart& start)
      : law_(law),
        pair_(start.pair),
        mass_(start.reducedMass),
        cutsTension_(law.conventions.tension == Tension::cut) {
    if (law.stiffens() || law.coheres()) radius_ = Extended(start.pair.reducedRadius());
  }

  /// On the gap [N]. @param compliance  dt/(2 m₁₂) of the implicit dashpot, else 0
  Extended force(Extended gap, Extended velocity, Extended compliance) {
    const Extended overlap = -gap;
    touches_ = overlap > (touches_ ? -bondRange(law_, radius_) : Extended(0));
    if (!touches_) {
      largest_ = rest_ = 0;
      return 0;
    }
    const Extended body = bodyForce(overlap, velocity > 0), gn = damping(overlap);
    const Extended whole = (body - gn * velocity) / (1 + gn * compliance);
    if (!cutsTension_) return whole;
    return std::max(whole, law_.coheres() ? std::min(body, Extended(0)) : Extended(0));
  }

 private:
  Extended elastic(Extended overlap) const { return elasticForce(law_, radius_, overlap); }
  /// γ_n [kg/s]
  Extended damping(Extended overlap) const {
    return dashpot(law_.damper, law_.gn, normalStiffness(law_, radius_, overlap), 1 / mass_).value;
  }
  /// @param parts  whether the bodies separate
  Extended bodyForce(Extended overlap, bool parts) {
    switch (law_.cohesion) {
      case CohesionLaw::none:
        break;
      case CohesionLaw::area:
        return elastic(overlap) - Extended(law_.kc) * cohesionArea(law_, pair_, overlap).value;
      case CohesionLaw::dmt:
        return elastic(overlap) - 2 * pi * Extended(law_.w) * radius_;
      case CohesionLaw::jkr: {
        const Extended y = jkrRoot(overlap / jkrUnit(law_, radius_)), cube = y * y * y;
        return Extended(1.5L) * pi * Extended(law_.w) * radius_ * (cube - 2) * cube;
      }
      case CohesionLaw::elastoPlastic:
        return law_.conventions.unloadingStiffness == UnloadingStiffness::lagged &&
                       law_.plasticDepth > 0.0
                   ? yieldingLate(overlap, parts)
                   : yielding(overlap);
    }
    return elastic(overlap);
  }
  /// min(k_n δ, k₂ (δ − δ₀)), where that is below −k_c δ this, with δ_max drawn back; beyond δ*
  /// k₂ (δ − δ₀).
  Extended yielding(Extended overlap) {
    largest_ = std::max(largest_, overlap);
    if (isBeyondPlasticLimit(law_, radius_, largest_)) largest_ = plasticLimit(law_, radius_);
    const Extended k2 = unloadingStiffness(law_, radius_, largest_), kn = law_.kn;
    const Extended unloading = k2 * overlap - (k2 - kn) * largest_,
                   pull = -Extended(law_.kc) * overlap;
    if (overlap > largest_) return unloading;
    if (unloading >= pull) return std::min(kn * overlap, unloading);
    largest_ = largestAtPull(law_, radius_, overlap);
    return pull;
  }

  /// @see UnloadingStiffness::lagged; the pull is left where the bodies approach again.
  Extended yieldingLate(Extended overlap, bool parts) {
    const Extended k2 = unloadingStiffness(law_, radius_, largest_), kn = law_.kn, kc = law_.kc;
    const auto remember = [&](Extended largest) {
      largest_ = largest;
      rest_ = std::min((1 - kn / k2) * largest, 2 * Extended(law_.plasticDepth) * radius_);
    };
    if (overlap > largest_) remember(overlap);
    const Extended line = k2 * (overlap - rest_);
    if (line >= kn * overlap && overlap < plasticLimit(law_, radius_)) return kn * overlap;
    if (line > -kc * overlap || !parts) return line;
    remember(overlap * (k2 + kc) / (k2 - kn));
    return -kc * overlap;
  }

  static constexpr Extended pi = std::numbers::pi_v<Extended>;
  const ContactLaw& law_;
  CollidingPair pair_;
  Extended mass_, radius_ = 0, largest_ = 0, rest_ = 0;  ///< δ_max, δ₀
  bool cutsTension_, touches_ = false;
};

}  // namespace

std::vector<DiscreteMotion> discreteImpact(const ContactLaw& law, const DiscreteStart& start,
                                           std::size_t steps) {
  if (!law.soft()) throw std::invalid_argument("a rigid law has no discrete oracle");
  const ContactLaw constant = withConstantDampers(law, start.reducedMass);
  NormalContact contact(constant, start);
  const bool euler = law.conventions.integrator == Integrator::semiImplicitEuler;
  const DampingVelocity damping = euler ? DampingVelocity::lagged : law.conventions.dampingVelocity;
  const Extended mass = start.reducedMass, dt = start.dt, half = dt / 2;

  Extended x = start.gap, a = contact.force(x, start.velocity, 0) / mass;
  Extended u = start.velocity - (euler ? Extended(0) : half * a);
  std::vector<DiscreteMotion> motion{{start.gap, start.velocity, start.velocity}};
  motion.reserve(steps + 1);
  for (std::size_t k = 0; k < steps; ++k) {
    u += a * dt;
    x += u * dt;
    const Extended seen = damping == DampingVelocity::predicted ? u + half * a : u;
    const bool implicit = damping == DampingVelocity::implicit;
    a = contact.force(x, seen, implicit ? half / mass : Extended(0)) / mass;
    motion.push_back({static_cast<double>(x), static_cast<double>(u),
                      static_cast<double>(euler ? u : u + half * a)});
  }
  return motion;
}

}  // namespace crossgrain::inline oracle

#include "oracle/discrete_impact.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "law/cohesion.hpp"
#include "oracle/impact.hpp"

namespace crossgrain::inline oracle {
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

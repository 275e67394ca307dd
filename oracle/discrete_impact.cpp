#include "oracle/discrete_impact.hpp"

#include <algorithm>
#include <stdexcept>

#include "oracle/impact.hpp"

namespace crossgrain::inline oracle {
namespace {

using Extended = long double;

/// The linear law along the normal.
struct NormalContact {
  Extended kn, gn;
  bool cutsTension;

  /// On the gap [N]. @param weight  what the implicit dashpot divides by, else 1
  Extended force(Extended gap, Extended velocity, Extended weight) const {
    if (!(gap < 0)) return 0;
    const Extended whole = (-kn * gap - gn * velocity) / weight;
    return cutsTension ? std::max(whole, Extended(0)) : whole;
  }
};

}  // namespace

std::vector<DiscreteMotion> discreteImpact(const ContactLaw& law, const DiscreteStart& start,
                                           std::size_t steps) {
  if (law.normal != NormalLaw::linear)
    throw std::invalid_argument("only the linear law has a discrete oracle");
  const ContactLaw constant = withConstantDampers(law, start.reducedMass);
  const NormalContact contact{constant.kn, constant.gn, law.conventions.tension == Tension::cut};
  const bool euler = law.conventions.integrator == Integrator::semiImplicitEuler;
  const DampingVelocity damping = euler ? DampingVelocity::lagged : law.conventions.dampingVelocity;
  const Extended mass = start.reducedMass, dt = start.dt, half = dt / 2;

  Extended x = start.gap, a = contact.force(x, start.velocity, 1) / mass;
  Extended u = start.velocity - (euler ? Extended(0) : half * a);
  std::vector<DiscreteMotion> motion{{start.gap, start.velocity, start.velocity}};
  motion.reserve(steps + 1);
  for (std::size_t k = 0; k < steps; ++k) {
    u += a * dt;
    x += u * dt;
    const Extended seen = damping == DampingVelocity::predicted ? u + half * a : u;
    const bool implicit = damping == DampingVelocity::implicit;
    a = contact.force(x, seen, implicit ? 1 + contact.gn * half / mass : 1) / mass;
    motion.push_back({static_cast<double>(x), static_cast<double>(u),
                      static_cast<double>(euler ? u : u + half * a)});
  }
  return motion;
}

}  // namespace crossgrain::inline oracle

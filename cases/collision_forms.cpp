#include <cmath>
#include <numbers>
#include <stdexcept>

#include "cases/collision_oracle.hpp"

/// Closed forms, with the normal frozen.
namespace crossgrain {

CollisionEnd rigidOutcome(double en, double et0, double mu, double inverseInertiaFactor,
                          double psi) {
  const double sliding = (1.0 + inverseInertiaFactor) * (1.0 + en) * mu;
  const double magnitude = std::max(-et0 * std::abs(psi), std::abs(psi) - sliding);
  return {en, std::copysign(1.0, psi) * magnitude};
}

double restitutionOfLinearLaw(const ContactLaw& law, double reducedMass) {
  const double eta = law.gn / (2.0 * reducedMass);
  const double omega2 = law.kn / reducedMass - eta * eta;
  if (!(omega2 > 0.0)) throw std::invalid_argument("the pair is overdamped: it never parts");
  const double omega = std::sqrt(omega2);
  const double end = law.conventions.tension == Tension::allow
                         ? std::numbers::pi
                         : std::numbers::pi - std::atan2(2.0 * eta * omega, omega2 - eta * eta);
  return std::exp(-eta / omega * end);
}

double slidingConstant(const ContactLaw& law, const CollidingPair& pair) {
  const double reducedMass = 1.0 / (1.0 / pair.mass[0] + 1.0 / pair.mass[1]);
  const double inverseInertiaFactor =
      reducedMass * (pair.radius[0] * pair.radius[0] / pair.inertia[0] +
                     pair.radius[1] * pair.radius[1] / pair.inertia[1]);
  double restitution = law.en;
  if (law.normal == NormalLaw::linear) {
    ContactLaw cut = law;
    cut.conventions.tension = Tension::cut;
    restitution = restitutionOfLinearLaw(cut, reducedMass);
  }
  return (1.0 + inverseInertiaFactor) * (1.0 + restitution) * law.mu;
}

}  // namespace crossgrain

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "oracle/collision_oracle.hpp"
#include "oracle/impact.hpp"

/// Closed forms, with the normal frozen.
namespace crossgrain::inline oracle {

CollisionEnd rigidOutcome(const ContactLaw& law, const CollidingPair& pair,
                          const CollisionStart& start) {
  const double sliding = pair.tangentialCompliance() * pair.reducedMass() * (1.0 + law.en) * law.mu;
  const double magnitude = std::max(-law.et0 * std::abs(start.psi), std::abs(start.psi) - sliding);
  const double psi = std::copysign(1.0, start.psi) * magnitude;
  const double impulse = (psi - start.psi) * start.vn / pair.tangentialCompliance();
  PairMotion after = motionBefore(pair, start);
  after.normal *= -law.en;
  after.tangential += impulse / pair.reducedMass();
  for (const int side : {0, 1})
    after.spin[side] -= pair.radius[side] * impulse / pair.inertia[side];
  return endOf(pair, start, after);
}

double restitutionOfLinearLaw(const ContactLaw& law, double reducedMass) {
  const double eta = withConstantDampers(law, reducedMass).gn / (2.0 * reducedMass);
  const double omega2 = law.kn / reducedMass - eta * eta;
  if (!(omega2 > 0.0)) throw std::invalid_argument("the pair is overdamped: it never parts");
  const double omega = std::sqrt(omega2);
  const double end = law.conventions.tension == Tension::allow
                         ? std::numbers::pi
                         : std::numbers::pi - std::atan2(2.0 * eta * omega, omega2 - eta * eta);
  return std::exp(-eta / omega * end);
}

std::optional<double> closedRestitution(const ContactLaw& law, double reducedMass) {
  if (!law.soft()) return law.en;
  if (law.normal == NormalLaw::linear) return restitutionOfLinearLaw(law, reducedMass);
  if (law.gn == 0.0) return 1.0;
  if (law.normal != NormalLaw::hertz || law.damper != Damper::critical) return std::nullopt;
  // δ^(5/4) in a time that runs as δ^(1/4) is a linear oscillator of ω₀ = 1 and η = this share of
  // critical damping; its force is zero where Hertz' is.
  ContactLaw oscillator;
  oscillator.kn = 1.0;
  oscillator.gn = 2.0 * law.gn / (2.0 * std::sqrt(5.0 / 6.0));
  oscillator.conventions.tension = law.conventions.tension;
  if (!(oscillator.gn < 2.0)) return std::nullopt;
  return restitutionOfLinearLaw(oscillator, 1.0);
}

std::optional<double> slidingConstant(const ContactLaw& law, const CollidingPair& pair) {
  if (!(law.mu > 0.0)) return std::nullopt;
  ContactLaw cut = law;
  cut.conventions.tension = Tension::cut;
  const auto restitution = closedRestitution(cut, pair.reducedMass());
  if (!restitution) return std::nullopt;
  return pair.tangentialCompliance() * pair.reducedMass() * (1.0 + *restitution) * law.mu;
}

}  // namespace crossgrain::inline oracle

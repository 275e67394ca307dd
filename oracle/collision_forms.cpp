#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "law/cohesion.hpp"
#include "oracle/collision_oracle.hpp"
#include "oracle/impact.hpp"

/// Closed forms, with the normal frozen.
namespace crossgrain::inline oracle {

namespace {

/// Ψ_f of Walton's law for Ψ_i ≥ 0.
double slipAfterRigid(const ContactLaw& law, const CollidingPair& pair, double psi) {
  const double sliding = pair.tangentialCompliance() * pair.reducedMass() * (1.0 + law.en) * law.mu;
  return std::max(-law.et0 * psi, psi - sliding);
}

}  // namespace

CollisionEnd rigidOutcome(const ContactLaw& law, const CollidingPair& pair,
                          const CollisionStart& start) {
  const double psi = std::copysign(1.0, start.psi) * slipAfterRigid(law, pair, std::abs(start.psi));
  const double impulse = (psi - start.psi) * start.vn / pair.tangentialCompliance();
  PairMotion after = motionBefore(pair, start);
  after.normal *= -law.en;
  after.tangential += impulse / pair.reducedMass();
  for (const int side : {0, 1})
    after.spin[side] -= pair.radius[side] * impulse / pair.inertia[side];
  return endOf(pair, start, after);
}

CollisionEnd rigidOutcomeInSpace(const ContactLaw& law, const CollidingPair& pair,
                                 const CollisionStart& start) {
  SpaceMotion after = spaceMotionBefore(pair, start);
  const Vec3 turning = pair.radius[0] * after.spin[0] + pair.radius[1] * after.spin[1];
  const Vec3 aside(0.0, after.velocity.y(), after.velocity.z());
  const Vec3 slip = aside - turning.cross(after.normal);
  const double speed = slip.norm();
  Vec3 impulse = Vec3::Zero();
  if (speed > 0.0)
    impulse = (start.vn * slipAfterRigid(law, pair, speed / start.vn) - speed) /
              pair.tangentialCompliance() * (slip / speed);
  after.velocity.x() *= -law.en;
  after.velocity += impulse / pair.reducedMass();
  for (const int side : {0, 1})
    after.spin[side] -= pair.radius[side] / pair.inertia[side] * after.normal.cross(impulse);
  return spaceEndOf(pair, start, after);
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
  if (law.coheres()) {
    if (law.gn > 0.0 || law.cohesion == CohesionLaw::jkr || law.plasticDepth > 0.0)
      return std::nullopt;
    if (law.cohesion != CohesionLaw::elastoPlastic) return 1.0;
    // With one k₂ it is the same at all speeds, for all bodies.
    return elastoPlasticRestitution(law, {{1.0, 1.0}, {1.0, 1.0}, {1.0, 1.0}}, 1.0);
  }
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

double elastoPlasticRestitution(const ContactLaw& law, const CollidingPair& pair, double speed) {
  const double radius = pair.reducedRadius();
  const double reached = speed * std::sqrt(pair.reducedMass() / law.kn);  // with k_n alone
  const bool beyond = isBeyondPlasticLimit(law, radius, reached);
  const double largest = beyond ? plasticLimit(law, radius) : reached;
  const double k2 = unloadingStiffness(law, radius, largest);
  const double least = (k2 - law.kn) / (k2 + law.kc);  // δ_min/δ_m
  const double square = law.kn / k2 - law.kc * least * (1.0 - law.kn / k2) / law.kn;
  if (!beyond) return std::sqrt(std::max(square, 0.0));
  const double share = largest / reached;  // squared, of the energy that is spent up to δ*
  return std::sqrt(std::max(1.0 - share * share * (1.0 - square), 0.0));
}

double jkrLossFactor(JkrEnd end) {
  const double atTouch = 8.0 / 15.0 * std::cbrt(4.0 / 3.0);
  return end == JkrEnd::largestPull ? atTouch - 4.0 / 15.0
                                    : atTouch + 4.0 / 45.0 * std::cbrt(1.0 / 3.0);
}

std::optional<double> stickingSpeed(const ContactLaw& law, const CollidingPair& pair) {
  if (law.cohesion == CohesionLaw::elastoPlastic || law.gn > 0.0) return std::nullopt;
  if (law.cohesion != CohesionLaw::jkr) return 0.0;
  const double radius = pair.reducedRadius();
  const double loss =
      jkrLossFactor(law.conventions.jkrEnd) * pullOff(law, radius) * jkrUnit(law, radius);
  return std::sqrt(2.0 * loss / pair.reducedMass());
}

std::optional<double> slidingConstant(const ContactLaw& law, const CollidingPair& pair) {
  if (!(law.mu > 0.0) || law.rolls() || law.coheres()) return std::nullopt;
  ContactLaw cut = law;
  cut.conventions.tension = Tension::cut;
  const auto restitution = closedRestitution(cut, pair.reducedMass());
  if (!restitution) return std::nullopt;
  return pair.tangentialCompliance() * pair.reducedMass() * (1.0 + *restitution) * law.mu;
}

}  // namespace crossgrain::inline oracle

#include "engines/box2d/restitution.hpp"

#include <numbers>

namespace box2d_granular {
namespace {

double overdampedCutRestitution(double eta, double rate) {
  if (rate == 0.0) return std::exp(-2.0);
  return std::exp(-eta / rate * std::log((eta + rate) / (eta - rate)));
}

}  // namespace

double normalRestitution(const ContactLaw& law, double reducedMass) {
  constexpr double pi = std::numbers::pi;
  const bool cut = law.conventions.tension == Tension::cut;
  const double eta = law.gn / (2.0 * reducedMass);
  const double omega2 = law.kn / reducedMass - eta * eta;
  if (omega2 <= 0.0) return cut ? overdampedCutRestitution(eta, std::sqrt(-omega2)) : 0.0;
  const double omega = std::sqrt(omega2);
  const double phase = cut ? pi - std::atan2(2.0 * eta * omega, omega2 - eta * eta) : pi;
  return std::exp(-eta / omega * phase);
}

Rebound collide(const ContactLaw& law, const PairInertia& pair, double psiI) {
  return withPartsOf(law, [&]<bool Damped, TangentialLaw T>() -> Rebound {
    // A first-order scheme errs by about a thousandth of a per cent at this many steps to a
    // contact; an overdamped contact, which never parts, is given up after ten of them.
    constexpr int stepsPerContact = 40000;
    const double dt = std::numbers::pi / std::sqrt(law.kn * pair.normal) / stepsPerContact;
    double overlap = 0.0, spring = 0.0;
    double vn = -1.0, vt = psiI;
    for (int step = 0; step < 10 * stepsPerContact; ++step) {
      overlap -= vn * dt;
      if (overlap <= 0.0) break;
      const ContactForce force = contactForce<Damped, T>(law, {overlap, vn, vt, dt}, spring);
      vn += force.normal * pair.normal * dt;
      vt += force.tangential * pair.tangential * dt;
    }
    return {vn, vt};
  });
}

Restitution rigidEquivalent(const ContactLaw& law, const PairInertia& pair) {
  constexpr double psi = 0.5;
  return {normalRestitution(law, 1.0 / pair.normal),
          std::clamp(-collide(law, pair, psi).psiF / psi, 0.0, 1.0)};
}

}  // namespace box2d_granular

#include "oracle/calibration.hpp"

#include <fmt/format.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_roots.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <stdexcept>

#include "law/cohesion.hpp"
#include "oracle/impact.hpp"

namespace crossgrain::inline oracle {
namespace {

using std::numbers::pi;

/// η and ω of an underdamped contact along its normal.
struct NormalOscillator {
  double eta, omega;
  double compressionPhase() const { return 2.0 * std::atan2(omega, eta); }  // ω t_s
};

NormalOscillator normalOscillator(const ContactLaw& law, double reducedMass) {
  const double omega = pi / contactTime(law, reducedMass);
  return {law.gn / (2.0 * reducedMass), omega};
}

/// ω t_c = 2ψ of a contact without tension. cot ψ = η/ω makes e_n = exp(−η t_c) the equation
/// 2ψ cot ψ = −ln e_n, whose left side falls from 2 (critical damping) to 0 (none, ψ = π/2).
double phaseWithoutTension(double en) {
  double logarithm = std::log(en);
  gsl_function excess{[](double psi, void* logE) {
                        return 2.0 * psi / std::tan(psi) + *static_cast<double*>(logE);
                      },
                      &logarithm};
  constexpr double nearlyCritical = 1e-6, beyondUndamped = 1.6;
  if (!(GSL_FN_EVAL(&excess, nearlyCritical) > 0.0))
    throw std::invalid_argument(
        fmt::format("e_n = {}: where tension is cut it must be > exp(-2) = 0.1353, which takes "
                    "critical damping; overdamped contacts are not supported",
                    en));
  const std::unique_ptr<gsl_root_fsolver, decltype(&gsl_root_fsolver_free)> solver(
      gsl_root_fsolver_alloc(gsl_root_fsolver_brent), &gsl_root_fsolver_free);
  gsl_root_fsolver_set(solver.get(), &excess, nearlyCritical, beyondUndamped);
  constexpr int mostIterations = 200;
  for (int i = 0; i < mostIterations; ++i) {
    gsl_root_fsolver_iterate(solver.get());
    if (gsl_root_test_interval(gsl_root_fsolver_x_lower(solver.get()),
                               gsl_root_fsolver_x_upper(solver.get()), 0.0, 1e-14) == GSL_SUCCESS)
      return 2.0 * gsl_root_fsolver_root(solver.get());
  }
  throw std::runtime_error(fmt::format("e_n = {}: the root search did not come to an end", en));
}

/// φ = ω t_c. @throws std::invalid_argument for an e_n that no such law has
double contactPhase(const ContactLaw& law, double en) {
  if (!(en > 0.0 && en <= 1.0))
    throw std::invalid_argument(fmt::format("e_n = {}: must be > 0 and <= 1", en));
  return law.conventions.tension == Tension::cut ? phaseWithoutTension(en) : pi;
}

/// Friction without a spring counts as a spring of 0; Coulomb's law without slip stops v_t at once.
double restitutionWithoutSlip(const ContactLaw& law, const ReducedPair& pair, double time) {
  if (law.tangential == TangentialLaw::coulomb) return 0.0;
  return stickingRestitution(pair.K * law.gt / (2.0 * pair.mass),
                             std::sqrt(pair.K * law.kt / pair.mass), time);
}

}  // namespace

ReducedPair reduced(const CollidingPair& pair) {
  const auto turning = [&](int k) { return pair.radius[k] * pair.radius[k] / pair.inertia[k]; };
  const double mass = 1.0 / (1.0 / pair.mass[0] + 1.0 / pair.mass[1]);
  return {mass, 1.0 + mass * (turning(0) + turning(1))};
}

void calibrateNormal(ContactLaw& law, double en, double contactTime, double reducedMass) {
  const double omega = contactPhase(law, en) / contactTime;
  const double eta = std::log(1.0 / en) / contactTime;
  law.kn = reducedMass * (omega * omega + eta * eta);
  law.gn = 2.0 * reducedMass * eta;
}

void calibrateDamping(ContactLaw& law, double en, double kn, double reducedMass) {
  const double decay = std::log(1.0 / en);
  const double time = std::hypot(contactPhase(law, en), decay) * std::sqrt(reducedMass / kn);
  law.kn = kn;
  law.gn = 2.0 * reducedMass * decay / time;
}

void calibrateTangential(ContactLaw& law, double et0, const ReducedPair& pair) {
  const NormalOscillator normal = normalOscillator(law, pair.mass);
  const double time = normal.compressionPhase() / normal.omega;
  double phase = pi, eta = 0.0;
  if (law.tangential == TangentialLaw::spring) {
    if (!(et0 > -1.0 && et0 <= 1.0))
      throw std::invalid_argument(fmt::format("e_t0 = {}: a spring has -1 < e_t0 <= 1", et0));
    phase = std::acos(-et0);
  } else if (law.tangential == TangentialLaw::springDashpot) {
    if (!(et0 > 0.0 && et0 <= 1.0))
      throw std::invalid_argument(fmt::format(
          "e_t0 = {}: a spring with dashpot has 0 < e_t0 <= 1 here, a spring alone -1 < e_t0 <= 1",
          et0));
    eta = std::log(1.0 / et0) / time;
  } else {
    throw std::invalid_argument("only spring and spring_dashpot have an e_t0 to choose");
  }
  const double omega = phase / time;
  law.kt = pair.mass / pair.K * (omega * omega + eta * eta);
  law.gt = 2.0 * pair.mass / pair.K * eta;
}

HertzMaterial hertzMaterial(const ContactLaw& law) {
  const double ratio = law.kt / law.kn;
  const double poisson =
      law.kt > 0.0 ? std::clamp((3.0 - 2.0 * ratio) / (3.0 - ratio), 0.0, 0.5) : 0.0;
  return {1.5 * law.kn * (1.0 - poisson * poisson), poisson};
}

TangentialLaw tangentialLawOf(const ContactLaw& law) {
  if (law.kt > 0.0) return law.gt > 0.0 ? TangentialLaw::springDashpot : TangentialLaw::spring;
  if (law.gt > 0.0) return TangentialLaw::viscous;
  return law.mu > 0.0 ? TangentialLaw::coulomb : TangentialLaw::none;
}

double stickingRestitution(double etaT, double undamped, double t) {
  const double square = undamped * undamped - etaT * etaT;
  const double decay = etaT * t;
  // Not zero, so that sin(phase)/phase is its limit at critical damping.
  const double phase = std::max(std::sqrt(std::abs(square)) * t, 1e-20);
  if (square > 0.0) return std::exp(-decay) * (decay / phase * std::sin(phase) - std::cos(phase));
  // The same with cosh and sinh, written so that nothing overflows.
  const double fast = decay + phase;
  const double slow = undamped * t * (undamped * t) / fast;
  const double sinhOverPhase = -std::exp(-slow) * std::expm1(-2.0 * phase) / (2.0 * phase);
  return decay * sinhOverPhase - 0.5 * (std::exp(-slow) + std::exp(-fast));
}

ImpliedImpact impliedImpact(const ContactLaw& given, const CollidingPair& pair) {
  const ReducedPair reducedPair = reduced(pair);
  const double mass = reducedPair.mass;
  const ContactLaw law = withConstantDampers(given, mass);
  const NormalOscillator normal = normalOscillator(law, mass);
  const double compression = normal.compressionPhase() / normal.omega;
  const bool tension = law.conventions.tension == Tension::allow;
  const auto restitution = [&](Tension choice) {
    ContactLaw chosen = law;
    chosen.conventions.tension = choice;
    return restitutionOfLinearLaw(chosen, mass);
  };

  ImpliedImpact implied{};
  implied.enAllowed = restitution(Tension::allow);
  implied.enCut = restitution(Tension::cut);
  implied.halfPeriod = pi / normal.omega;
  implied.contactTime = tension ? implied.halfPeriod : compression;
  implied.omega = normal.omega;
  implied.dampingRatio = law.gn / (2.0 * std::sqrt(law.kn * mass));
  // δ = (v/ω) e^{−ηt} sin ωt is largest at ωt = atan2(ω, η), half way to f_n = 0.
  implied.overlapPerSpeed = std::sqrt(implied.enCut * mass / law.kn);

  const bool frictionUnderTension =
      tension && law.gn > 0.0 && law.conventions.coulombBound != CoulombBound::compression;
  if (law.tangential == TangentialLaw::none || frictionUnderTension) return implied;
  implied.et0 = restitutionWithoutSlip(law, reducedPair, compression);
  if (law.kt > 0.0) {
    const double etaT = reducedPair.K * law.gt / (2.0 * mass);
    const double square = reducedPair.K * law.kt / mass - etaT * etaT;
    if (square > 0.0) implied.omegaT = std::sqrt(square);
    implied.dampingRatioT = etaT / std::sqrt(reducedPair.K * law.kt / mass);
  }
  // At first touch f_n = γ_n v_n holds a trial force of γ_t v_t. A spring that carries the whole
  // bound leaves the dashpot on top of it, so what has slipped goes on until v_t changes sign.
  if (law.mu > 0.0 && law.tangential == TangentialLaw::springDashpot && law.gt > 0.0 &&
      law.conventions.springReset == SpringReset::total)
    implied.firstTouchSticksToPsi = law.mu * law.gn / law.gt;
  if (law.mu > 0.0) {
    implied.slidingConstant = slidingConstant(law, pair);
    if (*implied.et0 > -1.0)
      implied.stickingEndsAtPsi = *implied.slidingConstant / (1.0 + *implied.et0);
  }
  return implied;
}

double rollingInertia(const CollidingPair& pair) {
  if (pair.plane) return inertiaAboutContact(pair, 0);
  return 1.0 / (1.0 / pair.inertia[0] + 1.0 / pair.inertia[1]);
}

void calibrateRolling(ContactLaw& law, const CollidingPair& pair, double frequency, double decay) {
  const double inertia = rollingInertia(pair), omega = 2.0 * std::numbers::pi * frequency;
  const double stiffness = inertia * (omega * omega + decay * decay);
  law.kr = stiffness / rollingSquare(law, pair);
  law.gr = 2.0 * inertia * decay / rollingDamperUnit(law, pair, stiffness);
}

ImpliedRolling impliedRolling(const ContactLaw& law, const CollidingPair& pair) {
  const double inertia = rollingInertia(pair), stiffness = law.kr * rollingSquare(law, pair);
  const double decay = law.gr * rollingDamperUnit(law, pair, stiffness) / (2.0 * inertia);
  const double square = stiffness / inertia - decay * decay;
  if (!(square > 0.0)) throw std::invalid_argument("the rolling spring does not oscillate");
  return {std::sqrt(square) / (2.0 * std::numbers::pi), decay};
}

double rollingCoefficientOf(const ContactLaw& law, double angle) {
  return std::tan(angle) / rollingLength(law, diskOnWall(1.0, 1.0, 1.0));
}

double restAngle(const ContactLaw& law) {
  return std::atan(law.muR * rollingLength(law, diskOnWall(1.0, 1.0, 1.0)));
}

double workOfAdhesion(const ContactLaw& law, double force, double reducedRadius) {
  ContactLaw unit = law;
  unit.w = 1.0;
  return force / pullOff(unit, reducedRadius);
}

}  // namespace crossgrain::inline oracle

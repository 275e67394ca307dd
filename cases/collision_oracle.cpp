#include "cases/collision_oracle.hpp"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>

#include <cstring>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <string>

#include "cases/two_body_problem.hpp"

namespace crossgrain {

int TwoBodyProblem::rightHandSide(double, const double y[], double dydt[], void* self) {
  State s;
  std::memcpy(&s, y, sizeof s);
  const State rate = static_cast<const TwoBodyProblem*>(self)->derivative(s);
  std::memcpy(dydt, &rate, sizeof rate);
  return GSL_SUCCESS;
}

CollisionEnd TwoBodyProblem::solve(const CollisionStart& start) {
  const double omega2 =
      law_.kn * inverseMass_ - 0.25 * law_.gn * law_.gn * inverseMass_ * inverseMass_;
  if (!(omega2 > 0.0))
    throw std::invalid_argument("the pair is overdamped: it never parts by itself");
  const double contactTime = std::numbers::pi / std::sqrt(omega2);

  gsl_odeiv2_system system{&rightHandSide, nullptr, dimension, this};
  const std::unique_ptr<gsl_odeiv2_step, decltype(&gsl_odeiv2_step_free)> stepper(
      gsl_odeiv2_step_alloc(gsl_odeiv2_step_rk8pd, dimension), &gsl_odeiv2_step_free);

  const PairMotion touch = motionBefore(pair_, start);
  State now{reach_, 0.0, touch.normal, touch.tangential, touch.spin[0], touch.spin[1], 0.0,
            0.0,    0.0, 0.0};
  stillness_ = 1e-13 * start.vn * (1.0 + std::abs(start.psi));
  enterPhase(now);

  // A fixed step of t_c/400 leaves rk8pd's own error far below rounding; events cut it short.
  const auto stepFrom = [&](const State& from, double h) {
    State to = from;
    std::array<double, dimension> error{};
    gsl_odeiv2_step_reset(stepper.get());
    gsl_odeiv2_step_apply(stepper.get(), 0.0, h, reinterpret_cast<double*>(&to), error.data(),
                          nullptr, nullptr, &system);
    return to;
  };
  /// When within h a guard that is > 0 at first no longer is.
  const auto timeOf = [&](const auto& guard, const State& from, double h) {
    double before = 0.0, after = h;
    while (after - before > 1e-16 * contactTime && after - before > 1e-15 * after) {
      const double middle = 0.5 * (before + after);
      (guard(stepFrom(from, middle)) > 0.0 ? before : after) = middle;
    }
    return after;
  };
  const auto phaseLasts = [this](const State& s) { return firstGuard(s); };
  const auto approach = [this](const State& s) { return -kinematics(s).normalVelocity; };

  const double fullStep = contactTime / 400.0;
  constexpr int mostSteps = 20000;
  double duration = 0.0, maxOverlap = 0.0;
  for (int step = 0; step < mostSteps; ++step) {
    double h = fullStep;
    State next = stepFrom(now, h);
    const bool event = !(phaseLasts(next) > 0.0);
    if (event) {
      h = timeOf(phaseLasts, now, h);
      next = stepFrom(now, h);
    }
    if (approach(now) > 0.0 && !(approach(next) > 0.0))
      maxOverlap = kinematics(stepFrom(now, timeOf(approach, now, h))).overlap;
    duration += h;
    now = next;
    if (!event) continue;
    const Kinematics k = kinematics(now);
    if (k.overlap <= 1e-14 * reach_ && k.normalVelocity > 0.0) {
      CollisionEnd end = endAt(now, start);
      end.duration = duration;
      end.maxOverlap = maxOverlap;
      return end;
    }
    enterPhase(now);
  }
  throw std::runtime_error("the collision oracle did not come to an end");
}

namespace {

/// Some conventions make the force jump back and forth between the steps of any engine: sticking
/// with the dashpot on top of a spring at its bound, slipping without it. What they converge to
/// depends on the engine, so there is nothing to hold it against.
void requireContinuousLimit(const ContactLaw& law) {
  const LawConventions& how = law.conventions;
  const bool tension = law.gn > 0.0 && how.tension == Tension::allow;
  const bool spring =
      law.tangential == TangentialLaw::spring || law.tangential == TangentialLaw::springDashpot;
  const bool dashpot = law.tangential == TangentialLaw::springDashpot && law.gt > 0.0;
  const char* jumps = nullptr;
  if (tension && law.tangential != TangentialLaw::none) {
    if (how.coulombBound == CoulombBound::signedForce) jumps = "coulomb_bound = \"signed\"";
    if (how.coulombBound == CoulombBound::magnitude && spring &&
        how.springUpdate == SpringUpdate::after)
      jumps = "coulomb_bound = \"magnitude\" with spring_update = \"after\"";
  }
  if (dashpot && how.dashpot == Dashpot::outside) jumps = "dashpot = \"outside\"";
  if (dashpot && how.springReset == SpringReset::springOnly &&
      how.springUpdate == SpringUpdate::after)
    jumps = "spring_reset = \"spring_only\" with spring_update = \"after\"";
  if (jumps)
    throw std::invalid_argument(std::string(jumps) +
                                " has no limit of small time steps to score against");
}

}  // namespace

CollisionEnd oracleOutcome(const ContactLaw& law, const CollidingPair& pair,
                           const CollisionStart& start) {
  if (law.normal == NormalLaw::linear) {
    requireContinuousLimit(law);
    return TwoBodyProblem(law, pair).solve(start);
  }
  return rigidOutcome(law, pair, start);
}

}  // namespace crossgrain

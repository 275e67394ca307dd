#include "cases/collision_oracle.hpp"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <string>

namespace crossgrain {
namespace {

/// Relative position and velocity of i against j, both spins, tangential spring.
struct State {
  double x, y, vx, vy, spinI, spinJ, spring;
};
constexpr std::size_t dimension = 7;
static_assert(sizeof(State) == dimension * sizeof(double));

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

/// Between two events the right-hand side is smooth; a phase says which branch of the law holds.
struct Phase {
  enum class Tangential {
    none,    ///< no tangential force
    damped,  ///< f_t = −γ_t v_t
    stick,   ///< f_t = −k_t ξ − γ_t v_t
    slip,    ///< f_t = bound · side
    hold     ///< Coulomb's law at v_t = 0: the force that keeps it there
  } tangential = Tangential::none;
  double side = 0.0;        ///< sign of f_t while it slips
  bool compressive = true;  ///< k_n δ − γ_n v_n > 0
};

struct Kinematics {
  double distance, nx, ny, overlap;
  double normalVelocity, tangentialVelocity;
  double turning;  ///< rate at which the normal turns [rad/s]
  double leverI, leverJ;
};

double sign(double value) {
  return (value > 0.0) - (value < 0.0);
}

class TwoBodyProblem {
 public:
  TwoBodyProblem(const ContactLaw& law, const CollidingPair& pair);
  CollisionEnd solve(const CollisionStart& start);

 private:
  // The law
  Kinematics kinematics(const State& s) const;
  double trialNormal(const Kinematics& k) const {
    return law_.kn * k.overlap - law_.gn * k.normalVelocity;
  }
  /// The share of the overlap that a disk's lever arm is short of its radius; `other` is its
  /// partner.
  double leverShare(int other) const {
    switch (law_.conventions.leverArm) {
      case LeverArm::radius:
        return 0.0;
      case LeverArm::contactPoint:
        return pair_.radius[other] / reach_;
      case LeverArm::overlapMiddle:
        break;
    }
    return 0.5;
  }
  double normalForce(const Kinematics& k) const;
  double bound(double normal) const;
  double testedForce(const Kinematics& k, double spring) const;
  double tangentialForce(const State& s, const Kinematics& k) const;
  State derivative(const State& s) const;

  // Events
  double compliance(const Kinematics& k) const;
  double holdingForce(const State& s, const Kinematics& k) const;
  double boundRate(const State& s, const Kinematics& k) const;
  double slippedSpring(const Kinematics& k) const;
  double slipGuard(const State& s, const Kinematics& k) const;
  double tangentialGuard(const State& s) const;
  double firstGuard(const State& s) const;
  void choosePhase(State& s);
  void chooseSpringPhase(State& s, const Kinematics& k);

  static int rightHandSide(double t, const double y[], double dydt[], void* self);

  ContactLaw law_;
  CollidingPair pair_;
  double reach_, inverseMass_;
  Phase phase_;
};

TwoBodyProblem::TwoBodyProblem(const ContactLaw& law, const CollidingPair& pair)
    : law_(law),
      pair_(pair),
      reach_(pair.radius[0] + pair.radius[1]),
      inverseMass_(1.0 / pair.mass[0] + 1.0 / pair.mass[1]) {
  if (law.tangential == TangentialLaw::spring) law_.gt = 0.0;
  if (law.mu == 0.0) law_.tangential = TangentialLaw::none;
}

Kinematics TwoBodyProblem::kinematics(const State& s) const {
  Kinematics k{};
  k.distance = std::hypot(s.x, s.y);
  k.nx = s.x / k.distance;
  k.ny = s.y / k.distance;
  k.overlap = reach_ - k.distance;
  k.leverI = pair_.radius[0];
  k.leverJ = pair_.radius[1];
  k.leverI -= k.overlap * leverShare(1);
  k.leverJ -= k.overlap * leverShare(0);
  k.normalVelocity = s.vx * k.nx + s.vy * k.ny;
  const double sideways = -s.vx * k.ny + s.vy * k.nx;
  k.turning = sideways / k.distance;
  k.tangentialVelocity = sideways - k.leverI * s.spinI - k.leverJ * s.spinJ;
  return k;
}

double TwoBodyProblem::normalForce(const Kinematics& k) const {
  const bool cut = law_.conventions.tension == Tension::cut;
  return cut && !phase_.compressive ? 0.0 : trialNormal(k);
}

/// Linear in f_n within a phase, so it also maps df_n/dt to the bound's rate.
double TwoBodyProblem::bound(double normal) const {
  if (phase_.compressive) return law_.mu * normal;
  switch (law_.conventions.coulombBound) {
    case CoulombBound::compression:
      return 0.0;
    case CoulombBound::magnitude:
      return -law_.mu * normal;
    case CoulombBound::signedForce:
      break;
  }
  return law_.mu * normal;
}

/// What is held against the bound.
double TwoBodyProblem::testedForce(const Kinematics& k, double spring) const {
  const bool outside = law_.conventions.dashpot == Dashpot::outside;
  return -law_.kt * spring - (outside ? 0.0 : law_.gt * k.tangentialVelocity);
}

double TwoBodyProblem::tangentialForce(const State& s, const Kinematics& k) const {
  switch (phase_.tangential) {
    case Phase::Tangential::none:
      return 0.0;
    case Phase::Tangential::damped:
      return -law_.gt * k.tangentialVelocity;
    case Phase::Tangential::stick:
      return -law_.kt * s.spring - law_.gt * k.tangentialVelocity;
    case Phase::Tangential::slip:
      return bound(normalForce(k)) * phase_.side;
    case Phase::Tangential::hold:
      break;
  }
  return holdingForce(s, k);
}

State TwoBodyProblem::derivative(const State& s) const {
  const Kinematics k = kinematics(s);
  const double normal = normalForce(k);
  const double tangential = tangentialForce(s, k);
  const bool stretches = phase_.tangential == Phase::Tangential::stick;
  return {s.vx,
          s.vy,
          (normal * k.nx - tangential * k.ny) * inverseMass_,
          (normal * k.ny + tangential * k.nx) * inverseMass_,
          -k.leverI * tangential / pair_.inertia[0],
          -k.leverJ * tangential / pair_.inertia[1],
          stretches ? k.tangentialVelocity : 0.0};
}

/// d v_t/dt per f_t [1/kg].
double TwoBodyProblem::compliance(const Kinematics& k) const {
  return inverseMass_ + k.leverI * k.leverI / pair_.inertia[0] +
         k.leverJ * k.leverJ / pair_.inertia[1];
}

/// The f_t that makes dv_t/dt = 0. Without f_t, dv_t/dt = −θ' v_n − l_i' ω_i − l_j' ω_j, where θ'
/// is the rate at which the normal turns and l' = leverShare · v_n.
double TwoBodyProblem::holdingForce(const State& s, const Kinematics& k) const {
  const double drift = -k.turning * k.normalVelocity -
                       k.normalVelocity * (leverShare(1) * s.spinI + leverShare(0) * s.spinJ);
  return -drift / compliance(k);
}

/// d bound/dt, from df_n/dt = −k_n v_n − γ_n dv_n/dt and dv_n/dt = a·n + θ'² |x|.
double TwoBodyProblem::boundRate(const State& s, const Kinematics& k) const {
  const State rate = derivative(s);
  const double sideways = k.turning * k.distance;
  const double acceleration = rate.vx * k.nx + rate.vy * k.ny + k.turning * sideways;
  return bound(-law_.kn * k.normalVelocity - law_.gn * acceleration);
}

/// ξ that the law leaves behind while it slips.
double TwoBodyProblem::slippedSpring(const Kinematics& k) const {
  const double force = bound(normalForce(k)) * phase_.side;
  const bool springOnly = law_.conventions.springReset == SpringReset::springOnly;
  return -(springOnly ? force + law_.gt * k.tangentialVelocity : force) / law_.kt;
}

/// > 0 as long as the step after a slipping one slips again, in the limit of small steps: the force
/// tested with the spring just reset exceeds the bound at once, or, where it equals the bound,
/// grows faster than the bound. A law that stretches its spring only after a sticking step
/// (SpringUpdate::after) does not see v_t in the step after a slip: it slips on while the bound
/// falls, also against a v_t that would relax the spring, and where the bound rises it sticks and
/// slips in turn, one stretch for two steps of the bound.
double TwoBodyProblem::slipGuard(const State& s, const Kinematics& k) const {
  const bool outside = law_.conventions.dashpot == Dashpot::outside;
  const bool springOnly = law_.conventions.springReset == SpringReset::springOnly;
  const double damping = law_.gt * k.tangentialVelocity * phase_.side;
  if (law_.gt > 0.0 && outside == springOnly) return outside ? damping : -damping;

  double testedRate = -law_.kt * k.tangentialVelocity * phase_.side;
  if (law_.conventions.springUpdate == SpringUpdate::after)
    testedRate = std::max(0.5 * testedRate, 0.0);
  if (!outside) {
    const double sticking = bound(normalForce(k)) * phase_.side;
    testedRate -= law_.gt * compliance(k) * (sticking - holdingForce(s, k)) * phase_.side;
  }
  return testedRate - boundRate(s, k);
}

double TwoBodyProblem::tangentialGuard(const State& s) const {
  const Kinematics k = kinematics(s);
  const double limit = bound(normalForce(k));
  switch (phase_.tangential) {
    case Phase::Tangential::none:
      return 1.0;
    case Phase::Tangential::damped:
      return limit - law_.gt * std::abs(k.tangentialVelocity);
    case Phase::Tangential::stick:
      return limit - std::abs(testedForce(k, s.spring));
    case Phase::Tangential::hold:
      return limit - std::abs(holdingForce(s, k));
    case Phase::Tangential::slip:
      break;
  }
  const double opposing = -phase_.side * k.tangentialVelocity;
  if (law_.tangential == TangentialLaw::coulomb || limit < 0.0) return opposing;
  if (law_.tangential == TangentialLaw::viscous) return law_.gt * opposing - limit;
  return slipGuard(s, k);
}

/// The phase lasts while this is > 0.
double TwoBodyProblem::firstGuard(const State& s) const {
  const Kinematics k = kinematics(s);
  double guard = std::min(k.overlap, tangentialGuard(s));
  if (law_.gn > 0.0) guard = std::min(guard, phase_.compressive ? trialNormal(k) : -trialNormal(k));
  return guard;
}

/// The phase that holds right after `s`, an event or the start; resets the spring where the law
/// does.
void TwoBodyProblem::choosePhase(State& s) {
  const Kinematics k = kinematics(s);
  phase_.compressive = law_.gn == 0.0 || trialNormal(k) > 0.0;
  const bool tension = !phase_.compressive;
  const bool noBound = tension && (law_.conventions.tension == Tension::cut ||
                                   law_.conventions.coulombBound == CoulombBound::compression);
  if (law_.tangential == TangentialLaw::none || noBound) {
    phase_.tangential = Phase::Tangential::none;
    return;
  }

  const double slip = k.tangentialVelocity;
  const double limit = bound(normalForce(k));
  const bool still =
      std::abs(slip) < 1e-13 * (std::abs(k.normalVelocity) + k.leverI * std::abs(s.spinI));
  if (law_.tangential == TangentialLaw::coulomb && still) {
    const double hold = holdingForce(s, k);
    const bool holds = std::abs(hold) <= limit;
    phase_.tangential = holds ? Phase::Tangential::hold : Phase::Tangential::slip;
    phase_.side = sign(hold);
  } else if (law_.tangential == TangentialLaw::viscous && law_.gt * std::abs(slip) <= limit) {
    phase_.tangential = Phase::Tangential::damped;
  } else if (law_.tangential == TangentialLaw::coulomb ||
             law_.tangential == TangentialLaw::viscous || limit < 0.0) {
    phase_.tangential = Phase::Tangential::slip;
    phase_.side = -sign(slip);
  } else {
    chooseSpringPhase(s, k);
  }
}

void TwoBodyProblem::chooseSpringPhase(State& s, const Kinematics& k) {
  const double limit = bound(normalForce(k));
  if (phase_.tangential == Phase::Tangential::slip) s.spring = slippedSpring(k);
  phase_.tangential = Phase::Tangential::stick;
  const double tested = testedForce(k, s.spring);
  if (std::abs(tested) < limit) return;
  phase_.tangential = Phase::Tangential::slip;
  phase_.side = sign(tested);
  if (slipGuard(s, k) > 0.0) return;
  // One step slips, the next sticks again with the spring reset.
  s.spring = slippedSpring(k);
  phase_.tangential = Phase::Tangential::stick;
}

int TwoBodyProblem::rightHandSide(double, const double y[], double dydt[], void* self) {
  const State s{y[0], y[1], y[2], y[3], y[4], y[5], y[6]};
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

  const double spin = -start.psi * start.vn / reach_;
  State now{reach_, 0.0, -start.vn, 0.0, spin, spin, 0.0};
  choosePhase(now);

  // A fixed step of t_c/400 leaves rk8pd's own error far below rounding; events cut it short.
  const auto stepFrom = [&](const State& from, double h) {
    State to = from;
    std::array<double, dimension> error{};
    gsl_odeiv2_step_reset(stepper.get());
    gsl_odeiv2_step_apply(stepper.get(), 0.0, h, reinterpret_cast<double*>(&to), error.data(),
                          nullptr, nullptr, &system);
    return to;
  };
  const double fullStep = contactTime / 400.0;
  constexpr int mostSteps = 20000;
  for (int step = 0; step < mostSteps; ++step) {
    State next = stepFrom(now, fullStep);
    if (firstGuard(next) > 0.0) {
      now = next;
      continue;
    }
    double before = 0.0, after = fullStep;
    while (after - before > 1e-16 * contactTime && after - before > 1e-15 * after) {
      const double middle = 0.5 * (before + after);
      (firstGuard(stepFrom(now, middle)) > 0.0 ? before : after) = middle;
    }
    now = stepFrom(now, after);
    const Kinematics k = kinematics(now);
    if (k.overlap <= 1e-14 * reach_ && k.normalVelocity > 0.0)
      return {k.normalVelocity / start.vn, k.tangentialVelocity / start.vn};
    choosePhase(now);
  }
  throw std::runtime_error("the collision oracle did not come to an end");
}

}  // namespace

CollisionEnd oracleOutcome(const ContactLaw& law, const CollidingPair& pair,
                           const CollisionStart& start) {
  if (law.normal == NormalLaw::linear) {
    requireContinuousLimit(law);
    return TwoBodyProblem(law, pair).solve(start);
  }
  const double reducedMass = 1.0 / (1.0 / pair.mass[0] + 1.0 / pair.mass[1]);
  const double inverseInertiaFactor =
      reducedMass * (pair.radius[0] * pair.radius[0] / pair.inertia[0] +
                     pair.radius[1] * pair.radius[1] / pair.inertia[1]);
  return rigidOutcome(law.en, law.et0, law.mu, inverseInertiaFactor, start.psi);
}

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

#include "oracle/calibration.hpp"
#include "oracle/two_body_problem.hpp"

/// Resistance against the relative spin ω_r = ω_i − ω_j, a torque M on i and −M on j (the types of
/// Ai et al. 2011): M, and when it changes between sticking and its bound. The conventions are
/// those of the tangential spring, with θ for ξ; two_body_events.cpp has what they mean in the
/// limit of small steps.
namespace crossgrain::inline oracle {

void TwoBodyProblem::setRollingConstants() {
  const bool spring = law_.rolling == RollingLaw::spring;
  rollingLength_ = crossgrain::rollingLength(law_, pair_);
  rollingStiffness_ = spring ? law_.kr * rollingSquare(law_, pair_) : 0.0;
  rollingDamping_ = law_.gr * rollingDamperUnit(law_, pair_, rollingStiffness_);
}

/// N. @see RollingLoad
double TwoBodyProblem::rollingLoad(const Kinematics& k) const {
  switch (law_.conventions.rollingLoad) {
    case RollingLoad::elastic:
      return elasticForce(k.overlap);
    case RollingLoad::magnitude:
      return phase_.loaded ? load(k) : -load(k);
    case RollingLoad::compression:
    case RollingLoad::whileCompressed:
      break;
  }
  return phase_.loaded ? load(k) : 0.0;
}

/// RollingLoad::whileCompressed without a load: a spring sticks, whatever it carries.
bool TwoBodyProblem::rollingHasNoLimit() const {
  return law_.rolling == RollingLaw::spring && !phase_.loaded &&
         law_.conventions.rollingLoad == RollingLoad::whileCompressed;
}

bool TwoBodyProblem::hasNoRollingBound() const {
  const RollingLoad of = law_.conventions.rollingLoad;
  if (rollingHasNoLimit()) return false;
  if (of == RollingLoad::elastic) return phase_.beyond;
  return neverLoaded() || (!phase_.loaded && of != RollingLoad::magnitude);
}

/// The force or torque that is compared with the bound.
double TwoBodyProblem::rollingTested(const State& s, const Kinematics& k) const {
  const bool outside = law_.conventions.rollingDashpot == Dashpot::outside;
  return -rollingStiffness_ * s.angle - (outside ? 0.0 : rollingDamping_ * k.rollingSpin);
}

/// M [N m].
double TwoBodyProblem::rollingTorque(const State& s, const Kinematics& k) const {
  switch (phase_.rolling) {
    case Phase::Rolling::none:
      return 0.0;
    case Phase::Rolling::damped: {
      const bool byLoad = law_.rolling == RollingLaw::viscousByLoad;
      return -(byLoad ? rollingBound(k) * rollingLength_ : rollingDamping_) * k.rollingSpin;
    }
    case Phase::Rolling::stick:
      return -rollingStiffness_ * s.angle - rollingDamping_ * k.rollingSpin;
    case Phase::Rolling::slip:
      return rollingBound(k) * phase_.rollingSide;
    case Phase::Rolling::hold:
      break;
  }
  return holdingTorque(s, k);
}

/// In the rolling spring while it sticks [J].
double TwoBodyProblem::rollingEnergy(const State& s) const {
  if (phase_.rolling != Phase::Rolling::stick) return 0.0;
  return 0.5 * rollingStiffness_ * s.angle * s.angle;
}

/// The M that makes dω_r/dt = 0 beside f_t; where Coulomb's law holds v_t = 0 as well, that of
/// both.
double TwoBodyProblem::holdingTorque(const State& s, const Kinematics& k) const {
  return turningBySlip(k) * tangentialForce(s, k) / rollingCompliance();
}

double TwoBodyProblem::rollingBoundRate(const State& s, const Kinematics& k) const {
  const double factor = law_.muR * rollingLength_;
  if (law_.conventions.rollingLoad == RollingLoad::elastic)
    return -factor * stiffness(k.overlap).value * k.normalVelocity;
  if (!phase_.loaded && law_.conventions.rollingLoad != RollingLoad::magnitude) return 0.0;
  return factor * (phase_.loaded ? 1.0 : -1.0) * loadRate(k, normalAcceleration(s, k));
}

/// As dashpotRate().
double TwoBodyProblem::rollingDashpotRate(const State& s, const Kinematics& k) const {
  const double sticking = rollingBound(k) * phase_.rollingSide;
  return -rollingDamping_ *
         (rollingCompliance() * sticking - turningBySlip(k) * tangentialForce(s, k)) *
         phase_.rollingSide;
}

/// θ as the law leaves it while it slips.
double TwoBodyProblem::slippedAngle(const Kinematics& k) const {
  const double torque = rollingBound(k) * phase_.rollingSide;
  const bool springOnly = law_.conventions.rollingReset == SpringReset::springOnly;
  return -(springOnly ? torque + rollingDamping_ * k.rollingSpin : torque) / rollingStiffness_;
}

/// By how much the spring's torque grows, towards its side [N m/s].
double TwoBodyProblem::rollingStretching(const Kinematics& k) const {
  return -rollingStiffness_ * k.rollingSpin * phase_.rollingSide;
}

/// As slipGuard(). With the dashpot outside the test and reset beside it the spring carries
/// |bound − γ|ω_r|| after a slip, less than the bound, and sticks until it has grown to that again;
/// unless that is the bound itself, as where ω_r comes to rest, slip after slip in ever shorter
/// times.
double TwoBodyProblem::rollingSlipGuard(const State& s, const Kinematics& k) const {
  const bool outside = law_.conventions.rollingDashpot == Dashpot::outside;
  const bool springOnly = law_.conventions.rollingReset == SpringReset::springOnly;
  const double damping = rollingDamping_ * k.rollingSpin * phase_.rollingSide;
  const bool negligible = outside && std::abs(damping) <= 1e-8 * rollingBound(k);
  if (rollingDamping_ > 0.0 && outside == springOnly && !negligible)
    return outside ? damping : -damping;
  double stretching = rollingStretching(k);
  if (law_.conventions.springUpdate == SpringUpdate::after) stretching = std::max(stretching, 0.0);
  return stretching + (outside ? 0.0 : rollingDashpotRate(s, k)) - rollingBoundRate(s, k);
}

/// The amount that a bound may lack [N m]: where a contact begins, until positions resolve its
/// overlap, it is as that of an overlap that they do; and unseenLoad().
double TwoBodyProblem::unseenBound(const Kinematics& k) const {
  const double unseen = visibleLength() - k.overlap, factor = law_.muR * rollingLength_;
  if (k.normalVelocity >= 0.0 || unseen <= 0.0) return factor * unseenLoad(k);
  return factor * stiffest(k) * unseen;
}

double TwoBodyProblem::rollingGuard(const State& s, const Kinematics& k) const {
  if (rollingHasNoLimit()) return 1.0;
  switch (phase_.rolling) {
    case Phase::Rolling::none:
    case Phase::Rolling::damped:
      return 1.0;
    case Phase::Rolling::stick:
      return rollingBound(k) + unseenBound(k) - std::abs(rollingTested(s, k));
    case Phase::Rolling::hold:
      return rollingBound(k) + law_.muR * rollingLength_ * unseenLoad(k) -
             std::abs(holdingTorque(s, k));
    case Phase::Rolling::slip:
      break;
  }
  if (law_.rolling == RollingLaw::spring) return rollingSlipGuard(s, k);
  return stillness_ / pair_.radius[0] - phase_.rollingSide * k.rollingSpin;
}

/// @param anew  at the first touch
void TwoBodyProblem::chooseRolling(State& s, bool anew) {
  const Kinematics k = kinematics(s);
  if (law_.rolling == RollingLaw::viscous || law_.rolling == RollingLaw::viscousByLoad) {
    phase_.rolling = Phase::Rolling::damped;
    return;
  }
  if (rollingHasNoLimit()) {
    if (phase_.rolling == Phase::Rolling::slip) s.angle = slippedAngle(k);
    phase_.rolling = Phase::Rolling::stick;
    return;
  }
  const bool none = hasNoRollingBound(), wasNone = phase_.rolling == Phase::Rolling::none;
  if (!anew && none == wasNone && rollingGuard(s, k) > 0.0) return;
  if (none) {
    phase_.rolling = Phase::Rolling::none;
    return;
  }
  if (law_.rolling == RollingLaw::spring) {
    phase_.rollingSide = wasNone ? 0.0 : phase_.rollingSide;
    if (!anew && (wasNone || phase_.rolling == Phase::Rolling::slip)) s.angle = slippedAngle(k);
    chooseRollingSpring(s);
    return;
  }
  phase_.rolling = Phase::Rolling::slip;
  phase_.rollingSide = -sign(k.rollingSpin);
  if (std::abs(k.rollingSpin) >= 2.0 * stillness_ / pair_.radius[0]) return;
  setRollingSpin(s, 0.0);
  phase_.rolling = Phase::Rolling::hold;
  // At the first touch both are zero: what they are as soon as positions resolve an overlap.
  State still = s;
  if (rollingBound(kinematics(s)) == 0.0 && k.normalVelocity < 0.0)
    still = along(s, -visibleLength() / k.normalVelocity);
  const Kinematics then = kinematics(still);
  const double hold = holdingTorque(still, then);
  // At its bound to the last bit it has just ceased to hold.
  if (hold == 0.0 || std::abs(hold) < rollingBound(then)) return;
  phase_.rolling = Phase::Rolling::slip;
  phase_.rollingSide = sign(hold);
}

/// As chooseSpringPhase(); a slip has left its θ already.
void TwoBodyProblem::chooseRollingSpring(State& s) {
  const LawConventions& how = law_.conventions;
  Kinematics k = kinematics(s);
  if (phase_.rolling == Phase::Rolling::slip && rollingDamping_ > 0.0 &&
      how.rollingReset == SpringReset::total && how.rollingDashpot == Dashpot::inside &&
      rollingDashpotRate(s, k) > rollingBoundRate(s, k)) {
    noLimit_ = true;
    if (overshoot_ > 0.0) setRollingSpin(s, phase_.rollingSide * overshoot_ / pair_.radius[0]);
    k = kinematics(s);
  }
  phase_.rolling = Phase::Rolling::stick;
  const double tested = rollingTested(s, k);
  if (std::abs(tested) < rollingBound(k)) return;
  phase_.rollingSide = sign(tested);
  if (tested == 0.0) {  // relaxed, at a bound of 0: whichever of both grows faster
    phase_.rollingSide = -sign(k.rollingSpin);
    if (rollingStretching(k) <= rollingBoundRate(s, k)) return;
  }
  phase_.rolling = Phase::Rolling::slip;
  if (rollingSlipGuard(s, k) > 0.0) return;
  s.angle = slippedAngle(k);
  phase_.rolling = Phase::Rolling::stick;
  // A dashpot beyond twice the bound leaves the spring beyond it on the other side: it slips there.
  const double left = rollingTested(s, k);
  if (std::abs(left) <= rollingBound(k) || sign(left) == phase_.rollingSide) return;
  phase_.rolling = Phase::Rolling::slip;
  phase_.rollingSide = sign(left);
}

}  // namespace crossgrain::inline oracle

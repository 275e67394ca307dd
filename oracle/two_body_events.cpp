#include "oracle/two_body_problem.hpp"

/// When a phase ends, and which one comes next.
namespace crossgrain::inline oracle {

/// d v_t/dt per f_t [1/kg]. Where a torque holds ω_r, it answers to f_t as well.
double TwoBodyProblem::compliance(const Kinematics& k) const {
  const double free =
      inverseMass_ + k.armI * k.leverI / pair_.inertia[0] + k.armJ * k.leverJ / pair_.inertia[1];
  if (phase_.rolling != Phase::Rolling::hold) return free;
  return free - slippingByTorque(k) * turningBySlip(k) / rollingCompliance();
}

/// dv_t/dt without f_t and M: −θ' v_n − c_i' ω_i − c_j' ω_j, where θ' is the rate at which the
/// normal turns and c' = armFraction · v_n.
double TwoBodyProblem::slipDrift(const State& s, const Kinematics& k) const {
  return -k.turning * k.normalVelocity -
         k.normalVelocity * (armFraction(0) * s.spinI + armFraction(1) * s.spinJ);
}

/// The f_t that makes dv_t/dt = 0 beside M; where that holds ω_r, with the M of both.
double TwoBodyProblem::holdingForce(const State& s, const Kinematics& k) const {
  double drift = slipDrift(s, k);
  if (law_.rolls() && phase_.rolling != Phase::Rolling::hold)
    drift -= slippingByTorque(k) * rollingTorque(s, k);
  return -drift / compliance(k);
}

/// dv_n/dt = a·n + θ'² |x|.
double TwoBodyProblem::normalAcceleration(const State& s, const Kinematics& k) const {
  const State rate = derivative(s);
  return rate.vx * k.nx + rate.vy * k.ny + k.turning * k.sideways;
}

double TwoBodyProblem::boundRate(const State& s, const Kinematics& k) const {
  return bound(loadRate(k, normalAcceleration(s, k)));
}

/// The spring as the law leaves it while it slips.
double TwoBodyProblem::slippedSpring(const Kinematics& k) const {
  if (springUnit(k.overlap) == 0.0) return 0.0;  // beyond δ = 0
  const double force = boundNow(k) * phase_.side;
  const bool springOnly = law_.conventions.springReset == SpringReset::springOnly;
  const double viscous = tangentialDamping(k.overlap).value * k.tangentialVelocity;
  return -(springOnly ? force + viscous : force) / springUnit(k.overlap);
}

/// > 0 as long as the step after a slipping one slips again, in the limit of small steps: the force
/// tested with the spring just reset exceeds the bound at once, or, where it equals the bound,
/// grows faster than the bound. A law that stretches its spring only after a sticking step
/// (SpringUpdate::after) does not see v_t in the step after a slip: it slips on while the bound
/// falls, also against a v_t that would relax the spring. Where the bound rises it sticks and slips
/// in turn, with a force that stays within a few steps' rise of the bound as long as the stretching
/// is the faster. A spring that keeps ξ while its stiffness follows the overlap has a force that
/// grows with it.
double TwoBodyProblem::slipGuard(const State& s, const Kinematics& k) const {
  const bool outside = law_.conventions.dashpot == Dashpot::outside;
  const bool springOnly = law_.conventions.springReset == SpringReset::springOnly;
  const double damping = tangentialDamping(k.overlap).value * k.tangentialVelocity * phase_.side;
  if (law_.gt > 0.0 && outside == springOnly) return outside ? damping : -damping;

  const Slope stiffness = tangentialStiffness(k.overlap);
  double stretching = -stiffness.value * k.tangentialVelocity * phase_.side;
  if (law_.conventions.springUpdate == SpringUpdate::after) stretching = std::max(stretching, 0.0);
  if (!remembersForce())
    stretching += phase_.side * slippedSpring(k) * stiffness.rate * k.normalVelocity;
  return stretching + (outside ? 0.0 : dashpotRate(s, k)) - boundRate(s, k);
}

/// The rate at which the dashpot's part of the tested force grows, towards `side`, in a contact
/// that begins to stick at its bound.
double TwoBodyProblem::dashpotRate(const State& s, const Kinematics& k) const {
  const Slope gt = tangentialDamping(k.overlap);
  const double sticking = boundNow(k) * phase_.side;
  return (-gt.value * compliance(k) * (sticking - holdingForce(s, k)) +
          gt.rate * k.normalVelocity * k.tangentialVelocity) *
         phase_.side;
}

double TwoBodyProblem::tangentialGuard(const State& s) const {
  const Kinematics k = kinematics(s);
  const double limit = boundNow(k);
  switch (phase_.tangential) {
    case Phase::Tangential::none:
      return 1.0;
    case Phase::Tangential::damped:
      return limit - tangentialDamping(k.overlap).value * std::abs(k.tangentialVelocity);
    case Phase::Tangential::stick:
      return limit + law_.mu * unseenLoad(k) - std::abs(testedForce(k, s.spring));
    case Phase::Tangential::hold:
      return limit + law_.mu * unseenLoad(k) - std::abs(holdingForce(s, k));
    case Phase::Tangential::slip:
      break;
  }
  const double opposing = stillness_ - phase_.side * k.tangentialVelocity;
  if (law_.tangential == TangentialLaw::coulomb || limit < 0.0) return opposing;
  if (law_.tangential == TangentialLaw::viscous)
    return tangentialDamping(k.overlap).value * opposing - limit;
  return slipGuard(s, k);
}

/// The phase lasts while this is > 0.
double TwoBodyProblem::firstGuard(const State& s) const {
  const Kinematics k = kinematics(s);
  double guard = std::min(k.overlap + bondRange_, tangentialGuard(s));
  if (law_.rolls()) guard = std::min(guard, rollingGuard(s, k));
  if (law_.coheres()) return std::min(guard, cohesionGuard(k));
  if (law_.gn > 0.0) guard = std::min(guard, phase_.compressive ? trialNormal(k) : -trialNormal(k));
  return guard;
}

/// Whether the outcome jumps with Ψ_i at this very start.
///
/// At the first touch only dashpots act: the tested force is f* = −γ_t v_t, its bound µ γ_n v, and
/// they are equal at |Ψ_i| = Ψ_j = µ γ_n/γ_t (of dampers that follow a stiffness: of the two γ(δ),
/// δ → 0). Just below, the contact sticks, with a spring that is still relaxed. Just above, it
/// slips, and the law resets the spring to all of the force, −k_t ξ = f_t: in the next step the
/// dashpot comes on top of that, f* exceeds the bound by γ_t |v_t|, and so the slip goes on until
/// v_t = 0. Both begin with the same force, and part unless the sticking contact slips at once as
/// well, that is unless f* grows at least as fast as the bound:
///   d|f*|/dt = k_t |v_t| + dashpotRate() ≥ boundRate().
/// A law that resets only the spring's part,
/// −k_t ξ = f_t − (−γ_t v_t), leaves at Ψ_j the spring relaxed too and does not jump; nor does one
/// with its dashpot outside the test, which does not see it at the first touch.
///
/// Starts within `alike` of Ψ_j count as Ψ_j: what the six figures of a case file, or an engine
/// with float32 velocities, cannot distinguish from it.
bool TwoBodyProblem::jumpsAtTouch(const CollisionStart& start) {
  constexpr double alike = 1e-6;
  if (!hasJump()) return false;
  const State s = firstTouch(start);
  const Phase before = phase_;
  phase_ = {Phase::Tangential::stick, 0.0, true};
  const Kinematics touch = kinematics(s);
  const double limit = boundNow(touch), tested = testedForce(touch, s.spring);
  phase_.side = sign(tested);
  bool jumps = std::abs(std::abs(tested) - limit) <= alike * limit;
  if (jumps) {
    // The rates are those at Ψ_j itself: near δ = 0 those of a law that stiffens are differences
    // of large numbers.
    State exact = s;
    exact.spinI += (1.0 - limit / std::abs(tested)) * touch.tangentialVelocity / touch.armI;
    const Kinematics k = kinematics(exact);
    const double stretching =
        -tangentialStiffness(k.overlap).value * k.tangentialVelocity * phase_.side;
    jumps = stretching + dashpotRate(exact, k) < boundRate(exact, k);
  }
  phase_ = before;
  return jumps;
}

/// Whether the law has such a start at all.
bool TwoBodyProblem::hasJump() const {
  const LawConventions& how = law_.conventions;
  return law_.tangential == TangentialLaw::springDashpot && law_.gt > 0.0 && law_.gn > 0.0 &&
         how.dashpot == Dashpot::inside && how.springReset == SpringReset::total;
}

/// Whether the contact begins with a slip.
bool TwoBodyProblem::slipsAtFirst(const CollisionStart& start) {
  const State s = firstTouch(start);
  phase_ = {Phase::Tangential::stick, 0.0, true};
  const Kinematics touch = kinematics(s);
  return std::abs(testedForce(touch, s.spring)) > boundNow(touch);
}

/// Whether an event leaves the tangential phase as it is: others than its own must not reset a
/// spring that slips.
bool TwoBodyProblem::tangentialLasts(const State& s) const {
  const bool none = law_.tangential == TangentialLaw::none || hasNoBound();
  return none == (phase_.tangential == Phase::Tangential::none) && tangentialGuard(s) > 0.0;
}

/// Begins the phase that holds right after `s`, an event or the start. While a contact slips, the
/// energy in its spring is part of the slip's account. Where friction and rolling resistance hold a
/// contact at rest, each counts on the other.
/// @param anew  at the first touch
void TwoBodyProblem::enterPhase(State& s, bool anew) {
  s.lostSliding += storedEnergy(s);
  s.lostRolling += rollingEnergy(s);
  chooseNormal(s, anew);
  const bool others = law_.rolls() || law_.coheres();
  const bool unloaded = phase_.tangential == Phase::Tangential::none && law_.springs();
  if (!anew && law_.coheres() && unloaded && !hasNoBound()) {
    phase_.side = 0.0;  // a bound of 0 has reset the spring until now
    s.spring = slippedSpring(kinematics(s));
  }
  if (anew || !others || !tangentialLasts(s)) choosePhase(s);
  if (law_.rolls()) {
    chooseRolling(s, anew);
    if (phase_.tangential == Phase::Tangential::hold && !tangentialLasts(s)) {
      choosePhase(s);
      chooseRolling(s, false);
    }
  }
  s.lostSliding -= storedEnergy(s);
  s.lostRolling -= rollingEnergy(s);
}

/// Resets the spring where the law does.
void TwoBodyProblem::choosePhase(State& s) {
  const Kinematics k = kinematics(s);
  if (law_.tangential == TangentialLaw::none || hasNoBound()) {
    phase_.tangential = Phase::Tangential::none;
    return;
  }

  const double slip = k.tangentialVelocity;
  const double limit = boundNow(k);
  const bool still = std::abs(slip) < 2.0 * stillness_;
  if (law_.tangential == TangentialLaw::coulomb && still) {
    // At rest to the last bit, else what is left of v_t would end the slip that may follow at once.
    s.spinI += slip / k.armI;
    const double hold = holdingForce(s, k);
    // At its bound to the last bit it has just ceased to hold.
    const bool holds = hold == 0.0 || std::abs(hold) < limit + 0.5 * law_.mu * unseenLoad(k);
    phase_.tangential = holds ? Phase::Tangential::hold : Phase::Tangential::slip;
    phase_.side = sign(hold);
  } else if (law_.tangential == TangentialLaw::viscous &&
             tangentialDamping(k.overlap).value * std::abs(slip) < limit) {
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
  const double limit = boundNow(k);
  if (phase_.tangential == Phase::Tangential::slip) {
    s.spring = slippedSpring(k);
    // A slip with a dashpot ends at v_t = 0, unless the spring is reset beside the dashpot.
    if (law_.gt > 0.0 && law_.conventions.springReset == SpringReset::total &&
        dashpotRate(s, k) > boundRate(s, k)) {
      noLimit_ = true;
      if (overshoot_ > 0.0) s.spinI += (k.tangentialVelocity - phase_.side * overshoot_) / k.armI;
    }
  }
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

}  // namespace crossgrain::inline oracle

#include "oracle/two_body_problem.hpp"

/// When a phase ends, and which one comes next.
namespace crossgrain::inline oracle {

namespace {

double sign(double value) {
  return (value > 0.0) - (value < 0.0);
}

}  // namespace

/// d v_t/dt per f_t [1/kg].
double TwoBodyProblem::compliance(const Kinematics& k) const {
  return inverseMass_ + k.armI * k.leverI / pair_.inertia[0] + k.armJ * k.leverJ / pair_.inertia[1];
}

/// The f_t that makes dv_t/dt = 0. Without f_t, dv_t/dt = −θ' v_n − c_i' ω_i − c_j' ω_j, where θ'
/// is the rate at which the normal turns and c' = armFraction · v_n.
double TwoBodyProblem::holdingForce(const State& s, const Kinematics& k) const {
  const double drift = -k.turning * k.normalVelocity -
                       k.normalVelocity * (armFraction(0) * s.spinI + armFraction(1) * s.spinJ);
  return -drift / compliance(k);
}

/// d bound/dt, from df_n/dt = −S v_n − γ_n dv_n/dt + γ_n′ v_n² and dv_n/dt = a·n + θ'² |x|.
double TwoBodyProblem::boundRate(const State& s, const Kinematics& k) const {
  const State rate = derivative(s);
  const double acceleration = rate.vx * k.nx + rate.vy * k.ny + k.turning * k.sideways;
  const Slope gn = normalDamping(k.overlap);
  return bound(-stiffness(k.overlap).value * k.normalVelocity - gn.value * acceleration +
               gn.rate * k.normalVelocity * k.normalVelocity);
}

/// What the law leaves the spring with while it slips.
double TwoBodyProblem::slippedSpring(const Kinematics& k) const {
  const double force = bound(normalForce(k)) * phase_.side;
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
  const double sticking = bound(normalForce(k)) * phase_.side;
  return (-gt.value * compliance(k) * (sticking - holdingForce(s, k)) +
          gt.rate * k.normalVelocity * k.tangentialVelocity) *
         phase_.side;
}

double TwoBodyProblem::tangentialGuard(const State& s) const {
  const Kinematics k = kinematics(s);
  const double limit = bound(normalForce(k));
  switch (phase_.tangential) {
    case Phase::Tangential::none:
      return 1.0;
    case Phase::Tangential::damped:
      return limit - tangentialDamping(k.overlap).value * std::abs(k.tangentialVelocity);
    case Phase::Tangential::stick:
      return limit - std::abs(testedForce(k, s.spring));
    case Phase::Tangential::hold:
      return limit - std::abs(holdingForce(s, k));
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
  double guard = std::min(k.overlap, tangentialGuard(s));
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
  const double limit = bound(normalForce(touch)), tested = testedForce(touch, s.spring);
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
  return std::abs(testedForce(touch, s.spring)) > bound(normalForce(touch));
}

/// Begins the phase that holds right after `s`, an event or the start. While a contact slips, the
/// energy in its spring is part of the slip's account.
void TwoBodyProblem::enterPhase(State& s) {
  s.lostSliding += storedEnergy(s);
  choosePhase(s);
  s.lostSliding -= storedEnergy(s);
}

/// Resets the spring where the law does.
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
  const bool still = std::abs(slip) < 2.0 * stillness_;
  if (law_.tangential == TangentialLaw::coulomb && still) {
    // At rest to the last bit, else what is left of v_t would end the slip that may follow at once.
    s.spinI += slip / k.armI;
    const double hold = holdingForce(s, k);
    const bool holds = std::abs(hold) <= limit;
    phase_.tangential = holds ? Phase::Tangential::hold : Phase::Tangential::slip;
    phase_.side = sign(hold);
  } else if (law_.tangential == TangentialLaw::viscous &&
             tangentialDamping(k.overlap).value * std::abs(slip) <= limit) {
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

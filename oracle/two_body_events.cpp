#include <algorithm>
#include <stdexcept>

#include "oracle/two_body_problem.hpp"

/// When a phase ends, and which one comes next. Compiled with collision_oracle.cpp.
namespace crossgrain::inline oracle {

/// dv_t/dt per f_t [1/kg], the same in all directions. Where a torque holds ω_r, it answers to f_t
/// as well.
template <int D>
double TwoBodyProblem<D>::compliance(const Motion& k) const {
  const double free = inverseMass_ + k.arm[0] * k.lever[0] / pair_.inertia[0] +
                      k.arm[1] * k.lever[1] / pair_.inertia[1];
  if (slider_[rolling].mode != Mode::hold) return free;
  return free - slippingByTorque(k) * turningBySlip(k) / rollingCompliance();
}

/// dv_t/dt in the tangent plane without f_t and M: −v_n dn/dt − (Σ c′ω) × n − (Σ c ω) × dn/dt with
/// c′ = armFraction · v_n. The last is along n in the plane.
template <int D>
SpinOf<D> TwoBodyProblem<D>::slipDrift(const Moment& s, const Motion& k) const {
  const Tangent grows = armFraction(0) * s.spin[0] + armFraction(1) * s.spin[1];
  const Tangent drift = -k.turning * k.normalVelocity - k.normalVelocity * sweepOf(k.normal, grows);
  if constexpr (D == 2)
    return drift;
  else {
    const Tangent flat = drift - drift.dot(k.normal) * k.normal;
    return flat - k.spinning * k.normal.cross(k.turning);
  }
}

/// −dω_r/dt in the tangent plane without f_t and M: a spin about n rolls as n turns.
template <int D>
SpinOf<D> TwoBodyProblem<D>::rollingDrift(const Motion& k) const {
  return k.twisting * k.turning;
}

/// The f_t that makes dv_t/dt = 0 beside M, and the M that makes dω_r/dt = 0 beside f_t; where both
/// hold, those of both.
template <int D>
SpinOf<D> TwoBodyProblem<D>::holding(Resistance of, const Moment& s, const Motion& k) const {
  if (of == rolling)
    return (turningBySlip(k) * coupleOf(k.normal, force(friction, s, k)) + rollingDrift(k)) /
           rollingCompliance();
  Tangent drift = slipDrift(s, k);
  if (law_.rolls()) {
    const bool holds = slider_[rolling].mode == Mode::hold;
    const Tangent torque =
        holds ? Tangent(rollingDrift(k) / rollingCompliance()) : force(rolling, s, k);
    drift -= slippingByTorque(k) * sweepOf(k.normal, torque);
  }
  return -drift / compliance(k);
}

/// dv_n/dt = a·n + |dn/dt|² |x|.
template <int D>
double TwoBodyProblem<D>::normalAcceleration(const Moment& s, const Motion& k) const {
  return acceleration(s, k).dot(k.normal) + dot(k.turning, k.sideways);
}

template <int D>
double TwoBodyProblem<D>::boundRate(Resistance of, const Moment& s, const Motion& k) const {
  const auto rate = [&] { return loadRate(k, normalAcceleration(s, k)); };
  if (of == friction) return NormalForces::bound(rate());
  const double factor = law_.muR * rollingLength_;
  if (law_.conventions.rollingLoad == RollingLoad::elastic)
    return -factor * NormalForces::stiffness(k.overlap).value * k.normalVelocity;
  if (!phase_.loaded && law_.conventions.rollingLoad != RollingLoad::magnitude) return 0.0;
  return factor * (phase_.loaded ? 1.0 : -1.0) * rate();
}

/// A spring as the law leaves it while it slips.
template <int D>
SpinOf<D> TwoBodyProblem<D>::slippedSpring(Resistance of, const Moment& s, const Motion& k) const {
  const double unit = springUnit(of, k);
  if (unit == 0.0) return noSpin<D>();  // beyond δ = 0
  const Tangent force = bound(of, k) * s.side[of];
  if (!slider_[of].springOnly) return -force / unit;
  return -(force + damping(of, k).value * k.velocity[of]) / unit;
}

/// The rate at which the dashpot's part of the tested force grows in a contact that begins to stick
/// at its bound, in the frame that the spring turns with.
template <int D>
SpinOf<D> TwoBodyProblem<D>::dashpotRate(Resistance of, const Moment& s, const Motion& k) const {
  const Slope dashpot = damping(of, k);
  const Tangent sticking = bound(of, k) * directionOf(s.side[of]);
  Tangent rate;
  if (of == friction)
    rate = -dashpot.value * compliance(k) * (sticking - holding(friction, s, k)) +
           dashpot.rate * k.normalVelocity * k.velocity[friction];
  else
    rate = -dashpot.value *
           (rollingCompliance() * sticking -
            turningBySlip(k) * coupleOf(k.normal, force(friction, s, k)) - rollingDrift(k));
  if constexpr (D == 3) rate += dashpot.value * k.twist * k.normal.cross(k.velocity[of]);
  return rate;
}

/// The rate at which the spring's part of it grows towards its side. A law that stretches its
/// spring only after a step that sticks (SpringUpdate::after) does not see the motion in the step
/// after a slip. A spring that keeps ξ while its stiffness follows the overlap has a force that
/// grows with it.
template <int D>
double TwoBodyProblem<D>::springRate(Resistance of, const Moment& s, const Motion& k) const {
  const Slope stiff = stiffness(of, k);
  double rate = dot(Tangent(-stiff.value * k.velocity[of]), s.side[of]);
  if (law_.conventions.springUpdate == SpringUpdate::after) rate = std::max(rate, 0.0);
  if (of == friction && !remembersForce())
    rate += dot(s.side[of], slippedSpring(of, s, k)) * stiff.rate * k.normalVelocity;
  return rate;
}

/// > 0 as long as the step after a slipping one slips again, in the limit of small steps: the force
/// tested with the spring just reset exceeds the bound at once, or, where it equals the bound,
/// grows faster than the bound. With SpringUpdate::after it slips on while the bound falls, also
/// against a motion that would relax the spring. Where the bound rises it sticks and slips in turn,
/// with a force that stays within a few steps' rise of the bound as long as the stretching is the
/// faster. With the dashpot outside the test and reset beside it the spring carries
/// |bound − γ|ω_r|| after a slip, less than the bound, and sticks until it has grown to that again;
/// unless that is the bound itself, as where ω_r comes to rest, slip after slip in ever shorter
/// times.
template <int D>
double TwoBodyProblem<D>::slipGuard(Resistance of, const Moment& s, const Motion& k) const {
  const Slider& slider = slider_[of];
  const double damped = dot(damping(of, k).value * k.velocity[of], s.side[of]);
  const bool negligible = slider.outside && std::abs(damped) <= 1e-8 * bound(of, k);
  if (slider.dashpot > 0.0 && slider.outside == slider.springOnly && !negligible)
    return slider.outside ? damped : -damped;
  const double dashpot = slider.outside ? 0.0 : dot(dashpotRate(of, s, k), s.side[of]);
  return springRate(of, s, k) + dashpot - boundRate(of, s, k);
}

/// Rate of the direction d of a slip that has one of its own. Each slip leaves the tested force at
/// bound·d, and the next step tests that with what it grows by, φ S + D, S = −k v of stretching:
/// d turns as the part of it across d, over the bound. φ is the share of steps that stretch the
/// spring, all of them unless the law stretches only after a step that sticks. With x = dbound/dt
/// less the other rates along d, a slip leaves it at its bound, and m steps later it has grown by
/// (m − 1) S dt against a bound that has by m x dt. So where x ≤ 0 every step slips, and d stays
/// whichever way the motion turns: φ = 0. Where 0 < x < S one step slips and m stick in turn, with
/// the smallest m that has m S > (m + 1) x, and φ = m/(m + 1), from ½ where S > 2x.
template <int D>
SpinOf<D> TwoBodyProblem<D>::turningOfSlip(Resistance of, const Moment& s, const Motion& k) const {
  const double limit = bound(of, k);
  const Slider& slider = slider_[of];
  Tangent turning = slider.followsMotion() ? noSpin<D>() : carried(s.side[of], k);
  if (slider.followsMotion() || !(limit > 0.0)) return turning;
  const Tangent along = directionOf(s.side[of]);
  const Tangent stretching = -stiffness(of, k).value * k.velocity[of];
  const Tangent dashpot = slider.outside ? noSpin<D>() : dashpotRate(of, s, k);
  double share = 1.0;
  if (law_.conventions.springUpdate == SpringUpdate::after) {
    const double rate = dot(stretching, along);
    const double x =
        boundRate(of, s, k) - dot(dashpot, along) - (springRate(of, s, k) - std::max(rate, 0.0));
    if (x <= 0.0)
      share = 0.0;
    else if (rate > x) {
      const double stuck = std::floor(x / (rate - x)) + 1.0;
      share = stuck / (stuck + 1.0);
    }
  }
  const Tangent pull = share * stretching + dashpot;
  return turning + (pull - dot(pull, along) * along) / limit;
}

/// RollingLoad::whileCompressed without a load: a spring sticks, whatever it carries.
template <int D>
bool TwoBodyProblem<D>::rollingHasNoLimit() const {
  return law_.rolling == RollingLaw::spring && !phase_.loaded &&
         law_.conventions.rollingLoad == RollingLoad::whileCompressed;
}

/// Whether there is no force or torque for want of a load.
template <int D>
bool TwoBodyProblem<D>::hasNoBound(Resistance of) const {
  if (of == friction) return law_.tangential == TangentialLaw::none || NormalForces::hasNoBound();
  const RollingLoad load = law_.conventions.rollingLoad;
  if (law_.rolling == RollingLaw::viscous || law_.rolling == RollingLaw::viscousByLoad ||
      rollingHasNoLimit())
    return false;
  if (load == RollingLoad::elastic) return phase_.beyond;
  return neverLoaded() || (!phase_.loaded && load != RollingLoad::magnitude);
}

/// The amount that a bound may lack: unseenLoad(); and that of a rolling spring, where a contact
/// begins, until positions resolve its overlap, is as that of an overlap that they do.
template <int D>
double TwoBodyProblem<D>::unseenBound(Resistance of, const Motion& k) const {
  if (of == friction) return law_.mu * unseenLoad(k);
  const double unseen = visibleLength() - k.overlap, factor = law_.muR * rollingLength_;
  if (slider_[of].mode == Mode::hold || k.normalVelocity >= 0.0 || unseen <= 0.0)
    return factor * unseenLoad(k);
  return factor * stiffest(k) * unseen;
}

/// > 0 as long as friction or rolling resistance stays in its mode.
template <int D>
double TwoBodyProblem<D>::guard(Resistance of, const Moment& s, const Motion& k) const {
  const Slider& slider = slider_[of];
  if (of == rolling && rollingHasNoLimit()) return 1.0;
  const Tangent& velocity = k.velocity[of];
  switch (slider.mode) {
    case Mode::none:
      break;
    case Mode::damped:
      if (of == rolling) return 1.0;
      return bound(of, k) - damping(of, k).value * sizeOf(velocity);
    case Mode::stick:
      return bound(of, k) + unseenBound(of, k) - sizeOf(tested(of, s, k));
    case Mode::hold:
      return bound(of, k) + unseenBound(of, k) - sizeOf(holding(of, s, k));
    case Mode::slip:
      if (of == friction && law_.tangential == TangentialLaw::viscous)
        return damping(of, k).value * (stillness_ + sizeOf(velocity)) - bound(of, k);
      if (D == 3 && slider.followsMotion()) return dot(velocity, slider.before) - stillness(of);
      if (!slider.springs || bound(of, k) < 0.0) return stillness(of) - dot(s.side[of], velocity);
      return slipGuard(of, s, k);
  }
  return 1.0;
}

/// The phase lasts while this is > 0.
template <int D>
double TwoBodyProblem<D>::firstGuard(const Moment& s) const {
  const Motion k = kinematics(s);
  return std::min({normalGuard(k), guard(friction, s, k), guard(rolling, s, k)});
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
template <int D>
bool TwoBodyProblem<D>::jumpsAtTouch(const CollisionStart& start) {
  constexpr double alike = 1e-6;
  if (!hasJump()) return false;
  Moment s = firstTouch(start);
  const Mode before = std::exchange(slider_[friction].mode, Mode::stick);
  const Motion touch = kinematics(s);
  const double limit = bound(friction, touch);
  const Tangent trial = tested(friction, s, touch);
  const double size = sizeOf(trial);
  bool jumps = std::abs(size - limit) <= alike * limit;
  if (jumps) {
    // The rates are those at Ψ_j itself: near δ = 0 those of a law that stiffens are differences
    // of large numbers.
    s.side[friction] = directionOf(trial);
    setVelocity(friction, s, touch, limit / size * touch.velocity[friction]);
    const Motion k = kinematics(s);
    const Tangent stretching = -tangentialStiffness(k.overlap).value * k.velocity[friction];
    jumps = dot(Tangent(stretching + dashpotRate(friction, s, k)), s.side[friction]) <
            boundRate(friction, s, k);
  }
  slider_[friction].mode = before;
  return jumps;
}

/// Whether the law has such a start at all.
template <int D>
bool TwoBodyProblem<D>::hasJump() const {
  const LawConventions& how = law_.conventions;
  return law_.tangential == TangentialLaw::springDashpot && law_.gt > 0.0 && law_.gn > 0.0 &&
         how.dashpot == Dashpot::inside && how.springReset == SpringReset::total;
}

/// Whether the contact begins with a slip.
template <int D>
bool TwoBodyProblem<D>::slipsAtFirst(const CollisionStart& start) {
  const Moment s = firstTouch(start);
  const Motion touch = kinematics(s);
  return sizeOf(tested(friction, s, touch)) > bound(friction, touch);
}

/// Whether an event leaves a mode as it is: others than its own must not reset a spring that slips.
template <int D>
bool TwoBodyProblem<D>::lasts(Resistance of, const Moment& s) const {
  if (of == rolling && rollingHasNoLimit()) return slider_[of].mode == Mode::stick;
  return hasNoBound(of) == (slider_[of].mode == Mode::none) && guard(of, s, kinematics(s)) > 0.0;
}

/// Begins the phase that holds right after `s`, an event or the start. While a contact slips, the
/// energy in its spring is part of the slip's account. Where friction and rolling resistance hold a
/// contact at rest, each counts on the other.
/// @param anew  at the first touch
template <int D>
void TwoBodyProblem<D>::enterPhase(Moment& s, bool anew) {
  s.lost.sliding += storedEnergy(friction, s);
  s.lost.rolling += storedEnergy(rolling, s);
  Motion k = kinematics(s);
  const bool wasCompressive = phase_.compressive;
  chooseNormal(k);
  s.largest = k.largest;
  chooseLoaded(k, anew || !law_.coheres() ? 1.0 : loadRate(k, normalAcceleration(s, k)));
  const bool others = law_.rolls() || law_.coheres();
  // Where a bound passes 0 what a spring has left has no direction.
  if (D == 3 && !law_.coheres() && phase_.compressive != wasCompressive) {
    slider_[friction].mode = Mode::none;
    if (law_.conventions.rollingLoad == RollingLoad::magnitude) slider_[rolling].mode = Mode::none;
  }
  if (anew || !others || !lasts(friction, s)) choose(friction, s, anew);
  if (law_.rolls()) {
    if (anew || !lasts(rolling, s)) choose(rolling, s, anew);
    if (slider_[friction].mode == Mode::hold && !lasts(friction, s)) {
      choose(friction, s, false);
      if (!lasts(rolling, s)) choose(rolling, s, false);
    }
  }
  s.lost.sliding -= storedEnergy(friction, s);
  s.lost.rolling -= storedEnergy(rolling, s);
}

/// Gives the first body a spin that makes v_t or ω_r what it is to be.
template <int D>
void TwoBodyProblem<D>::setVelocity(Resistance of, Moment& s, const Motion& k,
                                    const Tangent& wanted) const {
  if (of == friction) {
    s.spin[0] += coupleOf(k.normal, Tangent(k.velocity[friction] - wanted)) / k.arm[0];
    return;
  }
  s.spin[0] = s.spin[1] + wanted;
  if constexpr (D == 3) s.spin[0] += k.twisting * k.normal;
}

/// Begins a slip whose force is along a direction.
template <int D>
void TwoBodyProblem<D>::slip(Resistance of, Moment& s, const Tangent& along) {
  slider_[of].mode = Mode::slip;
  s.side[of] = directionOf(along);
  slider_[of].before = -s.side[of];
}

/// The mode that holds right after `s`; resets the spring where the law does.
template <int D>
void TwoBodyProblem<D>::choose(Resistance of, Moment& s, bool anew) {
  Slider& slider = slider_[of];
  if (hasNoBound(of)) {
    slider.mode = Mode::none;
    return;
  }
  if (slider.springs && bound(of, kinematics(s)) >= 0.0) {
    const bool slipped = slider.mode == Mode::slip, begins = slider.mode == Mode::none;
    if (begins) s.side[of] = noSpin<D>();
    if (slipped) endSlip(of, s);
    if (!anew && begins && D == 3)
      s.spring[of] = noSpin<D>();
    else if (!anew && (begins || slipped))
      s.spring[of] = slippedSpring(of, s, kinematics(s));
    slider.mode = Mode::stick;
    if (!(of == rolling && rollingHasNoLimit()) && !(D == 3 && slipped)) chooseSpring(of, s);
    return;
  }
  const Motion k = kinematics(s);
  const double speed = sizeOf(k.velocity[of]);
  const bool viscous = of == friction ? law_.tangential == TangentialLaw::viscous
                                      : law_.rolling != RollingLaw::constantTorque;
  if (viscous && (of == rolling || damping(of, k).value * speed < bound(of, k)))
    slider.mode = Mode::damped;
  else if (viscous || speed >= 2.0 * stillness(of))
    slip(of, s, -k.velocity[of]);
  else
    chooseAtRest(of, s);
}

/// Coulomb's law, or type A, where the motion comes to rest: it holds, or slips the other way.
template <int D>
void TwoBodyProblem<D>::chooseAtRest(Resistance of, Moment& s) {
  slider_[of].mode = Mode::hold;
  const Motion k = kinematics(s);
  // At rest to the last bit, else what is left of v_t would end the slip that may follow at once.
  setVelocity(of, s, k, noSpin<D>());
  Moment then = s;
  // At the first touch both are zero: what they are as soon as positions resolve an overlap.
  if (of == rolling && bound(of, kinematics(s)) == 0.0 && k.normalVelocity < 0.0)
    then = along(s, -visibleLength() / k.normalVelocity);
  const Motion still = of == rolling ? kinematics(then) : k;
  const Tangent hold = holding(of, then, still);
  const double allowed = of == friction ? 0.5 * law_.mu * unseenLoad(k) : 0.0;
  // At its bound to the last bit it has just ceased to hold.
  if (sizeOf(hold) == 0.0 || sizeOf(hold) < bound(of, still) + allowed) return;
  slip(of, s, hold);
  if constexpr (D == 3) setVelocity(of, s, kinematics(s), -4.0 * stillness(of) * s.side[of]);
}

/// The end of a slip of a spring: of one against the motion, in space, where that comes to rest.
/// @throws std::invalid_argument where a slip in space has no limit of small steps
template <int D>
void TwoBodyProblem<D>::endSlip(Resistance of, Moment& s) {
  Slider& slider = slider_[of];
  if (of == rolling && rollingHasNoLimit()) return;
  if constexpr (D == 3) {
    const Motion k = kinematics(s);
    if (slider.followsMotion()) {
      if (slider.slowing && slider.before.cross(*slider.slowing).norm() > 1e-3)
        throw std::invalid_argument(
            "no limit of small time steps: a slip whose force is along it turns on as it comes to "
            "rest, however slow it is");
      // At rest to the last bit, or what is left of v_t would end what follows at once.
      setVelocity(of, s, k, noSpin<D>());
      s.side[of] = -slider.before;
    }
    s.side[of] = directionOf(Tangent(s.side[of] - s.side[of].dot(k.normal) * k.normal));
  }
  // A slip with a dashpot ends at v_t = 0, unless the spring is reset beside the dashpot. Where the
  // bound falls faster than the dashpot relaxes, the length of steps decides.
  if (slider.dashpot == 0.0 || slider.springOnly || slider.outside) return;
  const Motion k = kinematics(s);
  if (!(dot(dashpotRate(of, s, k), s.side[of]) > boundRate(of, s, k))) return;
  if (D == 3)
    throw std::invalid_argument(
        "no limit of small time steps: a slip ends while its bound falls faster than the dashpot "
        "relaxes");
  noLimit_ = true;
  if (overshoot_ > 0.0)
    setVelocity(of, s, k, s.side[of] * (overshoot_ / (of == friction ? 1.0 : pair_.radius[0])));
}

/// Of a spring that does not slip yet: whether it does from now on.
template <int D>
void TwoBodyProblem<D>::chooseSpring(Resistance of, Moment& s) {
  Slider& slider = slider_[of];
  const Motion k = kinematics(s);
  const double limit = bound(of, k);
  Tangent trial = tested(of, s, k);
  if (sizeOf(trial) < limit) return;
  if constexpr (D == 3) {
    if (slider.followsMotion()) {
      // Each step of the law makes f := bound·f*/|f*| and tries f − γ v next: it comes to stick
      // again where v is along f, else to −bound v/|v|.
      constexpr int mostSteps = 100000;
      for (int step = 0; step < mostSteps && limit > 0.0; ++step) {
        const Tangent force = limit * directionOf(trial);
        trial = force - damping(of, k).value * k.velocity[of];
        if (trial.norm() <= limit) {
          s.spring[of] = -force / springUnit(of, k);
          return;
        }
        if ((force / limit + directionOf(k.velocity[of])).norm() < 1e-15) break;
      }
      if (sizeOf(k.velocity[of]) > 0.0) slip(of, s, -k.velocity[of]);
      return;
    }
  }
  s.side[of] = directionOf(trial);
  // Relaxed, at a bound of 0: whichever of both grows faster. Friction finds it at its next event.
  if (of == rolling && sizeOf(trial) == 0.0) {
    s.side[of] = -directionOf(k.velocity[of]);
    if (stiffness(of, k).value * sizeOf(k.velocity[of]) <= boundRate(of, s, k)) return;
  }
  slider.mode = Mode::slip;
  if (slipGuard(of, s, k) > 0.0) return;
  // One step slips, the next sticks again with the spring reset.
  s.spring[of] = slippedSpring(of, s, k);
  slider.mode = Mode::stick;
  // A dashpot beyond twice the bound leaves the spring beyond it on the other side: it slips there,
  // of friction from its next event on.
  const Tangent left = tested(of, s, k);
  if (of == friction || sizeOf(left) <= limit || dot(left, s.side[of]) > 0.0) return;
  slip(of, s, left);
}

}  // namespace crossgrain::inline oracle

#include "oracle/two_body_problem.hpp"

/// The law between two events, and the motion that it makes. Compiled with collision_oracle.cpp.
namespace crossgrain::inline oracle {

template <int D>
TwoBodyProblem<D>::TwoBodyProblem(const ContactLaw& law, const CollidingPair& pair)
    : NormalForces(law, pair) {
  const LawConventions& how = law_.conventions;
  const bool spring = law_.rolling == RollingLaw::spring;
  if (law_.rolls()) {
    rollingLength_ = crossgrain::rollingLength(law_, pair_);
    rollingStiffness_ = spring ? law_.kr * rollingSquare(law_, pair_) : 0.0;
    rollingDamping_ = law_.gr * rollingDamperUnit(law_, pair_, rollingStiffness_);
  }
  // A tangential dashpot outside the test has no limit of small steps (requireContinuousLimit()).
  slider_[friction] = {law_.springs(), law_.gt, false, how.springReset == SpringReset::springOnly};
  slider_[rolling] = {spring, rollingDamping_, how.rollingDashpot == Dashpot::outside,
                      how.rollingReset == SpringReset::springOnly};
}

/// v_t = v − v_n n − (Σ c ω) × n; dn/dt = (v − v_n n)/|x|.
template <int D>
Kinematics<D> TwoBodyProblem<D>::kinematics(const Moment& s) const {
  Motion k;
  const VecOf<D>&x = s.position, &v = s.velocity;
  if (pair_.plane) {
    k.distance = x.x();
    k.normal = VecOf<D>::UnitX();
  } else {
    if constexpr (D == 2)
      k.distance = std::hypot(x.x(), x.y());
    else
      k.distance = x.norm();
    k.normal = x / k.distance;
  }
  k.overlap = reach_ - k.distance;
  k.largest = s.largest;
  for (const int i : {0, 1}) {
    k.lever[i] = pair_.radius[i] - k.overlap * leverFraction(i);
    k.arm[i] = pair_.radius[i] - k.overlap * armFraction(i);
  }
  k.normalVelocity = v.dot(k.normal);
  k.velocity[rolling] = s.spin[0] - s.spin[1];
  if constexpr (D == 2) {
    k.sideways = v.dot(perpendicular(k.normal));
  } else {
    k.sideways = v - k.normalVelocity * k.normal;
    k.spinning = (k.arm[0] * s.spin[0] + k.arm[1] * s.spin[1]).dot(k.normal);
    k.twisting = k.velocity[rolling].dot(k.normal);
    k.velocity[rolling] -= k.twisting * k.normal;
    if (law_.conventions.springTwist == SpringTwist::meanSpin)
      k.twist = 0.5 * (s.spin[0] + s.spin[1]).dot(k.normal);
  }
  k.turning = pair_.plane ? noSpin<D>() : Tangent(k.sideways / k.distance);
  k.velocity[friction] = k.sideways - sweepOf(k.normal, k.arm[0] * s.spin[0]) -
                         sweepOf(k.normal, k.arm[1] * s.spin[1]);
  return k;
}

/// N. @see RollingLoad
template <int D>
double TwoBodyProblem<D>::rollingLoad(const Motion& k) const {
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

template <int D>
Slope TwoBodyProblem<D>::damping(Resistance of, const Motion& k) const {
  if (of == friction) return tangentialDamping(k.overlap);
  const bool byLoad = law_.rolling == RollingLaw::viscousByLoad;
  return {byLoad ? rollingBound(k) * rollingLength_ : rollingDamping_, 0.0};
}

/// The force or torque that is compared with the bound.
template <int D>
SpinOf<D> TwoBodyProblem<D>::tested(Resistance of, const Moment& s, const Motion& k) const {
  const Tangent spring = -springUnit(of, k) * s.spring[of];
  if (slider_[of].outside) return spring;
  return spring - damping(of, k).value * k.velocity[of];
}

/// Direction of a force or torque at its bound.
template <int D>
SpinOf<D> TwoBodyProblem<D>::side(Resistance of, const Moment& s, const Motion& k) const {
  if (D == 3 && slider_[of].followsMotion()) return -directionOf(k.velocity[of]);
  return directionOf(s.side[of]);
}

/// f_t [N] or M [N m].
template <int D>
SpinOf<D> TwoBodyProblem<D>::force(Resistance of, const Moment& s, const Motion& k) const {
  switch (slider_[of].mode) {
    case Mode::none:
      break;
    case Mode::damped:
      return -damping(of, k).value * k.velocity[of];
    case Mode::stick:
      return -springUnit(of, k) * s.spring[of] - damping(of, k).value * k.velocity[of];
    case Mode::slip:
      return bound(of, k) * side(of, s, k);
    case Mode::hold:
      return holding(of, s, k);
  }
  return noSpin<D>();
}

/// In a spring while it sticks [J].
template <int D>
double TwoBodyProblem<D>::storedEnergy(Resistance of, const Moment& s) const {
  if (slider_[of].mode != Mode::stick || (of == friction && !springHasEnergy())) return 0.0;
  if (of == rolling) return dot(0.5 * rollingStiffness_ * s.spring[of], s.spring[of]);
  const Motion k = kinematics(s);
  const double stiff = stiffness(of, k).value;
  if (!(stiff > 0.0)) return 0.0;
  const Tangent force = springUnit(of, k) * s.spring[of];
  return dot(0.5 * force, force) / stiff;
}

/// Loss of the stored energy per time because the stiffness changes, dδ/dt = −v_n: of a spring
/// that keeps ξ, −½ ξ² dk_t/dt; of one that keeps its force f, +½ (f/k_t)² dk_t/dt [W].
template <int D>
double TwoBodyProblem<D>::stiffeningLoss(const Moment& s, const Motion& k) const {
  const Slope stiff = tangentialStiffness(k.overlap);
  if (stiff.rate == 0.0 || !springHasEnergy()) return 0.0;
  const double unit = remembersForce() ? stiff.value : 1.0;
  const Tangent stretch = s.spring[friction] / unit;
  const double rising = dot(-0.5 * stiff.rate * k.normalVelocity * stretch, stretch);
  return remembersForce() ? rising : -rising;
}

/// Of i against j [m/s²].
template <int D>
VecOf<D> TwoBodyProblem<D>::acceleration(const Moment& s, const Motion& k) const {
  return (normalForce(k) * k.normal + alongTangent(k.normal, force(friction, s, k))) * inverseMass_;
}

/// Rate of what stays where it is on the bodies: parallel transport with n and a turn about it. A
/// number of the plane stays.
template <int D>
SpinOf<D> TwoBodyProblem<D>::carried(const Tangent& spring, const Motion& k) const {
  if constexpr (D == 2)
    return 0.0;
  else
    return -spring.dot(k.turning) * k.normal + k.twist * k.normal.cross(spring);
}

template <int D>
State<D> TwoBodyProblem<D>::derivative(const Moment& s) const {
  const Motion k = kinematics(s);
  const Tangent f = force(friction, s, k), torque = force(rolling, s, k);
  const Tangent couple = coupleOf(k.normal, f);
  const Tangent &slip = k.velocity[friction], &spin = k.velocity[rolling];
  /// v_t, taken with the arms of f_t, which does work on that.
  const Tangent worked = k.sideways - sweepOf(k.normal, k.lever[0] * s.spin[0]) -
                         sweepOf(k.normal, k.lever[1] * s.spin[1]);
  const double normal = normalForce(k), body = bodyForce(k);
  Moment rate;
  rate.position = s.velocity;
  rate.velocity = (normal * k.normal + alongTangent(k.normal, f)) * inverseMass_;
  rate.spin[0] = (torque - k.lever[0] * couple) / pair_.inertia[0];
  rate.spin[1] = (-torque - k.lever[1] * couple) / pair_.inertia[1];
  for (const Resistance of : both) {
    if (slider_[of].mode == Mode::stick)
      rate.spring[of] =
          (of == friction && remembersForce() ? stiffness(of, k).value : 1.0) * k.velocity[of] +
          carried(s.spring[of], k);
    if (D == 3 && slider_[of].mode == Mode::slip) rate.side[of] = turningOfSlip(of, s, k);
  }
  const Mode sliding = slider_[friction].mode, turning = slider_[rolling].mode;
  rate.lost.normal = (body - normal) * k.normalVelocity;
  if (sliding == Mode::stick || sliding == Mode::damped)
    rate.lost.tangential = springHasEnergy() ? dot(damping(friction, k).value * slip, slip) +
                                                   dot(f, Tangent(slip - worked))
                                             : dot(-f, worked);
  else
    rate.lost.sliding = dot(-f, worked);
  if (sliding == Mode::stick) rate.lost.stiffening = stiffeningLoss(s, k);
  if (turning == Mode::stick)
    rate.lost.rollingDamping = dot(rollingDamping_ * spin, spin);
  else if (turning == Mode::damped)
    rate.lost.rollingDamping = dot(-torque, spin);
  else if (turning == Mode::slip)
    rate.lost.rolling = dot(-torque, spin);
  if (remembersBody()) rate.lost.body = -body * k.normalVelocity;
  return rate;
}

template <int D>
CollisionEnd TwoBodyProblem<D>::endAt(const Moment& s, const CollisionStart& start) const {
  const Motion k = kinematics(s);
  CollisionEnd end;
  if constexpr (D == 2)
    end = endOf(pair_, start, {k.normalVelocity, k.sideways, {s.spin[0], s.spin[1]}});
  else
    end = spaceEndOf(pair_, start, {k.normal, s.velocity, {s.spin[0], s.spin[1]}});
  end.noLimit = noLimit_;
  const auto& lost = s.lost;
  end.lost = {lost.normal, lost.tangential, lost.stiffening, lost.sliding,
              storedEnergy(friction, s)};
  const bool spring = law_.rolling == RollingLaw::spring;
  if (spring || law_.rolling == RollingLaw::constantTorque)
    end.lost->rolling = lost.rolling + storedEnergy(rolling, s);
  if (law_.rolls() && law_.rolling != RollingLaw::constantTorque && !(spring && law_.gr == 0.0))
    end.lost->rollingDamping = lost.rollingDamping;
  if (law_.cohesion == CohesionLaw::elastoPlastic) end.lost->plastic = lost.body;
  if (law_.cohesion == CohesionLaw::jkr) end.lost->detachment = lost.body;
  return end;
}

}  // namespace crossgrain::inline oracle

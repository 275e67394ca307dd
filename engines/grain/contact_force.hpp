#pragma once

#include "engines/grain/adhesion.hpp"

namespace grain {

// The functions below are the law. `L` is one of law_types.hpp: it has ContactLaw's options either
// as compile-time constants, and what they exclude is not compiled, or as run-time values.

/// f_n = f_el(δ) − γ_n v_n (linear: Lätzel 2003, Eq. 4.9).
/// Implicit damping takes v_n at the end of the half step that f_n itself brings about:
/// v_n = v_n' + f_n dt/(2 m₁₂), hence the divisor. Where tension is cut the dashpot does not pull;
/// cohesion does.
/// @param body  the force without the dashpot: f_el of a law without cohesion
template <class L, class Real>
GRAIN_INLINE Real normalForce(const L& law, const ContactMotion<Real>& contact, Real body) {
  Real force = body;
  if (law.normalDamping) {
    const Real gn = normalDamping(law, contact);
    force -= gn * contact.normalVelocity;
    if (law.implicitDamping) force /= Real(1) + gn * contact.normalCompliance;
  }
  if (law.cohesion == CohesionLaw::none) return larger(force, law.leastForce);
  return larger(force, law.leastForce + smaller(body, Real(0)));
}

template <class L, class Real>
GRAIN_INLINE Real coulombBound(const L& law, Real normal) {
  if (law.signedBound) return law.mu * normal;
  return law.mu * larger(normal, law.ofPull * magnitude(normal));
}

/// An arm of a disk of radius a that touches one of radius `other` [m]: law.lever is that of f_t,
/// law.velocityLever that of the spin in v_t.
template <class Real>
GRAIN_INLINE Real armOf(LeverArm lever, Real a, Real other, Real overlap) {
  if (lever == LeverArm::radius) return a;
  if (lever == LeverArm::contactPoint) return a - overlap * other / (a + other);
  return a - Real(0.5) * overlap;
}

/// The same on a plane, its centre `height` above it.
template <class Real>
GRAIN_INLINE Real planeArmOf(LeverArm lever, PlaneArm plane, Real a, Real height) {
  if (lever == LeverArm::radius || plane == PlaneArm::radius) return a;
  return plane == PlaneArm::middle ? Real(0.5) * (a + height) : height;
}

/// How far from the centre the point is where a force acts on the plane: on its surface unless the
/// law has its contact point in the overlap.
template <class L, class Real>
GRAIN_INLINE Real planePoint(const L& law, Real a, Real height) {
  const bool inside = law.lever != LeverArm::radius && law.planeLever == PlaneArm::middle;
  return inside ? Real(0.5) * (a + height) : height;
}

/// Spring with or without dashpot: f* = −k_t ξ − γ_t v_t; where |f*| is within the bound f_t = f*
/// and ξ grows by v_t dt, else f_t = bound·sign(f*) and ξ = −f_t/k_t (Lätzel 2003, Eqs. 4.20–4.25).
template <class L, class Real>
GRAIN_INLINE ContactForce<Real> springForce(const L& law, const ContactMotion<Real>& contact,
                                            Real normal, Real load, Real bound, Real& spring) {
  // With History::force the spring is the force itself: one unit of it per unit.
  const bool force = law.history == History::force;
  const Real stiffness = tangentialStiffness(law, contact);
  const Real unit = force ? Real(1) : stiffness;
  Real inverse = law.inverseKt;
  if (force) inverse = Real(1);
  if (law.normal == NormalLaw::hertz && !force)
    inverse = stiffness > Real(0) ? Real(1) / stiffness : Real(0);
  Real stretch = contact.tangentialVelocity * law.dt;
  if (force) stretch *= stiffness;
  const Real part = partBefore<Real>(law.stretch);
  const Real stretched = law.stretch == SpringUpdate::after ? spring : spring + part * stretch;
  const Real elastic = -unit * stretched;
  Real viscous = Real(0), gt = Real(0);
  if (law.tangential == TangentialLaw::springDashpot) {
    gt = tangentialDamping(law, contact);
    viscous = -gt * contact.tangentialVelocity;
  }
  Real trial = elastic + viscous;
  if (law.implicitDamping && law.tangential == TangentialLaw::springDashpot)
    trial /= Real(1) + gt * contact.tangentialCompliance;
  const Real tested = law.dashpotOutsideBound ? elastic : trial;
  const bool holds = magnitude(tested) <= bound;
  // Where it does not hold `tested` is no zero, unless the bound is below zero, which turns the
  // force round.
  const Real slipping = law.signedBound ? signedLike(bound, tested) : withSignOf(bound, tested);
  Real slipped = -(law.resetSpringOnly ? slipping - viscous : slipping) * inverse;
  if (law.stretch == SpringUpdate::midpoint) slipped += Real(0.5) * stretch;
  spring = holds ? stretched + (Real(1) - part) * stretch : slipped;
  return {normal, holds ? trial : slipping, holds ? Real(0) : Real(1), load};
}

/// The force on i. `spring` is ξ, kept as long as the contact lasts, and so is `memory`, which only
/// a law that remembers() looks at: > 0 while JKR's bond holds, or the largest overlap. `rest` is
/// δ₀ of one that remembersRest().
template <class L, class Real>
GRAIN_INLINE ContactForce<Real> contactForce(const L& law, const ContactMotion<Real>& contact,
                                             Real& spring, Real& memory, Real& rest) {
  const Real body = remembersRest(law) ? laggedPlasticForce(law, contact, memory, rest)
                                       : bodyForce(law, contact, memory);
  const Real normal = normalForce(law, contact, body);
  const Real load = boundLoad(law, contact, normal, body);
  if (law.tangential == TangentialLaw::none) return {normal, Real(0), Real(0), load};
  const Real bound = coulombBound(law, load);
  const Real slip = contact.tangentialVelocity;
  if (law.tangential == TangentialLaw::coulomb)  // Eq. 4.16
    return {normal, -signedLike(bound, slip), Real(1), load};
  if (law.tangential == TangentialLaw::viscous) {  // Eq. 4.18
    const Real gt = tangentialDamping(law, contact);
    Real trial = gt * magnitude(slip);
    if (law.implicitDamping) trial /= Real(1) + gt * contact.tangentialCompliance;
    return {normal, -signedLike(smaller(trial, bound), slip), trial > bound ? Real(1) : Real(0),
            load};
  }
  return springForce(law, contact, normal, load, bound, spring);
}

/// 1/(J + m a²) of a disk from its inverse mass and moment of inertia; of a wall, whose are 0, 0.
template <class Real>
GRAIN_INLINE Real inverseRollingInertia(Real inverseMass, Real inverseInertia, Real a) {
  const Real sum = inverseMass + inverseInertia * a * a;  // (J + m a²)/(m J)
  return sum > Real(0) ? inverseMass * inverseInertia / sum : Real(0);
}

/// Lengths of a pair, or of a disk of radius a at a plane.
template <class L, class Real>
GRAIN_INLINE RollingMotion<Real> rollingMotion(const L& law, Real a, Real other, Real spin,
                                               bool atPlane) {
  const Real effective = atPlane ? a : a * other / (a + other);
  const Real smallest = atPlane ? a : smaller(a, other);
  const Real mean = atPlane ? a : Real(0.5) * (a + other);
  const Real radii = atPlane ? a * a : a * other;
  RollingMotion<Real> motion{};
  motion.spin = spin;
  motion.length = law.effective * effective + law.smallest * smallest + law.mean * mean;
  motion.square =
      law.ofLength * (motion.length * motion.length) + law.ofRadii * radii + law.ofNothing;
  return motion;
}

/// The same of a pair, or of a disk at a plane (other: 0).
template <class L, class Real>
GRAIN_INLINE RollingMotion<Real> rollingMotion(const L& law, Real a, Real other, Real spin) {
  return rollingMotion(law, a, other, spin, !(other > Real(0)));
}

/// µ_r L N [N m].
template <class L, class Real>
GRAIN_INLINE Real rollingBound(const L& law, const RollingMotion<Real>& motion,
                               const ContactMotion<Real>& contact, Real normal) {
  const Real load = law.rollingNet * normal + law.rollingSize * magnitude(normal) +
                    law.rollingElastic * elasticForce(law, contact);
  return law.muR * motion.length * larger(load, Real(0));
}

/// γ_r L² of a dashpot [N m s]. @see RollingDamper
template <class L, class Real>
GRAIN_INLINE Real rollingDamping(const L& law, const RollingMotion<Real>& motion) {
  if (seesRollingInertia(law))
    return Real(2) * law.gr * squareRoot(motion.inertia * law.kr * motion.square);
  return law.gr * motion.length * motion.length;
}

/// The rolling resistance on i. `angle` is θ, kept as long as the contact lasts. Like a tangential
/// spring it slips where the bound is met: θ is what carries the bound then.
template <class L, class Real>
GRAIN_INLINE RollingTorque<Real> rollingTorque(const L& law, const RollingMotion<Real>& motion,
                                               const ContactMotion<Real>& contact, Real normal,
                                               Real& angle) {
  const Real bound = rollingBound(law, motion, contact, normal);
  if (law.rolling != RollingLaw::spring) {
    const Real viscous = law.viscous * (law.gr * motion.length * motion.length) +
                         law.viscousByLoad * (bound * motion.length);
    return {-viscous * motion.spin - law.constantTorque * signedLike(bound, motion.spin),
            law.constantTorque};
  }
  const Real stiffness = law.kr * motion.square;
  const Real stretch = motion.spin * law.dt;
  const Real part = partBefore<Real>(law.stretch);
  const Real stretched = law.stretch == SpringUpdate::after ? angle : angle + part * stretch;
  const Real spring = -stiffness * stretched;
  const Real viscous = -rollingDamping(law, motion) * motion.spin;
  const Real trial = spring + viscous;
  const Real tested = spring + law.dashpotTested * viscous;
  const bool limited = bound > law.unlimited;
  const bool holds = !limited || magnitude(tested) <= bound;
  const Real slipping = withSignOf(bound, tested);
  Real slipped = -(slipping - law.dashpotLeftOut * viscous) / stiffness;
  if (law.stretch == SpringUpdate::midpoint) slipped += Real(0.5) * stretch;
  angle = holds ? stretched + (Real(1) - part) * stretch : slipped;
  return {holds ? trial : slipping, holds ? Real(0) : Real(1)};
}

/// Whether surfaces at that overlap are in contact, and for JKR whether they were before: 1 or 0.
template <class L, class Real>
GRAIN_INLINE Real isBonded(const L& law, Real overlap, Real radius, Real before) {
  const Real bound = before > Real(0) ? -jkrRange(law, radius) : Real(0);
  return overlap > bound ? Real(1) : Real(0);
}

}  // namespace grain

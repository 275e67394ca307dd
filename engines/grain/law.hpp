#pragma once

#include "engines/grain/real.hpp"

namespace grain {

enum class Tangential { none, coulomb, viscous, spring, springDashpot };
enum class Bound { compression, magnitude, signedForce };  ///< µ times max(f_n,0), |f_n| or f_n
enum class Lever {
  radius,
  contactPoint,
  overlapMiddle
};  ///< a_i, a_i − δ a_j/(a_i + a_j), a_i − δ/2
enum class Damping { lagged, predicted, implicit };
enum class Stretch { after, before, midpoint };  ///< when ξ += v_t dt, relative to the force
enum class Integrator { positionVerlet, velocityVerlet, semiImplicitEuler };

/// The contact law and its conventions.
///
/// n points from j to i, s = z × n, overlap δ = a_i + a_j − |x_i − x_j|;
/// v_n = (v_i − v_j)·n, v_t = (v_i − v_j)·s − (l_i ω_i + l_j ω_j); the force on i is f_n n + f_t s.
struct Law {
  double kn = 0.0;  ///< [N/m]
  double gn = 0.0;  ///< [kg/s]
  double kt = 0.0;  ///< [N/m]
  double gt = 0.0;  ///< [kg/s]
  double mu = 0.0;  ///< [-]
  Tangential tangential = Tangential::none;
  Bound bound = Bound::compression;
  bool cutTension = false;
  bool dashpotOutsideBound = false;  ///< hold only the spring's force against the bound
  bool resetSpringOnly = false;  ///< on slip spring and dashpot, not the spring, carry the bound
  Lever lever = Lever::radius;
  Stretch stretch = Stretch::after;
  Damping damping = Damping::predicted;

  bool friction() const { return tangential != Tangential::none && mu > 0.0; }
  bool springs() const {
    return friction() &&
           (tangential == Tangential::spring || tangential == Tangential::springDashpot);
  }
};

/// Motion of one contact that the law sees.
template <class Real>
struct ContactMotion {
  Real overlap;               ///< δ [m]
  Real normalVelocity;        ///< v_n [m/s]
  Real tangentialVelocity;    ///< v_t [m/s]
  Real normalCompliance;      ///< dt/2 · (1/m_i + 1/m_j); read if damping is implicit [s/kg]
  Real tangentialCompliance;  ///< dt/2 · (1/m_i + 1/m_j + l_i²/J_i + l_j²/J_j), likewise [s/kg]
};

template <class Real>
struct ContactForce {
  Real normal;      ///< f_n [N]
  Real tangential;  ///< f_t [N]
  Real sliding;     ///< 1 where the Coulomb bound holds, else 0
};

// The functions below are the law. `L` is one of law_types.hpp: it has Law's members either as
// compile-time constants, and what they exclude is not compiled, or as run-time values.

/// f_n = k_n δ − γ_n v_n (Lätzel 2003, Eq. 4.9).
/// Implicit damping takes v_n at the end of the half step that f_n itself brings about:
/// v_n = v_n' + f_n dt/(2 m₁₂), hence the divisor.
template <class L, class Real>
GRAIN_INLINE Real normalForce(const L& law, const ContactMotion<Real>& contact) {
  Real force = law.kn * contact.overlap;
  if (law.normalDamping) force -= law.gn * contact.normalVelocity;
  if (law.implicitDamping) force /= Real(1) + law.gn * contact.normalCompliance;
  return law.cutTension ? larger(force, Real(0)) : force;
}

template <class L, class Real>
GRAIN_INLINE Real coulombBound(const L& law, Real normal) {
  if (law.bound == Bound::compression) return law.mu * larger(normal, Real(0));
  if (law.bound == Bound::magnitude) return law.mu * magnitude(normal);
  return law.mu * normal;
}

/// l_i of a disk of radius a that touches one of radius `other` [m].
template <class L, class Real>
GRAIN_INLINE Real leverArm(const L& law, Real a, Real other, Real overlap) {
  if (law.lever == Lever::radius) return a;
  if (law.lever == Lever::contactPoint) return a - overlap * other / (a + other);
  return a - Real(0.5) * overlap;
}

/// Spring with or without dashpot: f* = −k_t ξ − γ_t v_t; where |f*| is within the bound f_t = f*
/// and ξ grows by v_t dt, else f_t = bound·sign(f*) and ξ = −f_t/k_t (Lätzel 2003, Eqs. 4.20–4.25).
template <class L, class Real>
GRAIN_INLINE ContactForce<Real> springForce(const L& law, const ContactMotion<Real>& contact,
                                            Real normal, Real bound, Real& spring) {
  const Real stretch = contact.tangentialVelocity * law.dt;
  const Real share = law.stretch == Stretch::after    ? Real(0)
                     : law.stretch == Stretch::before ? Real(1)
                                                      : Real(0.5);
  const Real stretched = law.stretch == Stretch::after ? spring : spring + share * stretch;
  const Real elastic = -law.kt * stretched;
  Real viscous = Real(0);
  if (law.tangential == Tangential::springDashpot) viscous = -law.gt * contact.tangentialVelocity;
  Real trial = elastic + viscous;
  if (law.implicitDamping && law.tangential == Tangential::springDashpot)
    trial /= Real(1) + law.gt * contact.tangentialCompliance;
  const Real tested = law.dashpotOutsideBound ? elastic : trial;
  const bool holds = magnitude(tested) <= bound;
  const Real slipping = signedLike(bound, tested);
  Real slipped = -(law.resetSpringOnly ? slipping - viscous : slipping) * law.inverseKt;
  if (law.stretch == Stretch::midpoint) slipped += Real(0.5) * stretch;
  spring = holds ? stretched + (Real(1) - share) * stretch : slipped;
  return {normal, holds ? trial : slipping, holds ? Real(0) : Real(1)};
}

/// The force on i. `spring` is ξ, kept as long as the contact lasts.
template <class L, class Real>
GRAIN_INLINE ContactForce<Real> contactForce(const L& law, const ContactMotion<Real>& contact,
                                             Real& spring) {
  const Real normal = normalForce(law, contact);
  if (law.tangential == Tangential::none) return {normal, Real(0), Real(0)};
  const Real bound = coulombBound(law, normal);
  const Real slip = contact.tangentialVelocity;
  if (law.tangential == Tangential::coulomb)  // Eq. 4.16
    return {normal, -signedLike(bound, slip), Real(1)};
  if (law.tangential == Tangential::viscous) {  // Eq. 4.18
    Real trial = law.gt * magnitude(slip);
    if (law.implicitDamping) trial /= Real(1) + law.gt * contact.tangentialCompliance;
    return {normal, -signedLike(smaller(trial, bound), slip), trial > bound ? Real(1) : Real(0)};
  }
  return springForce(law, contact, normal, bound, spring);
}

}  // namespace grain

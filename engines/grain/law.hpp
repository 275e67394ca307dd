#pragma once

#include <algorithm>
#include <cmath>

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
};

/// Motion of one contact that the law sees.
struct ContactMotion {
  double overlap;               ///< δ [m]
  double normalVelocity;        ///< v_n [m/s]
  double tangentialVelocity;    ///< v_t [m/s]
  double normalCompliance;      ///< dt/2 · (1/m_i + 1/m_j), zero unless damping is implicit [s/kg]
  double tangentialCompliance;  ///< dt/2 · (1/m_i + 1/m_j + l_i²/J_i + l_j²/J_j), likewise [s/kg]
};

struct ContactForce {
  double normal;      ///< f_n [N]
  double tangential;  ///< f_t [N]
  bool sliding;
};

/// f_n = k_n δ − γ_n v_n (Lätzel 2003, Eq. 4.9).
/// Implicit damping takes v_n at the end of the half step that f_n itself brings about:
/// v_n = v_n' + f_n dt/(2 m₁₂), hence the divisor.
inline double normalForce(const Law& law, const ContactMotion& contact) {
  const double force = (law.kn * contact.overlap - law.gn * contact.normalVelocity) /
                       (1.0 + law.gn * contact.normalCompliance);
  return law.cutTension ? std::max(force, 0.0) : force;
}

inline double coulombBound(const Law& law, double normal) {
  switch (law.bound) {
    case Bound::compression:
      return law.mu * std::max(normal, 0.0);
    case Bound::magnitude:
      return law.mu * std::abs(normal);
    case Bound::signedForce:
      break;
  }
  return law.mu * normal;
}

/// l_i of a disk of radius a that touches one of radius `other` [m].
inline double leverArm(const Law& law, double a, double other, double overlap) {
  switch (law.lever) {
    case Lever::radius:
      return a;
    case Lever::contactPoint:
      return a - overlap * other / (a + other);
    case Lever::overlapMiddle:
      break;
  }
  return a - 0.5 * overlap;
}

inline double sign(double value) {
  return (value > 0.0) - (value < 0.0);
}

/// Spring with or without dashpot: f* = −k_t ξ − γ_t v_t; where |f*| is within the bound f_t = f*
/// and ξ grows by v_t dt, else f_t = bound·sign(f*) and ξ = −f_t/k_t (Lätzel 2003, Eqs. 4.20–4.25).
inline ContactForce springForce(const Law& law, const ContactMotion& contact, double normal,
                                double bound, double& spring, double dt) {
  const double slip = contact.tangentialVelocity;
  const double share = law.stretch == Stretch::after    ? 0.0
                       : law.stretch == Stretch::before ? 1.0
                                                        : 0.5;
  spring += share * slip * dt;

  const double gt = law.tangential == Tangential::springDashpot ? law.gt : 0.0;
  const double elastic = -law.kt * spring;
  const double trial = (elastic - gt * slip) / (1.0 + gt * contact.tangentialCompliance);
  const double tested = law.dashpotOutsideBound ? elastic : trial;
  if (std::abs(tested) <= bound) {
    spring += (1.0 - share) * slip * dt;
    return {normal, trial, false};
  }
  const double force = bound * sign(tested);
  if (law.kt > 0.0) spring = -(law.resetSpringOnly ? force + gt * slip : force) / law.kt;
  if (law.stretch == Stretch::midpoint) spring += 0.5 * slip * dt;
  return {normal, force, true};
}

/// The force on i. `spring` is ξ, kept as long as the contact lasts.
inline ContactForce contactForce(const Law& law, const ContactMotion& contact, double& spring,
                                 double dt) {
  const double normal = normalForce(law, contact);
  const double bound = coulombBound(law, normal);
  const double slip = contact.tangentialVelocity;
  switch (law.tangential) {
    case Tangential::none:
      return {normal, 0.0, false};
    case Tangential::coulomb:  // Eq. 4.16
      return {normal, -bound * sign(slip), true};
    case Tangential::viscous: {  // Eq. 4.18
      const double trial = law.gt * std::abs(slip) / (1.0 + law.gt * contact.tangentialCompliance);
      return {normal, -std::min(trial, bound) * sign(slip), trial > bound};
    }
    case Tangential::spring:
    case Tangential::springDashpot:
      break;
  }
  return springForce(law, contact, normal, bound, spring, dt);
}

}  // namespace grain

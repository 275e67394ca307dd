#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engines/grain/real.hpp"
#include "law/contact_law.hpp"

namespace grain {

// The law of a scene as cases have it: its options, constants, signs and equations.
using namespace crossgrain::contact_law;

/// The part of v_t dt that ξ has grown by when the force is evaluated.
template <class Real>
GRAIN_INLINE constexpr Real partBefore(SpringUpdate when) {
  return when == SpringUpdate::after ? Real(0) : when == SpringUpdate::before ? Real(1) : Real(0.5);
}

/// Rigid disks have no springs: their friction is Coulomb's.
inline TangentialLaw tangentialOf(const ContactLaw& law) {
  return law.soft() ? law.tangential : TangentialLaw::coulomb;
}
/// Whether any torque acts on disks.
inline bool turnsDisks(const ContactLaw& law) {
  return law.friction() || law.rolls();
}

/// Euler's velocities belong to the same time as positions, so that there is nothing to predict.
inline DampingVelocity dampingVelocity(const ContactLaw& law) {
  const LawConventions& how = law.conventions;
  return how.integrator == Integrator::semiImplicitEuler ? DampingVelocity::lagged
                                                         : how.dampingVelocity;
}

/// Motion of one contact that the law sees.
template <class Real>
struct ContactMotion {
  Real overlap;             ///< δ [m]
  Real normalVelocity;      ///< v_n [m/s]
  Real tangentialVelocity;  ///< v_t [m/s]
  Real normalCompliance;    ///< dt/2 · (1/m_i + 1/m_j); read by implicit damping [s/kg]
  /// dt/2 · (1/m_i + 1/m_j + c_i l_i/J_i + c_j l_j/J_j), likewise [s/kg]
  Real tangentialCompliance;
  Real radius = 0;  ///< R₁₂ = a_i a_j/(a_i + a_j); read by Hertz' law and cohesion [m]
  Real reach = 0;   ///< a_i + a_j; 0: a plane; read by cohesion [m]
  Real mass = 0;    ///< m₁₂ = m_i m_j/(m_i + m_j); read by critical dampers [kg]
};

/// The same of its rolling.
template <class Real>
struct RollingMotion {
  Real spin;         ///< ω_r = ω_i − ω_j [rad/s]
  Real length;       ///< L [m]
  Real square;       ///< factor of k_r's constant [m²] or 1
  Real inertia = 0;  ///< I; read by critical dampers [kg m²]
};

template <class Real>
struct RollingTorque {
  Real torque;   ///< M on i; −M on j [N m]
  Real sliding;  ///< 1 where the bound holds, else 0
};

template <class Real>
struct ContactForce {
  Real normal;      ///< f_n [N]
  Real tangential;  ///< f_t [N]
  Real sliding;     ///< 1 where the Coulomb bound holds, else 0
  Real load;        ///< load in the bounds, in place of f_n [N]
};

/// Bodies of several materials: the law of each two of them.
struct Materials {
  std::vector<std::int32_t> ofDisk, ofWall;  ///< of each disk, and of each wall with all it has
  std::size_t count = 0;
  /// Of a and b at a · count + b; symmetric. They have Setup::law's options and no effect that it
  /// has not; other constants.
  std::vector<ContactLaw> laws;
};

/// Of two materials: without friction no spring and no dashpot acts along the tangent.
inline ContactLaw lawOfPair(ContactLaw law) {
  if (!(law.mu > 0.0)) law.kt = law.gt = 0.0;
  return law;
}

}  // namespace grain

#pragma once

#include "engines/grain/law.hpp"

namespace grain {

// How stiff a contact is and how much it damps, by its overlap. `L` as in contact_force.hpp.

/// f_el(δ). Hertz: 4/3 E₁₂ √R₁₂ δ^(3/2) (Johnson 1985, Eq. 4.22), and no further than its own root
/// for pairs that do not touch. @see Normal
template <class L, class Real>
GRAIN_INLINE Real elasticForce(const L& law, const ContactMotion<Real>& contact) {
  const Real overlap = contact.overlap;
  if (law.normal == NormalLaw::linear) return law.kn * overlap;
  if (law.normal == NormalLaw::rigid) return Real(0);
  if (law.normal == NormalLaw::polynomial) return (law.kn + law.kn3 * overlap) * overlap * overlap;
  return law.kn * squareRoot(contact.radius * larger(overlap, Real(0))) * overlap;
}

/// f_el′(δ).
template <class L, class Real>
GRAIN_INLINE Real normalStiffness(const L& law, const ContactMotion<Real>& contact) {
  const Real overlap = larger(contact.overlap, Real(0));
  if (law.normal == NormalLaw::linear) return law.kn;
  if (law.normal == NormalLaw::polynomial)
    return (Real(2) * law.kn + Real(3) * law.kn3 * overlap) * overlap;
  return Real(1.5) * law.kn * squareRoot(contact.radius * overlap);
}

/// a of a contact under JKR [m]. @see adhesion.hpp
template <class L, class Real>
Real jkrRadius(const L& law, const ContactMotion<Real>& contact);

/// Hertz–Mindlin: 8 G₁₂ a, a = √(R₁₂ δ) (Johnson 1985, Eq. 7.43), or JKR's (Thornton 1991).
template <class L, class Real>
GRAIN_INLINE Real tangentialStiffness(const L& law, const ContactMotion<Real>& contact) {
  if (law.normal != NormalLaw::hertz) return law.kt;
  if (law.cohesion == CohesionLaw::jkr) return law.kt * jkrRadius(law, contact);
  return law.kt * squareRoot(contact.radius * larger(contact.overlap, Real(0)));
}

/// γ that multiplies the velocity [kg/s]. @see Damper
template <class L, class Real>
GRAIN_INLINE Real damping(const L& law, const ContactMotion<Real>& contact, Real constant,
                          Real stiffness) {
  if (law.damper == Damper::constant) return constant;
  if (law.damper == Damper::viscoelastic) return constant * stiffness;
  return constant * squareRoot(contact.mass * larger(stiffness, Real(0)));
}

template <class L, class Real>
GRAIN_INLINE Real normalDamping(const L& law, const ContactMotion<Real>& contact) {
  const bool constant = law.damper == Damper::constant;
  return damping(law, contact, law.gn, constant ? Real(0) : normalStiffness(law, contact));
}

template <class L, class Real>
GRAIN_INLINE Real tangentialDamping(const L& law, const ContactMotion<Real>& contact) {
  const bool constant = law.damper == Damper::constant;
  return damping(law, contact, law.gt, constant ? Real(0) : tangentialStiffness(law, contact));
}

/// ∫ f_el dδ + ½ k_t ξ² (of a remembered force f²/(2 k_t)) [J].
template <class L, class Real>
Real storedEnergy(const L& law, const ContactMotion<Real>& contact, Real spring) {
  const Real overlap = contact.overlap;
  if (law.normal == NormalLaw::rigid) return Real(0);
  Real normal = Real(0.5) * law.kn * overlap * overlap;
  if (law.normal == NormalLaw::hertz) normal = Real(0.4) * elasticForce(law, contact) * overlap;
  if (law.normal == NormalLaw::polynomial)
    normal = (law.kn / Real(3) + law.kn3 / Real(4) * overlap) * overlap * overlap * overlap;
  const Real stiffness = tangentialStiffness(law, contact);
  if (!(stiffness > Real(0))) return normal;
  const Real stretch = law.history == History::force ? spring / stiffness : spring;
  return normal + Real(0.5) * stiffness * stretch * stretch;
}

}  // namespace grain

#pragma once

#include <algorithm>
#include <cmath>

#include "law/contact_law.hpp"

namespace box2d_granular {

// The law of a scene as cases have it. Of soft ones this engine has the linear and Hertz' with
// their springs and dashpots.
using namespace crossgrain::contact_law;

/// Motion of one contact that the law sees.
struct PairMotion {
  double overlap;             ///< δ [m]
  double normalVelocity;      ///< v_n [m/s]
  double tangentialVelocity;  ///< v_t [m/s]
  double dt;                  ///< [s]
  double radius = 0.0;        ///< R₁₂; read by Hertz' law [m]
  double mass = 0.0;          ///< m₁₂; read by critical dampers [kg]
};

struct ContactForce {
  double normal = 0.0;      ///< f_n [N]
  double tangential = 0.0;  ///< f_t [N]
  bool sliding = false;
};

/// f_el, f_el′ and k_t at an overlap.
struct Stiffness {
  double force, normal, tangential;
};
inline Stiffness stiffnessAt(const ContactLaw& law, double overlap, double radius) {
  if (law.normal == NormalLaw::linear) return {law.kn * overlap, law.kn, law.kt};
  const double root = std::sqrt(radius * std::max(overlap, 0.0));
  return {law.kn * root * overlap, 1.5 * law.kn * root, law.kt * root};
}

inline double dampingOf(Damper damper, double constant, double stiffness, double mass) {
  switch (damper) {
    case Damper::viscoelastic:
      return constant * stiffness;
    case Damper::critical:
      return constant * std::sqrt(mass * stiffness);
    case Damper::constant:
      break;
  }
  return constant;
}

/// Whether a contact remembers its tangential force, not ξ.
inline bool remembersForce(const ContactLaw& law) {
  return law.normal == NormalLaw::hertz && law.conventions.history == History::force;
}

/// The force on i (Lätzel 2003, Eqs. 4.9, 4.16, 4.18, 4.20 and 4.22–4.25).
/// @tparam Damped  whether γ_n > 0
/// @tparam T       which tangential law; `law.tangential` is not looked at
/// @param spring   ξ [m] or the force [N], kept as long as the contact lasts
template <bool Damped, TangentialLaw T>
ContactForce contactForce(const ContactLaw& law, const PairMotion& motion, double& spring) {
  const LawConventions& how = law.conventions;
  const Stiffness at = stiffnessAt(law, motion.overlap, motion.radius);
  double normal = at.force;
  if constexpr (Damped)
    normal -= dampingOf(law.damper, law.gn, at.normal, motion.mass) * motion.normalVelocity;
  if (how.tension == Tension::cut) normal = std::max(normal, 0.0);
  if constexpr (T == TangentialLaw::none) return {normal};

  const double carrying = how.coulombBound == CoulombBound::compression ? std::max(normal, 0.0)
                          : how.coulombBound == CoulombBound::magnitude ? std::abs(normal)
                                                                        : normal;
  const double bound = law.mu * carrying, vt = motion.tangentialVelocity;
  const auto sign = [](double value) { return (value > 0.0) - (value < 0.0); };
  if constexpr (T == TangentialLaw::coulomb) return {normal, -bound * sign(vt), true};
  const double gt = dampingOf(law.damper, law.gt, at.tangential, motion.mass);
  if constexpr (T == TangentialLaw::viscous) {
    const double trial = gt * std::abs(vt);
    return {normal, -std::min(trial, bound) * sign(vt), trial > bound};
  }

  const bool before = how.springUpdate == SpringUpdate::before;
  const bool ofForce = remembersForce(law);
  const double stiffness = ofForce ? 1.0 : at.tangential;
  const double stretch = (ofForce ? at.tangential : 1.0) * vt * motion.dt;
  if (before) spring += stretch;
  const double elastic = -stiffness * spring;
  const double viscous = T == TangentialLaw::springDashpot ? -gt * vt : 0.0;
  const double trial = elastic + viscous;
  const double tested = how.dashpot == Dashpot::outside ? elastic : trial;
  if (std::abs(tested) <= bound) {
    if (!before) spring += stretch;
    return {normal, trial, false};
  }
  const double force = bound * sign(tested);
  const bool springOnly = how.springReset == SpringReset::springOnly;
  if (stiffness > 0.0) spring = -(springOnly ? force - viscous : force) / stiffness;
  return {normal, force, true};
}

/// Stored in a contact: f_el and the spring [J].
inline double storedEnergy(const ContactLaw& law, double overlap, double radius, double spring) {
  const Stiffness at = stiffnessAt(law, overlap, radius);
  const double elastic = at.force * overlap * (law.normal == NormalLaw::linear ? 0.5 : 0.4);
  if (!(at.tangential > 0.0)) return elastic;
  return elastic +
         0.5 * spring * spring * (remembersForce(law) ? 1.0 / at.tangential : at.tangential);
}

/// Calls f.template operator()<Damped, T>() with the parts that the law really has.
template <typename F>
auto withPartsOf(const ContactLaw& law, F&& f) {
  const auto damped = [&]<bool Damped>() {
    switch (law.friction() ? law.tangential : TangentialLaw::none) {
      case TangentialLaw::coulomb:
        return f.template operator()<Damped, TangentialLaw::coulomb>();
      case TangentialLaw::viscous:
        return f.template operator()<Damped, TangentialLaw::viscous>();
      case TangentialLaw::spring:
        return f.template operator()<Damped, TangentialLaw::spring>();
      case TangentialLaw::springDashpot:
        return f.template operator()<Damped, TangentialLaw::springDashpot>();
      case TangentialLaw::none:
        break;
    }
    return f.template operator()<Damped, TangentialLaw::none>();
  };
  return law.gn > 0.0 ? damped.template operator()<true>() : damped.template operator()<false>();
}

}  // namespace box2d_granular

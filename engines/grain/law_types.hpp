#pragma once

#include "engines/grain/law.hpp"

namespace grain {

/// The constants of a law, in the precision of the state.
template <class Real>
struct LawConstants {
  Real kn, kn3, gn, kt, inverseKt, gt, mu;
  Real dt;        ///< [s]
  Real halfStep;  ///< dt/2 of implicit damping; 0 where nothing is implied, at t = 0 [s]
};

/// Every option at run time: the reference that each specialised law must match to the bit, and
/// what runs the conventions of other engines.
template <class Real>
struct GeneralLaw : LawConstants<Real> {
  Normal normal;
  Damper damper;
  History history;
  Tangential tangential;
  Bound bound;
  Lever lever, velocityLever;
  PlaneLever planeLever;
  Stretch stretch;
  bool cutTension, normalDamping, implicitDamping, dashpotOutsideBound, resetSpringOnly, rotation;
};

/// The thesis' conventions with the effects of a scene as constants: what the scene does not call
/// for is not compiled.
template <class Real, Tangential T, bool CutTension, bool NormalDamping, bool Rotation>
struct EffectsLaw : LawConstants<Real> {
  static constexpr Tangential tangential = T;
  static constexpr bool cutTension = CutTension;
  static constexpr bool normalDamping = NormalDamping;
  static constexpr bool rotation = Rotation;
  static constexpr Normal normal = Normal::linear;
  static constexpr Damper damper = Damper::constant;
  static constexpr History history = History::displacement;
  static constexpr Bound bound = Bound::compression;
  static constexpr Lever lever = Lever::radius;
  static constexpr Lever velocityLever = Lever::radius;
  static constexpr PlaneLever planeLever = PlaneLever::surface;
  static constexpr Stretch stretch = Stretch::after;
  static constexpr bool implicitDamping = false;
  static constexpr bool dashpotOutsideBound = false;
  static constexpr bool resetSpringOnly = false;

  explicit EffectsLaw(const GeneralLaw<Real>& general) : LawConstants<Real>(general) {}
};

/// Whether EffectsLaw has the law's conventions, so that only effects remain to be chosen.
template <class Real>
bool hasThesisConventions(const GeneralLaw<Real>& law) {
  return law.normal == Normal::linear && law.damper == Damper::constant &&
         law.history == History::displacement && law.bound == Bound::compression &&
         law.lever == Lever::radius && law.velocityLever == Lever::radius &&
         law.stretch == Stretch::after && !law.implicitDamping && !law.dashpotOutsideBound &&
         !law.resetSpringOnly;
}

/// Whether a law asks for the compliances of ContactMotion.
template <class L>
GRAIN_INLINE constexpr bool seesCompliances(const L& law) {
  return law.implicitDamping;
}

/// Whether a law asks for inverse masses.
template <class L>
GRAIN_INLINE constexpr bool seesMasses(const L& law) {
  return seesCompliances(law) || law.damper == Damper::critical;
}

template <class Real>
GeneralLaw<Real> generalLaw(const Law& law, double dt, bool rotation) {
  GeneralLaw<Real> to;
  to.kn = static_cast<Real>(law.kn);
  to.kn3 = static_cast<Real>(law.kn3);
  to.gn = static_cast<Real>(law.gn);
  to.kt = static_cast<Real>(law.kt);
  to.inverseKt = static_cast<Real>(law.kt > 0.0 ? 1.0 / law.kt : 0.0);
  to.gt = static_cast<Real>(law.gt);
  to.mu = static_cast<Real>(law.mu);
  to.dt = static_cast<Real>(dt);
  to.halfStep = static_cast<Real>(0.5 * dt);
  to.normal = law.normal;
  to.damper = law.damper;
  to.history = law.history;
  to.tangential = law.friction() ? law.tangential : Tangential::none;
  to.bound = law.bound;
  to.lever = law.lever;
  to.velocityLever = law.velocityLever.value_or(law.lever);
  to.planeLever = law.planeLever;
  to.stretch = law.stretch;
  to.cutTension = law.cutTension;
  to.normalDamping = law.gn > 0.0;
  to.implicitDamping = law.damping == Damping::implicit;
  to.dashpotOutsideBound = law.dashpotOutsideBound;
  to.resetSpringOnly = law.resetSpringOnly;
  to.rotation = law.friction() && rotation;
  return to;
}

}  // namespace grain

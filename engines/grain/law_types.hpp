#pragma once

#include <cstddef>
#include <iterator>
#include <optional>
#include <type_traits>

#include "engines/grain/law.hpp"

namespace grain {

/// The constants of a law, in the precision of the state.
template <class Real>
struct LawConstants {
  Real kn, kn3, gn, kt, inverseKt, gt, mu;
  Real kr, gr, muR;
  Real kc, w, k2, plasticDepth;
  Real dt;        ///< [s]
  Real halfStep;  ///< dt/2 of implicit damping; 0 where nothing is implied, at t = 0 [s]
};

/// The effects of a scene that decide which kernels it runs.
struct ContactEffects {
  Tangential tangential;
  bool cutTension, normalDamping, rotation;
  bool rollingSpring = false, cohesion = false;  ///< Cohesion::area
};

/// What engines differ in that simulate the same effects of the linear law.
struct Conventions {
  History history = History::displacement;
  Bound bound = Bound::compression;
  Lever lever = Lever::radius, velocityLever = Lever::radius;
  PlaneLever planeLever = PlaneLever::surface;  ///< of levers that are not the radius
  Stretch stretch = Stretch::after;
  bool implicitDamping = false, dashpotOutsideBound = false, resetSpringOnly = false;
  RollingConventions rollingConventions = {};
  CohesionConventions cohesionConventions = {};

  bool operator==(const Conventions&) const = default;
};

/// Those that have kernels of their own; any others run the general ones, at a third of the speed.
inline constexpr Conventions conventionSets[] = {{},  // the thesis'
                                                      // YADE's, whose mirror carries its packings.
                                                 {.history = History::force,
                                                  .lever = Lever::overlapMiddle,
                                                  .velocityLever = Lever::overlapMiddle,
                                                  .stretch = Stretch::before,
                                                  .dashpotOutsideBound = true}};

/// Every option at run time: the reference that each specialised law must match to the bit, and
/// what runs laws and conventions that have no kernels of their own.
template <class Real>
struct GeneralLaw : LawConstants<Real>, Conventions {
  Normal normal;
  Damper damper;
  Tangential tangential;
  bool cutTension, normalDamping, rotation;
  Rolling rolling;
  Cohesion cohesion;
};

/// The linear law under some conventions, with the effects of a scene as constants: what the scene
/// does not call for is not compiled.
template <class Real, ContactEffects E, Conventions C>
struct EffectsLaw : LawConstants<Real> {
  static constexpr Tangential tangential = E.tangential;
  static constexpr bool cutTension = E.cutTension;
  static constexpr bool normalDamping = E.normalDamping;
  static constexpr bool rotation = E.rotation;
  static constexpr Normal normal = Normal::linear;
  static constexpr Damper damper = Damper::constant;
  static constexpr History history = C.history;
  static constexpr Bound bound = C.bound;
  static constexpr Lever lever = C.lever;
  static constexpr Lever velocityLever = C.velocityLever;
  static constexpr PlaneLever planeLever = C.planeLever;
  static constexpr Stretch stretch = C.stretch;
  static constexpr bool implicitDamping = C.implicitDamping;
  static constexpr bool dashpotOutsideBound = C.dashpotOutsideBound;
  static constexpr bool resetSpringOnly = C.resetSpringOnly;
  static constexpr Rolling rolling = E.rollingSpring ? Rolling::spring : Rolling::none;
  static constexpr RollingConventions rollingConventions = C.rollingConventions;
  static constexpr Cohesion cohesion = E.cohesion ? Cohesion::area : Cohesion::none;
  static constexpr CohesionConventions cohesionConventions = C.cohesionConventions;

  EffectsLaw() = default;
  explicit EffectsLaw(const GeneralLaw<Real>& general) : LawConstants<Real>(general) {}
};

/// A law whose constants are those of each pair's materials.
template <class L>
struct OfMaterials : L {
  static constexpr bool ofMaterials = true;

  OfMaterials() = default;
  template <class Real>
  explicit OfMaterials(const GeneralLaw<Real>& general) : L(general) {}
};

template <class L>
concept HasMaterials = requires {
  L::ofMaterials;
};

/// The law without its constants. A law copied as a whole would stand in memory, where the compiler
/// leaves it: its constants are each to be a vector.
template <class L>
GRAIN_INLINE L onlySteps(const L& law) {
  if constexpr (std::is_member_object_pointer_v<decltype(&L::planeLever)>) {  // the general one:
                                                                              // its options too
    return law;
  } else {
    L own;
    own.dt = law.dt;
    own.halfStep = law.halfStep;
    return own;
  }
}

/// How many constants pairs can differ in.
inline constexpr std::size_t pairConstants = 14;

/// Calls visit(which, member) for each of them that the law has a use for; which < pairConstants.
template <class L, class Visit>
GRAIN_INLINE void forPairConstants(const L& law, Visit&& visit) {
  using Constants = LawConstants<std::remove_cvref_t<decltype(law.kn)>>;
  const bool springs =
      law.tangential == Tangential::spring || law.tangential == Tangential::springDashpot;
  const bool dashpots =
      law.tangential == Tangential::viscous || law.tangential == Tangential::springDashpot;
  visit(0, &Constants::kn);
  if (law.normal == Normal::polynomial) visit(1, &Constants::kn3);
  if (law.normalDamping) visit(2, &Constants::gn);
  if (law.tangential != Tangential::none) visit(3, &Constants::mu);
  if (springs) {
    visit(4, &Constants::kt);
    visit(5, &Constants::inverseKt);
  }
  if (dashpots) visit(6, &Constants::gt);
  if (law.rolling != Rolling::none) {
    visit(7, &Constants::kr);
    visit(8, &Constants::gr);
    visit(9, &Constants::muR);
  }
  if (law.cohesion == Cohesion::none) return;
  visit(10, &Constants::kc);
  if (law.cohesion == Cohesion::dmt || law.cohesion == Cohesion::jkr) visit(11, &Constants::w);
  if (law.cohesion != Cohesion::elastoPlastic) return;
  visit(12, &Constants::k2);
  visit(13, &Constants::plasticDepth);
}

/// Which of conventionSets a law has, so that only effects remain to be chosen; absent: none.
template <class Real>
std::optional<std::size_t> conventionSet(const GeneralLaw<Real>& law) {
  if (law.normal != Normal::linear || law.damper != Damper::constant) return std::nullopt;
  if (law.rolling != Rolling::none && law.rolling != Rolling::spring) return std::nullopt;
  if (law.cohesion != Cohesion::none && law.cohesion != Cohesion::area) return std::nullopt;
  for (std::size_t set = 0; set < std::size(conventionSets); ++set)
    if (static_cast<const Conventions&>(law) == conventionSets[set]) return set;
  return std::nullopt;
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

/// Whether a law has a memory besides its springs. @see Law::remembers
template <class L>
GRAIN_INLINE constexpr bool remembers(const L& law) {
  return law.cohesion == Cohesion::jkr || law.cohesion == Cohesion::elastoPlastic;
}

/// @see Law::remembersRest
template <class L>
GRAIN_INLINE constexpr bool remembersRest(const L& law) {
  return law.cohesion == Cohesion::elastoPlastic &&
         law.cohesionConventions.unloading == UnloadingStiffness::lagged;
}

/// Whether a law asks for the inertia of RollingMotion.
template <class L>
GRAIN_INLINE constexpr bool seesRollingInertia(const L& law) {
  return law.rolling == Rolling::spring && law.rollingConventions.damper == RollingDamper::critical;
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
  // A lever that is the radius is that on planes, too.
  if (to.lever != Lever::radius || to.velocityLever != Lever::radius)
    to.planeLever = law.planeLever;
  to.stretch = law.stretch;
  to.cutTension = law.cutTension;
  to.normalDamping = law.gn > 0.0;
  to.implicitDamping = law.damping == Damping::implicit;
  to.dashpotOutsideBound = law.dashpotOutsideBound;
  to.resetSpringOnly = law.resetSpringOnly;
  to.rotation = law.turnsDisks() && rotation;
  to.kr = static_cast<Real>(law.kr);
  to.gr = static_cast<Real>(law.gr);
  to.muR = static_cast<Real>(law.muR);
  to.kc = static_cast<Real>(law.kc);
  to.w = static_cast<Real>(law.w);
  to.k2 = static_cast<Real>(law.k2);
  to.plasticDepth = static_cast<Real>(law.plasticDepth);
  to.cohesion = law.cohesion;
  if (to.cohesion != Cohesion::none) to.cohesionConventions = law.cohesionConventions;
  to.rolling = to.rotation ? law.rolling : Rolling::none;
  if (to.rolling != Rolling::none) to.rollingConventions = law.rollingConventions;
  return to;
}

}  // namespace grain

#pragma once

#include <cstddef>
#include <iterator>
#include <limits>
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

/// Options of a law as numbers that multiply or limit: every kernel has all of them, and none asks
/// which one is on. Of those that exclude each other one is not 0, so that adding up the others'
/// zeros changes no bit.
template <class Real>
struct LawOptions {
  Real leastForce;  ///< of f_n: 0 where tension is cut, else −∞ [N]
  Real ofPull;      ///< the share of |f_n| in Coulomb's bound while bodies pull: 0, 1
  // CohesionArea: A = lens · the lens + disks · π R₁₂ δ; at a plane `walls` in place of `disks`.
  Real lens, disks, walls;
  // CohesionLoad of CohesionLaw::area: f_n, less the pull, |f_n|, f_n without its dashpot.
  Real net, lessPull, size, body;
  // RollingLength, of R₁₂, the smaller radius and the mean; RollingStiffness, of L², a_i a_j and 1.
  Real effective, smallest, mean, ofLength, ofRadii, ofNothing;
  // RollingLoad: f_n, |f_n|, f_el; a spring is limited where its bound is larger than `unlimited`.
  Real rollingNet, rollingSize, rollingElastic, unlimited;
  // Of Rolling without a spring: constantTorque, viscous, viscousByLoad.
  Real constantTorque, viscous, viscousByLoad;
  // Of a rolling spring: the dashpot's share of what is held against the bound, and of what is left
  // out of the spring where it slips.
  Real dashpotTested, dashpotLeftOut;
};

/// How contacts resist rolling, as far as kernels differ.
enum class Rolls {
  none,
  withoutSpring,
  spring,
  criticalSpring  ///< RollingDamper::critical
};
inline constexpr std::size_t rollsCount = 4;

/// The effects of a scene that decide which kernels it runs.
struct ContactEffects {
  TangentialLaw tangential;
  bool normalDamping, rotation;
  Rolls rolling = Rolls::none;
  bool cohesion = false;  ///< CohesionLaw::area
};

/// Differences of engines that simulate the same effects of the linear law, and no number of
/// LawOptions makes.
struct Conventions {
  History history = History::displacement;
  bool signedBound = false;  ///< CoulombBound::signedForce
  LeverArm lever = LeverArm::radius, velocityLever = LeverArm::radius;
  PlaneArm planeLever = PlaneArm::surface;  ///< of levers that are not the radius
  SpringUpdate stretch = SpringUpdate::after;
  bool implicitDamping = false, dashpotOutsideBound = false, resetSpringOnly = false;

  bool operator==(const Conventions&) const = default;
};

struct ConventionSet {
  Conventions conventions;
  bool everyEffect;  ///< each may be left out; else only whole laws have kernels
};

/// Those that have kernels of their own, in the plane and in space; any others run the general
/// ones, at a third of the speed.
inline constexpr ConventionSet conventionSets[] = {{{}, true},  // the thesis'
                                                                // A case's that names none.
                                                   {{.lever = LeverArm::overlapMiddle,
                                                     .velocityLever = LeverArm::overlapMiddle,
                                                     .stretch = SpringUpdate::before,
                                                     .resetSpringOnly = true},
                                                    true},
                                                   // YADE's, whose mirror carries its packings.
                                                   {{.history = History::force,
                                                     .lever = LeverArm::overlapMiddle,
                                                     .velocityLever = LeverArm::overlapMiddle,
                                                     .stretch = SpringUpdate::before,
                                                     .dashpotOutsideBound = true},
                                                    false}};

/// Every option at run time: the reference that each specialised law must match to the bit, and
/// what runs laws and conventions that have no kernels of their own.
template <class Real>
struct GeneralLaw : LawConstants<Real>, LawOptions<Real>, Conventions {
  NormalLaw normal;
  Damper damper;
  TangentialLaw tangential;
  bool normalDamping, rotation;
  RollingLaw rolling;
  CohesionLaw cohesion;
  LawConventions conventions;  ///< those of rolling and cohesion are read
};

/// The linear law under some conventions, with the effects of a scene as constants: what the scene
/// does not call for is not compiled.
template <class Real, ContactEffects E, Conventions C>
struct EffectsLaw : LawConstants<Real>, LawOptions<Real> {
  static constexpr TangentialLaw tangential = E.tangential;
  static constexpr bool normalDamping = E.normalDamping;
  static constexpr bool rotation = E.rotation;
  static constexpr NormalLaw normal = NormalLaw::linear;
  static constexpr Damper damper = Damper::constant;
  static constexpr History history = C.history;
  static constexpr bool signedBound = C.signedBound;
  static constexpr LeverArm lever = C.lever;
  static constexpr LeverArm velocityLever = C.velocityLever;
  static constexpr PlaneArm planeLever = C.planeLever;
  static constexpr SpringUpdate stretch = C.stretch;
  static constexpr bool implicitDamping = C.implicitDamping;
  static constexpr bool dashpotOutsideBound = C.dashpotOutsideBound;
  static constexpr bool resetSpringOnly = C.resetSpringOnly;
  static constexpr RollingLaw rolling = E.rolling == Rolls::none ? RollingLaw::none
                                        : E.rolling == Rolls::withoutSpring
                                            ? RollingLaw::constantTorque
                                            : RollingLaw::spring;
  static constexpr CohesionLaw cohesion = E.cohesion ? CohesionLaw::area : CohesionLaw::none;
  static constexpr LawConventions conventions{.rollingDamper = E.rolling == Rolls::criticalSpring
                                                                   ? RollingDamper::critical
                                                                   : RollingDamper::constant};

  EffectsLaw() = default;
  explicit EffectsLaw(const GeneralLaw<Real>& general)
      : LawConstants<Real>(general), LawOptions<Real>(general) {}
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

/// Whether contacts remember a tangential spring.
template <class L>
GRAIN_INLINE constexpr bool hasSprings(const L& law) {
  return law.tangential == TangentialLaw::spring || law.tangential == TangentialLaw::springDashpot;
}

/// How many constants pairs can differ in.
inline constexpr std::size_t pairConstants = 14;

/// Calls visit(which, member) for each of them that the law has a use for; which < pairConstants.
template <class L, class Visit>
GRAIN_INLINE void forPairConstants(const L& law, Visit&& visit) {
  using Constants = LawConstants<std::remove_cvref_t<decltype(law.kn)>>;
  const bool dashpots =
      law.tangential == TangentialLaw::viscous || law.tangential == TangentialLaw::springDashpot;
  visit(0, &Constants::kn);
  if (law.normal == NormalLaw::polynomial) visit(1, &Constants::kn3);
  if (law.normalDamping) visit(2, &Constants::gn);
  if (law.tangential != TangentialLaw::none) visit(3, &Constants::mu);
  if (hasSprings(law)) {
    visit(4, &Constants::kt);
    visit(5, &Constants::inverseKt);
  }
  if (dashpots) visit(6, &Constants::gt);
  if (law.rolling != RollingLaw::none) {
    visit(7, &Constants::kr);
    visit(8, &Constants::gr);
    visit(9, &Constants::muR);
  }
  if (law.cohesion == CohesionLaw::none) return;
  visit(10, &Constants::kc);
  if (law.cohesion == CohesionLaw::dmt || law.cohesion == CohesionLaw::jkr)
    visit(11, &Constants::w);
  if (law.cohesion != CohesionLaw::elastoPlastic) return;
  visit(12, &Constants::k2);
  visit(13, &Constants::plasticDepth);
}

/// Calls visit(member) for each number of LawOptions that pairs of bodies have a use for.
template <class L, class Visit>
GRAIN_INLINE void forPairOptions(const L& law, Visit&& visit) {
  using Options = LawOptions<std::remove_cvref_t<decltype(law.dt)>>;
  visit(&Options::leastForce);
  if (law.tangential != TangentialLaw::none) visit(&Options::ofPull);
  if (law.cohesion == CohesionLaw::area) {
    visit(&Options::lens);
    visit(&Options::disks);
    visit(&Options::walls);
    visit(&Options::net);
    visit(&Options::lessPull);
    visit(&Options::size);
    visit(&Options::body);
  }
  if (law.rolling == RollingLaw::none) return;
  visit(&Options::effective);
  visit(&Options::smallest);
  visit(&Options::mean);
  visit(&Options::ofLength);
  visit(&Options::ofRadii);
  visit(&Options::ofNothing);
  visit(&Options::rollingNet);
  visit(&Options::rollingSize);
  visit(&Options::rollingElastic);
  visit(&Options::unlimited);
  visit(&Options::constantTorque);
  visit(&Options::viscous);
  visit(&Options::viscousByLoad);
  visit(&Options::dashpotTested);
  visit(&Options::dashpotLeftOut);
}

/// A law that has its conventions at run time.
template <class L>
concept DecidedAtRunTime = std::is_member_object_pointer_v<decltype(&L::planeLever)>;

/// The law without its constants. A law copied as a whole would stand in memory, where the compiler
/// leaves it: its constants are each to be a vector.
template <class L>
GRAIN_INLINE L withoutConstants(const L& law) {
  if constexpr (DecidedAtRunTime<L>) {  // its options too
    return law;
  } else {
    L own;
    own.dt = law.dt;
    own.halfStep = law.halfStep;
    forPairOptions(law, [&](auto member) GRAIN_INLINE_LAMBDA { own.*member = law.*member; });
    return own;
  }
}

/// A pair's own law: of a law without materials that one itself.
template <class L, class Block>
GRAIN_INLINE const L& lawOfPair(const L& law, const Block&, std::size_t) {
  return law;
}
template <HasMaterials L, class Block>
GRAIN_INLINE L lawOfPair(const L& law, const Block& b, std::size_t p) {
  L own = withoutConstants(law);
  forPairConstants(law, [&](std::size_t which, auto member)
                            GRAIN_INLINE_LAMBDA { own.*member = b.constants[which][p]; });
  return own;
}

inline constexpr std::size_t effectVariants = 5 * 2 * 2 * rollsCount * 2;
inline constexpr std::size_t contactVariants = std::size(conventionSets) * effectVariants;

/// @param set  of conventionSets
constexpr std::size_t indexOf(const ContactEffects& e, std::size_t set) {
  const std::size_t tangential = set * 5 + static_cast<std::size_t>(e.tangential);
  const std::size_t turning = (tangential * 2 + e.normalDamping) * 2 + e.rotation;
  return (turning * rollsCount + static_cast<std::size_t>(e.rolling)) * 2 + e.cohesion;
}
constexpr ContactEffects contactEffects(std::size_t index) {
  const std::size_t turning = index / (2 * rollsCount);
  return {static_cast<TangentialLaw>(turning / 4 % 5), turning / 2 % 2 == 1, turning % 2 == 1,
          static_cast<Rolls>(index / 2 % rollsCount), index % 2 == 1};
}

/// Which kernels a law runs: its effects under one of conventionSets, as indexOf() numbers them;
/// absent: the general ones.
template <class Real>
std::optional<std::size_t> contactVariant(const GeneralLaw<Real>& law) {
  if (law.normal != NormalLaw::linear || law.damper != Damper::constant) return std::nullopt;
  if (law.cohesion != CohesionLaw::none && law.cohesion != CohesionLaw::area) return std::nullopt;
  const bool critical = law.conventions.rollingDamper == RollingDamper::critical;
  const Rolls rolls = law.rolling == RollingLaw::none     ? Rolls::none
                      : law.rolling != RollingLaw::spring ? Rolls::withoutSpring
                      : critical                          ? Rolls::criticalSpring
                                                          : Rolls::spring;
  for (std::size_t set = 0; set < std::size(conventionSets); ++set)
    if (static_cast<const Conventions&>(law) == conventionSets[set].conventions)
      return indexOf({law.tangential, law.normalDamping, law.rotation, rolls,
                      law.cohesion == CohesionLaw::area},
                     set);
  return std::nullopt;
}

/// The kernel of a law's effects, or that of the same with the dashpots that it lacks, which are 0.
/// @return null where neither is compiled
template <class Kernel>
Kernel kernelOf(const Kernel (&all)[contactVariants], std::size_t variant) {
  if (all[variant] != nullptr) return all[variant];
  ContactEffects effects = contactEffects(variant);
  effects.normalDamping = true;
  if (effects.tangential == TangentialLaw::spring)
    effects.tangential = TangentialLaw::springDashpot;
  return all[indexOf(effects, variant / effectVariants)];
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

/// Whether contacts remember more than their springs: a bond, or their largest overlap.
template <class L>
GRAIN_INLINE constexpr bool remembers(const L& law) {
  return law.cohesion == CohesionLaw::jkr || law.cohesion == CohesionLaw::elastoPlastic;
}

/// Whether they remember δ₀ besides.
template <class L>
GRAIN_INLINE constexpr bool remembersRest(const L& law) {
  return law.cohesion == CohesionLaw::elastoPlastic &&
         law.conventions.unloadingStiffness == UnloadingStiffness::lagged;
}

/// Whether a law asks for the inertia of RollingMotion.
template <class L>
GRAIN_INLINE constexpr bool seesRollingInertia(const L& law) {
  return law.rolling == RollingLaw::spring &&
         law.conventions.rollingDamper == RollingDamper::critical;
}

template <class Real>
LawOptions<Real> lawOptions(const ContactLaw& law) {
  const auto one = [](bool is) { return is ? Real(1) : Real(0); };
  const LawConventions& how = law.conventions;
  const CohesionArea area = how.cohesionArea;
  const CohesionLoad load = how.cohesionLoad;
  LawOptions<Real> to;
  to.leastForce = how.tension == Tension::cut ? Real(0) : -std::numeric_limits<Real>::infinity();
  to.ofPull = one(how.coulombBound == CoulombBound::magnitude);
  to.lens = one(area == CohesionArea::lens);
  to.walls = area == CohesionArea::lens ? Real(0) : Real(2);
  to.disks = area == CohesionArea::twiceBetweenDisks ? Real(4) : to.walls;
  // Cohesion by area has no pull-off force.
  to.net = one(load == CohesionLoad::net || load == CohesionLoad::withoutPull ||
               load == CohesionLoad::plusTwicePullOff);
  to.lessPull = one(load == CohesionLoad::withoutPull);
  to.size = one(load == CohesionLoad::magnitudePlusPullOff);
  to.body = one(load == CohesionLoad::netWithoutDashpot);
  to.effective = how.rollingLength == RollingLength::effective        ? Real(1)
                 : how.rollingLength == RollingLength::twiceEffective ? Real(2)
                                                                      : Real(0);
  to.smallest = one(how.rollingLength == RollingLength::smallerRadius);
  to.mean = one(how.rollingLength == RollingLength::meanRadius);
  to.ofLength = one(how.rollingStiffness == RollingStiffness::lengthSquare);
  to.ofRadii = one(how.rollingStiffness == RollingStiffness::radii);
  to.ofNothing = one(how.rollingStiffness == RollingStiffness::constant);
  to.rollingNet = one(how.rollingLoad == RollingLoad::compression ||
                      how.rollingLoad == RollingLoad::whileCompressed);
  to.rollingSize = one(how.rollingLoad == RollingLoad::magnitude);
  to.rollingElastic = one(how.rollingLoad == RollingLoad::elastic);
  to.unlimited = how.rollingLoad == RollingLoad::whileCompressed ? Real(0) : Real(-1);
  to.constantTorque = one(law.rolling == RollingLaw::constantTorque);
  to.viscous = one(law.rolling == RollingLaw::viscous);
  to.viscousByLoad = one(law.rolling == RollingLaw::viscousByLoad);
  to.dashpotTested = one(how.rollingDashpot == Dashpot::inside);
  to.dashpotLeftOut = one(how.rollingReset == SpringReset::springOnly);
  return to;
}

template <class Real>
GeneralLaw<Real> generalLaw(const ContactLaw& law, double dt, bool rotation) {
  const LawConventions& how = law.conventions;
  GeneralLaw<Real> to;
  static_cast<LawOptions<Real>&>(to) = lawOptions<Real>(law);
  to.kn = static_cast<Real>(law.kn);
  to.kn3 = static_cast<Real>(law.kn3);
  // A dashpot that is not there is 0: kernels with it serve for a law without.
  to.gn = static_cast<Real>(law.gn > 0.0 ? law.gn : 0.0);
  to.kt = static_cast<Real>(law.kt);
  to.inverseKt = static_cast<Real>(law.kt > 0.0 ? 1.0 / law.kt : 0.0);
  to.gt = static_cast<Real>(tangentialOf(law) == TangentialLaw::spring ? 0.0 : law.gt);
  to.mu = static_cast<Real>(law.mu);
  to.dt = static_cast<Real>(dt);
  to.halfStep = static_cast<Real>(0.5 * dt);
  to.normal = law.normal;
  to.damper = law.damper;
  to.history = how.history;
  to.tangential = law.friction() ? tangentialOf(law) : TangentialLaw::none;
  to.signedBound = how.coulombBound == CoulombBound::signedForce;
  to.lever = how.leverArm;
  to.velocityLever = how.armOfVelocity();
  // A lever that is the radius is that on planes, too.
  if (to.lever != LeverArm::radius || to.velocityLever != LeverArm::radius)
    to.planeLever = how.planeArm;
  to.stretch = how.springUpdate;
  to.normalDamping = law.gn > 0.0;
  to.implicitDamping = dampingVelocity(law) == DampingVelocity::implicit;
  to.dashpotOutsideBound = how.dashpot == Dashpot::outside;
  to.resetSpringOnly = how.springReset == SpringReset::springOnly;
  to.rotation = turnsDisks(law) && rotation;
  to.kr = static_cast<Real>(law.kr);
  to.gr = static_cast<Real>(law.gr);
  to.muR = static_cast<Real>(law.muR);
  to.kc = static_cast<Real>(law.kc);
  to.w = static_cast<Real>(law.w);
  to.k2 = static_cast<Real>(law.kUnload);
  to.plasticDepth = static_cast<Real>(law.plasticDepth);
  to.cohesion = law.cohesion;
  to.rolling = to.rotation ? law.rolling : RollingLaw::none;
  to.conventions = how;
  return to;
}

}  // namespace grain

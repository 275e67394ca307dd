// Every instantiation of the kernels, in one place. Compiled once for each instruction set of
// CMakeLists.txt, which names it in GRAIN_SET.

#include <utility>

#include "engines/grain/contact_kernel.hpp"
#include "engines/grain/motion_kernel.hpp"
#include "engines/grain/plane_kernel.hpp"
#include "engines/grain/space_kernel.hpp"

#define GRAIN_TEXT_(name) #name
#define GRAIN_TEXT(name) GRAIN_TEXT_(name)

namespace grain {
namespace {

/// Without friction and resistance to rolling nothing turns: one kernel for both.
constexpr ContactEffects meaningful(ContactEffects e) {
  e.rotation = e.rotation && (e.tangential != TangentialLaw::none || e.rolling != Rolls::none);
  return e;
}

template <class Real, std::size_t Index>
using LawAt = EffectsLaw<Real, meaningful(contactEffects(Index)),
                         conventionSets[Index / effectVariants].conventions>;

#ifdef GRAIN_RARE_SET
constexpr bool rareSet = true;
#else
constexpr bool rareSet = false;
#endif

/// The compiler's time goes with each kernel. Whole laws have theirs under every set of
/// conventions, and so has what leaves effects out under those of everyEffect; where few processors
/// run the instruction set, only in the plane under the first. A mirror's have no kernels but for
/// the rolling springs that its engine has.
struct Compiled {
  ContactEffects effects;
  bool whole, plain, leavesOut, first, mirror;

  constexpr explicit Compiled(std::size_t index)
      : effects(contactEffects(index)),
        whole(effects.tangential == TangentialLaw::springDashpot && effects.normalDamping &&
              effects.rotation),
        plain(effects.rolling == Rolls::none && !effects.cohesion),
        leavesOut(plain && conventionSets[index / effectVariants].everyEffect),
        first(index < effectVariants),
        mirror(!conventionSets[index / effectVariants].everyEffect) {}

  constexpr bool usualRolling() const {
    return effects.rolling == Rolls::none || effects.rolling == Rolls::spring;
  }
  constexpr bool inPlane() const {
    return (whole && (!mirror || usualRolling())) || (leavesOut && (first || !rareSet));
  }
  /// Few contacts are with planes: under rolling and cohesion the general one will do.
  constexpr bool atPlanes() const { return inPlane() && plain; }
  constexpr bool ofMaterials() const { return whole && !mirror && usualRolling(); }
  /// In space springs follow their normals by the usual conventions: those of a mirror are others.
  constexpr bool inSpace() const { return !mirror && (whole || (leavesOut && !rareSet)); }
};

template <class Real, std::size_t Index>
constexpr ContactKernel<Real> contactKernelAt() {
  if constexpr (Compiled(Index).inPlane()) return &contactKernel<LawAt<Real, Index>, Real>;
  return nullptr;
}

template <class Real, std::size_t Index>
constexpr ContactKernel<Real> materialKernelAt() {
  if constexpr (Compiled(Index).ofMaterials())
    return &contactKernel<OfMaterials<LawAt<Real, Index>>, Real>;
  return nullptr;
}

template <class Real, std::size_t Index>
constexpr PlaneKernel<Real> planeKernelAt() {
  if constexpr (Compiled(Index).atPlanes()) return &planeKernel<LawAt<Real, Index>, Real>;
  return nullptr;
}

/// @tparam Own  the law, or the same with materials
template <class Own, class Bodies, bool IsCompiled>
constexpr SpaceContactKernel<Bodies> spaceKernelOf() {
  if constexpr (IsCompiled) return &space::contactKernel<Own, Bodies>;
  return nullptr;
}

/// A plate's torque needs both a plate and spins.
constexpr std::size_t meaningful(std::size_t index) {
  MotionEffects e = motionEffects(index);
  e.plateSpin = e.plateSpin && e.plate && e.rotation;
  return indexOf(e);
}

template <class Real, std::size_t... C>
constexpr SpaceKernels spaceKernels(std::index_sequence<C...>) {
  using General = GeneralLaw<double>;
  if constexpr (sizeof(Real) == sizeof(double))
    return {{{spaceKernelOf<LawAt<double, C>, SpacePairs, Compiled(C).inSpace()>()...},
             &space::contactKernel<General, SpacePairs>},
            {{spaceKernelOf<OfMaterials<LawAt<double, C>>, SpacePairs, Compiled(C).inSpace()>()...},
             &space::contactKernel<OfMaterials<General>, SpacePairs>},
            {{spaceKernelOf<OfMaterials<LawAt<double, C>>, SpacePlane, Compiled(C).inSpace()>()...},
             &space::contactKernel<OfMaterials<General>, SpacePlane>},
            &space::motionKernel,
            &space::neighbourKernel,
            &space::chooseKernel};
  return {};
}

template <class Real, std::size_t... C, std::size_t... M>
Kernels<Real> table(std::index_sequence<C...>, std::index_sequence<M...>) {
  return {GRAIN_TEXT(GRAIN_SET),
          {contactKernelAt<Real, C>()...},
          &contactKernel<GeneralLaw<Real>, Real>,
          {&motionKernel<Real, meaningful(M)>...},
          {&kickKernel<Real, false>, &kickKernel<Real, true>},
          {planeKernelAt<Real, C>()...},
          &planeKernel<GeneralLaw<Real>, Real>,
          {materialKernelAt<Real, C>()...},
          &contactKernel<OfMaterials<GeneralLaw<Real>>, Real>,
          &planeKernel<OfMaterials<GeneralLaw<Real>>, Real>,
          spaceKernels<Real>(std::index_sequence<C...>())};
}

}  // namespace

template <class Real>
Kernels<Real> GRAIN_SET() {
  return table<Real>(std::make_index_sequence<contactVariants>(),
                     std::make_index_sequence<motionVariants>());
}

template Kernels<double> GRAIN_SET<double>();
template Kernels<float> GRAIN_SET<float>();

}  // namespace grain

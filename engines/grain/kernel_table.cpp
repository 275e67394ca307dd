// Every instantiation of the kernels, in one place. Compiled once for each instruction set of
// CMakeLists.txt, which names it in GRAIN_SET.

#include <utility>

#include "engines/grain/contact_kernel.hpp"
#include "engines/grain/ledger_kernel.hpp"
#include "engines/grain/motion_kernel.hpp"
#include "engines/grain/plane_kernel.hpp"
#include "engines/grain/space_kernel.hpp"

#define GRAIN_TEXT_(name) #name
#define GRAIN_TEXT(name) GRAIN_TEXT_(name)

namespace grain {
namespace {

/// Without friction nothing turns: one kernel for both.
constexpr ContactEffects meaningful(ContactEffects e) {
  e.rotation = e.rotation && e.tangential != Tangential::none;
  return e;
}

template <class Real, std::size_t Index>
using LawAt =
    EffectsLaw<Real, meaningful(contactEffects(Index)), conventionSets[Index / effectVariants]>;

/// Conventions other than the thesis', springs against rolling and cohesion are compiled for the
/// effects of its cell, tension or not: the compiler's time goes with each.
constexpr bool compiled(std::size_t index) {
  const ContactEffects e = contactEffects(index);
  const bool allButTension =
      e.tangential == Tangential::springDashpot && e.normalDamping && e.rotation;
  return allButTension || (index < effectVariants && !e.rollingSpring && !e.cohesion);
}

template <class Real, std::size_t Index>
constexpr ContactKernel<Real> contactKernelAt() {
  if constexpr (compiled(Index)) return &contactKernel<LawAt<Real, Index>, Real>;
  return nullptr;
}

/// Of materials: under the thesis' conventions, for the effects of its cell.
template <class Real, std::size_t Index>
constexpr ContactKernel<Real> materialKernelAt() {
  constexpr ContactEffects e = contactEffects(Index);
  constexpr bool ofTheCell = e.tangential == Tangential::springDashpot && e.normalDamping &&
                             e.rotation && Index < effectVariants;
  if constexpr (ofTheCell) return &contactKernel<OfMaterials<LawAt<Real, Index>>, Real>;
  return nullptr;
}

template <class Real, std::size_t Index>
constexpr PlaneKernel<Real> planeKernelAt() {
  if constexpr (compiled(Index)) return &planeKernel<LawAt<Real, Index>, Real>;
  return nullptr;
}

/// A plate's torque needs both a plate and spins.
constexpr std::size_t meaningful(std::size_t index) {
  MotionEffects e = motionEffects(index);
  e.plateSpin = e.plateSpin && e.plate && e.rotation;
  return indexOf(e);
}

template <std::size_t Index>
constexpr SpacePairKernel sideBySideAt() {
  constexpr ContactEffects effects{Tangential::springDashpot, Index % 2 == 1, true, true};
  using L = EffectsLaw<double, effects, sideBySideConventions(Index / 2 == 1)>;
  return &space::sideBySideKernel<L, SpringTurn::rotated, SpringTwist::meanSpin>;
}

template <class Real>
constexpr SpaceKernels spaceKernels() {
  if constexpr (sizeof(Real) == sizeof(double))
    return {&space::pairKernel<GeneralLaw<double>, false>,
            &space::pairKernel<space::EverydayLaw, false>,
            &space::pairKernel<GeneralLaw<double>, true>,
            &space::pairKernel<space::EverydayLaw, true>,
            {sideBySideAt<0>(), sideBySideAt<1>(), sideBySideAt<2>(), sideBySideAt<3>()},
            &space::motionKernel,
            &space::neighbourKernel,
            &space::chooseKernel};
  return {};
}

template <class Real, std::size_t... C, std::size_t... M, std::size_t... D>
Kernels<Real> table(std::index_sequence<C...>, std::index_sequence<M...>,
                    std::index_sequence<D...>) {
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
          {&ledgerDiskKernel<Real, D>...},
          &ledgerPairKernel<Real>,
          spaceKernels<Real>()};
}

}  // namespace

template <class Real>
Kernels<Real> GRAIN_SET() {
  return table<Real>(std::make_index_sequence<contactVariants>(),
                     std::make_index_sequence<motionVariants>(),
                     std::make_index_sequence<ledgerDiskVariants>());
}

template Kernels<double> GRAIN_SET<double>();
template Kernels<float> GRAIN_SET<float>();

}  // namespace grain

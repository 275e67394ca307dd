// Every instantiation of the kernels, in one place. Compiled once for each instruction set of
// CMakeLists.txt, which names it in GRAIN_SET.

#include <utility>

#include "engines/grain/contact_kernel.hpp"
#include "engines/grain/motion_kernel.hpp"
#include "engines/grain/plane_kernel.hpp"

#define GRAIN_TEXT_(name) #name
#define GRAIN_TEXT(name) GRAIN_TEXT_(name)

namespace grain {
namespace {

template <class Real, std::size_t Index>
constexpr auto effectsLaw() {
  constexpr ContactEffects e = contactEffects(Index);
  // Without friction nothing turns: one kernel for both.
  constexpr bool rotation = e.rotation && e.tangential != Tangential::none;
  return static_cast<EffectsLaw<Real, e.tangential, e.cutTension, e.normalDamping, rotation>*>(
      nullptr);
}

template <class Real, std::size_t Index>
using LawAt = std::remove_pointer_t<decltype(effectsLaw<Real, Index>())>;

/// A plate's torque needs both a plate and spins.
constexpr std::size_t meaningful(std::size_t index) {
  MotionEffects e = motionEffects(index);
  e.plateSpin = e.plateSpin && e.plate && e.rotation;
  return indexOf(e);
}

template <class Real, std::size_t... C, std::size_t... M>
Kernels<Real> table(std::index_sequence<C...>, std::index_sequence<M...>) {
  return {GRAIN_TEXT(GRAIN_SET),
          {&contactKernel<LawAt<Real, C>, Real>...},
          &contactKernel<GeneralLaw<Real>, Real>,
          {&motionKernel<Real, meaningful(M)>...},
          {&kickKernel<Real, false>, &kickKernel<Real, true>},
          {&planeKernel<LawAt<Real, C>, Real>...},
          &planeKernel<GeneralLaw<Real>, Real>};
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

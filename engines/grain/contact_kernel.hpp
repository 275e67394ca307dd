#pragma once

#include <algorithm>
#include <cstdint>
#include <type_traits>

#include "engines/grain/contact_force.hpp"
#include "engines/grain/kernels.hpp"

namespace grain {

/// Pairs are taken in blocks that stay in the nearest cache: gather both disks, apply the law to
/// all pairs of the block side by side, then scatter the forces one pair after the other, in the
/// order of the list: a disk's forces are summed in one order, whatever the width of the vectors.
inline constexpr std::size_t blockSize = 128;

template <class Real>
struct alignas(64) ContactBlock {
  Vec<Real> distance[blockSize], velocity[blockSize];  ///< of i relative to j
  Real spinI[blockSize], spinJ[blockSize];
  Real inverseMass[blockSize], inverseInertiaI[blockSize], inverseInertiaJ[blockSize];
  Real inverseRollingI[blockSize], inverseRollingJ[blockSize];  ///< 1/(J + m a²)
  Vec<Real> force[blockSize];
  Real leverI[blockSize], leverJ[blockSize];
  Real normal[blockSize], tangential[blockSize], sliding[blockSize];
  Real rolling[blockSize], rollingSlides[blockSize];
};

/// With the constants of each pair. @see forPairConstants
template <class Real>
struct MaterialBlock : ContactBlock<Real> {
  Real constants[pairConstants][blockSize];
};
template <class L, class Real>
using BlockOf = std::conditional_t<HasMaterials<L>, MaterialBlock<Real>, ContactBlock<Real>>;

/// A few vectors at a time; a library's way to copy has its beginnings to pay for.
template <class T>
GRAIN_INLINE void copy(const T* from, std::size_t count, T* to) {
#pragma omp simd
  for (std::size_t p = 0; p < count; ++p) to[p] = from[p];
}

/// Velocities are gathered only for a law that has a use for them.
template <class L>
GRAIN_INLINE bool seesVelocities(const L& law) {
  return law.normalDamping || law.tangential != TangentialLaw::none || remembersRest(law);
}

template <class L, class Real>
GRAIN_INLINE void gather(const L& law, const ContactView<Real>& disks, const std::int32_t* pairI,
                         const std::int32_t* pairJ, std::size_t count, BlockOf<L, Real>& b) {
  for (std::size_t p = 0; p < count; ++p) {
    const auto i = static_cast<std::size_t>(pairI[p]);
    const auto j = static_cast<std::size_t>(pairJ[p]);
    b.distance[p] = disks.position[i] - disks.position[j];
    if (seesVelocities(law)) b.velocity[p] = disks.velocity[i] - disks.velocity[j];
    if (law.rotation) {
      b.spinI[p] = disks.spin[i];
      b.spinJ[p] = disks.spin[j];
    }
    if (seesMasses(law)) {
      b.inverseMass[p] = disks.inverseMass[i] + disks.inverseMass[j];
      if (law.rotation) {
        b.inverseInertiaI[p] = disks.inverseInertia[i];
        b.inverseInertiaJ[p] = disks.inverseInertia[j];
      }
    }
    if (seesRollingInertia(law)) {
      b.inverseRollingI[p] =
          inverseRollingInertia(disks.inverseMass[i], disks.inverseInertia[i], disks.radius[i]);
      b.inverseRollingJ[p] =
          inverseRollingInertia(disks.inverseMass[j], disks.inverseInertia[j], disks.radius[j]);
    }
    if constexpr (HasMaterials<L>) {
      const GeneralLaw<Real>& own = disks.lawOf(disks.material[i], disks.material[j]);
      forPairConstants(law, [&](std::size_t which, auto member)
                                GRAIN_INLINE_LAMBDA { b.constants[which][p] = own.*member; });
    }
  }
}

/// The contact kernel: geometry, relative motion, law, force. Pairs that do not touch (yet) take
/// part with no force.
/// Writes the block, and each pair its own springs: the loop may be taken side by side.
template <class L, class Real>
GRAIN_INLINE std::size_t applyLaw(const L& common, const PairView<Real>& pairs, std::size_t begin,
                                  std::size_t count, BlockOf<L, Real>& b) {
  const Real *const radiusI = pairs.radiusI + begin, *const radiusJ = pairs.radiusJ + begin;
  const Vec<Real>* const shift = hasLocalCoordinates<Real> ? pairs.shift + begin : nullptr;
  const PairMemory<Real> kept = pairs.kept.from(begin);
  const bool friction = common.tangential != TangentialLaw::none;
  const bool history = hasSprings(common);
  Real touching = 0;
#pragma omp simd reduction(+ : touching)
  for (std::size_t p = 0; p < count; ++p) {
    const L& law = lawOfPair(common, b, p);
    const Real reach = radiusI[p] + radiusJ[p];
    Real dx = b.distance[p].x, dy = b.distance[p].y;
    if constexpr (hasLocalCoordinates<Real>) {
      dx += shift[p].x;
      dy += shift[p].y;
    }
    const Real distance2 = dx * dx + dy * dy;
    // A factor and not a choice: compilers turn choices into branches, and then give up the
    // vectors.
    Real touches = distance2 < reach * reach ? Real(1) : Real(0);
    const Real distance = squareRoot(distance2);
    const Real inverse = Real(1) / distance;
    const Real nx = dx * inverse;
    const Real ny = dy * inverse;

    ContactMotion<Real> motion{};
    motion.overlap = reach - distance;
    if (law.normal == NormalLaw::hertz || law.cohesion != CohesionLaw::none)
      motion.radius = radiusI[p] * radiusJ[p] / reach;
    if (law.cohesion == CohesionLaw::area) motion.reach = reach;
    Real memory = remembers(law) ? kept.memory[p] : Real(0);
    if (law.cohesion == CohesionLaw::jkr)
      touches = memory = isBonded(law, motion.overlap, motion.radius, memory);
    if (law.damper == Damper::critical) motion.mass = Real(1) / b.inverseMass[p];
    Real rest = remembersRest(law) ? kept.rest[p] : Real(0);
    if (law.normalDamping || remembersRest(law))
      motion.normalVelocity = b.velocity[p].x * nx + b.velocity[p].y * ny;
    if (seesCompliances(law)) motion.normalCompliance = law.halfStep * b.inverseMass[p];
    Real leverI = 0, leverJ = 0, armI = 0, armJ = 0;  // of the force, of the velocity
    if (friction) motion.tangentialVelocity = b.velocity[p].y * nx - b.velocity[p].x * ny;
    if (law.rotation) {
      leverI = armOf(law.lever, radiusI[p], radiusJ[p], motion.overlap);
      leverJ = armOf(law.lever, radiusJ[p], radiusI[p], motion.overlap);
      armI = armOf(law.velocityLever, radiusI[p], radiusJ[p], motion.overlap);
      armJ = armOf(law.velocityLever, radiusJ[p], radiusI[p], motion.overlap);
      motion.tangentialVelocity -= armI * b.spinI[p] + armJ * b.spinJ[p];
    }
    if (seesCompliances(law)) {
      motion.tangentialCompliance = motion.normalCompliance;
      if (law.rotation)
        motion.tangentialCompliance += law.halfStep * (armI * leverI * b.inverseInertiaI[p] +
                                                       armJ * leverJ * b.inverseInertiaJ[p]);
    }

    Real spring = history ? kept.spring[p] : Real(0);
    const ContactForce<Real> force = contactForce(law, motion, spring, memory, rest);
    const Real fn = touches * force.normal;
    const Real ft = touches * force.tangential;
    if (history) kept.spring[p] = touches * spring;
    if (remembers(law)) kept.memory[p] = touches * memory;
    if (remembersRest(law)) kept.rest[p] = touches * rest;
    b.force[p].x = friction ? fn * nx - ft * ny : fn * nx;
    b.force[p].y = friction ? fn * ny + ft * nx : fn * ny;
    if (law.rotation) {
      b.leverI[p] = leverI * ft;
      b.leverJ[p] = leverJ * ft;
    }
    if (law.rolling != RollingLaw::none) {
      RollingMotion<Real> rolling =
          rollingMotion(law, radiusI[p], radiusJ[p], b.spinI[p] - b.spinJ[p], false);
      if (seesRollingInertia(law))
        rolling.inertia = Real(1) / (b.inverseRollingI[p] + b.inverseRollingJ[p]);
      Real angle = law.rolling == RollingLaw::spring ? kept.angle[p] : Real(0);
      const RollingTorque<Real> resistance = rollingTorque(law, rolling, motion, force.load, angle);
      if (law.rolling == RollingLaw::spring) kept.angle[p] = touches * angle;
      b.rolling[p] = touches * resistance.torque;
      b.rollingSlides[p] = touches * resistance.sliding;
      b.leverI[p] -= b.rolling[p];
      b.leverJ[p] += b.rolling[p];
    }
    b.normal[p] = fn;
    b.tangential[p] = ft;
    b.sliding[p] = touches * force.sliding;
    touching += touches;
  }
  return static_cast<std::size_t>(touching);
}

template <bool Both, class L, class Real>
GRAIN_INLINE void scatter(const L& law, const ContactView<Real>& view, const std::int32_t* pairI,
                          const std::int32_t* pairJ, std::size_t count,
                          const ContactBlock<Real>& b) {
  const ContactView<Real> disks = view;  // a copy that no store through a pointer can change
  for (std::size_t p = 0; p < count; ++p) {
    const auto i = static_cast<std::size_t>(pairI[p]);
    disks.force[i] += b.force[p];
    if (law.rotation) disks.torque[i] -= b.leverI[p];
    if constexpr (Both) {
      const auto j = static_cast<std::size_t>(pairJ[p]);
      disks.force[j] -= b.force[p];
      if (law.rotation) disks.torque[j] -= b.leverJ[p];
    }
  }
}

template <class L, class Real>
static std::size_t contactKernel(const GeneralLaw<Real>& general, const ContactView<Real>& disks,
                                 const PairView<Real>& pairs) {
  const L law(general);
  BlockOf<L, Real> b;
  std::size_t touching = 0;
  for (std::size_t begin = 0; begin < pairs.count; begin += blockSize) {
    const std::size_t count = std::min(blockSize, pairs.count - begin);
    const std::int32_t* i = pairs.i + begin;
    const std::int32_t* j = pairs.j + begin;
    gather(law, disks, i, j, count, b);
    touching += applyLaw(law, pairs, begin, count, b);
    if (pairs.normal != nullptr) {
      copy(b.normal, count, pairs.normal + begin);
      copy(b.tangential, count, pairs.tangential + begin);
      copy(b.sliding, count, pairs.sliding + begin);
    }
    if (law.rolling != RollingLaw::none && pairs.rolling != nullptr) {
      copy(b.rolling, count, pairs.rolling + begin);
      copy(b.rollingSlides, count, pairs.rollingSlides + begin);
    }
    if (pairs.addTo == AddTo::none) {
      copy(b.force, count, pairs.stored.force + begin);
      if (law.rotation) {
        copy(b.leverI, count, pairs.stored.leverI + begin);
        copy(b.leverJ, count, pairs.stored.leverJ + begin);
      }
    }
    if (pairs.addTo == AddTo::both) scatter<true>(law, disks, i, j, count, b);
    if (pairs.addTo == AddTo::first) scatter<false>(law, disks, i, j, count, b);
  }
  return touching;
}

}  // namespace grain

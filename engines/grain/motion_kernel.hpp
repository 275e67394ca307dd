#pragma once

#include "engines/grain/kernels.hpp"

namespace grain {

/// v += kick·a, x += drift·v, u = v + ahead·a; then the new forces begin with gravity and plate.
/// `Effects` is an index of motionEffects().
template <class Real, std::size_t Effects>
static MotionReport<Real> motionKernel(const MotionConstants<Real>& constants,
                                       const MotionView<Real>& disks, std::size_t begin,
                                       std::size_t end) {
  constexpr MotionEffects effects = motionEffects(Effects);
  // Copies of its own, which no store through a pointer can change: only then are the arrays'
  // beginnings known to stay, and the loads contiguous.
  const MotionConstants<Real> c = constants;
  const MotionView<Real> d = disks;
  Real excess = -1, sum = 0;
#pragma omp simd reduction(max : excess) reduction(+ : sum)
  for (std::size_t i = begin; i < end; ++i) {
    const Real ax = d.force[i].x * d.inverseMass[i];
    const Real ay = d.force[i].y * d.inverseMass[i];
    const Real vx = d.velocity[i].x + c.kick * ax;
    const Real vy = d.velocity[i].y + c.kick * ay;
    d.velocity[i].x = vx;
    d.velocity[i].y = vy;
    const Real x = d.position[i].x + c.drift * vx;
    const Real y = d.position[i].y + c.drift * vy;
    d.position[i].x = x;
    d.position[i].y = y;
    const Real dx = x - d.chosen[i].x;
    const Real dy = y - d.chosen[i].y;
    excess = larger(excess, dx * dx + dy * dy - d.allowance[i]);
    sum += vx * vx + vy * vy;

    Real ux = vx, uy = vy, us = 0;
    if constexpr (effects.predict) {
      d.seenVelocity[i].x = ux = vx + c.ahead * ax;
      d.seenVelocity[i].y = uy = vy + c.ahead * ay;
    }
    if constexpr (effects.rotation) {
      const Real spinUp = d.torque[i] * d.inverseInertia[i];
      const Real spin = d.spin[i] + c.kick * spinUp;
      d.spin[i] = us = spin;
      if constexpr (effects.predict) d.seenSpin[i] = us = spin + c.ahead * spinUp;
    }

    Real fx = 0, fy = 0, torque = 0;
    if constexpr (effects.plate) {
      const BottomForce<Real> plate = bottomForce<effects.plateSpin>(
          c.plate, d.mass[i], d.radius[i], ux, uy, us, d.plateSpring[i].x, d.plateSpring[i].y);
      fx = plate.x;
      fy = plate.y;
      torque = plate.torque;
    }
    if constexpr (effects.gravity) {
      fx += d.mass[i] * c.gravityX;
      fy += d.mass[i] * c.gravityY;
    }
    d.force[i].x = fx;
    d.force[i].y = fy;
    if constexpr (effects.rotation) d.torque[i] = torque;
  }
  return {excess, sum};
}

template <class Real, bool Rotation>
static void kickKernel(Real dt, const MotionView<Real>& disks, std::size_t begin, std::size_t end) {
  const MotionView<Real> d = disks;
#pragma omp simd
  for (std::size_t i = begin; i < end; ++i) {
    d.velocity[i].x += dt * (d.force[i].x * d.inverseMass[i]);
    d.velocity[i].y += dt * (d.force[i].y * d.inverseMass[i]);
    if constexpr (Rotation) d.spin[i] += dt * (d.torque[i] * d.inverseInertia[i]);
  }
}

}  // namespace grain

#pragma once

#include "engines/grain/contact_force.hpp"
#include "engines/grain/kernels.hpp"

namespace grain {

// The ledger's arithmetic, disks and pairs side by side. What they come to is summed up elsewhere,
// one after the other: sums do not depend on the width of vectors.

/// The plate's force anew, from the spring that it was made of, and what it does to disk i.
template <bool Spin, class Real>
GRAIN_INLINE void accountPlate(const LedgerDisks<Real>& d, std::size_t i) {
  const Real ux = d.seenVelocity[i].x, uy = d.seenVelocity[i].y;
  const Real us = Spin ? d.seenSpin[i] : Real(0);
  const Real beforeX = d.plateBefore[i].x, beforeY = d.plateBefore[i].y;
  const Real trialX = -d.plate.kb * beforeX - d.plate.gb * ux;
  const Real trialY = -d.plate.kb * beforeY - d.plate.gb * uy;
  const bool slides =
      squareRoot(trialX * trialX + trialY * trialY) > d.plate.pressure * d.weighed[i];
  Real setX = beforeX, setY = beforeY;
  const BottomForce<Real> force =
      bottomForce<Spin>(d.plate, d.weighed[i], d.radius[i], ux, uy, us, setX, setY);
  // Where it slips the spring is set to what the force is.
  const auto x = static_cast<double>(slides ? setX : beforeX);
  const auto y = static_cast<double>(slides ? setY : beforeY);
  const auto kb = static_cast<double>(d.plate.kb);
  const double springX = -kb * x, springY = -kb * y;
  const auto power = [&](const DiskMotions& motion) {
    const double vx = motion.velocity[i].x, vy = motion.velocity[i].y;
    const double spin = Spin ? motion.spin[i] : 0.0;
    const double ofSpring = springX * vx + springY * vy;
    return PlatePower{ofSpring, static_cast<double>(force.x) * vx +
                                    static_cast<double>(force.y) * vy +
                                    static_cast<double>(force.torque) * spin - ofSpring};
  };
  d.plateSlides[i] = slides ? 1.0 : 0.0;
  d.plateSquare[i] = x * x + y * y;
  d.plateClosing[i] = power(d.closing);
  d.plateOpening[i] = power(d.opening);
}

/// Velocities are those stored, carried on by the acceleration.
template <class Real, std::size_t Variant>
static void ledgerDiskKernel(const LedgerDisks<Real>& disks, std::size_t count) {
  constexpr bool rotation = Variant % 2 == 1, plate = Variant / 2 > 0, plateSpin = Variant / 2 > 1;
  const LedgerDisks<Real> d = disks;  // a copy that no store through a pointer can change
#pragma omp simd
  for (std::size_t i = 0; i < count; ++i) {
    const auto inverseMass = static_cast<double>(d.inverseMass[i]);
    const auto velocity = [&](double time, Real stored, Real force) {
      return static_cast<double>(stored) + time * inverseMass * static_cast<double>(force);
    };
    const Real vx = d.velocity[i].x, vy = d.velocity[i].y, fx = d.force[i].x, fy = d.force[i].y;
    d.closing.velocity[i].x = velocity(d.toClosing, vx, fx);
    d.closing.velocity[i].y = velocity(d.toClosing, vy, fy);
    d.opening.velocity[i].x = velocity(d.toOpening, vx, fx);
    d.opening.velocity[i].y = velocity(d.toOpening, vy, fy);
    const double nowX = velocity(d.toForces, vx, fx), nowY = velocity(d.toForces, vy, fy);
    double spin = 0.0;
    if constexpr (rotation) {
      const auto stored = static_cast<double>(d.spin[i]);
      const auto spinUp = static_cast<double>(d.torque[i] * d.inverseInertia[i]);
      d.closing.spin[i] = stored + d.toClosing * spinUp;
      d.opening.spin[i] = stored + d.toOpening * spinUp;
      spin = stored + d.toForces * spinUp;
    }
    d.kinetic[i] = 0.5 * d.mass[i] * (nowX * nowX + nowY * nowY) + 0.5 * d.inertia[i] * spin * spin;
    if constexpr (plate) accountPlate<plateSpin>(d, i);
  }
}

/// Geometry is the contact kernel's own arithmetic: the same bits.
template <bool RadiusLevers, class Real>
GRAIN_INLINE void ledgerPairs(LeverArm force, LeverArm velocity, LedgerPairs<Real>& b,
                              std::size_t count) {
#pragma omp simd
  for (std::size_t p = 0; p < count; ++p) {
    const Real dx = b.distance[p].x, dy = b.distance[p].y;
    const Real reach = b.radiusI[p] + b.radiusJ[p];
    const Real distance2 = dx * dx + dy * dy;
    const Real distance = squareRoot(distance2);
    const Real inverse = Real(1) / distance;
    b.touches[p] = distance2 < reach * reach ? Real(1) : Real(0);
    b.nx[p] = dx * inverse;
    b.ny[p] = dy * inverse;
    b.overlap[p] = reach - distance;
    const auto nx = static_cast<double>(b.nx[p]), ny = static_cast<double>(b.ny[p]);
    const auto overlap = static_cast<double>(b.overlap[p]);
    const auto own = static_cast<double>(b.radiusI[p]), other = static_cast<double>(b.radiusJ[p]);
    double leverI = own, leverJ = other, armI = own, armJ = other;
    if constexpr (!RadiusLevers) {
      leverI = armOf(force, own, other, overlap);
      leverJ = armOf(force, other, own, overlap);
      armI = armOf(velocity, own, other, overlap);
      armJ = armOf(velocity, other, own, overlap);
    }
    b.leverI[p] = leverI;
    b.leverJ[p] = leverJ;
    const auto across = [&](const Vec<double>& v, double turned) {
      return v.y * nx - v.x * ny - turned;
    };
    b.normalClosing[p] = b.closing[p].x * nx + b.closing[p].y * ny;
    b.normalOpening[p] = b.opening[p].x * nx + b.opening[p].y * ny;
    b.acrossClosing[p] = across(b.closing[p], leverI * b.closingI[p] + leverJ * b.closingJ[p]);
    b.acrossOpening[p] = across(b.opening[p], leverI * b.openingI[p] + leverJ * b.openingJ[p]);
    b.slipClosing[p] = across(b.closing[p], armI * b.closingI[p] + armJ * b.closingJ[p]);
    b.slipOpening[p] = across(b.opening[p], armI * b.openingI[p] + armJ * b.openingJ[p]);
    b.seenSlip[p] = across(b.seen[p], armI * b.seenI[p] + armJ * b.seenJ[p]);
  }
}

template <class Real>
static void ledgerPairKernel(LeverArm force, LeverArm velocity, LedgerPairs<Real>& b,
                             std::size_t count) {
  if (force == LeverArm::radius && velocity == LeverArm::radius)
    ledgerPairs<true>(force, velocity, b, count);
  else
    ledgerPairs<false>(force, velocity, b, count);
}

}  // namespace grain

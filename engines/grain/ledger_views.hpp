#pragma once

#include <cstddef>
#include <cstdint>

#include "engines/grain/bottom.hpp"
#include "engines/grain/law_types.hpp"

namespace grain {

/// Velocities of disks' centres and, where they rotate, their spins; by place.
struct DiskMotions {
  Vec<double>* velocity;
  double* spin;
};

/// Power of a plate on a disk by one part of a step [W]: by its spring, and beyond that.
struct PlatePower {
  double spring, beyond;
};

/// Moving disks as their ledger sees them; arrays that the effects do not call for are null.
template <class Real>
struct LedgerDisks {
  const Vec<Real>*velocity, *force;
  const Real *spin, *torque;
  const Real *inverseMass, *inverseInertia;
  const double *mass, *inertia;
  double toForces, toClosing, toOpening;  ///< from the stored velocities to those looked at [s]
  DiskMotions closing, opening;           ///< half way through the two parts' kicks
  double* kinetic;                        ///< [J]

  BottomConstants<Real> plate;
  const Real *weighed, *radius;
  const Vec<Real>* seenVelocity;
  const Real* seenSpin;
  const Vec<Real>* plateBefore;  ///< springs before this evaluation [m]
  double* plateSlides;           ///< 1 or 0
  double* plateSquare;           ///< of the spring's stretch that the force was made of [m²]
  PlatePower *plateClosing, *plateOpening;
};

/// Pairs of disks as their ledger sees them, so many at a time that they stay in the nearest cache.
template <class Real>
struct alignas(64) LedgerPairs {
  static constexpr std::size_t size = 64;

  // Of i relative to j, and each one's own.
  Vec<Real> distance[size];
  Vec<double> closing[size], opening[size], seen[size];
  double closingI[size], closingJ[size], openingI[size], openingJ[size];  ///< spins
  double seenI[size], seenJ[size];
  Real radiusI[size], radiusJ[size];

  // Results; @see Touch
  Real touches[size], nx[size], ny[size], overlap[size];
  double leverI[size], leverJ[size];
  double normalClosing[size], normalOpening[size];
  double acrossClosing[size], acrossOpening[size];
  double slipClosing[size], slipOpening[size], seenSlip[size];
};

template <class Real>
using LedgerDiskKernel = void (*)(const LedgerDisks<Real>&, std::size_t count);

template <class Real>
using LedgerPairKernel = void (*)(LeverArm force, LeverArm velocity, LedgerPairs<Real>&,
                                  std::size_t count);

/// Of kernels for disks: without plate, with one, with one that brakes spins; without and with
/// rotation.
inline constexpr std::size_t ledgerDiskVariants = 3 * 2;
constexpr std::size_t ledgerDiskVariant(bool rotation, bool plate, bool plateSpin) {
  return (plateSpin && rotation ? 2u : plate ? 1u : 0u) * 2u + rotation;
}

}  // namespace grain

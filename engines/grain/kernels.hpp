#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engines/grain/bottom.hpp"
#include "engines/grain/law_types.hpp"
#include "engines/grain/space_views.hpp"

namespace grain {

/// Arrays that contacts read of the disks (moving, then wall disks) and add to (moving disks).
/// Without rotation there are no spins and torques: null.
template <class Real>
struct ContactView {
  const Vec<Real>*position, *velocity;
  const Real *spin, *radius;
  const Real *inverseMass, *inverseInertia;  ///< 0 for wall disks
  Vec<Real>* force;
  Real* torque;
  /// For several materials: the material of each disk, and the laws by two of them.
  const std::int32_t* material = nullptr;
  const GeneralLaw<Real>* laws = nullptr;
  std::int32_t materials = 0;

  GRAIN_INLINE const GeneralLaw<Real>& lawOf(std::int32_t a, std::int32_t b) const {
    return laws[a * materials + b];
  }
};

/// Forces of a list of pairs, one entry a pair: on i, and l f_t of i and j.
template <class Real>
struct PairForces {
  Vec<Real>* force;
  Real *leverI, *leverJ;
};

/// Which disks of a pair a list adds its forces to: both, the first (the second is of a wall), or
/// none (they are stored, for two threads to add).
enum class AddTo { both, first, none };

/// Memory of contacts, one entry each; null where they have no such memory. @see contactForce
template <class Real>
struct PairMemory {
  Real *spring, *angle;  ///< ξ, θ
  Real *memory, *rest;

  GRAIN_INLINE PairMemory from(std::size_t begin) const {
    const auto at = [begin](Real* all) { return all == nullptr ? nullptr : all + begin; };
    return {at(spring), at(angle), at(memory), at(rest)};
  }
};

template <class Real>
struct PairView {
  std::size_t count;
  const std::int32_t *i, *j;
  const Real *radiusI, *radiusJ;  ///< [m]
  const Vec<Real>* shift;         ///< origin of i − origin of j, of local coordinates
  PairMemory<Real> kept;
  Real *normal, *tangential, *sliding;  ///< the law's results; null: not asked for
  Real *rolling, *rollingSlides;        ///< likewise; null without rolling resistance
  AddTo addTo;
  PairForces<Real> stored;  ///< for AddTo::none
};

/// Adds the forces of all pairs that touch. @returns how many do
template <class Real>
using ContactKernel = std::size_t (*)(const GeneralLaw<Real>&, const ContactView<Real>&,
                                      const PairView<Real>&);

/// The moving disks as their motion sees them; arrays that the effects do not call for are null.
template <class Real>
struct MotionView {
  Vec<Real>*position, *velocity;
  Real* spin;
  Vec<Real>* seenVelocity;
  Real* seenSpin;  ///< velocities for dashpots; the plain ones unless predicted
  Vec<Real>* force;
  Real* torque;
  const Real *inverseMass, *inverseInertia, *mass, *radius;
  Vec<Real>* plateSpring;  ///< [m]
  /// Where the near pairs were chosen, and the square of how far a disk may be from there.
  const Vec<Real>* chosen;
  const Real* allowance;
};

template <class Real>
struct MotionConstants {
  Real kick, drift;  ///< v += kick·a, x += drift·v [s]
  Real ahead;        ///< how far the dashpots' velocities are carried on [s]
  Real gravityX, gravityY;
  BottomConstants<Real> plate;
};

/// Extremes that a motion kernel saw on its way.
template <class Real>
struct MotionReport {
  Real excess;        ///< > 0, or not a number, if some disk is beyond its allowance [m²]
  Real speedSquares;  ///< sum of v², not finite if some v is not
};

/// Kicks, drifts and predicts disks begin … end−1, and sets their forces to those that have no part
/// in a contact.
template <class Real>
using MotionKernel = MotionReport<Real> (*)(const MotionConstants<Real>&, const MotionView<Real>&,
                                            std::size_t begin, std::size_t end);

/// v += dt·a alone.
template <class Real>
using KickKernel = void (*)(Real dt, const MotionView<Real>&, std::size_t begin, std::size_t end);

/// A disk against a plane through (x, y) that moves with (vx, vy) − spin × arm.
template <class Real>
struct PlaneView {
  double x, y;  ///< in double, as disks are seen from their own origins
  Real nx, ny;
  Real centreX, centreY, vx, vy, spin;
  const Vec<Real>* origin;                        ///< of the disks' coordinates; null: one origin
  PairMemory<Real> kept;                          ///< one a disk
  Real *overlap, *normal, *tangential, *sliding;  ///< results, one a disk; null: not asked for
  Real *rolling, *rollingSlides;                  ///< likewise; null without rolling resistance
  std::int32_t material = 0;                      ///< its own, of a law of materials
};

template <class Real>
using PlaneKernel = std::size_t (*)(const GeneralLaw<Real>&, const ContactView<Real>&,
                                    const PlaneView<Real>&, std::size_t begin, std::size_t end);

struct MotionEffects {
  bool rotation, predict, gravity, plate, plateSpin;
};

inline constexpr std::size_t motionVariants = 2 * 2 * 2 * 2 * 2;

constexpr std::size_t indexOf(const MotionEffects& e) {
  return (((e.rotation * 2u + e.predict) * 2u + e.gravity) * 2u + e.plate) * 2u + e.plateSpin;
}
constexpr MotionEffects motionEffects(std::size_t index) {
  return {index / 16 % 2 == 1, index / 8 % 2 == 1, index / 4 % 2 == 1, index / 2 % 2 == 1,
          index % 2 == 1};
}

/// Every kernel for one precision, compiled for one instruction set.
template <class Real>
struct Kernels {
  const char* instructions;  ///< "x86-64-v3", …
  /// Null: that combination runs the general one.
  ContactKernel<Real> contacts[contactVariants];
  ContactKernel<Real> generalContacts;
  MotionKernel<Real> motion[motionVariants];
  KickKernel<Real> kick[2];                   ///< without and with rotation
  PlaneKernel<Real> planes[contactVariants];  ///< likewise
  PlaneKernel<Real> generalPlanes;
  /// The same of laws of materials, whose few planes run the general one.
  ContactKernel<Real> materialContacts[contactVariants];
  ContactKernel<Real> generalMaterialContacts;
  PlaneKernel<Real> materialPlanes;
  SpaceKernels space;  ///< of double precision alone
};

/// The fastest set that this processor runs, or the one that GRAIN_INSTRUCTIONS names; all give the
/// same bits. @throws std::invalid_argument for a name that is none, or beyond the processor
template <class Real>
Kernels<Real> kernels();

/// Names of the sets that this processor runs, slowest first.
const std::vector<const char*>& instructionSets();

}  // namespace grain

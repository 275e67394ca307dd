#pragma once

#include "engines/grain/law.hpp"

namespace grain {

/// Friction with the plate that the disks lie on, in the precision of the state.
template <class Real>
struct BottomConstants {
  Real pressure;  ///< µ_b g: the bound per mass [m/s²]
  Real kb, inverseKb, gb, tauM, dt;

  BottomConstants(const BottomPlate& plate, double step)
      : pressure(static_cast<Real>(plate.mu * plate.gravity)),
        kb(static_cast<Real>(plate.kb)),
        inverseKb(static_cast<Real>(plate.kb > 0.0 ? 1.0 / plate.kb : 0.0)),
        gb(static_cast<Real>(plate.gb)),
        tauM(static_cast<Real>(plate.tauM)),
        dt(static_cast<Real>(step)) {}
};

template <class Real>
struct BottomForce {
  Real x, y;    ///< [N]
  Real torque;  ///< [N m]
};

/// f* = −k_b ξ − γ_b v, limited to µ_b m g; the spring grows by v dt while it holds and is set to
/// −f/k_b where it slips. The torque's trial force f_M* = −sign(ω) τ_M |f*| − γ_b ω a brakes the
/// spin: the sign that Eq. 4.29 is printed with would spin a disk up.
template <bool Spin, class Real>
GRAIN_INLINE BottomForce<Real> bottomForce(const BottomConstants<Real>& plate, Real mass,
                                           Real radius, Real vx, Real vy, Real spin, Real& springX,
                                           Real& springY) {
  const Real bound = plate.pressure * mass;
  const Real trialX = -plate.kb * springX - plate.gb * vx;
  const Real trialY = -plate.kb * springY - plate.gb * vy;
  const Real trial = squareRoot(trialX * trialX + trialY * trialY);
  const bool holds = trial <= bound;
  const Real scale = holds ? Real(1) : bound / trial;
  const Real fx = trialX * scale;
  const Real fy = trialY * scale;
  springX = holds ? springX + vx * plate.dt : -fx * plate.inverseKb;
  springY = holds ? springY + vy * plate.dt : -fy * plate.inverseKb;
  if constexpr (!Spin) return {fx, fy, Real(0)};
  const Real brake = plate.tauM * trial + plate.gb * magnitude(spin) * radius;
  return {fx, fy, -signedLike(smaller(bound, brake), spin) * (Real(2) / Real(3)) * radius};
}

}  // namespace grain

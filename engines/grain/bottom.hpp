#pragma once

#include <algorithm>
#include <cmath>

namespace grain {

/// Friction with the plate that the disks lie on (Lätzel 2003, Eqs. 4.27–4.29).
struct Bottom {
  double mu = 0.0;        ///< µ_b [-]
  double kb = 0.0;        ///< [N/m]
  double gb = 0.0;        ///< [kg/s]
  double tauM = 0.0;      ///< τ_M [-]
  double gravity = 9.81;  ///< [m/s²]
  bool spin = true;
};

struct BottomForce {
  double x, y;    ///< [N]
  double torque;  ///< [N m]
};

/// f* = −k_b ξ − γ_b v, held to µ_b m g; the spring grows by v dt while it holds and is set to
/// −f/k_b where it slips. The torque's trial force f_M* = −sign(ω) τ_M |f*| − γ_b ω a brakes the
/// spin: the sign that Eq. 4.29 is printed with would spin a disk up.
inline BottomForce bottomForce(const Bottom& plate, double mass, double radius, double vx,
                               double vy, double spin, double& springX, double& springY,
                               double dt) {
  const double bound = plate.mu * mass * plate.gravity;
  double fx = -plate.kb * springX - plate.gb * vx;
  double fy = -plate.kb * springY - plate.gb * vy;
  const double trial = std::sqrt(fx * fx + fy * fy);
  if (trial <= bound) {
    springX += vx * dt;
    springY += vy * dt;
  } else {
    fx *= bound / trial;
    fy *= bound / trial;
    if (plate.kb > 0.0) {
      springX = -fx / plate.kb;
      springY = -fy / plate.kb;
    }
  }
  if (!plate.spin || spin == 0.0) return {fx, fy, 0.0};
  const double brake = plate.tauM * trial + plate.gb * std::abs(spin) * radius;
  return {fx, fy, -std::copysign(std::min(bound, brake), spin) * (2.0 / 3.0) * radius};
}

}  // namespace grain

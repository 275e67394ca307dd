#pragma once

#include <functional>
#include <vector>

namespace grain {

/// Pose and velocity of a rigid wall at one instant (SI units).
/// A member at reference offset (dx, dy) from the centre, R = |(dx, dy)|, is at
/// centre + turn(angle)(dx, dy)(1 + radialShift/R).
struct WallState {
  double x = 0.0, y = 0.0;
  double angle = 0.0;
  double radialShift = 0.0;
  double vx = 0.0, vy = 0.0;
  double spin = 0.0;
  double radialVelocity = 0.0;
};

/// A straight wall through (x, y); (nx, ny) is its unit normal into the free side.
struct Plane {
  double x = 0.0, y = 0.0;
  double nx = 0.0, ny = 1.0;
};

/// A rigid body of disks and planes, given at t = 0, that moves as prescribed.
struct Wall {
  std::vector<double> diskX, diskY, diskRadius;
  std::vector<Plane> planes;
  std::function<WallState(double t)> motion;
};

/// What the disks do to a wall: force [N] and torque about the wall's centre [N m].
struct WallLoad {
  double fx = 0.0, fy = 0.0, torque = 0.0;
};

}  // namespace grain

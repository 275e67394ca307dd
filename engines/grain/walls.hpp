#pragma once

#include <cstddef>
#include <cstdint>
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
  bool moves = true;  ///< false: motion(t) is motion(0) at all times, and nobody asks again
};

/// What the disks do to a wall: force [N] and torque about the wall's centre [N m].
struct WallLoad {
  double fx = 0.0, fy = 0.0, torque = 0.0;
};

/// A member's place and velocity.
struct WallPoint {
  double x, y, vx, vy;
};

/// A wall under way.
class MovingWall {
 public:
  explicit MovingWall(Wall wall);

  /// @returns an upper bound of any disk's displacement [m]
  double moveTo(double t);
  const WallState& state() const { return now_; }
  std::size_t diskCount() const { return wall_.diskX.size(); }
  const std::vector<double>& radii() const { return wall_.diskRadius; }
  bool moves() const { return wall_.moves; }
  WallPoint disk(std::size_t k) const {
    const auto [dx, dy, distance] = offsets_[k];
    const double x = cos_ * dx - sin_ * dy;
    const double y = sin_ * dx + cos_ * dy;
    if (!radial_ || distance == 0.0)
      return {now_.x + x, now_.y + y, now_.vx - now_.spin * y, now_.vy + now_.spin * x};
    const double scale = 1.0 + now_.radialShift / distance;
    const double rx = scale * x;
    const double ry = scale * y;
    const double radial = now_.radialVelocity / (distance * scale);
    return {now_.x + rx, now_.y + ry, now_.vx - now_.spin * ry + radial * rx,
            now_.vy + now_.spin * rx + radial * ry};
  }
  Plane plane(std::size_t k) const;
  /// No member is faster than this now [m/s].
  double speed() const;

 private:
  /// From the wall's centre to a disk at t = 0, and how far that is [m].
  struct Offset {
    double x, y, distance;
  };

  Wall wall_;
  WallState start_, now_;
  std::vector<Offset> offsets_;  ///< of the disks
  bool radial_ = false;          ///< disks are shifted along their offsets, or move along them
  double cos_ = 1.0, sin_ = 0.0;
  double reach_ = 0.0;  ///< of the farthest disk from the centre [m]
};

}  // namespace grain

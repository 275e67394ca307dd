#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
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

  bool operator==(const WallState&) const = default;
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
  bool moves = true;  ///< false: motion(t) is motion(0) at all times, and is not asked for again
};

/// Action of the disks on a wall: force [N] and torque about the wall's centre [N m].
struct WallLoad {
  double fx = 0.0, fy = 0.0, torque = 0.0;
};

/// A member's place and velocity.
struct WallPoint {
  double x, y, vx, vy;
};

/// From a wall's centre to a member at t = 0, and how far that is [m].
struct WallOffset {
  double x, y, distance;
};

/// A wall at one instant: where its members are.
struct WallPose {
  WallState now;
  double cosine = 1.0, sine = 0.0;  ///< of the angle
  bool radial = false;              ///< members are shifted along their offsets, or move along them

  WallPoint at(const WallOffset& offset) const {
    const double x = cosine * offset.x - sine * offset.y;
    const double y = sine * offset.x + cosine * offset.y;
    if (!radial || offset.distance == 0.0)
      return {now.x + x, now.y + y, now.vx - now.spin * y, now.vy + now.spin * x};
    const double scale = 1.0 + now.radialShift / offset.distance;
    const double rx = scale * x;
    const double ry = scale * y;
    const double outwards = now.radialVelocity / (offset.distance * scale);
    return {now.x + rx, now.y + ry, now.vx - now.spin * ry + outwards * rx,
            now.vy + now.spin * rx + outwards * ry};
  }
};

/// A wall under way.
class MovingWall {
 public:
  explicit MovingWall(Wall wall);

  /// @returns an upper bound of any disk's displacement [m]
  double moveTo(double t);
  /// Whether the last moveTo() changed nothing.
  bool stoodStill() const { return stoodStill_; }
  const WallPose& pose() const { return pose_; }
  const WallState& state() const { return pose_.now; }
  std::size_t diskCount() const { return wall_.diskX.size(); }
  const std::vector<double>& radii() const { return wall_.diskRadius; }
  bool moves() const { return wall_.moves; }
  const std::vector<WallOffset>& offsets() const { return offsets_; }  ///< of the disks
  WallPoint disk(std::size_t k) const { return pose_.at(offsets_[k]); }
  Plane plane(std::size_t k) const;
  /// No member is faster than this now [m/s].
  double speed() const;

  /// Has the place at a later time ready, for meanVelocities().
  void lookAhead(double t);
  struct MeanVelocity {
    double vx, vy, spin;
  };
  /// Of a point that moves with the wall, from the last moveTo() to this one, and on to where
  /// lookAhead() was: by the trapezium rule, so exact where the velocity is constant.
  std::pair<MeanVelocity, MeanVelocity> meanVelocities(const WallOffset& offset) const;
  /// Of a point that is at (x, y) from the centre now, not shifted radially.
  WallOffset offsetOf(double x, double y) const;

 private:
  WallPose poseAt(double t) const;

  Wall wall_;
  WallState start_;
  WallPose pose_, before_, ahead_;
  std::vector<WallOffset> offsets_;
  bool stoodStill_ = false;
  double reach_ = 0.0;  ///< of the farthest disk from the centre [m]
};

}  // namespace grain

#pragma once

#include <cmath>
#include <functional>
#include <vector>

namespace box2d_granular {

/// A vector in the plane of motion (SI units, laboratory frame).
struct Vector {
  double x = 0.0, y = 0.0;
};

inline Vector operator+(Vector a, Vector b) {
  return {a.x + b.x, a.y + b.y};
}
inline Vector operator-(Vector a, Vector b) {
  return {a.x - b.x, a.y - b.y};
}
inline Vector operator*(double factor, Vector a) {
  return {factor * a.x, factor * a.y};
}
inline double dot(Vector a, Vector b) {
  return a.x * b.x + a.y * b.y;
}
/// z component of a × b.
inline double cross(Vector a, Vector b) {
  return a.x * b.y - a.y * b.x;
}
/// z × a: a turned by +90°.
inline Vector perpendicular(Vector a) {
  return {-a.y, a.x};
}

/// v turned by an angle [rad].
inline Vector turned(double angle, Vector v) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * v.x - s * v.y, s * v.x + c * v.y};
}

struct Disk {
  double radius = 0.0;   ///< [m]
  double mass = 0.0;     ///< [kg]
  double inertia = 0.0;  ///< about the centre [kg m²]
  Vector position;       ///< [m]
  Vector velocity;       ///< [m/s]
  double spin = 0.0;     ///< counter-clockwise positive [rad/s]
};

/// The half plane behind `point`; the unit normal points into the free side.
struct Plane {
  Vector point, normal;
};

/// Where a wall is and how it moves at one instant.
struct Pose {
  Vector centre;       ///< [m]
  double angle = 0.0;  ///< since t = 0 [rad]
  Vector velocity;     ///< of the centre [m/s]
  double spin = 0.0;   ///< [rad/s]
};

/// A rigid body of disks and planes, given at t = 0, that moves as prescribed.
struct Wall {
  std::vector<Vector> diskPosition;  ///< [m]
  std::vector<double> diskRadius;    ///< [m]
  std::vector<Plane> planes;
  bool moves = false;
  std::function<Pose(double t)> pose;
};

/// What a world is built from. Ids: disks, then wall disks wall by wall, then planes wall by wall.
struct Model {
  std::vector<Disk> disks;
  std::vector<Wall> walls;
  Vector gravity;         ///< [m/s²]
  bool rotation = true;   ///< whether anything can change a spin
  double dt = 0.0;        ///< time step [s]
  double lengthUnit = 1;  ///< Box2D's unit of length [m]
};

}  // namespace box2d_granular

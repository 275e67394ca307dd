#pragma once

#include <functional>
#include <vector>

#include "engines/cpp/crossgrain_vector.hpp"

namespace box2d_granular {

using crossgrain_worker::turned;
using crossgrain_worker::Vector;

/// A disk or a convex body, whose radius is that of the circle about its centre that holds it.
struct Disk {
  double radius = 0.0;   ///< [m]
  double mass = 0.0;     ///< [kg]
  double inertia = 0.0;  ///< about the centre [kg m²]
  Vector position;       ///< [m]
  Vector velocity;       ///< [m/s]
  double spin = 0.0;     ///< counter-clockwise positive [rad/s]
  // Of convex bodies:
  std::vector<Vector> vertices = {};  ///< of a polygon, counter-clockwise, or ends of a capsule [m]
  double rounding = 0.0;              ///< of a capsule [m]
  double turn = 0.0;                  ///< counter-clockwise positive [rad]
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

/// Parts that a world is built from. Ids: disks, then wall disks wall by wall, then planes wall by
/// wall.
struct Model {
  std::vector<Disk> disks;
  std::vector<Wall> walls;
  Vector gravity;         ///< [m/s²]
  bool rotation = true;   ///< whether anything can change a spin
  double dt = 0.0;        ///< time step [s]
  double lengthUnit = 1;  ///< Box2D's unit of length [m]
  double skin = 0.0;      ///< that polygons have around them, of b2_polygonRadius
};

}  // namespace box2d_granular

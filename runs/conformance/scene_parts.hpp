#pragma once

#include <string>

#include "adapters/scene.hpp"
#include "runs/conformance/thesis_numbers.hpp"

/// What scenes of checks and tests are made of.
namespace crossgrain::conformance {

/// A solid disk, J = ½ m a² [m, kg, m, m/s, rad/s].
inline void addDisk(Disks& disks, double radius, double mass, const Vec2& position,
                    const Vec2& velocity, double spin = 0.0) {
  disks.radius.push_back(radius);
  disks.mass.push_back(mass);
  disks.inertia.push_back(solidInertia(mass, radius));
  disks.position.push_back(position);
  disks.velocity.push_back(velocity);
  disks.spin.push_back(spin);
}

inline void addDisk(Scene& scene, double radius, double mass, const Vec2& position,
                    const Vec2& velocity, double spin = 0.0) {
  addDisk(scene.disks, radius, mass, position, velocity, spin);
}

/// Two small disks `gap` [m] apart that meet head on along x at `vn` [m/s], with spins that give
/// v_t = psi vn.
inline void addPair(Scene& scene, const Vec2& middle, double vn, double psi, double gap) {
  const double reach = smallRadius + 0.5 * gap;
  const double spin = -0.5 * psi * vn / smallRadius;
  addDisk(scene, smallRadius, smallMass, middle + Vec2(reach, 0), Vec2(-0.5 * vn, 0), spin);
  addDisk(scene, smallRadius, smallMass, middle - Vec2(reach, 0), Vec2(0.5 * vn, 0), spin);
}

/// A body of one wall disk.
inline WallBody diskWall(const Vec2& position, double radius) {
  WallBody body;
  body.name = "post";
  body.diskPosition = {position};
  body.diskRadius = {radius};
  return body;
}

/// A body of one plane.
inline WallBody planeWall(const Vec2& point, const Vec2& normal) {
  WallBody body;
  body.name = "plane";
  body.planes = {{point, normal}};
  return body;
}

/// At a constant ω [rad/s].
inline Motion rotating(double omega) {
  Motion motion;
  motion.kind = Motion::Kind::rotating;
  motion.angularVelocity = omega;
  return motion;
}

}  // namespace crossgrain::conformance

#pragma once

#include <cmath>
#include <memory>
#include <vector>

#include "adapters/box2d.hpp"

namespace crossgrain::test {

// Small and large disk of Lätzel 2003, Table 3.1, the small radius as cases use it.
inline constexpr double smallRadius = 3.70e-3, smallMass = 0.275e-3;
inline constexpr double largeRadius = 4.495e-3, largeMass = 0.490e-3;
inline constexpr double smallContactTime = 2.18e-3;  // two small disks, thesis law [s]

/// Lätzel 2003, Table 4.1, with the conventions that the penalty engine has.
inline ContactLaw thesisLaw(TangentialLaw tangential = TangentialLaw::springDashpot) {
  ContactLaw law;
  law.tangential = tangential;
  law.kn = 352.1;
  law.gn = 0.19;
  law.kt = 267.1;
  law.gt = 0.15;
  law.mu = 0.44;
  law.conventions.dampingVelocity = DampingVelocity::lagged;
  law.conventions.integrator = Integrator::semiImplicitEuler;
  return law;
}

inline ContactLaw rigidLaw(double en, double et0, double mu) {
  ContactLaw law;
  law.normal = NormalLaw::rigid;
  law.en = en;
  law.et0 = et0;
  law.mu = mu;
  return law;
}

inline void addDisk(Scene& scene, double radius, double mass, Vec2 position, Vec2 velocity,
                    double spin = 0.0) {
  scene.disks.radius.push_back(radius);
  scene.disks.mass.push_back(mass);
  scene.disks.inertia.push_back(0.5 * mass * radius * radius);
  scene.disks.position.push_back(position);
  scene.disks.velocity.push_back(velocity);
  scene.disks.spin.push_back(spin);
}

/// Two small disks that meet head on along x at `vn`, with spins that give v_t = psi vn.
inline void addPair(Scene& scene, Vec2 middle, double vn, double psi, double gap) {
  const double reach = smallRadius + 0.5 * gap;
  const double spin = -0.5 * psi * vn / smallRadius;
  addDisk(scene, smallRadius, smallMass, middle + Vec2(reach, 0), Vec2(-0.5 * vn, 0), spin);
  addDisk(scene, smallRadius, smallMass, middle - Vec2(reach, 0), Vec2(0.5 * vn, 0), spin);
}

struct Outcome {
  double en, psiF;
};

/// What became of the pair of disks (first, first + 1) of addPair(), its normal taken as fixed.
inline Outcome outcome(const Snapshot& after, std::size_t first, double vn) {
  const Vec2 v = after.velocity[first] - after.velocity[first + 1];
  const double spins = after.spin ? (*after.spin)[first] + (*after.spin)[first + 1] : 0.0;
  return {v.x() / vn, (v.y() - smallRadius * spins) / vn};
}

inline WallBody wallDisk(Vec2 position, double radius) {
  WallBody body;
  body.name = "post";
  body.diskPosition = {position};
  body.diskRadius = {radius};
  return body;
}

inline WallBody floorPlane(Vec2 point, Vec2 normal) {
  WallBody body;
  body.name = "floor";
  body.planes = {{point, normal}};
  return body;
}

inline Snapshot runTo(Engine& engine, const Scene& scene, double t, const Settings& settings = {}) {
  engine.load(scene, settings);
  engine.advance(t);
  return engine.snapshot(ContactReport::instant);
}

}  // namespace crossgrain::test

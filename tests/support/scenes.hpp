#pragma once

#include "studies/conformance/conformance_scenes.hpp"

namespace crossgrain::test {
using namespace crossgrain::conformance;

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
  return WallBody{.name = "post", .diskPosition = {position}, .diskRadius = {radius}};
}

}  // namespace crossgrain::test

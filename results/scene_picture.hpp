#pragma once

#include <array>
#include <optional>
#include <vector>

#include "results/schema.hpp"

namespace crossgrain::inline results {

/// A scene at one instant, to be drawn: lengths in m, one entry per disk, wall disk or contact. Of
/// a scene in space x and y are its x and z, seen along its y: bodies in front of the plane y = cut
/// are left out.
struct ScenePicture {
  std::vector<double> radius, x, y;      ///< disks
  std::vector<double> startR, startPhi;  ///< where they started: distance from the origin, angle
  std::vector<double> wallX, wallY, wallRadius;
  std::optional<std::vector<double>> speed;             ///< of the disks [m/s]
  std::optional<double> cut;                            ///< of a scene in space
  std::optional<std::vector<double>> depth, wallDepth;  ///< of centres of spheres behind the cut
  std::optional<std::vector<int>> contactI, contactJ;   ///< ids: disks, then wall disks
  std::optional<std::vector<double>> contactForce;      ///< f_n [N]
  std::optional<std::vector<std::array<double, 4>>> planes;   ///< x, y and normal x, y
  std::optional<std::vector<std::array<double, 3>>> circles;  ///< walls: x, y, radius
  /// x0, y0, x1 … of each convex body, where it is; empty of a disk
  std::optional<std::vector<std::vector<double>>> outlines;
  double time = 0.0;      ///< [s]
  double rotation = 0.0;  ///< of the wheel so far

  void fields(auto& io) {
    FIELDS(io, radius, x, y, startR, startPhi, wallX, wallY, wallRadius, rotation);
    PRESENT_FIELDS(io, speed, cut, depth, wallDepth, contactI, contactJ, contactForce, planes,
                   circles, outlines);
    io("time_s", time);
  }
};

}  // namespace crossgrain::inline results

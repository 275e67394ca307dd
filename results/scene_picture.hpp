#pragma once

#include <array>
#include <optional>
#include <vector>

#include "results/json_fields.hpp"

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
    io("radius", radius);
    io("x", x);
    io("y", y);
    io("start_r", startR);
    io("start_phi", startPhi);
    io("wall_x", wallX);
    io("wall_y", wallY);
    io("wall_radius", wallRadius);
    io.present("speed", speed);
    io.present("cut", cut);
    io.present("depth", depth);
    io.present("wall_depth", wallDepth);
    io.present("contact_i", contactI);
    io.present("contact_j", contactJ);
    io.present("contact_force", contactForce);
    io.present("planes", planes);
    io.present("circles", circles);
    io.present("outlines", outlines);
    io("time_s", time);
    io("rotation", rotation);
  }
};

}  // namespace crossgrain::inline results

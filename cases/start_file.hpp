#pragma once

#include <filesystem>
#include <vector>

#include "adapters/scene.hpp"
#include "cases/packing.hpp"

namespace crossgrain::inline cases {

/// The disks of a file of the user's own; those that do not move are walls.
struct Start {
  Disks disks;
  std::vector<Vec2> fixedPosition;               ///< [m]
  std::vector<double> fixedRadius;               ///< [m]
  std::vector<int> lines = {}, fixedLines = {};  ///< of the file, of each; of HDF5 none
};

/// CSV where the name ends in ".csv", else HDF5 (packing.hpp has its datasets; nothing is fixed).
///
/// CSV: a line of column names, then one line a disk; commas between, and blanks or lines that
/// begin with # where one likes. x, y, radius [m] are needed; vx, vy [m/s], spin [rad/s], mass
/// [kg], inertia [kg m²] and fixed (0 or 1) may be there, in any order.
/// @throws BadInput "start.csv:12: radius = -0.1: must be > 0 m"
Start readStart(const std::filesystem::path& file, const DiskDefaults& defaults);

}  // namespace crossgrain::inline cases

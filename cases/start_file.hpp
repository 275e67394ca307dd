#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cases/packing.hpp"

/// Starts of the user's own, as files.
namespace crossgrain::inline cases {

/// A convex body that rows of a start file name.
template <int D>
struct StartShapeOf {
  std::string name;
  ShapeOf<D> shape;  ///< in its own frame
  FrameOf<D> frame;  ///< in which it was given
  ShapeMassOf<D> spread;
};

/// The disks of a file of the user's own; those that do not move are walls.
template <int D>
struct StartOf {
  DisksOf<D> disks;
  std::vector<VecOf<D>> fixedPosition;           ///< [m]
  std::vector<double> fixedRadius;               ///< [m]
  std::vector<int> lines = {}, fixedLines = {};  ///< of the file, of each; of HDF5 none
  /// Material of each, empty where its row does not say; of HDF5 none.
  std::vector<std::string> materials = {}, fixedMaterials = {};
};

/// CSV where the name ends in ".csv", else HDF5 (packing.hpp has its datasets; nothing is fixed).
///
/// CSV: a line of column names, then one line a disk; commas between, and blanks or lines that
/// begin with # where one likes. x, y, radius [m] are needed; vx, vy [m/s], spin [rad/s], mass
/// [kg], inertia [kg m²], fixed (0 or 1) and material (a name of
/// [[law.pairs]]) may be there, in any order. In space also z, vz, and
/// spin_x, spin_y, spin_z in place of spin; in HDF5 vectors have three columns.
/// In place of a radius a row may name a shape, and say its angle [degrees], in space its
/// quaternion qw, qx, qy, qz; where there is a column of shapes, what is not of a row is empty.
/// @param shapes  that rows may name
/// @throws BadInput "start.csv:12: radius = -0.1: must be > 0 m"
template <int D>
StartOf<D> readStart(const std::filesystem::path& file, const DiskDefaults& defaults,
                     const std::vector<StartShapeOf<D>>& shapes = {});

}  // namespace crossgrain::inline cases

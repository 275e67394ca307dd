#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "adapters/motion.hpp"
#include "adapters/scene.hpp"
#include "stability/placement.hpp"

namespace crossgrain::inline cases {

/// Disks of one kind, each at `position` plus one of `places`.
struct DiskGroup {
  Vec2 position = Vec2::Zero();               ///< [m]
  std::vector<Vec2> places = {Vec2::Zero()};  ///< in diameters of the group
  Vec2 velocity = Vec2::Zero();               ///< [m/s]
  double spin = 0.0;                          ///< [rad/s]
  double radius = 0.0;                        ///< [m]
  double mass = 0.0;                          ///< of a disk of `radius`; others as a² [kg]
  double jitter = 0.0;        ///< each coordinate is off by up to this, uniformly [diameters]
  double radiusSpread = 0.0;  ///< radii are off by up to this share, uniformly [-]
  double velocityRms = 0.0;   ///< of each component, normally distributed about `velocity` [m/s]
};

/// A body of planes and wall disks that moves as prescribed.
struct WallGroup {
  Vec2 centre = Vec2::Zero();  ///< about which it rotates [m]
  std::vector<Plane> planes;
  std::vector<Vec2> position;  ///< of wall disks [m]
  double radius = 0.0;         ///< of wall disks [m]
  std::vector<double> radii;   ///< of each, where they are not all alike [m]
  Motion motion;
};

/// Starts of the user's own, in place of groups: each is a packing.
struct StartFiles {
  std::vector<std::filesystem::path> files;
  std::vector<Disks> disks;  ///< of each
  /// Of each component, added to all velocities, other ones in each packing: so one file makes
  /// several packings [m/s].
  double velocityRms = 0.0;
  std::vector<Vec2> fixedPosition = {};      ///< of disks that stand still, alike in all files [m]
  std::vector<double> fixedRadius = {};      ///< [m]
  std::vector<std::vector<int>> lines = {};  ///< of each file, of its disks and then its fixed ones
};

/// Disks and walls put together as a case file says, and then placed as a whole; gravity and walls
/// go along.
struct Assembly {
  std::vector<DiskGroup> disks;
  StartFiles starts;  ///< either these or `disks`
  std::vector<WallGroup> walls;
  Vec2 gravity = Vec2::Zero();  ///< [m/s²]
  double inertiaFactor = 0.5;   ///< q in J = q m a²
  bool rotation = true;         ///< false: friction acts, but no disk has a spin or gets one
  double maxOverlap = 0.2;      ///< largest overlap of a start, in units of the smallest radius
  std::uint64_t seed = 1;       ///< of jitter, radii and velocities

  Placement placement;

  /// How long it is watched: one of the three. Contact times are those of the lightest pair.
  std::optional<double> duration;      ///< [s]
  std::optional<double> contactTimes;  ///< [-]
  std::optional<double> steps;         ///< of the case's time step
};

/// Places on a lattice, in diameters: row by row, from the origin to the right and upward.
/// @param spacing     between columns and between rows
/// @param triangular  odd rows are shifted by half a column
std::vector<Vec2> gridPlaces(int columns, int rows, const Vec2& spacing, bool triangular);

/// A triangle of rows of base, base − 1, … 1 disks, each in the gaps of the one below.
std::vector<Vec2> heapPlaces(int base, double spacing);

}  // namespace crossgrain::inline cases

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "results/head.hpp"

/// What results of a Couette case say of it, whatever was done with it.
namespace crossgrain::inline results {

struct CouetteCell {
  double innerRadius = 0.0, outerRadius = 0.0;  ///< [m]
  double wallRadius = 0.0, wallSpacing = 0.0;   ///< of the walls' disks [m]
  double height = 0.0;                          ///< [m]
  double omega = 0.0;                           ///< of the wheel [rad/s]
  std::size_t small = 0, large = 0;             ///< disks
  double smallRadius = 0.0, largeRadius = 0.0;  ///< [m]
  double volumeFraction = 0.0;                  ///< of the disks without the walls' [-]
  double diameter = 0.0;                        ///< the d of r̃ = (r − R_i)/d [m]
};

/// Rotations are the wheel's since the hand-over. Of a file's snapshots nobody knows them.
struct CouetteAveraging {
  std::string method;  ///< the first one, which verdicts are of
  std::optional<double> settleRotations, rotations;
  std::optional<double> fromRotation, toRotation;
  std::optional<double> preparedRotations;  ///< before the hand-over; absent: nobody knows
  std::int64_t snapshots = 0;               ///< a run
  double confidence = 0.95;
  std::optional<double> lineWidth;  ///< of a study of ring widths: the kernels' [d]
};

/// The averaged part of a case that is no Couette cell (cases/case.hpp).
struct RegionRow {
  std::string bins;             ///< "rings", "slabs", "grid" or "whole"
  std::string along;            ///< of slabs: "x" or "y"
  double height = 1.0;          ///< of the disks [m]
  double diameter = 0.0;        ///< d, of the smallest disks [m]
  std::size_t disks = 0;        ///< in the scene
  std::vector<double> x, y;     ///< of the bins' centres; empty for rings [m]
  double from = 0.0, to = 0.0;  ///< averaged [s]
};

struct RingPlaces {
  std::vector<double> r;        ///< of the rings' centres [m]
  std::vector<double> rTilde;   ///< (r − R_i)/d
  std::optional<double> width;  ///< [m]
};

struct PackingRow {
  std::size_t index = 0;
  std::uint64_t seed = 0;
  std::string hash;
  bool fromCache = false;
};

struct CouetteFrame {
  ResultsHead head;
  CouetteCell cell;
  std::optional<RegionRow> region;  ///< then there is no cell
  CouetteAveraging averaging;
  std::vector<std::string> effects;  ///< that the case calls for
  RingPlaces rings;
  std::vector<std::string> notes;  ///< sentences for the top of the report
};

}  // namespace crossgrain::inline results

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "results/head.hpp"
#include "results/schema.hpp"

/// Description of a Couette case in all its results.
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

  void fields(auto& io) {
    FIELDS(io, innerRadius, outerRadius, wallRadius, wallSpacing, height, omega, small, large,
           smallRadius, largeRadius, volumeFraction, diameter);
  }
};

/// Rotations are the wheel's since the hand-over. They are unknown for a file's snapshots.
struct FlowAveraging {
  std::string method;  ///< the first one, which verdicts are of
  std::optional<double> settleRotations, rotations;
  std::optional<double> fromRotation, toRotation;
  std::optional<double> preparedRotations;  ///< before the hand-over; absent: not known
  std::int64_t snapshots = 0;               ///< a run
  double confidence = 0.95;
  std::optional<double> lineWidth;  ///< of a study of ring widths: the kernels' [d]

  void fields(auto& io) {
    io("method", method, aName);
    PRESENT_FIELDS(io, settleRotations, rotations, fromRotation, toRotation, lineWidth);
    io.when(fromRotation.has_value(), "prepared_rotations", preparedRotations);
    FIELDS(io, snapshots, confidence);
  }
};

/// The averaged part of a case that is no Couette cell (cases/case.hpp).
struct RegionRow {
  std::string bins;             ///< "rings", "slabs", "grid" or "whole"
  std::string along;            ///< of slabs: "x", "y" or "z"
  double height = 1.0;          ///< of the disks [m]
  double diameter = 0.0;        ///< d, of the smallest disks [m]
  std::size_t disks = 0;        ///< in the scene
  std::vector<double> x, y;     ///< of the bins' centres; empty for rings [m]
  std::vector<double> z;        ///< likewise, in space alone; also of rings
  double from = 0.0, to = 0.0;  ///< averaged [s]

  void fields(auto& io) {
    FIELDS(io, bins, height, diameter, disks, x, y);
    io.when(!along.empty(), "along", along);
    io.when(!z.empty(), "z", z);
    io("from_s", from);
    io("to_s", to);
  }
};

struct RingPlaces {
  std::vector<double> r;        ///< of the rings' centres [m]
  std::vector<double> rTilde;   ///< (r − R_i)/d
  std::optional<double> width;  ///< [m]

  void fields(auto& io) { FIELDS(io, r, rTilde, width); }
};

struct PackingRow {
  std::size_t index = 0;
  std::uint64_t seed = 0;
  std::string hash;
  bool fromCache = false;

  void fields(auto& io) { FIELDS(io, index, seed, hash, fromCache); }
};

struct FlowFrame {
  ResultsHead head;
  CouetteCell cell;
  std::optional<RegionRow> region;  ///< then there is no cell
  FlowAveraging averaging;
  std::vector<std::string> effects;  ///< that the case calls for
  RingPlaces rings;
  std::vector<std::string> notes;  ///< sentences for the top of the report

  void fields(auto& io) {
    head.fields(io);
    io.when(!region, "cell", cell);
    io.present("region", region);
    FIELDS(io, averaging, rings, notes);
    io("effects", effects, aName);
  }
};

}  // namespace crossgrain::inline results

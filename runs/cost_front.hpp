#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runs/cost_point.hpp"

namespace crossgrain {

/// The interval that a point's true error lies in: error ∓ (statistical error + the reference's own
/// error), the lower end at least 0. Averages of a single packing have no statistical error: theirs
/// is 0 … ∞. Absent without an error.
struct ErrorBounds {
  double low = 0.0, high = 0.0;
};
std::optional<ErrorBounds> errorBounds(const CostPoint& point);

/// The error that a point counts with on a front: as measured, but its upper bound where it is
/// below the reference's or its own statistical error, since such a small error may be chance.
/// Absent unless the point ran and has an error with a finite upper bound.
std::optional<double> countedError(const CostPoint& point);

/// The points that no other beats: none is at most as slow and at most as wrong, and less in one of
/// both. By rising wall time; points that are equal in both stay together.
/// @param points  of one kind and measure; those without time or error are on no front
std::vector<std::size_t> paretoFront(const std::vector<CostPoint>& points);

struct Front {
  std::string errorKind, measure;
  std::string engine;  ///< empty: over all engines
  std::vector<std::size_t> points;
  std::vector<double> errors;  ///< that these points count with
};

/// For each kind and measure: the front over all engines, then that of each engine.
std::vector<Front> paretoFronts(const std::vector<CostPoint>& points);

}  // namespace crossgrain

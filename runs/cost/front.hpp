#pragma once

#include <optional>
#include <string>
#include <vector>

#include "averaging/error_bounds.hpp"
#include "runs/cost/point.hpp"

namespace crossgrain::inline runs {

/// A point's error with what it is uncertain by. Absent without an error.
std::optional<MeasuredError> measuredError(const CostPoint& point);

/// What a point counts with on a front. Absent unless it ran and its error says anything.
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

}  // namespace crossgrain::inline runs

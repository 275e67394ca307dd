#pragma once

#include <vector>

#include "results/cost_analysis.hpp"
#include "results/cost_point.hpp"

namespace crossgrain::inline runs {

/// The points that no other beats: none is at most as slow and at most as wrong, and less in one of
/// both. By rising wall time; points that are equal in both stay together.
/// @param points  of one kind and measure; those without time or error are on no front
std::vector<std::size_t> paretoFront(const std::vector<CostPoint>& points);

/// For each kind and measure: the front over all engines, then that of each engine.
std::vector<Front> paretoFronts(const std::vector<CostPoint>& points);

}  // namespace crossgrain::inline runs

#pragma once

#include <string>
#include <vector>

#include "results/cost_analysis.hpp"
#include "results/cost_point.hpp"

namespace crossgrain::inline runs {

/// Of one engine in one measure, over its points.
Cheapest cheapest(const std::vector<CostPoint>& points, const std::string& engine, CostKind kind,
                  const std::string& measure, double target);

/// For every engine, kind and measure of the points and every target, in that order.
std::vector<Cheapest> cheapestTable(const std::vector<CostPoint>& points,
                                    const std::vector<double>& targets);

}  // namespace crossgrain::inline runs

#pragma once

#include <string>
#include <vector>

#include "results/cost_analysis.hpp"
#include "results/cost_point.hpp"

namespace crossgrain::inline runs {

/// 10 %, 1 %, 0.1 % and 1e-6.
std::vector<double> usualTargets();

/// Of one engine in one measure, over its points.
Cheapest cheapest(const std::vector<CostPoint>& points, const std::string& engine, CostKind kind,
                  const std::string& measure, double target);

/// For every engine, kind and measure of the points and every target, in that order.
std::vector<Cheapest> cheapestTable(const std::vector<CostPoint>& points,
                                    const std::vector<double>& targets);

/// For every target and engine, in that order; the engine that reaches a target in the least time
/// is marked.
std::vector<Advice> advice(const std::vector<CostPoint>& points,
                           const std::vector<double>& targets);

/// What `crossgrain cost --want` prints: one fragment per engine, all else as TOML comments.
std::string adviceAsToml(const std::vector<Advice>& advice, const std::vector<CostPoint>& points);

}  // namespace crossgrain::inline runs

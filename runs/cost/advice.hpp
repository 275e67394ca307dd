#pragma once

#include <string>
#include <vector>

#include "results/cost_analysis.hpp"
#include "results/cost_point.hpp"

namespace crossgrain::inline runs {

/// 10 %, 1 %, 0.1 % and 1e-6.
std::vector<double> usualTargets();

/// For every target and engine, in that order; the engine that reaches a target in the least time
/// is marked.
std::vector<Advice> advice(const std::vector<CostPoint>& points,
                           const std::vector<double>& targets);

/// What `crossgrain cost --want` prints: one fragment per engine, all else as TOML comments.
std::string adviceAsToml(const std::vector<Advice>& advice, const std::vector<CostPoint>& points);

}  // namespace crossgrain::inline runs

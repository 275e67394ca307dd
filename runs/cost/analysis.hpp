#pragma once

#include <vector>

#include "results/cost.hpp"
#include "runs/cost/advice.hpp"

namespace crossgrain::inline runs {

/// Sets orders, fronts, cheapest and advice from points and theory.
/// @param targets  accuracies to find settings for
void addCostAnalysis(CostResults& results, const std::vector<double>& targets = usualTargets());

}  // namespace crossgrain::inline runs

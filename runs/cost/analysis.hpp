#pragma once

#include <vector>

#include "results/cost.hpp"
#include "runs/cost/advice.hpp"

namespace crossgrain::inline runs {

/// Sets orders, fronts, cheapest, advice and cells from points, theory and models.
/// @param targets  accuracies to find settings for
void addCostAnalysis(CostResults& results, const std::vector<double>& targets = usualTargets());

}  // namespace crossgrain::inline runs

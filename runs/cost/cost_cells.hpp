#pragma once

#include <vector>

#include "results/cost.hpp"

namespace crossgrain::inline runs {

/// 10 %, 1 % and 0.1 %.
std::vector<double> cellTargets();

/// For every engine, kind of error, basis and target, in that order, what was measured says of it.
/// Not reached is said only where it was shown: of every setting, or, of the case's law, of the
/// engine's own limit of small steps, which lies above the target whatever the step.
std::vector<CostCell> costCells(const std::vector<CostPoint>& points,
                                const std::vector<CostModel>& models,
                                const std::vector<double>& targets = cellTargets());

}  // namespace crossgrain::inline runs

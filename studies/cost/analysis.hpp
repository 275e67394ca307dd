#pragma once

#include <string>
#include <vector>

#include "results/cost.hpp"

/// Conclusions from the points of a study of cost.
namespace crossgrain::inline studies {

/// Sets fronts, advice and cells from points and models; advice for 10 %, 1 %, 0.1 %, 1e-6 and the
/// results' own target.
void addCostAnalysis(CostResults& results);

/// For every engine with time steps of its own scheme that were run over packings: of whole runs,
/// or, where there is none, of trajectories.
std::vector<LargestStep> largestSteps(const std::vector<CostPoint>& points);

/// The points that no other is shown to beat: none is at most as slow and at most as wrong, and
/// less in one of both. Where intervals of times overlap neither point is shown to be faster. By
/// rising time.
/// @param points  of one kind and measure; those without time or error are on no front
std::vector<std::size_t> paretoFront(const std::vector<CostPoint>& points);

/// For each kind and measure: the front over all engines, then that of each engine.
std::vector<Front> paretoFronts(const std::vector<CostPoint>& points);

/// For every target and engine, in that order; the engine that reaches a target in the least time
/// is marked, and those that tie with it. By the rule of the cells: no advice reaches a target that
/// a cell does not.
std::vector<Advice> advice(const std::vector<CostPoint>& points,
                           const std::vector<CostModel>& models,
                           const std::vector<double>& targets);

/// Result for every engine, kind of error, basis and target (10 %, 1 % and 0.1 %), in that order. A
/// target is called not reached only where that was shown: of every setting, or, of the case's
/// law, of the engine's own limit of small steps, which lies above the target whatever the step.
/// A setting is never the best because its step's error cancels its model's.
std::vector<CostCell> costCells(const std::vector<CostPoint>& points,
                                const std::vector<CostModel>& models,
                                const std::vector<double>& targets = {0.1, 0.01, 1e-3});

}  // namespace crossgrain::inline studies

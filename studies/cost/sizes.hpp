#pragma once

#include <vector>

#include "results/cost.hpp"
#include "studies/cost/study.hpp"

namespace crossgrain::inline studies {

/// A timing of steps.
struct PlannedTiming {
  std::size_t bodies = 0;
  std::size_t engine = 0;  ///< its place
  int workers = 1;
  bool operator==(const PlannedTiming&) const = default;
};

/// Strong scaling: every size with every number of workers, one always among them. Weak scaling:
/// from each size n, p·n bodies on p workers, where that is no more than the largest size. An
/// engine without workers has one.
/// @param shares  whether an engine's step can be shared
/// @returns by size, engine and workers, each once
std::vector<PlannedTiming> plannedTimings(const std::vector<std::size_t>& bodies,
                                          const std::vector<int>& workers,
                                          const std::vector<bool>& shares);

/// 1, 2, 4, … up to the cores, and their number itself.
std::vector<int> usualWorkers(unsigned cores);

/// Sizes that the case asks for [bodies]; else the scene's own and four times as many.
std::vector<std::size_t> sizesOf(const Case& setup, std::size_t own);

/// Times steps of each engine on the case's flow as it grows (cases/larger_scene.hpp), with one
/// worker and with several: in each round all of them take turns, each in a fresh process, and
/// nothing else of the command runs meanwhile. Each round of a timing is kept in the store at once.
/// A size that the scene cannot have, that memory has no room for or that the time left does not
/// allow is there with the reason.
/// @param left  time left for all of it [s]
/// @throws BadInput for a number of threads that [engines] sets, OutputError, Interrupted
std::vector<StepTime> timeSizes(CostStudy& study, double left);

}  // namespace crossgrain::inline studies

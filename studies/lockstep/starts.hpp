#pragma once

#include <functional>
#include <vector>

#include "cases/packing.hpp"
#include "results/lockstep_findings.hpp"

namespace crossgrain::inline studies {

/// A state of the flow to start from, all springs relaxed.
struct FlowState {
  LockstepStart start;
  Packing packing;  ///< disks and wheel as they are there
};

/// `count` states of the case's flow as the in-house engine has it: from each packing in turn, one
/// in each of equal spans of time, at a random moment of it that follows from the case's seed. No
/// state comes twice: walls that swing leave few moments to start at, so that an assembly's further
/// packings are drawn then; there are fewer states where it has none (files, or nothing random).
/// @param dt        the case's [s]
/// @param progress  called with the fraction done, from all threads
/// @param jobs      packings side by side
std::vector<FlowState> statesAlongTheFlow(const Case& setup, const std::vector<Packing>& packings,
                                          double dt, std::size_t count,
                                          const std::function<void(double)>& progress,
                                          int jobs = 1);

}  // namespace crossgrain::inline studies

#pragma once

#include <string>
#include <vector>

#include "cases/thesis_ladder.hpp"
#include "results/thesis.hpp"
#include "runs/common/run_store.hpp"
#include "runs/lockstep/lockstep.hpp"

namespace crossgrain::inline runs {

/// Holds engines against their mirrors on packing 0 of a leg. Those without a mirror there, or
/// whose mirror was named as well, are left out.
/// @throws BadInput, OutputError, Interrupted
std::vector<ThesisCarrier> findCarriers(const std::vector<LockstepEngine>& engines,
                                        const LadderLeg& leg, std::size_t starts,
                                        const RunCommand& command, const RunStore& store,
                                        Progress& progress);

}  // namespace crossgrain::inline runs

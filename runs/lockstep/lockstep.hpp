#pragma once

#include <string>
#include <vector>

#include "cases/case.hpp"
#include "results/lockstep.hpp"
#include "runs/common/options.hpp"
#include "runs/common/run_store.hpp"

namespace crossgrain::inline runs {

/// Holds each engine named, but for the in-house one, against its mirror.
/// Everything finished is kept in the store at once.
/// @throws BadInput, UnsupportedScene (an engine named cannot run the case), OutputError,
/// Interrupted
LockstepResults runLockstep(const Case& setup, const RunCommand& command, RunStore& store,
                            std::size_t starts);

/// What that would run, for people.
std::string lockstepPlan(const Case& setup, const RunCommand& command, RunStore& store,
                         std::size_t starts);

}  // namespace crossgrain::inline runs

#pragma once

#include <functional>
#include <string>
#include <vector>

#include "adapters/engine_entry.hpp"
#include "cases/case.hpp"
#include "runs/baseline/baseline.hpp"
#include "runs/common/run_store.hpp"

namespace crossgrain::inline runs {

/// What one engine does from each start and in each collision.
/// @param engine  started; that of `entry`
/// @param cases   one Couette case, or the variants of a case of collisions
/// @param dt      of the Couette case [s]
/// @throws UnsupportedScene, EngineFailure, BadInput, Interrupted
BaselineEngine keepEngine(Engine& engine, const EngineEntry& entry, const std::vector<Case>& cases,
                          const std::vector<FlowState>& starts, double dt,
                          const std::function<void(double)>& progress);

/// What all engines named do.
/// @param starts     along the flow of a Couette case
/// @param endpoints  whether each start is also run and averaged
/// @throws as keepEngine(); nothing is written
Baseline keepBaseline(const std::vector<Case>& cases, const RunCommand& command, std::size_t starts,
                      bool endpoints);

}  // namespace crossgrain::inline runs

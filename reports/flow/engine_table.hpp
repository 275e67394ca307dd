#pragma once

#include <string>
#include <vector>

#include "reports/common/sections.hpp"
#include "reports/flow/engine_runs.hpp"

/// What ran, its cost and the state of the cell, as tables of engines.
namespace crossgrain::reports {

/// The table of engines, and engines and runs that did not finish, with their reasons.
void addEngineTable(Blocks& blocks, const std::vector<EngineRuns>& engines);

/// The state alone: of what was averaged and not run. No rows: nothing is known.
Table stateTable(const std::vector<EngineRuns>& engines);

/// Columns for these engines, after the first ones.
std::vector<Column> columnsOf(std::vector<Column> first, const std::vector<EngineRuns>& engines);

/// Rings, weights and snapshots that the profiles are means over.
std::string describeAverages(const FlowFrame& frame);

/// What the engines made of the case's scene.
std::vector<EffectiveScene> effectiveOf(const FlowFrame& frame,
                                        const std::vector<EngineRuns>& engines);

}  // namespace crossgrain::reports

#pragma once

#include <string>
#include <vector>

#include "reports/common/sections.hpp"
#include "reports/flow/engine_runs.hpp"

/// What ran, its cost, and in what state runs were while they were averaged: tables of engines and
/// sentences.
namespace crossgrain::reports {

/// The table of engines, and engines and runs that did not finish, with their reasons.
void addEngineTable(Blocks& blocks, const std::vector<EngineRuns>& engines);

/// The state alone: of what was averaged and not run. No rows: nothing is known.
Table stateTable(const std::vector<EngineRuns>& engines);

/// Rings, weights and snapshots that the profiles are means over.
/// @param engines  of which files may have others than the case says
std::string describeAverages(const FlowFrame& frame, const std::vector<EngineRuns>& engines);

/// What the engines made of the case's scene.
std::vector<EffectiveScene> effectiveOf(const FlowFrame& frame,
                                        const std::vector<EngineRuns>& engines);

/// "rotations 0.25 to 1.25 since the hand-over, 2.25 to 3.25 since the ring had closed"; what is
/// not known is left out.
std::string averagedRotations(const FlowAveraging& averaging);

/// Before any mean: which packings flow, are blocked or collisional, on which engines; where a
/// pair's regimes differ; which engines drift, on which no drift is seen and down to what size, and
/// where it is undecided.
std::vector<std::string> stateSentences(const CompareResults& results,
                                        const std::vector<EngineRuns>& engines);

/// Tables: regimes by packing and engine; pairs whose regimes differ; drifts by series and engine.
void addStates(Blocks& blocks, const CompareResults& results,
               const std::vector<EngineRuns>& engines);

}  // namespace crossgrain::reports

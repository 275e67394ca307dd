#pragma once

#include <string>
#include <vector>

#include "reports/common/report.hpp"
#include "reports/flow/engine_runs.hpp"

/// In what state runs were while they were averaged: regime, and steady or not.
namespace crossgrain::reports {

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

#pragma once

#include <string>
#include <vector>

#include "reports/common/view.hpp"
#include "reports/couette/engine_runs.hpp"

/// In what state runs were while they were averaged: regime, and steady or not.
namespace crossgrain::reports {

/// A fraction ≥ 0 in per cent, whole or, below one, to its first digit: "40", "0.3".
std::string readablePercent(double fraction);

/// "rotations 0.25 to 1.25 since the hand-over, 2.25 to 3.25 since the ring had closed"; the part
/// that nobody knows is left out, and all of it where nothing is known.
std::string averagedRotations(const CouetteAveraging& averaging);

/// What belongs to the head of the report, before anything is said of means: which packings flow,
/// stand still or are carried by collisions, on which engines; where a pair's regimes differ; which
/// engines drift, on which no drift is seen and down to what size, and where it cannot be told.
std::vector<std::string> stateSentences(const CompareResults& results,
                                        const std::vector<EngineRuns>& engines);

/// The tables of the Series section: regimes by packing and engine; pairs whose regimes differ;
/// drifts by series and engine.
void addStates(Json& view, const CompareResults& results, const std::vector<EngineRuns>& engines);

}  // namespace crossgrain::reports

#pragma once

#include "reports/common/report.hpp"
#include "reports/flow/engine_runs.hpp"
#include "results/compare.hpp"
#include "results/overview.hpp"
#include "results/rev.hpp"

namespace crossgrain::reports {

/// An engine per row: its own law, averages against the reference, cost, failed runs.
Overview compareOverview(const CompareResults& results);

/// A field per row, a weight per column: from which ring width on the weight hardly matters.
Overview revOverview(const RevResults& results);

/// Of endpoints of one pair: the farthest of those with the most severe answer; null without one.
const EndpointRow* worstOf(const std::vector<const EndpointRow*>& rows);

/// That row as a cell. @param isModel  a disagreement is one of declared laws
OverviewCell endpointCell(const EndpointRow& row, bool isModel);

/// The same in a report: the difference of two engines that are both true to their laws is one of
/// models, and nothing has a verdict where nothing was judged.
OverviewCell endpointCell(const CompareResults& results, const EndpointRow& row);

/// Endpoints in which an engine and its own mirror disagree: these have one law.
std::vector<std::string> disagreementsWithMirror(const CompareResults& results,
                                                 const std::string& engine);

/// Whether the difference of an engine from the reference is shown to come from its declared law:
/// lockstep verifies that law, or its mirror agrees with it wherever both it and the reference
/// disagree, and nowhere does it disagree with its mirror. Of a mirror always: it is the in-house
/// engine.
bool isModelDifference(const CompareResults& results, const EngineRow& engine);

/// At most three sentences: who agrees with whom on what, the cause of differences, what to do
/// next.
std::vector<std::string> compareConclusion(const CompareResults& results);

}  // namespace crossgrain::reports

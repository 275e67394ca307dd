#pragma once

#include "reports/common/digest_value.hpp"
#include "reports/couette/engine_runs.hpp"
#include "results/compare.hpp"
#include "results/overview.hpp"
#include "results/rev.hpp"

namespace crossgrain::reports {

/// An engine per row: its own law, averages against the reference, cost, runs lost.
Overview compareOverview(const CompareResults& results);

/// Means of the endpoints, the reference's as figures and the others' with their answers.
std::vector<DigestValue> compareValues(const CompareResults& results);

/// Whose snapshots: in which state, how steady, how well balanced, and what the fits give.
Overview averageOverview(const CompareResults& results);

/// A field per row, a weight per column: from which ring width on the weight hardly matters.
Overview revOverview(const RevResults& results);

/// Of endpoints of one pair: the row that says most, the farthest of those with the gravest answer;
/// null without one.
const EndpointRow* gravestOf(const std::vector<const EndpointRow*>& rows);

/// That row as a cell. @param isModel  a disagreement is one of declared laws
OverviewCell endpointCell(const EndpointRow& row, bool isModel);

/// The same in a report: what parts two engines that are both true to their laws is their model,
/// and nothing has a verdict where nothing was judged.
OverviewCell endpointCell(const CompareResults& results, const EndpointRow& row);

/// Endpoints in which an engine and its own mirror disagree: no law parts these two.
std::vector<std::string> partedFromItsMirror(const CompareResults& results,
                                             const std::string& engine);

/// Whether what parts an engine from the reference is shown to be its declared law: lockstep finds
/// it to be that law, or its mirror agrees with it wherever both it and the reference disagree, and
/// nowhere does it disagree with its mirror. Of a mirror always: it is the in-house engine.
bool isModelDifference(const CompareResults& results, const EngineRow& engine);

/// At most three sentences: who agrees with whom on what, what is to blame, what to do next.
std::vector<std::string> compareConclusion(const CompareResults& results);

/// "40 snapshots of grain averaged: 12 fields in 20 rings."
std::string averageLead(const CompareResults& results, const std::vector<EngineRuns>& engines);

/// "400 snapshots of grain: 12 fields under 5 weights, in rings of widths from 0.1 to 4 d."
std::string revLead(const RevResults& results);

}  // namespace crossgrain::reports

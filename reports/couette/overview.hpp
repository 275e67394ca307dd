#pragma once

#include "results/compare.hpp"
#include "results/overview.hpp"

namespace crossgrain::reports {

/// An engine per row: its own law, collisions, averages against the reference, cost, runs lost.
Overview compareOverview(const CompareResults& results);

/// Of endpoints of one pair: the row that says most, the farthest of those with the gravest answer;
/// null without one.
const EndpointRow* gravestOf(const std::vector<const EndpointRow*>& rows);

/// That row as a cell. @param isModel  a disagreement is one of declared laws
OverviewCell endpointCell(const EndpointRow& row, bool isModel);

/// Whether what parts an engine from the reference is shown to be its declared law: lockstep finds
/// it to be that law, or its mirror agrees with it wherever both it and the reference disagree. Of
/// a mirror always: it is the in-house engine.
bool isModelDifference(const CompareResults& results, const EngineRow& engine);

/// At most three sentences: who agrees with whom on what, what is to blame, what to do next.
std::vector<std::string> compareConclusion(const CompareResults& results);

}  // namespace crossgrain::reports

#pragma once

#include <string>
#include <vector>

#include "results/endpoints.hpp"
#include "studies/flow/campaign.hpp"
#include "studies/flow/endpoint_table.hpp"

namespace crossgrain::inline studies {

/// Runs the engines of a campaign, one interim analysis after the other
/// (averaging/interim_analyses.hpp), until every
/// endpoint of every pair is decided, all analyses are made or the budget would be exceeded. An
/// engine stops when all its endpoints are decided, or where it finishes no run. What lockstep
/// found to be its mirror runs one packing itself, the mirror all.
/// @param campaign  asked, timed, with the packings of the first analysis
/// @param budget    no analysis begins that would end later than this after `campaign` began [s]
/// @returns verdicts, spot checks, responses; no alarms
EndpointFindings runWithInterims(const Case& setup, Campaign& campaign, const RunCommand& command,
                                 const LockstepFindings& lockstep, double budget);

/// All pairs of the engines named, in the order in which they were named. A mirror that came along
/// stands between the reference and its peer; where the peer is evaluated through it, mirror and
/// peer are lockstep's matter. Of a neutral campaign first each of them against the median of the
/// others.
std::vector<ComparedPair> pairsOf(const Campaign& campaign, const std::vector<std::string>& names,
                                  const std::vector<SurrogateEngine>& surrogates);

}  // namespace crossgrain::inline studies

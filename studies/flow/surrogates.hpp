#pragma once

#include <span>
#include <string>
#include <vector>

#include "results/endpoints.hpp"
#include "results/lockstep_findings.hpp"
#include "studies/flow/campaign.hpp"
#include "studies/lockstep/terms.hpp"

namespace crossgrain::inline studies {

/// Engines that lockstep found to be their mirrors, by which their packings may be run. The mirror
/// is one of the campaign's; an engine without one, or whose mirror was named beside it, runs all
/// packings itself.
std::vector<SurrogateEngine> surrogateEngines(const Campaign& campaign,
                                              const std::vector<std::string>& names,
                                              const LockstepFindings& found);

/// How endpoints respond to 10 % more of the constant that ε_eq is expressed in, and of µ.
/// @param engine   one that has run the first `packings` of the campaign with the case as it is
/// @param changed  the case with its law changed
/// @param runs     among which are that engine's on as many packings with each of these
std::vector<EndpointResponse> endpointResponses(const Case& setup, const Campaign& campaign,
                                                const std::string& engine,
                                                const std::vector<ChangedCase>& changed,
                                                const RunsById& runs, int packings);

/// The first part of the spot check: compares the averaged run of each with its mirror's on the
/// same packing, where chaos is as the responses show it. Sets `inUse`, or the alarm.
void judgeSpotChecks(const Case& setup, const Campaign& campaign,
                     const std::vector<EndpointResponse>& responses,
                     std::vector<SurrogateEngine>& engines);

/// The second: what windows within a run of its own show. Where they leave more than largestReach
/// of an endpoint open, the mirror does not stand for the engine, and that is the alarm.
void judgeLateWindows(const Case& setup, const std::vector<EndpointResponse>& responses,
                      LateWindows late, SurrogateEngine& engine);

}  // namespace crossgrain::inline studies

#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "averaging/interim_analyses.hpp"
#include "cases/case.hpp"
#include "cases/endpoints.hpp"
#include "results/endpoints.hpp"
#include "results/run.hpp"
#include "studies/flow/paired_runs.hpp"

namespace crossgrain::inline studies {

/// Of any verdict.
inline constexpr int fewestPackings = 4;

/// The interim analyses of a case: at its packings, and as many more each time.
/// A single one where the first has too few packings for any verdict, or where packings are a file.
InterimPlan interimPlanOf(const Case& setup);

/// Verdicts on every endpoint with a margin, pair by pair, after the interim analyses that
/// `available` packings allow; the endpoints of a pair are one family.
///
/// Where mirrors stand for engines, their averages follow under the assumption that averages
/// respond linearly to so small a change, and to whatever separates trajectories as far as a
/// constant's change no more than to that. Each differs from its mirror by at most
///
///     B = (ε_eq R + max over constants c of ε_late,c R_c) / change,   R = max R_c
///
/// R_c the upper end of the response's interval to that change, ε_eq what lockstep's windows at
/// the beginning show and ε_late,c what windows over a whole run of the engine's own do, the upper
/// ends of their intervals. The second term is what the followed run of the spot check could have
/// missed. Without responses, or late windows, there is no bound and no row.
/// @param known    surrogates and responses; no rows yet
/// @param stopped  engines that ran fewer packings than `available`, and how many
std::vector<EndpointRow> endpointRows(const Case& setup, std::span<const FlowRun> runs,
                                      const std::vector<ComparedPair>& pairs,
                                      const InterimPlan& plan, int available,
                                      const EndpointFindings& known,
                                      const std::map<std::string, int>& stopped = {});

/// Verdicts on endpoints with expected values, of runs of one start: each of these engines against
/// the closed form, and pair by pair. Numbers that come back the same when the start is run again
/// have no scatter: within the margin they agree, else they disagree. Others are undecided.
std::vector<EndpointRow> closedFormRows(const Case& setup, std::span<const FlowRun> runs,
                                        const std::vector<std::string>& engines,
                                        const std::vector<ComparedPair>& pairs);

/// Values of one endpoint of two engines, in the order in which they were added.
struct EndpointValues {
  std::string endpoint;  ///< that the case has a margin for
  Numbers reference, other;
};

/// Verdicts on such values alone, one family.
/// @param names  of the two engines
std::vector<EndpointRow> endpointRows(const Case& setup, const std::vector<EndpointValues>& family,
                                      const std::pair<std::string, std::string>& names,
                                      const InterimPlan& plan);

/// max over constants c of ε_late,c R_c / change, in margins; absent where nothing is known of it.
std::optional<double> reachOf(std::string_view endpoint, const LateWindows& late,
                              const std::vector<EndpointResponse>& responses);

/// Response of an endpoint to a changed constant: runs with it against runs without, packing by
/// packing.
/// @param packings  how many there are
EndpointResponse responseTo(const Case& setup, const Runs& runs, const Runs& changed,
                            const std::string& endpoint, const std::string& constant, double change,
                            std::size_t packings);

/// An engine's run against its mirror's of the same packing, in margins, beside the scatter that
/// chaos gives two such runs, which the responses show. `chance` is that of Student's t, of all
/// endpoints together: below 1 − confidence it is an alarm.
std::vector<SpotCheckNumber> spotCheckOf(const Case& setup, const FlowRun& engine,
                                         const FlowRun& mirror,
                                         const std::vector<EndpointResponse>& responses);

}  // namespace crossgrain::inline studies

#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cases/case.hpp"
#include "cases/endpoints.hpp"
#include "studies/flow/averages.hpp"
#include "studies/flow/paired_runs.hpp"

namespace crossgrain::inline studies {

/// An endpoint of one finished run, from its profiles by the case's first method; absent where
/// there is nothing to measure. [unit of the endpoint]
std::optional<double> endpointOf(const Endpoint& endpoint, const Case& setup, const FlowRun& run);

/// Of the first of these runs that has no value and of which more can be said than that there was
/// nothing to measure: "mine, packing 3: no mean_x in 120 of 200 snapshots".
std::string missingValueReason(const Endpoint& endpoint, const Case& setup, const Runs& runs);

/// Why a run cannot have the endpoint, whatever happened in it: "no contacts in its files", "it
/// reports no contacts"; empty: it could.
std::string notShown(const Endpoint& endpoint, const Case& setup, const FlowRun& run);

/// Runs of an engine that can have an endpoint, all but those that do not show what it is made of.
struct AbleRuns {
  Runs runs;
  std::string lack;  ///< of the others: "mine: no contacts in its files of 1 of 4 runs"
};
AbleRuns ableRuns(const Endpoint& endpoint, const Case& setup, const Runs& all);

/// Of one engine's finished runs, by packing index.
Numbers endpointByPacking(const Endpoint& endpoint, const Case& setup, const Runs& runs,
                          std::size_t packings);

/// Snapshots of a run below which it says nothing of its own error.
inline constexpr std::size_t fewestOfOwnError = 16;

/// Why endpointErrors() have nothing on it that a test could be made with.
std::string missingErrorReason(const Endpoint& endpoint, const FlowRun& run);

/// The errors of a run's endpoints by the run alone. Of n = 16 to 64 parts of the run, each left
/// out in turn, the pseudo-values n θ − (n − 1) θ_(k) (Tukey's jackknife) are a series in time
/// whose mean is judged as any (averaging/statistics.hpp), so that correlations count. Endpoints of
/// one instant and extremes have none, nor have runs of fewer than 16 snapshots.
std::vector<EndpointError> endpointErrors(const Case& setup, const RunAverages& averages,
                                          const FlowRun& run);

/// An endpoint of one finished run. [unit of the endpoint]
struct EndpointValue {
  std::optional<double> value;  ///< absent where there is nothing to measure
  std::string why;              ///< why it is absent, where more can be said of it
  bool notCovered = false;      ///< the snapshots are of other times
};

/// A run that lacks more than mostMissing of the snapshots that a number is made of has no value: a
/// mean over what is left is off the mean over all by up to that share of the quantity's range, and
/// margins are a tenth to a quarter of what is measured.
EndpointValue endpointValue(const Endpoint& endpoint, const Case& setup, const FlowRun& run);

inline constexpr double mostMissing = 0.05;

/// A field bin by bin, as means and slopes over bins take it. What is per volume weighs the bin's
/// volume and is 0 where a bin is empty; what is of the content weighs that, Σ w V = ν V: so a bin
/// that holds next to nothing counts as one that holds nothing, and rounding decides nothing.
struct WeightedBins {
  Numbers value;               ///< [its unit]
  std::vector<double> weight;  ///< as long [m³]
};
WeightedBins weightedBins(const Case& setup, const FlowRun& run, std::string_view field);

/// Mean of them over the cell, Σ weight · value / Σ weight [its unit].
std::optional<double> cellMean(const Case& setup, const FlowRun& run, std::string_view field);

}  // namespace crossgrain::inline studies

#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "studies/thesis/claim_runs.hpp"
#include "studies/thesis/claim_statistics.hpp"

/// The row of a claim that follows from its figures by the rule.
namespace crossgrain::inline studies {

/// Where an estimate lies against a band:
/// - reproduced: its interval at `confidence` lies within the band;
/// - refuted: its interval at 1 − (1 − confidence)/figures lies outside, so that a claim of so many
///   judged figures is refuted by chance no more often than one figure is;
/// - undecided: neither, or there is no error.
Verdict placeIn(const ClaimBand& band, const Estimate& estimate, double confidence, int figures);

/// Runs that it would take for the interval to leave the edge that it lies across, if their scatter
/// stays as it is; absent where no number of them does, or the error is not over runs.
std::optional<int> runsToDecide(const ClaimBand& band, const Estimate& estimate, double confidence);

/// What a figure comes to.
struct Evidence {
  std::optional<Estimate> estimate;
  std::string missing = {};        ///< why there is none
  std::vector<CaseRun> runs = {};  ///< that it rests on
  std::size_t of = 0;              ///< runs that were asked, where some may not have the number
};

/// @param found  by the figures' names in the rule; of one that is not there nothing is known
ClaimRow claimRow(const ClaimScope& scope, const std::map<std::string, Evidence>& found);

}  // namespace crossgrain::inline studies

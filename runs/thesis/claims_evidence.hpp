#pragma once

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "runs/thesis/claims_scope.hpp"
#include "runs/thesis/claims_statistics.hpp"

namespace crossgrain::inline runs {

/// A run's number for one figure; absent where the run has no data for it.
using RunFigure = std::function<std::optional<Measured>(const LegRun&)>;

/// Where an estimate lies against a band:
/// - reproduced: its interval at `confidence` lies within the band;
/// - refuted: its interval at 1 − (1 − confidence)/figures lies outside, so that a claim of so many
///   judged figures is refuted by chance no more often than one figure is;
/// - undecided: neither, or there is no error.
ClaimVerdict placeIn(const ClaimBand& band, const Estimate& estimate, double confidence,
                     int figures);

/// Runs that it would take for the interval to leave the edge that it lies across, if their scatter
/// stays as it is; absent where no number of them does, or the error is not over runs.
std::optional<int> runsToDecide(const ClaimBand& band, const Estimate& estimate, double confidence);

/// What one claim's figures come to, figure by figure, and the row that follows by the rule.
class Evidence {
 public:
  explicit Evidence(const ClaimScope& scope) : scope_(scope) {}

  /// @param missing  why there is none
  /// @param of  runs that were asked for the number, where some may have none
  void put(const std::string& figure, const std::optional<Estimate>& estimate, std::string missing,
           std::size_t of = 0);
  /// Mean over the runs that have the number.
  void mean(const std::string& figure, const RunSet& set, const RunFigure& of);
  /// Kendall's τ with ν̄ over the runs that have the number.
  void trend(const std::string& figure, const RunSet& set, const RunFigure& of);
  /// The legs of these runs are those that the claim rests on.
  void restsOn(const RunSet& set);
  /// Why a set of runs gives nothing.
  static std::string missing(const RunSet& set);

  ClaimRow row() const;

 private:
  struct Entry {
    std::optional<Estimate> estimate;
    std::string missing;
    std::size_t of = 0;
  };

  const Entry* entryOf(const ClaimBand& band) const;
  ClaimVerdict verdictOf(const ClaimBand& band) const;
  std::string sentenceOf(const ClaimBand& band, ClaimVerdict verdict) const;

  const ClaimScope& scope_;
  std::map<std::string, Entry> entries_;
  std::set<std::string> legs_;
  std::vector<LegRun> runs_;
};

}  // namespace crossgrain::inline runs

#pragma once

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "cases/thesis_claims.hpp"
#include "results/thesis_runs.hpp"
#include "studies/thesis/claim_statistics.hpp"

/// Which runs a claim is judged by, and the row that follows from its figures by the rule.
namespace crossgrain::inline studies {

/// Some runs, a description of them, and the cases that should have had one and have none.
struct RunSet {
  std::vector<CaseRun> runs;
  std::string label;  ///< "runs of shear flow"
  std::vector<std::string> without;
};

/// One interpretation of what the thesis leaves open, and the cases that are of it.
struct Interpretation {
  std::string key;                        ///< "spacing", "mass", "radius"; empty: the default
  std::string label;                      ///< "wall spacing 7 mm"
  std::vector<const ThesisCase*> judged;  ///< that claims are judged by
  std::vector<const ThesisCase*> timed;   ///< whose history shows how states change
};

/// The default first: the reference is the first case of the family "packings" (where there is
/// none, the first), judged are that family's cases of the same cell but for the disks' numbers.
/// Then, for each family of "spacing", "mass" and "radius", the values that differ.
std::vector<Interpretation> interpretationsOf(const ThesisResults& results);

/// One claim for one engine under one interpretation.
struct ClaimScope {
  const ThesisResults& results;
  const ClaimRules& rules;
  const ClaimRule& rule;
  std::string engine;
  const Interpretation& interpretation;
  std::string mirror = {};  ///< whose runs are the engine's, too; empty: none

  double number(std::string_view name) const { return rule.number(name); }
  double common(std::string_view name) const { return rules.number(name); }

  /// The finished runs of these cases: the engine's own, and its mirror's of other packings.
  RunSet runsOf(const std::vector<const ThesisCase*>& cases, std::string label) const;
  /// Runs of ν̄ in [from, to).
  RunSet densities(double from, double to, const std::string& label) const;
  /// All runs of cases of a family, whatever their interpretation.
  RunSet family(std::string_view name) const;
  /// For each packing its longest run of all cases that show it.
  RunSet timed() const;
};

/// Where an estimate lies against a band:
/// - reproduced: its interval at `confidence` lies within the band;
/// - refuted: its interval at 1 − (1 − confidence)/figures lies outside, so that a claim of so many
///   judged figures is refuted by chance no more often than one figure is;
/// - undecided: neither, or there is no error.
Verdict placeIn(const ClaimBand& band, const Estimate& estimate, double confidence, int figures);

/// Runs that it would take for the interval to leave the edge that it lies across, if their scatter
/// stays as it is; absent where no number of them does, or the error is not over runs.
std::optional<int> runsToDecide(const ClaimBand& band, const Estimate& estimate, double confidence);

/// What one claim's figures come to, figure by figure.
class Evidence {
 public:
  explicit Evidence(const ClaimScope& scope) : scope_(scope) {}

  /// @param missing  why there is none
  /// @param of  runs that were asked for the number, where some may have none
  void put(const std::string& figure, const std::optional<Estimate>& estimate, std::string missing,
           std::size_t of = 0);
  /// The claim rests on these runs' cases.
  void restsOn(const std::vector<CaseRun>& runs);
  /// Why a set of runs gives nothing.
  static std::string missing(const RunSet& set);

  ClaimRow row() const;

 private:
  struct Entry {
    std::optional<Estimate> estimate;
    std::string missing;
    std::size_t of = 0;
  };

  Verdict verdictOf(const ClaimBand& band) const;
  std::string describe(const ClaimBand& band, Verdict verdict) const;

  const ClaimScope& scope_;
  std::map<std::string, Entry> entries_;
  std::vector<CaseRun> runs_;
};

}  // namespace crossgrain::inline studies

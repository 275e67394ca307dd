#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cases/thesis_claims.hpp"
#include "results/thesis_runs.hpp"

/// By which runs a claim and its figures are judged.
namespace crossgrain::inline studies {

/// Some runs, a description of them, and the cases that should have had one and have none.
struct RunSet {
  std::vector<CaseRun> runs;
  std::string label;  ///< "runs of shear flow"
  std::vector<std::string> without;

  /// Why they give nothing.
  std::string missing() const;
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

using RunChoice = RunSet (*)(const ClaimScope& scope);

RunSet flow(const ClaimScope& scope);             ///< of shear flow by table 3.2
RunSet upward(const ClaimScope& scope);           ///< of shear flow and all labels above it
RunSet blocked(const ClaimScope& scope);          ///< from the first blocked label on
RunSet lowDensities(const ClaimScope& scope);     ///< of shear flow up to the rule's low_to
RunSet figureDensities(const ClaimScope& scope);  ///< of shear flow up to the rule's change_to
RunSet atLabel(const ClaimScope& scope);          ///< at the rule's ν̄
RunSet timedAtLabel(const ClaimScope& scope);  ///< the longest of each packing, at the rule's ν̄
/// Of the family "rate" up to the rule's rate, or from it on, of shear flow and above.
RunSet slowRates(const ClaimScope& scope);
RunSet fastRates(const ClaimScope& scope);
RunSet withoutPlate(const ClaimScope& scope);
RunSet withoutFriction(const ClaimScope& scope);
RunSet ofAnotherStiffness(const ClaimScope& scope);  ///< than that of upward()

/// Those whose wheel has the common number of contacts while they are averaged.
RunSet thatCarry(const ClaimScope& scope, RunSet set);
template <RunSet (*from)(const ClaimScope&)>
RunSet carrying(const ClaimScope& scope) {
  return thatCarry(scope, from(scope));
}

}  // namespace crossgrain::inline studies

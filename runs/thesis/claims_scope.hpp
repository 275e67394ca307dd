#pragma once

#include <functional>
#include <string>
#include <vector>

#include "cases/thesis_claims.hpp"
#include "reports/thesis/leg_choices.hpp"
#include "reports/thesis/leg_runs.hpp"
#include "results/thesis.hpp"

/// Which runs a claim is judged by.
namespace crossgrain::inline runs {

using reports::LegRun;

/// Some runs, what they are in words, and the legs that should have had one and have none.
struct RunSet {
  std::vector<LegRun> runs;
  std::string words;  ///< "runs of shear flow"
  std::vector<std::string> without;
};

/// One way to read what the thesis leaves open, and the legs that are of it.
struct Reading {
  std::string key;                       ///< "spacing", "mass", "radius"; empty: the default
  std::string words;                     ///< "wall spacing 7 mm"
  std::vector<const ThesisLeg*> ladder;  ///< that claims are judged by
  std::vector<const ThesisLeg*> timed;   ///< whose history tells how states change
};

/// The default first: the leg of reference is the first one of the family "packings" (where there
/// is none, the first), and its ladder are that family's legs of the same cell but for the disks'
/// numbers. Then, for each family of "spacing", "mass" and "radius", the values that differ.
std::vector<Reading> readingsOf(const ThesisResults& results);

/// One claim for one engine under one reading.
struct ClaimScope {
  const ThesisResults& results;
  const ClaimRules& rules;
  const ClaimRule& rule;
  std::string engine;
  const Reading& reading;
  std::string carrier = {};  ///< the mirror whose runs are the engine's, too; empty: none

  double number(std::string_view name) const { return rule.number(name); }
  double common(std::string_view name) const { return rules.number(name); }

  /// The finished runs of these legs: the engine's own, and its carrier's of other packings.
  RunSet runsOf(const std::vector<const ThesisLeg*>& legs, std::string words) const;
  /// Runs of labels in [from, to).
  RunSet labels(double from, double to, std::string words) const;
  RunSet flow() const;     ///< of shear flow by table 3.2
  RunSet upward() const;   ///< of shear flow and all labels above it
  RunSet blocked() const;  ///< from the first blocked label on
  RunSet at(double label) const;
  /// All runs of legs of a family, whatever their reading.
  RunSet family(std::string_view name) const;
  /// For each packing its longest run of all legs that show it.
  RunSet timed() const;
  /// Those whose wheel has the common number of contacts while they are averaged.
  RunSet carrying(RunSet from) const;
};

using reports::isOf;

/// Contacts of the wheel's disks at a time, in the averaged time; absent: nobody knows.
std::optional<double> wheelContactsOf(const LegRun& at);

/// "5 to 8", or several; when the runs were averaged, in rotations since the ring had closed.
std::string rotationsOf(const std::vector<LegRun>& runs);

}  // namespace crossgrain::inline runs

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cases/case.hpp"
#include "tests/coverage/legs.hpp"

/// How often bars cover, verdicts are false and faults are found, counted on runs of known truth.
namespace crossgrain::coverage {

/// A share of trials in which something held.
struct Rate {
  std::string study;
  std::string leg;          ///< leg that was compared with the case, or empty
  std::string field;        ///< "any" for a whole family
  std::optional<int> ring;  ///< from 0; absent: all rings together
  int packings = 0;         ///< in a group
  int independent = 0;      ///< trials that share no run
  double value = 0.0;       ///< the share; of "…_ratio" studies a ratio

  /// Binomial, from the independent trials alone; rings of one run count once.
  double error() const;
};

/// Runs as `run()` makes them, of all legs; window 0 of runs that have several.
struct Sample {
  const Case* setup;
  std::vector<FlowRun> runs;
  std::size_t packings = 0;
};

/// Do 95 % bars of one window cover the mean of a long run of the same packing? Studies
/// "within" (against the whole run), "within_next" (two windows in a row against each other: a
/// slow drift cancels) and "within_ratio", rms distance from the whole run's mean over the rms bar.
std::vector<Rate> withinRuns(const Case& setup, const std::vector<WindowRun>& entries);

/// Do the 95 % intervals of groups of P packings cover the mean of all? Study "ensemble".
std::vector<Rate> ensembles(const Sample& sample, int group);

/// Studies "disagree_0" and "disagree": a disagree anywhere in the family, with margins of 0
/// and with the case's. Without a leg, groups of the case's own packings are paired at random; with
/// one, packing by packing.
std::vector<Rate> disagreements(const Sample& sample, const std::string& leg, int group);

/// Verdicts on endpoints after the case's looks, of groups of as many packings of leg "again"
/// against the case itself, whose true difference is 0. Studies "looks_decided": agree, as it is
/// (of every endpoint); "looks_false_disagree": any disagree in the family where every difference
/// is the margin itself; "looks_false_agree": an agree there; "looks_found": disagree where one
/// endpoint is two margins off.
std::vector<Rate> looks(const Sample& sample);

/// Study "power": how often a shift of the size that smallestDetectable() names for the sample's
/// own scatter is found when planted in one ring of leg "again"; "detects_ratio": that size over
/// the margin, on the scale of the test.
std::vector<Rate> power(const Sample& sample, int group);

}  // namespace crossgrain::coverage

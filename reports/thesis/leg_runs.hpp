#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "results/thesis.hpp"

namespace crossgrain::reports {

/// A finished run with its leg.
struct LegRun {
  const ThesisLeg* leg = nullptr;
  const ThesisRun* run = nullptr;
};

/// For each packing the run that followed it for longest. One seed gives one packing of so many
/// disks, whatever leg shows it: all runs must be of one reading and rate.
std::vector<LegRun> longestOfEachPacking(const std::vector<LegRun>& runs);

/// The span in which that rotation ends; null where the history does not reach so far.
const ThesisSpan* spanAt(const ThesisRun& run, double rotation);

/// A parameter that was fitted to the run; absent where it could not be.
std::optional<double> fittedIn(const ThesisRun& run, std::string_view name);

}  // namespace crossgrain::reports

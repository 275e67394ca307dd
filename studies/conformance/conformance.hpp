#pragma once

#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "adapters/engine_entry.hpp"
#include "results/conformance.hpp"
#include "studies/conformance/check_context.hpp"
#include "studies/core/study.hpp"

namespace crossgrain::conformance {

/// Results of the checks.
struct CheckReport {
  std::vector<ConformanceRow> rows;
  std::vector<std::string> declared;           ///< declaredBy()
  std::set<std::string> examined;              ///< of that
  std::map<std::string, std::string> refused;  ///< of the rest, why it could not be examined
};

/// All checks, in the order in which they are run.
std::vector<Check> allChecks();

/// Runs checks on one engine through its real worker, one row each. A worker that broke down is
/// started again for the next check; after three of them the rest is not tried.
/// @param scratch   folder for workers
/// @param timeIsUp  from when on checks are not tried
/// @param progress  gets the check that is run, and the fraction done
/// @throws EngineFailure if it cannot be started at all; BadInput if it is not installed;
///         Interrupted
CheckReport runChecks(
    const EngineEntry& entry, const std::vector<Check>& checks,
    const std::filesystem::path& scratch,
    const std::function<void(const std::string&, double)>& progress,
    const std::function<bool()>& timeIsUp = [] { return false; });

}  // namespace crossgrain::conformance

namespace crossgrain::inline studies {

struct ConformanceTask {
  EngineEntry entry;
  std::optional<std::string> only;  ///< checks with one of these in their name, by commas
  bool quiet = false;
  std::string commandLine;                                  ///< for the report
  double budget = std::numeric_limits<double>::infinity();  ///< [s]
};

/// Names of the checks that runConformance() runs, where it can. @param only  as ConformanceTask
/// has it @throws BadInput
std::vector<std::string> conformanceChecks(const std::optional<std::string>& only);

/// The checks, lockstep with the mirror and collisions, one after the other, and the most likely
/// cause of a failure. Nothing is kept. Checks that would begin after the budget are not tried; a
/// check that runs is not cut short.
/// @throws EngineFailure if it cannot be started; BadInput, Interrupted
ConformanceResults runConformance(const ConformanceTask& task);

/// An engine that broke down failed; a failed check fails the engine. Checks that were not tried in
/// the time given did not pass. Nor did an engine of which too little was examined.
/// @param allowUnexamined  it did, however little
Outcome outcomeOf(const ConformanceResults& results, bool allowUnexamined = false);

}  // namespace crossgrain::inline studies

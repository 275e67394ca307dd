#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "cases/case.hpp"
#include "cases/case_keys.hpp"
#include "results/thesis.hpp"

namespace crossgrain::inline runs {

/// What a run of a leg depends on, as a fingerprint; not on which build of this program made it.
std::string keyOfRun(const Case& setup, const CaseKeys& task);

/// Finished runs of earlier results by their keys: a ladder of days is climbed over several
/// sittings, by the program as it is at each.
using EarlierRuns = std::map<std::string, ThesisRun>;

/// @param file  results.json of a ladder. Runs without a key, of versions that gave none, are left.
/// @throws BadInput if it holds no such results
EarlierRuns readEarlierRuns(const std::filesystem::path& file);

/// One sentence for each other program that made some of the runs.
std::vector<std::string> madeByOthers(const std::vector<ThesisRun>& runs);

}  // namespace crossgrain::inline runs

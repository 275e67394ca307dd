#pragma once

#include <filesystem>
#include <limits>
#include <optional>
#include <string>

#include "cases/thesis_sweep.hpp"
#include "results/thesis.hpp"
#include "runs/common/run_store.hpp"

namespace crossgrain::inline runs {

/// The keys of all cases, by name, for the store.
std::map<std::string, CaseKeys> keysOfCases(const ThesisSweep& sweep);

/// Runs a sweep: every run that is not in the store yet, most important first, several side by
/// side; then judges the thesis' claims by all that is there.
/// @param store   of the command, opened with keysOfCases()
/// @param budget  no run begins that is predicted to end later than this after the command [s]
/// @param earlier  results.json of an earlier session, whose finished runs are taken as they are
/// @returns finished and failed runs, compacted; what was left out is in the notes
/// @throws BadInput, OutputError, Interrupted
ThesisResults runThesis(const ThesisSweep& sweep, const RunCommand& command, RunStore& store,
                        double budget = std::numeric_limits<double>::infinity(),
                        const std::optional<std::filesystem::path>& earlier = std::nullopt);

/// What runThesis() would run, for people.
std::string thesisPlan(const ThesisSweep& sweep, const RunCommand& command, RunStore& store,
                       const std::optional<std::filesystem::path>& earlier = std::nullopt);

/// The same runs, compacted, judged again by the rules that they hold.
/// @param reasons  a file of reasons, in place of those that the results hold
/// @throws BadInput for a file of reasons that is wrong
ThesisResults judgedAgain(ThesisResults results,
                          const std::optional<std::filesystem::path>& reasons = std::nullopt);

}  // namespace crossgrain::inline runs

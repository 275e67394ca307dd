#pragma once

#include <string>

#include "cli/command.hpp"
#include "results/engine_row.hpp"
#include "results/overview.hpp"

namespace crossgrain::inline cli {

/// One line on standard error for a run that failed.
void printFailure(const std::string& reason);

/// One line on standard error for each engine named that cannot run the case: the others ran.
/// @returns whether there is any
bool printRefusals(const CommandLine& line, const std::vector<EngineRow>& engines);

/// The matrix that the report opens with: in colours on a terminal, unless NO_COLOR is set.
void printOverview(const Overview& overview);

/// Prints the plan of --dry-run. @returns an ExitStatus
int told(const std::string& plan);

/// The line "nothing was judged: …", on standard output, or on standard error where that holds a
/// path alone. Nothing judged is no success. @param byRequest  it was clear from what was asked for
/// @returns an ExitStatus: 1, or 0 if `byRequest` and not `strict`
int nothingWasJudged(const CommandLine& line, const std::string& reason, bool byRequest = false,
                     bool strict = false);

/// One line on standard error: how long the program has run, for how much of that engines stepped
/// and for how much plots were drawn. What is left are starts, files, averages and pages.
void printTimeSpent();

/// What stands on the terminal of results whose report has been written: the path of results.json
/// alone (--json), or text, matrix and the report's path.
/// @param timeSpent  also printTimeSpent()
void printResults(const CommandLine& line, const std::string& text, const Overview& overview,
                  bool timeSpent);

/// Failures on standard error, and that nothing was judged. @returns the status
int printOutcome(const CommandLine& line, const Outcome& outcome);

}  // namespace crossgrain::inline cli

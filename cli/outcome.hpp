#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "cli/command.hpp"
#include "reports/common/overview.hpp"

namespace crossgrain::inline cli {

/// One line on standard error for a run that failed.
void printFailure(const std::string& reason);

/// On standard output, lines no longer than the terminal is wide.
void printText(const std::string& text);

/// The matrix that the report opens with: in colours on a terminal, unless NO_COLOR is set.
void printOverview(const reports::Overview& overview);

/// Prints on the terminal, of results whose report has been written: the path of results.json
/// alone (--json), or text, matrix and the report's path.
/// @param timeSpent  and a line on standard error: how long the program has run, for how much of
///                   that engines stepped and plots were drawn. The rest are starts, files,
///                   averages
void printResults(const CommandLine& line, const std::string& text,
                  const reports::Overview& overview, bool timeSpent);

/// Results of a command that writes no results.json.
void printJson(const nlohmann::json& results);

/// Of a --dry-run of one step: what would be done. @returns the status
int printPlanned(const CommandLine& line, const std::string& what);

/// Failures on standard error; "nothing was judged: …" and "status 1: …", which says what makes it
/// so, on standard output, or on standard error where that holds a path alone. @returns the status
int printOutcome(const CommandLine& line, const Outcome& outcome);

}  // namespace crossgrain::inline cli

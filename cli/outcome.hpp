#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "cases/case.hpp"
#include "cli/command.hpp"
#include "runs/common/run_store.hpp"

namespace crossgrain::inline cli {

/// Rows of a list whose `key` has this value.
int countOf(const nlohmann::json& list, const char* key, const std::string& value);

/// One line on standard error for each run, or leg, that failed.
void printFailures(const nlohmann::json& rows);

/// What the commands that only average leave and print. @returns an ExitStatus
int averaged(const CommandLine& line, RunStore& store, const nlohmann::json& results);

/// Prints what --dry-run tells. @returns an ExitStatus
int told(const std::string& plan);

/// The line "nothing was judged: …", on standard output, or on standard error where that holds a
/// path alone. Nothing judged is no success. @param byRequest  it was clear from what was asked for
/// @returns an ExitStatus: 1, or 0 if `byRequest` and not `strict`
int nothingWasJudged(const CommandLine& line, const std::string& reason, bool byRequest = false,
                     bool strict = false);

/// What loads but is hardly meant, one line each on standard error.
void printWarnings(const Case& setup);

}  // namespace crossgrain::inline cli

#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "cli/command.hpp"
#include "runs/run_store.hpp"

namespace crossgrain {

/// Rows of a list whose `key` has this value.
int countOf(const nlohmann::json& list, const char* key, const std::string& value);

/// One line on standard error for each run, or leg, that failed.
void printFailures(const nlohmann::json& rows);

/// What the commands that only average leave and print. @returns an ExitStatus
int averaged(const CommandLine& line, RunStore& store, const nlohmann::json& results);

/// Prints what --dry-run tells. @returns an ExitStatus
int told(const std::string& plan);

}  // namespace crossgrain

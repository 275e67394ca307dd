#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "cli/command.hpp"

namespace crossgrain::inline cli {

/// Options of commands. CLI11 itself is slow to compile, so that only option_groups.cpp and
/// program.cpp include it.

/// @name Options of one command
/// @{
void addFlag(CLI::App& app, const std::string& name, bool& set, const std::string& what);
void addNumber(CLI::App& app, const std::string& name, std::optional<double>& number,
               const std::string& what);

/// @param type  how its value is called: "TEXT", or all that it can be, "allow|cut"
void addText(CLI::App& app, const std::string& name, std::optional<std::string>& text,
             const std::string& what, const std::string& type = "TEXT");

/// Names of engines, none or several.
void addNamesArgument(CLI::App& app, std::vector<std::string>& names, const std::string& what);

/// An argument, or an option, that is required.
void addArgument(CLI::App& app, const std::string& name, std::string& text, const std::string& what,
                 const std::string& type = "TEXT");

/// @}

/// All that a study takes.
void addStudy(CLI::App& app, CommandLine& line, const SharedOptions& takes,
              const std::vector<StudyOption>& own, const std::vector<Exclusion>& exclusions);

/// @name Options of several commands
/// @{
constexpr int anyNumber = std::numeric_limits<int>::max();

/// Case files or folders, into CommandLine::inputs.
void addInputs(CLI::App& app, CommandLine& line, const std::string& name, const std::string& what,
               int least, int most);

/// --engines, required unless there is a default.
void addEngines(CLI::App& app, CommandLine& line, const char* usual = nullptr);

/// --set
void addOverrides(CLI::App& app, CommandLine& line);

/// Of all commands that take one case file.
void addCase(CLI::App& app, CommandLine& line, const std::string& what = "case file");

/// Files of results, and the case that they are of behind them.
void addFilesAndCase(CLI::App& app, CommandLine& line, const std::string& files,
                     const std::string& what);

/// -k: which of the cases.
void addSelection(CLI::App& app, CommandLine& line);

void addQuiet(CLI::App& app, CommandLine& line);

/// --json, of a command that writes no results.json.
void addJson(CLI::App& app, CommandLine& line);

/// --dry-run, of a command that writes no folder of results.
void addDryRun(CLI::App& app, CommandLine& line);

void addVerbose(CLI::App& app, CommandLine& line);

/// Of all commands that run engines on packings: --seed, --quick.
void addPackings(CLI::App& app, CommandLine& line);
/// @}

}  // namespace crossgrain::inline cli

#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "adapters/effects.hpp"
#include "cases/case.hpp"
#include "runs/options.hpp"

namespace crossgrain {

/// Exit statuses, as design and README promise them.
enum ExitStatus {
  exitHeld = 0,
  exitFellShort = 1,
  exitBadInput = 2,
  exitEngineFailed = 3,
  exitInterrupted = 130
};

/// What the command line said, whichever command it was.
struct CommandLine {
  RunCommand run;
  std::vector<std::filesystem::path> inputs;  ///< case files, or result folders
  std::filesystem::path snapshots;            ///< file to average
  std::vector<std::string> overrides;         ///< --set
  double budget = 720.0;                      ///< of `cost` [s]
  std::optional<double> want;                 ///< accuracy to print a fragment for, 0.01 is 1 %
  bool quick = false;
  bool longCases = false;  ///< --long
  bool strict = false;
  bool json = false;
};

/// The one Couette case that a command was given, without variants; shortened by --quick.
/// @throws BadInput
Case onlyCase(const CommandLine& line, const char* command);

/// "effects called for: friction, rotation; left out: gravity"
std::string effectsInWords(const Effects& called);

int listEngines(const CommandLine& line);
int checkCase(const CommandLine& line);
int collide(const CommandLine& line);
int compare(const CommandLine& line);
int average(const CommandLine& line);
int rev(const CommandLine& line);
int effects(const CommandLine& line);
int stability(const CommandLine& line);
int cost(const CommandLine& line);
int rebuildReports(const CommandLine& line);
int serveEngine(const std::string& name);

}  // namespace crossgrain

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "adapters/effects.hpp"
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
  bool quick = false;
  bool longCases = false;  ///< --long
  bool strict = false;
  bool json = false;
};

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
int rebuildReports(const CommandLine& line);
int serveEngine(const std::string& name);

}  // namespace crossgrain

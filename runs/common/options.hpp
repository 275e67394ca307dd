#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace crossgrain::inline runs {

/// What every command that runs engines is told on its command line.
struct RunCommand {
  std::vector<std::string> engines;  ///< names, "all" allowed
  std::filesystem::path out;
  int jobs = 1;         ///< engines side by side
  bool fresh = false;   ///< set aside what an earlier command left in `out`, and begin anew
  bool dryRun = false;  ///< say what would run; write and hold nothing
  bool quiet = false;
  std::string commandLine;  ///< for the report
};

}  // namespace crossgrain::inline runs

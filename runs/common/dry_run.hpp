#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "runs/common/kept_task.hpp"

namespace crossgrain::inline runs {

/// What an engine has to do for a command, as far as can be told without computing anything.
struct PlannedWork {
  std::string engine;
  std::string what;  ///< "runs", "cases"
  std::string refusal = {};
  std::size_t total = 0, finished = 0;
  double seconds = 0.0;  ///< that the finished ones took, where they say
};

/// Counts a piece of work, and what it took if its result is there.
void count(PlannedWork& work, const std::optional<nlohmann::json>& kept);

/// One line for an engine: "grain   4 runs: 2 finished, 2 to do, about 3.1 s".
std::string inWords(const PlannedWork& work);

/// All that `--dry-run` prints.
/// @param head  what is to be run, a line or more
std::string dryRunInWords(const std::string& head, const std::vector<PlannedWork>& works,
                          const RunStore& store, const RunCommand& command);

}  // namespace crossgrain::inline runs

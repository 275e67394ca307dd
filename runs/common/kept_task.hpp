#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "runs/common/progress.hpp"
#include "runs/common/run_store.hpp"

namespace crossgrain::inline runs {

/// A piece of work whose result stays in the store, so that it is done once.
struct KeptTask {
  struct Outcome {
    nlohmann::json result;
    bool finished;     ///< is kept; what failed is tried again by the next command
    std::string line;  ///< how it ended, for the progress
  };

  std::string name;     ///< of its file
  std::string label;    ///< for people
  CaseKeys key;         ///< what it depends on
  double weight = 1.0;  ///< how long it is likely to take; the longest start first
  /// @param progress  to be told the fraction done, 0 … 1
  std::function<Outcome(const std::function<void(double)>& progress)> work;
};

/// Takes up the results that are there and does the rest, `jobs` at a time. All that are there are
/// looked at before anything is done, so that what stands in the way does so at once.
/// @returns the results in the order of the tasks
/// @throws BadInput from RunStore::find(); Interrupted; the first thing that a task threw
std::vector<nlohmann::json> doOrTakeUp(const std::vector<KeptTask>& tasks, const RunStore& store,
                                       Progress& progress, const std::string& stage, int jobs);

}  // namespace crossgrain::inline runs

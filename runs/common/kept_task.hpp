#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "results/json_fields.hpp"
#include "runs/common/progress.hpp"
#include "runs/common/run_store.hpp"
#include "support/task_pool.hpp"

namespace crossgrain::inline runs {

/// A piece of work whose result stays in the store, so that it is done once.
/// @tparam Result  has fields(); or is JSON
template <typename Result>
struct KeptTask {
  struct Outcome {
    Result result;
    bool finished;     ///< is kept; what failed is tried again by the next command
    std::string line;  ///< how it ended, for the progress
  };

  std::string name;     ///< of its file
  std::string label;    ///< for people
  CaseKeys key;         ///< what it depends on
  double weight = 1.0;  ///< how long it is likely to take; the longest start first
  /// @param progress  to be told the fraction done, 0 … 1
  std::function<Outcome(const std::function<void(double)>& progress)> work;
  /// Where all tasks have one, the highest start first, however long they take.
  std::optional<double> priority = {};
};

/// Takes up the results that are there and does the rest, `jobs` at a time. All that are there are
/// looked at before anything is done, so that what stands in the way does so at once.
/// @returns the results in the order of the tasks
/// @throws BadInput from RunStore::find(); Interrupted; the first thing that a task threw
template <typename Result>
std::vector<Result> doOrTakeUp(const std::vector<KeptTask<Result>>& tasks, const RunStore& store,
                               Progress& progress, const std::string& stage, int jobs) {
  std::vector<Result> results(tasks.size());
  std::vector<double> weights;
  for (const auto& task : tasks) weights.push_back(task.weight);
  progress.begin(stage, weights);
  std::vector<Task> open;
  for (std::size_t k = 0; k < tasks.size(); ++k) {
    const auto& task = tasks[k];
    if (auto before = store.findAs<Result>(task.name, task.key)) {
      results[k] = *std::move(before);
      progress.finish(k, task.label + ": finished in an earlier run");
      continue;
    }
    open.push_back({task.priority.value_or(task.weight), [&, k] {
                      const auto& own = tasks[k];
                      auto outcome = own.work([&](double f) { progress.update(k, own.label, f); });
                      if (outcome.finished) store.keep(own.name, own.key, jsonOf(outcome.result));
                      results[k] = std::move(outcome.result);
                      progress.finish(k, own.label + ": " + outcome.line);
                    }});
  }
  runTasks(open, jobs);
  return results;
}

}  // namespace crossgrain::inline runs

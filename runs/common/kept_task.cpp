#include "runs/common/kept_task.hpp"

#include "support/task_pool.hpp"

namespace crossgrain::inline runs {

using nlohmann::json;

std::vector<json> doOrTakeUp(const std::vector<KeptTask>& tasks, const RunStore& store,
                             Progress& progress, const std::string& stage, int jobs) {
  std::vector<json> results(tasks.size());
  std::vector<double> weights;
  for (const KeptTask& task : tasks) weights.push_back(task.weight);
  progress.begin(stage, weights);
  std::vector<Task> open;
  for (std::size_t k = 0; k < tasks.size(); ++k) {
    const KeptTask& task = tasks[k];
    if (auto before = store.find(task.name, task.key)) {
      results[k] = std::move(*before);
      progress.finish(k, task.label + ": finished in an earlier run");
      continue;
    }
    open.push_back({task.weight, [&, k] {
                      const KeptTask& own = tasks[k];
                      KeptTask::Outcome outcome =
                          own.work([&](double f) { progress.update(k, own.label, f); });
                      if (outcome.finished) store.keep(own.name, own.key, outcome.result);
                      results[k] = std::move(outcome.result);
                      progress.finish(k, own.label + ": " + outcome.line);
                    }});
  }
  runTasks(open, jobs);
  return results;
}

}  // namespace crossgrain::inline runs

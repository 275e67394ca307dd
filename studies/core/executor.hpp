#pragma once

#include <fmt/format.h>
#include <algorithm>

#include <chrono>
#include <compare>
#include <functional>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "results/schema.hpp"
#include "studies/core/run_store.hpp"
#include "support/interrupt.hpp"
#include "support/task_pool.hpp"

namespace crossgrain::inline studies {

/// How long work goes on at its speed so far, in words: "12 s left". Nothing is predicted within
/// the first second and the first hundredth.
/// @param fraction  of the work that is done
/// @param elapsed  since it began [s]
std::string timeLeft(double fraction, double elapsed);

/// Progress of some pieces of work, shown on standard error: one line that is redrawn with the
/// time left on a terminal, a plain line per finished piece elsewhere. Safe to call from all
/// threads.
class Progress {
 public:
  /// @param quiet  shows nothing
  explicit Progress(bool quiet);
  ~Progress();

  /// A new stage of work; weights [any unit] say how long each of its pieces takes.
  void begin(const std::string& stage, std::vector<double> weights);

  /// Piece `index` is done to that fraction; label is shown while it runs.
  void update(std::size_t index, const std::string& label, double fraction);
  /// Piece `index` is over; `line` says how it ended, if there is something to say.
  void finish(std::size_t index, const std::string& line);
  /// So many pieces need no work, as they are there already. All of them, of one stage or several,
  /// are one line, which comes before the next piece that works or at the end.
  /// @param noun  "run", "packing"
  void keep(std::size_t count, const std::string& noun);
  /// A line of its own.
  void say(const std::string& line);

 private:
  void draw();
  void erase();
  void showHead();
  void showKept();

  bool quiet_, terminal_;
  std::mutex mutex_;
  std::string stage_;
  std::vector<double> weights_, fractions_;
  std::size_t finished_ = 0;
  std::vector<std::string> running_;
  std::chrono::steady_clock::time_point started_, drawn_;
  bool lineOpen_ = false, headShown_ = true;
  std::map<std::string, std::size_t> kept_;
};

/// Identity of a run: engine, case or change of it, and packing. Results are looked up by it.
struct RunId {
  std::string engine, variant = {};
  int packing = 0;
  auto operator<=>(const RunId&) const = default;
};

/// A piece of work whose result stays in the store, so that it is done once.
/// @tparam Result  has fields(); or is JSON
template <typename Result>
struct CachedTask {
  struct Outcome {
    Result result;
    bool finished;     ///< is kept; what failed is tried again by the next command
    std::string line;  ///< how it ended, for the progress
  };

  std::string name;     ///< of its file
  std::string label;    ///< for people
  CaseKeys key;         ///< inputs that the result depends on
  double weight = 1.0;  ///< how long it is likely to take; the longest start first
  /// @param progress  to be called with the fraction done, 0 … 1
  std::function<Outcome(const std::function<void(double)>& progress)> work;
  /// Where all tasks have one, the highest start first, however long they take.
  std::optional<double> priority = {};
  RunId of = {};
};

/// Loads the results that are there and runs the other tasks, `jobs` at a time. All those
/// results are read before a task begins, so that a bad one is an error at once. Tasks that another
/// shard of the command runs are waited for at the end, and run here if that process dies.
/// @returns the results in the order of the tasks
/// @throws BadInput from RunStore::find(); Interrupted; the first thing that a task threw
template <typename Result>
std::vector<Result> runOrLoad(const std::vector<CachedTask<Result>>& tasks, const RunStore& store,
                              Progress& progress, const std::string& stage, int jobs) {
  std::vector<Result> results(tasks.size());
  const auto isThere = [&](std::size_t k) {
    auto before = store.findAs<Result>(tasks[k].name, tasks[k].key);
    if (before) results[k] = *std::move(before);
    return before.has_value();
  };
  std::vector<std::size_t> open;  // tasks by their place in the progress
  std::vector<double> weights;
  for (std::size_t k = 0; k < tasks.size(); ++k) {
    if (isThere(k)) continue;
    open.push_back(k);
    weights.push_back(tasks[k].weight);
  }
  progress.keep(tasks.size() - open.size(), "run");
  if (open.empty()) return results;
  progress.begin(stage, weights);
  const auto run = [&](std::size_t place) {
    const auto& own = tasks[open[place]];
    auto outcome = own.work([&](double f) { progress.update(place, own.label, f); });
    store.keep(own.name, own.key, jsonOf(outcome.result), outcome.finished);
    if (!outcome.finished) store.failed(own.name);
    results[open[place]] = std::move(outcome.result);
    progress.finish(place, own.label + ": " + outcome.line);
  };
  const auto isDone = [&](std::size_t place) {  // unless another has it
    if (!store.isShared()) {
      run(place);
      return true;
    }
    const auto claim = store.claim(tasks[open[place]].name);
    if (!claim) return false;
    if (isThere(open[place]))
      progress.finish(place, tasks[open[place]].label + ": finished by another shard");
    else
      run(place);
    return true;
  };
  std::vector<Task> work;
  std::mutex mutex;
  std::vector<std::size_t> left;
  for (std::size_t place = 0; place < open.size(); ++place)
    work.push_back({tasks[open[place]].priority.value_or(weights[place]), [&, place] {
                      if (isDone(place)) return;
                      const std::scoped_lock lock(mutex);
                      left.push_back(place);
                    }});
  runTasks(work, jobs);
  for (const std::size_t place : left)
    while (!isDone(place)) {
      throwIfInterrupted();
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
  return results;
}

/// Work of an engine for a command, as far as is known without computing anything.
struct PlannedWork {
  std::string engine;
  std::string what;  ///< "runs", "cases"
  std::string refusal = {};
  std::size_t total = 0, finished = 0;
  double seconds = 0.0;  ///< that the finished ones took, where known
};

/// Counts a piece of work, and the time that it took if its result is there.
void count(PlannedWork& work, const std::optional<nlohmann::json>& kept);

/// The work of tasks, engine by engine in the order of tasks.
/// @param what  a piece of it: "runs", "cases"
template <typename Result>
std::vector<PlannedWork> plannedWork(const std::vector<CachedTask<Result>>& tasks,
                                     const std::string& what, const RunStore& store) {
  std::vector<PlannedWork> works;
  for (const auto& task : tasks) {
    auto work = std::ranges::find(works, task.of.engine, &PlannedWork::engine);
    if (work == works.end()) work = works.insert(works.end(), {task.of.engine, what});
    count(*work, store.find(task.name, task.key));
  }
  return works;
}

/// Results of tasks by the identity of their runs.
/// @param results  of runOrLoad()
template <typename Result>
std::map<RunId, Result> byId(const std::vector<CachedTask<Result>>& tasks,
                             std::vector<Result> results) {
  std::map<RunId, Result> all;
  for (std::size_t k = 0; k < tasks.size(); ++k) all[tasks[k].of] = std::move(results[k]);
  return all;
}

/// One line for an engine: "grain   4 runs: 2 finished, 2 to do, about 3.1 s".
std::string describe(const PlannedWork& work);

/// Text that `--dry-run` prints.
/// @param head  what is to be run, a line or more
std::string describeDryRun(const std::string& head, const std::vector<PlannedWork>& works,
                           const RunStore& store, const RunCommand& command);

}  // namespace crossgrain::inline studies

#pragma once

#include <chrono>
#include <limits>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "cases/thesis_ladder.hpp"
#include "results/thesis.hpp"
#include "runs/common/engine_access.hpp"
#include "runs/common/executor.hpp"
#include "runs/common/run_store.hpp"
#include "runs/thesis/earlier_runs.hpp"

namespace crossgrain::inline runs {

/// An engine that climbs, and how fast it was seen to be.
struct ClimbingEngine {
  EngineEntry entry;
  LadderEngine::Part part = LadderEngine::Part::own;
  std::string version = {};              ///< empty: it did not answer
  std::optional<Capabilities> can = {};  ///< absent: it did not answer
  double perStep = 0.0;  ///< seconds that a step takes a disk, all told; 0: not known
  std::size_t seen = 0;  ///< runs that say so
};

/// The runs of a ladder, most important first, several side by side. What is finished stays in the
/// store; what the budget has no room for is left out and noted.
///
///   askEngines ── holdAgainstMirrors ── run ── results
class Climb {
 public:
  /// All outlive it.
  /// @param earlier  runs that need not be made again
  /// @throws BadInput for an engine that is not installed
  Climb(const ThesisLadder& ladder, const RunCommand& command, RunStore& store, double budget,
        EarlierRuns earlier);

  /// Which engine can run which leg, and how long a step takes it.
  void askEngines();
  /// Which of them are their mirrors, so that those may carry them: on the first leg that all
  /// engines run, from so many states along its flow.
  void holdAgainstMirrors(std::size_t starts);
  void run();

  /// What run() would do.
  std::string plan() const;
  /// Legs, engines, finished and failed runs, notes.
  ThesisResults results() const;

 private:
  using Outcome = KeptTask<ThesisRun>::Outcome;

  void ask(ClimbingEngine& own);
  void takeSteps();
  void timeStepsOf(ClimbingEngine& own);
  KeptTask<ThesisRun> taskOf(const LadderStep& step) const;
  Outcome runStep(const LadderStep& step, const std::string& name, const CaseKeys& key,
                  const std::function<void(double)>& progress) const;
  double predicted(const LadderStep& step) const;
  /// @param share  of the run that took so long: the rest was done before
  void learn(const LadderStep& step, double seconds, double share) const;
  /// Its earlier run, if there is one.
  const ThesisRun* earlier(const LadderStep& step, const CaseKeys& key) const;
  double elapsed() const;
  std::string label(const LadderStep& step) const;

  const ThesisLadder& ladder_;
  const RunCommand& command_;
  RunStore& store_;
  double budget_;
  EarlierRuns earlier_;
  Progress progress_;
  std::chrono::steady_clock::time_point started_ = std::chrono::steady_clock::now();
  std::vector<LadderStep> steps_;
  std::vector<ThesisRun> runs_;
  std::vector<std::string> refusals_;
  std::vector<ThesisCarrier> carriers_;
  mutable std::mutex learning_;
  mutable std::vector<ClimbingEngine> engines_;
};

}  // namespace crossgrain::inline runs

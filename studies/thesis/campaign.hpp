#pragma once

#include <chrono>
#include <filesystem>
#include <limits>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "cases/thesis_sweep.hpp"
#include "results/thesis.hpp"
#include "studies/core/engine_access.hpp"
#include "studies/core/executor.hpp"
#include "studies/core/run_store.hpp"

namespace crossgrain::inline studies {

/// Finished runs of earlier results by their keys, so that a campaign of days may be made in
/// several sessions, by the program as it is at each.
using EarlierRuns = std::map<std::string, ThesisRun>;

/// @param file  results.json of a campaign. Runs without a key, of versions that gave none, are
/// left.
/// @throws BadInput if it holds no such results
EarlierRuns readEarlierRuns(const std::filesystem::path& file);

/// An engine of the campaign, and how fast it was seen to be.
struct ThesisEngine {
  EngineEntry entry;
  SweepEngine::Part part = SweepEngine::Part::own;
  std::string version = {};              ///< empty: it did not answer
  std::optional<Capabilities> can = {};  ///< absent: it did not answer
  double perStep = 0.0;                  ///< seconds that a step takes a disk; 0: not known
  std::size_t seen = 0;                  ///< runs that say so
};

/// The runs of a sweep, most important first, several side by side. What is finished stays in the
/// store; what the budget has no room for is left out and noted.
///
///   askEngines ── compareWithMirrors ── run ── results
class ThesisCampaign {
 public:
  /// All outlive it.
  /// @param earlier  runs that need not be made again
  /// @throws BadInput for an engine that is not installed
  ThesisCampaign(const ThesisSweep& sweep, const RunCommand& command, RunStore& store,
                 double budget = std::numeric_limits<double>::infinity(), EarlierRuns earlier = {});

  /// Which engine can run which case.
  void askEngines();
  /// Which of them are equivalent to their mirrors, so that those may stand for them: on the first
  /// case that all engines run, from so many states along its flow.
  void compareWithMirrors(std::size_t starts);
  void run();

  /// What run() would do.
  std::string plan() const;
  /// Cases, engines, finished and failed runs, notes.
  ThesisResults results() const;

 private:
  using Outcome = CachedTask<ThesisRun>::Outcome;

  void ask(ThesisEngine& own);
  void listRuns();
  void timeStepsOf(ThesisEngine& own);
  CachedTask<ThesisRun> taskOf(const SweepRun& wanted) const;
  Outcome make(const SweepRun& wanted, const std::string& name, const CaseKeys& key,
               const std::function<void(double)>& progress) const;
  double predicted(const SweepRun& wanted) const;
  /// @param share  of the run that took so long: the rest was done before
  void learn(const SweepRun& wanted, double seconds, double share) const;
  /// Its earlier run, if there is one.
  const ThesisRun* earlier(const SweepRun& wanted, const CaseKeys& key) const;
  double elapsed() const;

  const ThesisSweep& sweep_;
  const RunCommand& command_;
  RunStore& store_;
  double budget_;
  EarlierRuns earlier_;
  Progress progress_;
  std::chrono::steady_clock::time_point started_ = std::chrono::steady_clock::now();
  std::vector<SweepRun> wanted_;
  std::vector<ThesisRun> runs_;
  std::vector<std::string> refusals_;
  std::vector<ThesisSurrogate> surrogates_;
  mutable std::mutex learning_;
  mutable std::vector<ThesisEngine> engines_;
};

}  // namespace crossgrain::inline studies

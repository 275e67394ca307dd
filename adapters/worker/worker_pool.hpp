#pragma once

#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "adapters/program_call.hpp"
#include "adapters/worker/worker_engine.hpp"

namespace crossgrain {

/// Workers between two runs. Starting one takes up to seconds; `load` starts afresh by the
/// protocol, so that a worker can go from run to run: PooledEngine takes one here and gives it
/// back.
///
/// An engine's workers are taken back only once one of them was seen to start afresh. What is known
/// of an engine is known for the life of the pool.
class WorkerPool {
 public:
  /// Engine of a worker and the call that started it. Only workers equal in both can be exchanged.
  struct Kind {
    std::string name;
    ProgramCall call;
    bool operator==(const Kind&) const = default;
  };

  /// Outcome of an engine's second load.
  enum class Loads {
    untried,
    afresh,    ///< its second load did what its first had done
    notAfresh  ///< or it broke down over that: a new process for each run
  };

  WorkerPool() = default;
  /// Ends all waiting workers, side by side.
  ~WorkerPool();
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;

  /// A waiting worker that still answers, for a run with that folder and time-out; else null.
  struct Taken {
    std::unique_ptr<WorkerEngine> worker;
    bool loaded = false;  ///< it has been sent a scene before
  };
  Taken take(const Kind& kind, const std::filesystem::path& scratch, double timeout);

  /// @pre nothing was wrong with it; if `loaded`, loadsOf(kind) is afresh
  void giveBack(const Kind& kind, std::unique_ptr<WorkerEngine> worker, bool loaded);

  Loads loadsOf(const Kind& kind) const;
  /// @param why  of those that do not start afresh, for people
  void learn(const Kind& kind, Loads loads, const std::string& why = {});
  /// Why the engine of that name gets a new process for each run; empty: it does not.
  std::string reasonNotReused(const std::string& name) const;

 private:
  struct Waiting {
    Kind kind;
    std::unique_ptr<WorkerEngine> worker;
    bool loaded;
  };
  struct Known {
    Kind kind;
    Loads loads;
    std::string why;
  };

  mutable std::mutex mutex_;
  std::vector<Waiting> waiting_;  ///< the one that has waited longest first
  std::vector<Known> known_;
};

/// An engine in a worker that other runs may have had before, and others may have after.
///
/// The first worker of an engine that is new to the pool is tried with the first scene that it is
/// asked to load: it loads that scene, does some steps, loads it again, and does them again. If all
/// that it shows is the same to the bit, and contacts were among it, its workers are used again.
/// If not, or if it breaks down over that, this run and every later one gets a new process, whose
/// only scene is that run's: an engine with leftovers shows what it would have shown alone.
/// Leftovers that one scene cannot show are not found, here as wherever scenes are loaded one after
/// the other into one worker (lockstep, collisions).
///
/// A worker that failed in any way, or whose answers were found to be impossible (discardWorker()),
/// is ended with this object.
class PooledEngine final : public Engine {
 public:
  /// @throws EngineFailure if there is none that waits and a new one cannot be started
  PooledEngine(WorkerPool& pool, WorkerPool::Kind kind, std::filesystem::path scratch,
               double timeout);
  ~PooledEngine() override;
  PooledEngine(const PooledEngine&) = delete;
  PooledEngine& operator=(const PooledEngine&) = delete;

  Capabilities capabilities() const override { return worker_->capabilities(); }
  EffectiveParameters load(const Scene& scene, const Settings& settings) override;
  double advance(double t) override;
  Snapshot snapshot(ContactReport contacts) override;
  EffectiveParameters loadInSpace(const SpaceScene& scene, const Settings& settings) override;
  SpaceSnapshot snapshotInSpace(ContactReport contacts) override;
  Stats stats() const override;
  void checkpoint(const std::filesystem::path& file) override;
  void restore(const std::filesystem::path& file) override;

  /// Keeps this worker from other runs: its answers were found to be impossible.
  void discardWorker() { trusted_ = false; }

  /// Of the worker that it has now; −1 once that has gone.
  pid_t pid() const { return worker_->pid(); }

 private:
  /// Does `work`; after a failure the worker is no longer trusted.
  template <typename Work>
  std::invoke_result_t<Work> ask(Work&& work) const;
  EffectiveParameters loadTried(const Scene& scene, const Settings& settings);
  std::unique_ptr<WorkerEngine> startNew() const;

  WorkerPool& pool_;
  WorkerPool::Kind kind_;
  std::filesystem::path scratch_;
  double timeout_;
  std::unique_ptr<WorkerEngine> worker_;
  bool loaded_ = false;  ///< it has been sent a scene
  mutable bool trusted_ = true;
};

/// Pool of this process, where workers wait until it ends.
WorkerPool& workerPool();

}  // namespace crossgrain

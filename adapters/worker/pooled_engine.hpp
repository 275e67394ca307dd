#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "adapters/worker/worker_pool.hpp"

namespace crossgrain {

/// An engine in a worker that other runs may have had before, and others may have after.
///
/// The first worker of an engine that is new to the pool is tried with the first scene that it is
/// asked to load: it loads that scene, does some steps, loads it again, and does them again. If all
/// that it shows is the same to the bit, and contacts were among it, its workers are used again.
/// If not, or if it breaks down over that, this run and every later one gets a new process, whose
/// only scene is that run's: an engine with leftovers shows what it would have shown alone.
/// What one scene cannot show is taken on trust, as it is wherever scenes are loaded one after the
/// other into one worker (lockstep, collisions).
///
/// A worker that failed in any way, or whose answers were found to be impossible (distrust()), is
/// ended with this object.
class PooledEngine final : public Engine {
 public:
  /// @throws EngineFailure if there is none that waits and a new one cannot be started
  PooledEngine(WorkerPool& pool, WorkerPool::Kind kind, std::filesystem::path scratch,
               double timeout);
  ~PooledEngine() override;
  PooledEngine(const PooledEngine&) = delete;
  PooledEngine& operator=(const PooledEngine&) = delete;

  Capabilities capabilities() const override { return worker_->capabilities(); }
  Realised load(const Scene& scene, const Settings& settings) override;
  double advance(double t) override;
  Snapshot snapshot(ContactReport contacts) override;
  Stats stats() const override;
  void checkpoint(const std::filesystem::path& file) override;
  void restore(const std::filesystem::path& file) override;

  /// What it showed cannot be: no other run is to have this worker.
  void distrust() { trusted_ = false; }

  /// Of the worker that it has now; −1 once that has gone.
  pid_t pid() const { return worker_->pid(); }

 private:
  /// Does `work`; after a failure the worker is no longer trusted.
  template <typename Work>
  std::invoke_result_t<Work> ask(Work&& work) const;
  Realised loadTried(const Scene& scene, const Settings& settings);
  std::unique_ptr<WorkerEngine> startNew() const;

  WorkerPool& pool_;
  WorkerPool::Kind kind_;
  std::filesystem::path scratch_;
  double timeout_;
  std::unique_ptr<WorkerEngine> worker_;
  bool loaded_ = false;  ///< it has been sent a scene
  mutable bool trusted_ = true;
};

}  // namespace crossgrain

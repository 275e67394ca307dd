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
/// An engine's workers are taken back only once one of them was seen to start afresh, see
/// PooledEngine. What is known of an engine is known for the life of the pool.
class WorkerPool {
 public:
  /// Who it is of and how it was started: what is not the same in all of this is another worker.
  struct Kind {
    std::string name;
    ProgramCall call;
    bool operator==(const Kind&) const = default;
  };

  /// What a second load of an engine was seen to do.
  enum class Loads {
    untried,
    afresh,    ///< its second load did what its first had done
    notAfresh  ///< or it broke down over that: a new process for each run
  };

  WorkerPool() = default;
  /// All that wait are told to end, then waited for.
  ~WorkerPool();
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;

  /// One that waits, if it still answers, for a run with that folder and patience; else null.
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
  std::string whyAlwaysNew(const std::string& name) const;

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

/// Of this process: they wait until it ends.
WorkerPool& workerPool();

}  // namespace crossgrain

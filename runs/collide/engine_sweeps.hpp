#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cases/case.hpp"
#include "runs/collide/sweep.hpp"
#include "runs/common/engine_access.hpp"
#include "runs/common/run_store.hpp"

namespace crossgrain::inline runs {

/// One case of collisions, with what its curves are held against.
struct CollisionCase {
  const Case* setup;
  std::vector<double> steps;  ///< time steps, a sweep for each [s]
  std::vector<CollisionStart> starts = {};
  OracleCurve oracle = {};

  /// Whether an engine takes part: mirrors only where the case wants them.
  bool wants(const EngineEntry& entry, const std::vector<std::string>& named) const;
};

/// What one engine does: the sweeps of all cases in one worker, which is started again after a
/// failure. Finished cases are kept.
///
///   start ── takeUp ── runRest
class EngineSweeps {
 public:
  /// All outlive it. @param named  the engines that the user asked for
  EngineSweeps(const EngineEntry& entry, const std::vector<std::string>& named,
               const RunStore& store)
      : entry_(entry), named_(named), store_(store) {}

  /// Starts the worker and asks for its version; one that fails does so again, sweep by sweep.
  /// @throws Interrupted, BadInput
  void start(double timeout);
  /// Looks for what is finished. @throws BadInput from RunStore::find()
  void takeUp(const std::vector<CollisionCase>& cases);
  /// Runs what is not there yet. Failures end up in the curve that failed, which is not kept.
  /// @param progress  told the fraction done, 0 … 1
  /// @throws Interrupted, BadInput, OutputError
  void runRest(const std::vector<CollisionCase>& cases,
               const std::function<void(double)>& progress);

  const EngineEntry& entry() const { return entry_; }
  /// The curves of a case, step by step: absent before they are run, none where the engine takes no
  /// part.
  const std::optional<std::vector<CollisionCurve>>& curves(std::size_t which) const {
    return curves_[which];
  }
  /// How many cases were finished before.
  std::size_t takenUp() const { return takenUp_; }

 private:
  std::vector<CollisionCurve> run(const CollisionCase& each,
                                  const std::function<void()>& oneIsDone);
  std::string nameOf(const Case& setup) const;

  const EngineEntry& entry_;
  const std::vector<std::string>& named_;
  const RunStore& store_;
  std::unique_ptr<Engine> worker_;
  std::string version_;  ///< empty: it did not answer
  std::vector<std::optional<std::vector<CollisionCurve>>> curves_;
  std::size_t takenUp_ = 0;
};

}  // namespace crossgrain::inline runs

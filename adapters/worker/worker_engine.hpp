#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "adapters/engine.hpp"
#include "adapters/worker/arrays.hpp"
#include "adapters/worker/process.hpp"

namespace crossgrain {

/// A request to a worker and what came of it, as they travelled.
struct Exchange {
  nlohmann::json request;
  std::string sent;  ///< content of the array file of `load`
  /// Null where none came: `failure` says why, as the user reads it.
  nlohmann::json answer;
  std::string received;  ///< content of the array file of `snapshot`
  std::string failure;
};

/// Gets every exchange with a worker once it is over, before anything in it is believed.
using ExchangeListener = std::function<void(const Exchange&)>;

/// An engine in a process of its own, spoken to by the worker protocol (README.md).
///
/// Whatever goes wrong with that process — it ends, hangs, answers nonsense, writes a short file or
/// a NaN — is an EngineFailure of one line that names the engine, the scene and the time. The
/// process is then gone and every later call throws the same line. A refusal or a failure that the
/// worker itself reports leaves it alive.
class WorkerEngine final : public Engine {
 public:
  /// Starts the worker and asks what it can do.
  /// @param call     the program; its stamp becomes part of the version
  /// @param scratch  directory for array files and the log NAME.log; made if there is none
  /// @param timeout  longest wait for one answer [s]; longer for a worker that computes meanwhile
  /// @param listener gets every exchange, hello too
  /// @throws EngineFailure
  WorkerEngine(std::string name, const ProgramCall& call, std::filesystem::path scratch,
               double timeout, ExchangeListener listener = {});
  ~WorkerEngine() override;

  Capabilities capabilities() const override { return capabilities_; }
  EffectiveParameters load(const Scene& scene, const Settings& settings) override;
  double advance(double t) override;
  Snapshot snapshot(ContactReport contacts) override;
  EffectiveParameters loadInSpace(const SpaceScene& scene, const Settings& settings) override;
  SpaceSnapshot snapshotInSpace(ContactReport contacts) override;
  Stats stats() const override;
  void checkpoint(const std::filesystem::path& file) override;
  void restore(const std::filesystem::path& file) override;

  /// Whether the worker runs and has written nothing without a request.
  bool isReady() const;

  /// From now on it works for another run: with that run's folder and patience, and a log that
  /// begins anew; what it has said so far stays in the folder that it leaves.
  /// @throws EngineFailure if the log cannot move along
  void moveTo(const std::filesystem::path& scratch, double timeout);

  /// Asks it to end, and does not wait for that. Nothing can be asked of it any more.
  void dismiss();

  /// Of the worker, which is also its process group; −1 once it has gone.
  pid_t pid() const { return process_ ? process_->pid() : -1; }

 private:
  template <int D>
  EffectiveParameters loadShape(const SceneOf<D>& scene, const Settings& settings);
  template <int D>
  SnapshotOf<D> snapshotOf(const SceneOf<D>& shape, ContactReport contacts);
  nlohmann::json ask(nlohmann::json request, const std::string& what) const;
  /// The answer, heard by the listener, too.
  nlohmann::json exchange(const nlohmann::json& request, const std::string& what) const;
  nlohmann::json answerTo(const nlohmann::json& request, const std::string& what) const;
  /// Its line. A worker that is late and computes is waited for until it has had as much processor
  /// time again as the time-out, so that none fails for what else the machine does.
  std::string receive(ChildProcess::Clock::time_point deadline) const;
  /// Ends the worker and throws.
  [[noreturn]] void fail(const std::string& what) const;
  /// Runs `read` on a reply; what it throws becomes an EngineFailure that says which reply.
  template <typename Read>
  std::invoke_result_t<Read> understand(const std::string& what, Read&& read) const;
  std::string where() const;
  /// One line: engine, scene, time, what went wrong, and when all was well last.
  std::string failure(const std::string& what) const;
  std::string howItEnded(const std::string& what) const;

  std::string name_;
  std::filesystem::path scratch_;
  std::filesystem::path log_;
  double timeout_;
  std::uint64_t memory_;  ///< that it is limited to [bytes]; 0: it is not
  ExchangeListener listener_;
  mutable std::unique_ptr<ChildProcess> process_;
  mutable std::string firstFailure_;
  Capabilities capabilities_;
  /// The loaded scene: what snapshots are checked against. One of the two, of its dimension.
  Scene shape_;
  SpaceScene shapeInSpace_;
  std::string sceneName_;
  double time_ = 0.0;
  std::optional<double> goodTime_;  ///< of the last snapshot of this scene
  std::unique_ptr<ExchangeFile> exchangeFile_;
  bool writesOver_ = false;  ///< the worker writes over what an array file holds
  bool keepsFile_ = false;   ///< of this scene
  bool dismissed_ = false;
};

}  // namespace crossgrain

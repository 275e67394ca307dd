#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "adapters/engine.hpp"

namespace crossgrain::inline studies {

/// State of a long run so far, kept on disk now and then, so that --resume goes on in the
/// middle of it: the engine's own checkpoint and the snapshots taken before. Engines without
/// checkpoints keep nothing, nor do any in space.
template <int D>
class UnfinishedRunOf {
 public:
  /// @param key  everything that the run depends on
  UnfinishedRunOf(std::filesystem::path folder, std::string key, const SceneOf<D>& scene,
                  bool possible);

  struct Before {
    double time = 0.0;          ///< that the engine has reached [s]
    std::size_t snapshots = 0;  ///< taken up to then
    double wallSeconds = 0.0, cpuSeconds = 0.0;
  };

  /// Takes the engine, which has loaded the scene, to where the run was left. Absent if nothing
  /// was kept under this key, or it is damaged: then the run begins anew.
  /// @throws EngineFailure if the engine does not take its own checkpoint
  std::optional<Before> resume(Engine& engine);

  /// The k-th of those taken before, from disk.
  SnapshotOf<D> snapshot(std::size_t k) const;

  void took(const SnapshotOf<D>& snapshot);
  /// @param time  that the engine has reached [s]
  void keep(Engine& engine, double time);
  /// The same, if the last time is half a minute ago.
  void keepIfDue(Engine& engine, double time);
  /// The run is finished, and kept elsewhere.
  void remove();

 private:
  Before readBack(const nlohmann::json& kept);

  std::filesystem::path folder_;
  std::string key_;
  const SceneOf<D>& scene_;
  bool possible_;
  nlohmann::json snapshots_ = nlohmann::json::array();  ///< on disk
  std::vector<SnapshotOf<D>> pending_;                  ///< not yet there
  double earlierWall_ = 0.0, earlierCpu_ = 0.0;
  int checkpoints_ = 0;
  std::chrono::steady_clock::time_point keptAt_;
};
using UnfinishedRun = UnfinishedRunOf<2>;

}  // namespace crossgrain::inline studies

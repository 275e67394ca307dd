#include "studies/flow/unfinished_run.hpp"

#include <fmt/format.h>

#include "adapters/worker/arrays.hpp"
#include "adapters/worker/json.hpp"
#include "support/files.hpp"
#include "support/json_text.hpp"

namespace crossgrain::inline studies {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

constexpr auto interval = std::chrono::seconds(30);
constexpr const char* indexName = "index.json";

/// The run kept under that key; null: none that can be used.
json keptUnder(const fs::path& folder, const std::string& key) {
  try {
    json kept = readJsonFile(folder / indexName).value_or(json());
    return kept.is_object() && member<std::string>(kept, "key") == key ? kept : json();
  } catch (const FieldError&) {
    return json();
  } catch (const BadInput&) {
    return json();
  }
}

}  // namespace

template <int D>
UnfinishedRunOf<D>::UnfinishedRunOf(fs::path folder, std::string key, const SceneOf<D>& scene,
                                    bool possible)
    : folder_(fs::absolute(folder)),
      key_(std::move(key)),
      scene_(scene),
      possible_(possible),
      keptAt_(std::chrono::steady_clock::now()) {}

template <int D>
std::optional<typename UnfinishedRunOf<D>::Before> UnfinishedRunOf<D>::resume(Engine& engine) {
  if (!possible_) return std::nullopt;
  const json kept = keptUnder(folder_, key_);
  if (!kept.is_object()) {
    remove();
    return std::nullopt;
  }
  std::string checkpoint;
  Before before;
  try {
    before = readBack(kept);
    checkpoint = kept.at("checkpoint");
  } catch (const std::exception&) {  // damaged: of no use
    remove();
    return std::nullopt;
  }
  try {
    engine.restore(folder_ / checkpoint);
  } catch (const EngineFailure&) {
    remove();  // so that the next attempt begins anew
    throw;
  }
  return before;
}

template <int D>
typename UnfinishedRunOf<D>::Before UnfinishedRunOf<D>::readBack(const json& kept) {
  Before before;
  before.time = kept.at("time");
  before.wallSeconds = earlierWall_ = kept.at("wall_s");
  before.cpuSeconds = earlierCpu_ = kept.at("cpu_s");
  snapshots_ = kept.at("snapshots");
  before.snapshots = snapshots_.size();
  for (std::size_t k = 0; k < before.snapshots; ++k) snapshot(k);  // throws if damaged
  checkpoints_ = kept.at("checkpoints");
  return before;
}

template <int D>
SnapshotOf<D> UnfinishedRunOf<D>::snapshot(std::size_t k) const {
  const json& entry = snapshots_.at(k);
  const fs::path file = folder_ / entry.at("file").get<std::string>();
  return snapshotFromJson(entry.at("snapshot"), ArrayReader(file, entry.at("arrays")), scene_);
}

template <int D>
void UnfinishedRunOf<D>::took(const SnapshotOf<D>& snapshot) {
  if (possible_) pending_.push_back(snapshot);
}

template <int D>
void UnfinishedRunOf<D>::keepIfDue(Engine& engine, double time) {
  if (possible_ && std::chrono::steady_clock::now() - keptAt_ > interval) keep(engine, time);
}

/// The index is written last and in one piece: whatever happens before leaves the earlier one.
template <int D>
void UnfinishedRunOf<D>::keep(Engine& engine, double time) {
  if (!possible_) return;
  makeDirectory(folder_);
  for (const SnapshotOf<D>& snapshot : pending_) {
    const std::string name = fmt::format("snapshot-{:05d}.bin", snapshots_.size());
    ArrayWriter arrays;
    json entry = {{"file", name}, {"snapshot", toJson(snapshot, arrays)}};
    entry["arrays"] = arrays.write(folder_ / name);
    snapshots_.push_back(std::move(entry));
  }
  pending_.clear();
  const auto checkpointName = [](int number) { return fmt::format("engine-{}", number); };
  engine.checkpoint(folder_ / checkpointName(++checkpoints_));
  const Stats stats = engine.stats();
  writeFile(folder_ / indexName, json({{"key", key_},
                                       {"time", time},
                                       {"wall_s", earlierWall_ + stats.wallSeconds},
                                       {"cpu_s", earlierCpu_ + stats.cpuSeconds},
                                       {"checkpoint", checkpointName(checkpoints_)},
                                       {"checkpoints", checkpoints_},
                                       {"snapshots", snapshots_}})
                                     .dump());
  std::error_code ignored;
  fs::remove(folder_ / checkpointName(checkpoints_ - 1), ignored);
  keptAt_ = std::chrono::steady_clock::now();
}

template <int D>
void UnfinishedRunOf<D>::remove() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

template class UnfinishedRunOf<2>;
template class UnfinishedRunOf<3>;

}  // namespace crossgrain::inline studies

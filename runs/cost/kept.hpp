#pragma once

#include <optional>
#include <string>

#include "results/cost_fields.hpp"
#include "runs/common/run_store.hpp"
#include "runs/cost/average_bounds.hpp"
#include "runs/cost/collision_limit.hpp"
#include "runs/cost/trajectory.hpp"

/// What a study of cost keeps in its store while it is under way, as structs.
namespace crossgrain::inline runs {

/// A point that was seen to fail past its limit.
struct KeptFailure {
  std::string reason;
};
void fields(auto& io, KeptFailure& failure) {
  io("reason", failure.reason);
}

void fields(auto& io, TrajectoryReference& reference) {
  io("error", reference.error);
  io("positions", reference.positions);
}

void fields(auto& io, SettingWindows& windows) {
  io("equivalent", windows.equivalent);
  io("dt_s", windows.dt);
  io("wall_s", windows.wallSeconds);
  io("cpu_s", windows.cpuSeconds);
  io("steps", windows.steps);
  io("contact_evaluations", windows.contactEvaluations);
}

void fields(auto& io, CollisionLimit& limit) {
  io("setting", limit.setting);
  io("ends", limit.ends);
  io("error", limit.error);
  io("model", limit.model);
  io("reason", limit.reason);
}

/// @throws FieldError, and as RunStore::find()
template <class Run>
std::optional<Run> findAs(const RunStore& store, const std::string& name, const CaseKeys& key) {
  return store.findAs<Run>(name, key);
}

/// What the store has by that name, else what `make` makes, which is then kept.
template <class Make>
auto keptOr(const RunStore& store, const std::string& name, const CaseKeys& key, Make make) {
  using Run = decltype(make());
  if (auto kept = findAs<Run>(store, name, key)) return std::move(*kept);
  Run made = make();
  store.keep(name, key, jsonOf(made));
  return made;
}

}  // namespace crossgrain::inline runs

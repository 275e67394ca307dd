#include "studies/lockstep/lockstep.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "adapters/registry.hpp"
#include "adapters/suitability.hpp"
#include "adapters/worker/json.hpp"
#include "results/lockstep.hpp"
#include "results/lockstep_findings.hpp"
#include "studies/core/engine_access.hpp"
#include "studies/core/executor.hpp"
#include "studies/lockstep/comparison.hpp"
#include "studies/lockstep/rules.hpp"
#include "studies/lockstep/starts.hpp"
#include "studies/lockstep/terms.hpp"

namespace crossgrain::inline studies {

std::string noMirrorReason(const EngineEntry& entry, const Capabilities& can, const Case& setup) {
  if (entry.name == engineRegistry().front().name)
    return "mirrors are made of this engine: it is its own";
  if (!hasNormalLaw(can, setup.law))
    return "has another normal law in place of the case's: no mirror stands for it step by step";
  return {};
}

namespace {

std::string describe(Equivalence verdict) {
  std::string words(nameOf(verdict));
  std::ranges::replace(words, '_', ' ');
  return words;
}

CachedTask<LockstepRow> taskOf(const LockstepEngine& engine, const Case& setup,
                               const std::vector<FlowState>& states, double dt,
                               const RunStore& store) {
  const EngineEntry& entry = engine.entry;
  std::string from;
  for (const FlowState& state : states) from += (from.empty() ? "" : " ") + state.packing.hash;
  CachedTask<LockstepRow> task;
  task.name = "lockstep-" + entry.name;
  task.label = entry.name;
  task.key = runKey(setup, entry.name, engine.version);
  task.key["starts"] = from;
  task.weight = entry.command ? 10.0 : 1.0;
  task.work = [&entry, &setup, &states, &store, dt](const std::function<void(double)>& progress) {
    LockstepRow row;
    row.engine = entry.name;
    try {
      const auto worker =
          startAudited(entry, store.scratch("lockstep-" + entry.name), setup.run.timeout);
      row.reason = noMirrorReason(entry, worker->capabilities(), setup);
      if (row.reason.empty()) row = holdAgainstMirror(*worker, entry, setup, states, dt, progress);
    } catch (const UnsupportedScene& refusal) {
      row.reason = refusal.what();
    } catch (const EngineFailure& failure) {
      row.reason = row.failure = failure.what();
    }
    const bool finished = row.failure.empty();
    const std::string line = finished ? describe(row.verdict) : row.failure;
    return CachedTask<LockstepRow>::Outcome{std::move(row), finished, line};
  };
  return task;
}

}  // namespace

LockstepFindings holdAgainstMirrors(const std::vector<LockstepEngine>& engines, const Case& setup,
                                    const LockstepPlan& plan, const RunStore& store,
                                    Progress& progress) {
  progress.begin("finding states of the flow", {1.0});
  const std::vector<FlowState> states = statesAlongTheFlow(
      setup, plan.packings, plan.dt, plan.starts,
      [&](double fraction) { progress.update(0, "states", fraction); }, plan.jobs);
  if (states.size() < plan.starts)
    progress.say(fmt::format("{} different starts along the flow, of the {} asked for",
                             states.size(), plan.starts));
  std::vector<CachedTask<LockstepRow>> tasks;
  for (const LockstepEngine& engine : engines)
    tasks.push_back(taskOf(engine, setup, states, plan.dt, store));
  LockstepFindings findings;
  findings.rules = lockstepRules(setup.law);
  for (const FlowState& state : states) findings.starts.push_back(state.start);
  findings.rows = runOrLoad(tasks, store, progress, "lockstep", plan.jobs);
  return findings;
}

}  // namespace crossgrain::inline studies

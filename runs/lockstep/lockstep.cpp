#include "runs/lockstep/lockstep.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "adapters/suitability.hpp"
#include "results/lockstep_fields.hpp"
#include "results/schema.hpp"
#include "runs/common/engine_access.hpp"
#include "runs/couette/campaign.hpp"
#include "runs/lockstep/comparison.hpp"
#include "runs/lockstep/rules.hpp"
#include "runs/lockstep/terms.hpp"

namespace crossgrain::inline runs {
namespace {

/// Why an engine has no mirror in this scene; empty: it has one.
std::string whyNoMirror(const EngineEntry& entry, const Capabilities& can, const Case& setup) {
  if (entry.name == engineRegistry().front().name)
    return "mirrors are made of this engine: it is its own";
  if (!hasNormalLaw(can, setup.law))
    return "has another normal law in place of the case's: no mirror stands for it step by step";
  return {};
}

std::string inWords(LockstepVerdict verdict) {
  std::string words(nameOf(verdict));
  std::ranges::replace(words, '_', ' ');
  return words;
}

KeptTask<LockstepRow> taskOf(const Campaign& campaign, std::size_t e, const Case& setup,
                             const std::vector<FlowState>& states) {
  const EngineEntry& entry = campaign.engines()[e];
  std::string part = "lockstep from";
  for (const FlowState& state : states) part += ' ' + state.packing.hash;
  KeptTask<LockstepRow> task;
  task.name = "lockstep-" + entry.name;
  task.label = entry.name;
  task.key = campaign.keyOf(e, 0, part);
  task.weight = entry.command ? 10.0 : 1.0;
  task.work = [&campaign, &entry, &setup, &states](const std::function<void(double)>& progress) {
    const auto engine =
        startEngine(entry, campaign.store().scratch("lockstep-" + entry.name), setup.run.timeout);
    LockstepRow row;
    if (std::string reason = whyNoMirror(entry, engine->capabilities(), setup); !reason.empty()) {
      row.engine = entry.name;
      row.reason = std::move(reason);
    } else {
      row = holdAgainstMirror(*engine, entry, setup, states, campaign.dt(), progress);
    }
    const bool finished = row.failure.empty();
    const std::string line = finished ? inWords(row.verdict) : row.failure;
    return KeptTask<LockstepRow>::Outcome{std::move(row), finished, line};
  };
  return task;
}

}  // namespace

LockstepResults runLockstep(const Case& setup, const RunCommand& command, RunStore& store,
                            std::size_t starts) {
  checkEngineSections(setup);
  Campaign campaign(setup, command, selectEngines(command.engines), store);
  campaign.askEngines();
  campaign.preparePackings();
  campaign.progress().begin("finding states of the flow", {1.0});
  const std::vector<FlowState> states = statesAlongTheFlow(
      setup, campaign.packings(), campaign.dt(), starts,
      [&](double fraction) { campaign.progress().update(0, "states", fraction); });
  std::vector<KeptTask<LockstepRow>> tasks;
  for (std::size_t e = 0; e < campaign.engines().size(); ++e)
    if (campaign.refusal(e).empty()) tasks.push_back(taskOf(campaign, e, setup, states));
  const auto rows =
      doOrTakeUp(tasks, campaign.store(), campaign.progress(), "lockstep", command.jobs);

  LockstepResults results{campaign.study(kindLockstep), {}, {}, {}};
  results.rules = {lockstepRounding, lockstepSameLaw, yardstickChanges.back(),
                   yardstickOf(setup.law)};
  for (const FlowState& state : states) results.starts.push_back(state.start);
  results.rows = rows;
  for (EngineRow& engine : results.engines)
    for (const LockstepRow& row : rows)
      if (row.engine == engine.name && !row.failure.empty()) {
        engine.status = EngineStatus::failed;
        engine.reason = row.failure;
      }
  return results;
}

std::string lockstepPlan(const Case& setup, const RunCommand& command, RunStore& store,
                         std::size_t starts) {
  checkEngineSections(setup);
  Campaign campaign(setup, command, selectEngines(command.engines), store);
  campaign.askEngines();
  campaign.lookForPackings();
  std::vector<PlannedWork> works;
  for (std::size_t e = 0; e < campaign.engines().size(); ++e) {
    PlannedWork work{campaign.engines()[e].name, "windows", campaign.refusal(e)};
    const auto& can = campaign.capabilities(e);
    if (can && work.refusal.empty()) work.refusal = whyNoMirror(campaign.engines()[e], *can, setup);
    if (work.refusal.empty()) work.total = starts;
    works.push_back(work);
  }
  return dryRunInWords(campaign.planHead(), works, store, command);
}

}  // namespace crossgrain::inline runs

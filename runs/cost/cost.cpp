#include "runs/cost/cost.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "results/schema.hpp"
#include "runs/cost/analysis.hpp"
#include "runs/cost/error_kind.hpp"
#include "runs/cost/executor.hpp"
#include "runs/cost/planner.hpp"
#include "runs/cost/study.hpp"
#include "support/bad_input.hpp"

namespace crossgrain::inline runs {

namespace {

void checkEngineNames(const Case& setup) {
  checkEngineSections(setup);
  for (const auto& [name, values] : setup.cost.settings)
    if (!findEngine(name))
      throw BadInput(fmt::format("{}: [cost.settings.{}]: there is no such engine",
                                 setup.file.string(), name));
}

/// The orders that integrators are known for.
const std::map<std::string, int>& knownOrders() {
  static const std::map<std::string, int> orders = {
      {"position_verlet", 2}, {"velocity_verlet", 2}, {"semi_implicit_euler", 1}};
  return orders;
}

/// What the engines took to start, the orders they claim, and those that failed for other reasons
/// than a step beyond the stability limit.
void addEngines(CostResults& results, const CostStudy& study) {
  for (std::size_t e = 0; e < study.engines.size(); ++e) {
    const TimedEngine& engine = study.engines[e];
    const std::string& name = study.entryOf(e).name;
    if (!engine.takesPart) continue;
    results.startup.push_back({name, engine.start, engine.load});
    if (const auto& realised = study.campaign.realised(e))
      if (const auto found = knownOrders().find(realised->integrator); found != knownOrders().end())
        results.theory[name] = found->second;
    for (const auto& [integrator, order] : knownOrders())
      results.theory[name + " " + integrator] = order;
  }
  results.engineFailures = study.engineFailures;
  for (EngineRow& engine : results.engines)
    for (const CostPoint& point : results.points)
      if (point.engine == engine.name && point.status == CostStatus::failed &&
          std::ranges::find(study.engineFailures, point.reason) != study.engineFailures.end()) {
        engine.status = EngineStatus::failed;
        engine.reason = point.reason;
      }
}

}  // namespace

CostResults measureCost(const Case& setup, const CostRequest& request, RunStore& store) {
  checkEngineNames(setup);
  CostStudy study(setup, request.run, store);
  const ErrorKinds kinds = errorKinds(study);
  study.prepare();
  for (const auto& kind : kinds) kind->prepare();

  CostPlan plan = planCost(study, kinds, request.budget);
  if (request.tellPlan) request.tellPlan(planInWords(plan, study.engineNames(), request.budget));

  std::vector<CostPoint> points = execute(plan, study, kinds);

  CostResults results;
  CouetteStudy couette = study.campaign.study(kindCost);
  static_cast<CouetteFrame&>(results) = couette;
  results.elapsed = couette.elapsed;
  results.engines = std::move(couette.engines);
  results.packings = std::move(couette.packings);
  results.points = std::move(points);
  results.budget = request.budget;
  results.budgetForTheRest = plan.budgetForTheRest;
  for (const auto& kind : kinds) kind->addTo(results);
  addEngines(results, study);
  addCostAnalysis(results, request.targets);
  return results;
}

std::string costPlan(const Case& setup, const CostRequest& request, RunStore& store) {
  checkEngineNames(setup);
  CostStudy study(setup, request.run, store);
  study.ask();
  std::vector<PlannedWork> works = study.campaign.plan({});  // engines that refuse
  for (std::size_t e = 0; e < study.engines.size(); ++e)
    for (const CostKind kind : costKinds) {
      PlannedWork work{study.entryOf(e).name, "settings, " + toString(kind)};
      const std::vector<CostSetting>& settings = study.settingsOf(e, kind);
      for (std::size_t s = 0; s < settings.size(); ++s) {
        if (!settings[s].refusal.empty() ||
            (kind == CostKind::averages && settings[s].isSampling()))
          continue;
        ++work.total;
        work.finished += study.isKept({e, kind, s, 0.0, {}, false});
      }
      if (work.total > 0) works.push_back(work);
    }
  return dryRunInWords(
      fmt::format("{}budget {:.0f} s; what fits into it is planned once steps have been timed\n",
                  study.campaign.planHead(), request.budget),
      works, study.campaign.store(), request.run);
}

}  // namespace crossgrain::inline runs

#include "studies/cost/cost.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <memory>
#include <tuple>

#include "cases/loader.hpp"
#include "results/schema.hpp"
#include "studies/core/engine_access.hpp"
#include "studies/core/executor.hpp"
#include "studies/core/study_cases.hpp"
#include "studies/cost/analysis.hpp"
#include "studies/cost/averages.hpp"
#include "studies/cost/collision.hpp"
#include "studies/cost/trajectory.hpp"
#include "support/bad_input.hpp"
#include "support/files.hpp"
#include "support/interrupt.hpp"

namespace crossgrain::inline studies {

namespace {

/// What --quick makes of [cost]: every kind of error and some settings, in seconds.
const std::vector<std::string> quickCosts = {"cost.timed=0.002",
                                             "cost.psi_count=9",
                                             "cost.collision_steps=[50, 10, 1.2]",
                                             "cost.collision_reference=800",
                                             "cost.trajectory_steps=[50, 10]",
                                             "cost.trajectory_reference=400",
                                             "cost.window_most=5",
                                             "cost.average_steps=[50, 10]",
                                             "cost.average_reference=100"};

double costBudget(const CostOptions& options) {
  return secondsOf(options.budget.value_or("12m"));
}

std::vector<Case> casesOfCost(const CommandLine& line, CostOptions& own) {
  costBudget(own);  // what is misspelt is refused before anything runs
  if (own.target) fractionOf(*own.target);
  const Case setup = onlyCase(line, "cost");
  if (!line.quick) return {setup};
  std::vector<std::string> overrides =
      quickOverrides(loadCase(line.inputs.front(), line.overrides).front(), 0.05);
  overrides.insert(overrides.end(), quickCosts.begin(), quickCosts.end());
  overrides.insert(overrides.end(), line.overrides.begin(), line.overrides.end());
  return loadCase(line.inputs.front(), overrides);
}

using ErrorKinds = std::vector<std::unique_ptr<ErrorKind>>;
using Points = std::vector<CostPoint>;

/// Those that the case wants, in their order.
ErrorKinds errorKinds(CostStudy& study) {
  ErrorKinds kinds;
  kinds.push_back(collisionErrors(study));
  kinds.push_back(trajectoryErrors(study));
  kinds.push_back(averageErrors(study));
  std::erase_if(kinds, [&](const auto& kind) {
    return std::ranges::find(study.setup.cost.kinds, kind->kind()) == study.setup.cost.kinds.end();
  });
  return kinds;
}

ErrorKind& kindOf(const ErrorKinds& kinds, const PlannedPoint& point) {
  return **std::ranges::find_if(kinds, [&](const auto& one) { return one->kind() == point.kind; });
}

void checkEngineNames(const Case& setup) {
  checkEngineSections(setup);
  for (const auto& [name, values] : setup.cost.settings)
    if (!findEngine(name))
      throw BadInput(fmt::format("{}: [cost.settings.{}]: there is no such engine",
                                 setup.file.string(), name));
}

/// Every setting of every engine, for every kind of error, and what of it fits into the budget [s].
CostPlan planCost(const CostStudy& study, const ErrorKinds& kinds, double budget) {
  CostPlan plan{.references = ReferenceTimes(study.engines.size())};
  for (const auto& kind : kinds) {
    double common = 0.0;
    for (std::size_t e = 0; e < study.engines.size(); ++e) {
      const std::vector<CostSetting>& settings = study.settingsOf(e, kind->kind());
      bool anew = false;
      for (std::size_t s = 0; s < settings.size(); ++s) {
        PlannedPoint& point = plan.points.emplace_back(PlannedPoint{e, kind->kind(), s});
        if (!settings[s].refusal.empty() || kind->isKept(point)) continue;
        point.seconds = kind->predicted(e, settings[s]);
        anew = true;
      }
      if (!anew) continue;
      plan.references[e][kind->kind()] = kind->ownTime(e);
      common = kind->commonTime();
    }
    constexpr double largestPart = 0.8;  // of a budget that references may take
    if (common > largestPart * budget) {
      plan.impossible[kind->kind()] =
          fmt::format("the reference alone would take about {:.3g} s of {:.3g} s", common, budget);
      plan.budgetForTheRest += common / largestPart;
    } else {
      plan.common += common;
    }
  }
  fitIntoBudget(plan, budget);
  return plan;
}

/// Points without a number, one per measure, that say why.
Points without(const CostStudy& study, const ErrorKind& kind, const PlannedPoint& planned,
               CostStatus status, const std::string& reason) {
  const CostSetting& setting = study.settingOf(planned);
  CostPoint row = pointOf(study.entryOf(planned.engine).name, setting, planned.kind,
                          study.stepOf(planned.engine, setting.setup));
  row.status = status;
  row.reason = BadInput(reason).what();  // in one line
  Points points;
  for (const std::string& measure : kind.measures()) {
    row.measure = measure;
    points.push_back(row);
  }
  return points;
}

/// A failure at a step beyond a stability limit is a result. @returns its reason, else nothing
std::optional<std::string> pastLimit(const CostStudy& study, const PlannedPoint& planned,
                                     const std::string& reason) {
  if (reason.find(beyondLimit) != std::string::npos) return reason;
  const Case& setup = study.settingOf(planned).setup;
  const double theory =
      planned.kind == CostKind::collision ? pairLimit(setup) : packingLimit(setup);
  // What the case's own step bears and a longer one does not is past a limit, wherever theory puts
  // it: it knows no dashpots.
  const double limit = std::min(theory, study.stepOf(planned.engine, study.setup));
  if (study.stepOf(planned.engine, setup) <= limit) return std::nullopt;
  return fmt::format("{}: {}", beyondLimit, reason);
}

using Measured = CachedTask<Points>::Outcome;

Measured measure(CostStudy& study, ErrorKind& kind, const PlannedPoint& planned) {
  const auto ended = [&](CostStatus status, const std::string& reason, bool isResult) {
    return Measured{without(study, kind, planned, status, reason), isResult,
                    fmt::format("{}: {}", nameOf(status), reason)};
  };
  try {
    Points points = kind.measure(planned);
    const CostPoint& first = points.front();
    const std::string line = !first.ran()
                                 ? fmt::format("{}: {}", nameOf(first.status), first.reason)
                             : first.error ? fmt::format("{:.3g}", *first.error)
                                           : "no number";
    return {std::move(points), kind.keepsPoints(), line};
  } catch (const Interrupted&) {
    throw;
  } catch (const OutputError&) {
    throw;
  } catch (const BadInput&) {
    throw;
  } catch (const UnsupportedScene& refusal) {
    return ended(CostStatus::refused, refusal.what(), false);
  } catch (const std::exception& error) {
    if (std::string(error.what()).find(beyondLimit) == std::string::npos)
      study.engines[planned.engine].worker.reset();
    if (const auto reason = pastLimit(study, planned, error.what()))
      return ended(CostStatus::failed, *reason, true);
    study.engineFailures.push_back(error.what());
    return ended(CostStatus::failed, error.what(), false);
  }
}

/// Measures what is planned, one point at a time: kind by kind, engines in turn, so that a machine
/// that slows down does so for all. A point that fails ends by itself.
/// @returns points by kind, engine and setting
Points execute(const CostPlan& plan, CostStudy& study, const ErrorKinds& kinds) {
  for (const auto& kind : kinds)
    if (!plan.impossible.contains(kind->kind())) kind->makeReferences();
  std::map<std::tuple<CostKind, std::size_t, std::size_t>, Points> found;
  std::map<std::pair<std::size_t, CostKind>, int> rank;  // of an engine's points of a kind
  std::vector<double> spent(study.engines.size(), 0.0);  // [s]
  std::vector<CachedTask<Points>> tasks;
  std::vector<const PlannedPoint*> measured;
  for (const PlannedPoint& point : plan.points) {
    ErrorKind& kind = kindOf(kinds, point);
    const CostSetting& setting = study.settingOf(point);
    const int turn = rank[{point.engine, point.kind}]++;
    Points& points = found[{point.kind, point.engine, point.setting}];
    if (!setting.refusal.empty())
      points = without(study, kind, point, CostStatus::refused, setting.refusal);
    else if (!point.notMeasured.empty())
      points = without(study, kind, point, CostStatus::notMeasured, point.notMeasured);
    if (!points.empty()) continue;
    const auto work = [&, share = plan.shares[point.engine]](const auto&) -> Measured {
      throwIfInterrupted();
      // Predictions may be off; an engine's share is not.
      if (double& so = spent[point.engine]; so + point.seconds > 1.2 * share + 5.0) {
        const std::string reason = doesNotFit(point.seconds, share - so, share);
        return {without(study, kind, point, CostStatus::notMeasured, reason), false, reason};
      }
      const auto start = std::chrono::steady_clock::now();
      Measured outcome = measure(study, kind, point);
      spent[point.engine] +=
          std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      return outcome;
    };
    tasks.push_back({.name = study.nameOf(point),
                     .label = fmt::format("{}, {}: {} {}", study.entryOf(point.engine).name,
                                          toString(point.kind), setting.knob, setting.setting),
                     .key = study.keyOf(point),
                     .weight = point.seconds,
                     .work = work,
                     .priority = -1e6 * static_cast<double>(point.kind) - turn});
    measured.push_back(&point);
  }
  const auto results = runOrLoad(tasks, study.campaign.store(), study.campaign.progress(),
                                 "measuring, one at a time", 1);
  for (std::size_t k = 0; k < results.size(); ++k)
    found[{measured[k]->kind, measured[k]->engine, measured[k]->setting}] = results[k];
  Points all;
  for (const auto& [at, points] : found) all.insert(all.end(), points.begin(), points.end());
  return all;
}

/// What engines took to start, and which failed for other reasons than a step beyond the stability
/// limit.
void addEngines(CostResults& results, const CostStudy& study) {
  for (std::size_t e = 0; e < study.engines.size(); ++e)
    if (const TimedEngine& engine = study.engines[e]; engine.takesPart)
      results.startup.push_back({study.entryOf(e).name, engine.start, engine.load});
  results.engineFailures = study.engineFailures;
  for (EngineRow& engine : results.engines)
    for (const CostPoint& point : results.points)
      if (point.engine == engine.name && point.status == CostStatus::failed &&
          std::ranges::find(study.engineFailures, point.reason) != study.engineFailures.end()) {
        engine.status = Status::failed;
        engine.reason = point.reason;
      }
}

CostResults runCost(const StudyWork& work, const CostOptions& options) {
  checkEngineNames(work.setup());
  CostStudy study(work.setup(), work.line.run, work.store);
  const ErrorKinds kinds = errorKinds(study);
  study.prepare();
  const CostPlan plan = planCost(study, kinds, costBudget(options));
  std::vector<std::string> names;
  for (const EngineEntry& entry : study.campaign.engines()) names.push_back(entry.name);
  study.campaign.progress().say(planText(plan, names, costBudget(options)));

  CostResults results;
  results.points = execute(plan, study, kinds);
  FlowStudy couette = study.campaign.study(kindCost);
  static_cast<FlowFrame&>(results) = couette;
  results.elapsed = couette.elapsed;
  results.engines = std::move(couette.engines);
  results.packings = std::move(couette.packings);
  results.budget = costBudget(options);
  results.budgetForTheRest = plan.budgetForTheRest;
  for (const auto& kind : kinds) kind->addTo(results);
  addEngines(results, study);
  if (options.target) results.target = fractionOf(*options.target);
  addCostAnalysis(results);
  return results;
}

std::string planOfCost(const StudyWork& work, const CostOptions& options) {
  checkEngineNames(work.setup());
  CostStudy study(work.setup(), work.line.run, work.store);
  const ErrorKinds kinds = errorKinds(study);
  study.ask();
  std::vector<PlannedWork> works = study.campaign.plan({});  // engines that refuse
  for (std::size_t e = 0; e < study.engines.size(); ++e)
    for (const auto& kind : kinds) {
      PlannedWork settings{study.entryOf(e).name, "settings, " + toString(kind->kind())};
      const std::vector<CostSetting>& all = study.settingsOf(e, kind->kind());
      for (std::size_t s = 0; s < all.size(); ++s) {
        if (!all[s].refusal.empty()) continue;
        ++settings.total;
        settings.finished += kind->isKept({e, kind->kind(), s});
      }
      if (settings.total > 0) works.push_back(settings);
    }
  return describeDryRun(
      fmt::format("{}budget {:.0f} s; what fits into it is planned once steps have been timed\n",
                  study.campaign.planHead(), costBudget(options)),
      works, work.store, work.line.run);
}

Outcome outcomeOfCost(const CostResults& results, const CommandLine& line, const CostOptions&) {
  Outcome outcome{results.engineFailures.empty() ? exitPassed : exitEngineFailed,
                  refusals(results.engines, line.run.engines)};
  outcome.failures.insert(outcome.failures.end(), results.engineFailures.begin(),
                          results.engineFailures.end());
  return outcome;
}

}  // namespace

const Study<CostOptions, CostResults> costStudy = {
    "cost",
    {.packings = true},
    Keeps::oneCase,
    [](CostOptions& own, CommandLine&) {
      return std::vector<StudyOption>{
          {"--budget", "time that all may take, e.g. 90s, 10m, 1h (default: 12m)", &own.budget},
          {"--want", "accuracy, e.g. 1% or 1e-3: prints the cheapest setting of each engine",
           &own.target}};
    },
    casesOfCost,
    planOfCost,
    runCost,
    outcomeOfCost};

}  // namespace crossgrain::inline studies

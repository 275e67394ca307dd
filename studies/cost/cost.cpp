#include "studies/cost/cost.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <memory>
#include <set>
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

void checkEngineNames(const Case& setup) {
  checkEngineSections(setup);
  for (const auto& [name, values] : setup.cost.settings)
    if (!findEngine(name))
      throw BadInput(fmt::format("{}: [cost.settings.{}]: there is no such engine",
                                 setup.file.string(), name));
}

/// Points without a number, one per measure, that say why.
Points without(const CostStudy& study, const ErrorKind& kind, const PlannedPoint& planned,
               Status status, const std::string& reason) {
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
  const auto ended = [&](Status status, const std::string& reason, bool isResult) {
    return Measured{without(study, kind, planned, status, reason), isResult,
                    fmt::format("{}: {}", nameOf(status, costStatusNames), reason)};
  };
  try {
    Points points = kind.measure(planned);
    const CostPoint& first = points.front();
    const std::string line =
        !first.ran()  ? fmt::format("{}: {}", nameOf(first.status, costStatusNames), first.reason)
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
    return ended(Status::refused, refusal.what(), false);
  } catch (const std::exception& error) {
    if (std::string(error.what()).find(beyondLimit) == std::string::npos)
      study.engines[planned.engine].worker.reset();
    if (const auto reason = pastLimit(study, planned, error.what()))
      return ended(Status::failed, *reason, true);
    study.engineFailures.push_back(error.what());
    return ended(Status::failed, error.what(), false);
  }
}

/// Measures one kind of error after the other, one point at a time: of each the case as it is
/// first, then the cheapest on whichever engine, so that a budget buys as many points as it can.
class Measuring {
 public:
  /// @param budget  for all that is measured [s]
  Measuring(CostStudy& study, double budget) : study_(study), budget_(budget) {}

  void measureKind(ErrorKind& kind) {
    std::vector<PlannedPoint> plan = planned(kind);
    const bool anew =
        std::ranges::any_of(plan, [](const auto& point) { return point.seconds > 0; });
    const double common = anew ? kind.commonTime() : 0.0;
    const std::string why = lackOfTime(common);
    if (why.empty())
      kind.makeReferences();
    else
      budgetForTheRest += common;
    std::vector<CachedTask<Points>> tasks;
    std::vector<const PlannedPoint*> measured;
    for (const PlannedPoint& point : plan) {
      const CostSetting& setting = study_.settingOf(point);
      const auto put = [&](Status status, const std::string& reason) {
        found_[{point.kind, point.engine, point.setting}] =
            without(study_, kind, point, status, reason);
      };
      if (!setting.refusal.empty()) {
        put(Status::refused, setting.refusal);
      } else if (!why.empty()) {
        put(Status::notRun, "its reference " + why);
        budgetForTheRest += point.seconds;
      } else {
        tasks.push_back({.name = study_.nameOf(point),
                         .label = fmt::format("{}, {}: {} {}", study_.entryOf(point.engine).name,
                                              toString(point.kind), setting.knob, setting.setting),
                         .key = study_.keyOf(point),
                         .weight = point.seconds,
                         .work = [&](const auto&) { return affordable(kind, point); },
                         .priority = -static_cast<double>(tasks.size())});
        measured.push_back(&point);
      }
    }
    const auto results =
        runOrLoad(tasks, study_.campaign.store(), study_.campaign.progress(),
                  fmt::format("errors of {}, one at a time", toString(kind.kind())), 1);
    for (std::size_t k = 0; k < results.size(); ++k)
      found_[{measured[k]->kind, measured[k]->engine, measured[k]->setting}] = results[k];
  }

  /// By kind, engine and setting.
  Points points() const {
    Points all;
    for (const auto& [at, points] : found_) all.insert(all.end(), points.begin(), points.end());
    return all;
  }

  double budgetForTheRest = 0.0;  ///< for what did not fit, all else kept [s]

 private:
  using Clock = std::chrono::steady_clock;

  std::vector<PlannedPoint> planned(const ErrorKind& kind) const {
    std::vector<PlannedPoint> plan;
    for (std::size_t e = 0; e < study_.engines.size(); ++e) {
      const std::vector<CostSetting>& settings = study_.settingsOf(e, kind.kind());
      for (std::size_t s = 0; s < settings.size(); ++s) {
        PlannedPoint& point = plan.emplace_back(PlannedPoint{e, kind.kind(), s});
        if (settings[s].refusal.empty() && !kind.isKept(point))
          point.seconds = kind.predicted(e, settings[s]);
      }
    }
    std::ranges::stable_sort(plan, {}, [](const PlannedPoint& point) {
      return std::tuple(point.setting > 0, point.seconds);
    });
    return plan;
  }

  /// "would take about 90 s, 8 s are left of the budget of 20 s"; empty: there is time for it.
  std::string lackOfTime(double seconds) const {
    const double left = budget_ - std::chrono::duration<double>(Clock::now() - started_).count();
    if (!(seconds > 0.0) || seconds <= left) return {};
    return fmt::format("would take about {:.3g} s, {:.3g} s are left of the budget of {:.3g} s",
                       seconds, std::max(left, 0.0), budget_);
  }

  /// The first point of an engine and kind pays for the references of its own.
  Measured affordable(ErrorKind& kind, const PlannedPoint& point) {
    throwIfInterrupted();
    const std::pair group(point.kind, point.engine);
    const double takes = point.seconds > 0.0 && !begun_.contains(group)
                             ? point.seconds + kind.ownTime(point.engine)
                             : point.seconds;
    if (const std::string why = lackOfTime(takes); !why.empty()) {
      budgetForTheRest += takes;
      return {without(study_, kind, point, Status::notRun, why), false, why};
    }
    begun_.insert(group);
    return measure(study_, kind, point);
  }

  CostStudy& study_;
  double budget_;
  Clock::time_point started_ = Clock::now();
  std::map<std::tuple<CostKind, std::size_t, std::size_t>, Points> found_;
  std::set<std::pair<CostKind, std::size_t>> begun_;
};

/// What engines took to start, and which failed for other reasons than a step beyond the stability
/// limit.
void addEngines(CostResults& results, const CostStudy& study) {
  for (std::size_t e = 0; e < study.engines.size(); ++e)
    if (const TimedEngine& engine = study.engines[e]; engine.takesPart)
      results.startup.push_back({study.entryOf(e).name, engine.start, engine.load});
  results.engineFailures = study.engineFailures;
  for (EngineRow& engine : results.engines)
    for (const CostPoint& point : results.points)
      if (point.engine == engine.name && point.status == Status::failed &&
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
  Measuring measuring(study, costBudget(options));
  for (const auto& kind : kinds) measuring.measureKind(*kind);

  CostResults results;
  results.points = measuring.points();
  FlowStudy couette = study.campaign.study(kindCost);
  static_cast<FlowFrame&>(results) = couette;
  results.elapsed = couette.elapsed;
  results.engines = std::move(couette.engines);
  results.packings = std::move(couette.packings);
  results.budget = costBudget(options);
  results.budgetForTheRest = measuring.budgetForTheRest;
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
  return describeDryRun(fmt::format("{}budget {:.0f} s: what it has no room for is left out, of "
                                    "each kind of error the slowest\n",
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
          {"--budget", "the longest that the command may take, e.g. 90s, 10m, 1h (default: 12m)",
           &own.budget},
          {"--want", "accuracy, e.g. 1% or 1e-3: prints the cheapest setting of each engine",
           &own.target}};
    },
    casesOfCost,
    planOfCost,
    runCost,
    outcomeOfCost};

}  // namespace crossgrain::inline studies

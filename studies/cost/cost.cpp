#include "studies/cost/cost.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <set>
#include <tuple>

#include "cases/loader.hpp"
#include "results/schema.hpp"
#include "studies/core/engine_access.hpp"
#include "studies/core/executor.hpp"
#include "studies/core/study.hpp"
#include "studies/cost/analysis.hpp"
#include "studies/cost/averages.hpp"
#include "studies/cost/collision.hpp"
#include "studies/cost/sizes.hpp"
#include "studies/cost/trajectory.hpp"
#include "support/bad_input.hpp"
#include "support/files.hpp"
#include "support/interrupt.hpp"
#include "support/numbers.hpp"

namespace crossgrain::inline studies {

namespace {

/// Overrides of [cost] for --quick: every kind of error and some settings, in seconds.
const std::vector<std::string> quickCosts = {"cost.timed=0.002",
                                             "cost.repeats=3",
                                             "cost.psi_count=9",
                                             "cost.collision_steps=[50, 10, 1.2]",
                                             "cost.collision_reference=800",
                                             "cost.trajectory_steps=[50, 10]",
                                             "cost.trajectory_reference=400",
                                             "cost.window_most=5",
                                             "cost.average_steps=[50, 10]",
                                             "cost.average_reference=100",
                                             "cost.rigid_steps=[0.5, 2]",
                                             "cost.iterations=[2]",
                                             "cost.disks=[1]",
                                             "cost.threads=[1]"};

double costBudget(const CostOptions& options) {
  return secondsOf(options.budget.value_or("10m"));
}

std::vector<Case> casesOfCost(const CommandLine& given, CostOptions& own) {
  CommandLine line = given;
  costBudget(own);  // what is misspelt is refused before anything runs
  for (const auto& [key, numbers] : {std::pair("disks", &own.disks), {"threads", &own.threads}})
    if (*numbers) line.overrides.push_back(fmt::format("cost.{}=[{}]", key, **numbers));
  const Case setup = onlyFlow(line, {"cost"});
  if (own.target) accuracyOf(*own.target, !setup.law.soft());
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
  // A step longer than the case's own that fails is past a limit even below that of theory, which
  // knows no dashpots.
  const double limit = std::min(theory, study.stepOf(planned.engine, study.setup));
  if (study.stepOf(planned.engine, setup) <= limit) return std::nullopt;
  return fmt::format("{}: {}", beyondLimit, reason);
}

using Measured = CachedTask<CostRun>::Outcome;

/// Measures one round. A failure beyond a stability limit is a result, and kept.
Measured measure(CostStudy& study, ErrorKind& kind, const PlannedPoint& planned, std::size_t round,
                 double longest) {
  const auto ended = [&](Status status, const std::string& reason, bool isResult) {
    CostRun run;
    run.status = status;
    run.reason = BadInput(reason).what();  // in one line
    return Measured{run, isResult, fmt::format("{}: {}", nameOf(status, costStatusNames), reason)};
  };
  try {
    CostRun run = kind.run(planned, round, longest);
    if (run.status != Status::finished) {
      const std::string why =
          fmt::format("{}: {}", nameOf(run.status, costStatusNames), run.reason);
      return {std::move(run), true, why};
    }
    return {std::move(run), true, "done"};
  } catch (const Interrupted&) {
    throw;
  } catch (const OutputError&) {
    throw;
  } catch (const BadInput&) {
    throw;
  } catch (const UnsupportedScene& refusal) {
    return ended(Status::refused, refusal.what(), false);
  } catch (const TakesTooLong& late) {
    study.engines[planned.engine].worker.reset();
    const auto reason = pastLimit(study, planned, late.what());
    return ended(reason ? Status::failed : Status::notRun, reason.value_or(late.what()), false);
  } catch (const std::exception& error) {
    if (std::string(error.what()).find(beyondLimit) == std::string::npos)
      study.engines[planned.engine].worker.reset();
    if (const auto reason = pastLimit(study, planned, error.what()))
      return ended(Status::failed, *reason, true);
    study.engineFailures.push_back(error.what());
    return ended(Status::failed, error.what(), false);
  }
}

/// Of a setting's rounds, those that no earlier command has run; none where one says that it fails.
double shareMissing(const CostStudy& study, const PlannedPoint& point, std::size_t rounds) {
  std::size_t missing = 0;
  for (std::size_t round = 0; round < rounds; ++round) {
    const auto kept = study.campaign.store().findAs<CostRun>(study.nameOf(point, round),
                                                             study.keyOf(point, round));
    if (kept && kept->status != Status::finished) return 0.0;
    missing += !kept;
  }
  return static_cast<double>(missing) / static_cast<double>(rounds);
}

/// Share of the budget of each kind of error and of the time of a step, which comes last. What one
/// leaves is the next one's. Endpoints have most: they are what a scene is run for, and they come
/// last of the errors.
double shareOf(CostKind kind) {
  constexpr double shares[] = {0.2, 0.2, 0.5};
  return shares[static_cast<std::size_t>(kind)];
}
constexpr double shareOfSteps = 0.1;

/// Measures one kind of error after the other, round by round and one point at a time: of each the
/// time steps first, then other settings, in turns over the engines, each one's cheapest first
/// after the case's own step, so that a budget reaches every engine. A point that is begun gets as
/// many rounds as an interval takes, and further ones as long as there is time.
class Measuring {
 public:
  Measuring(CostStudy& study, double budget)
      : study_(study), budget_(budget), began_(study.campaign.elapsed()) {}

  void measureKinds(const ErrorKinds& kinds) {
    const double all = std::max(0.0, budget_ - began_);
    double shares = shareOfSteps, answers = 0.0, until = began_;
    for (const auto& kind : kinds) {
      shares += shareOf(kind->kind());
      if (kind->kind() == CostKind::averages) answers = timeForAnswers(*kind, all);
    }
    for (const auto& kind : kinds) {
      until += all * shareOf(kind->kind()) / shares;
      if (kind->kind() == CostKind::averages)
        measureKind(*kind, std::clamp(study_.campaign.elapsed() + answers, until,
                                      std::max(until, budget_)));
      else
        measureKind(*kind, std::min(until, budget_ - answers));
    }
  }

  /// Engines without an endpoint, as the budget had no room for it, and what it takes.
  std::vector<MissingAnswer> missingAnswers(const ErrorKinds& kinds) const {
    std::vector<MissingAnswer> missing;
    for (const auto& kind : kinds) {
      if (kind->kind() != CostKind::averages) continue;
      double seconds = kind->commonTime(std::min(fewestRounds, kind->rounds()));
      for (const auto& [takes, engine] : firstAnswers(*kind)) {
        if (hasAnswer(engine)) continue;
        seconds += takes * pace(engine);
        missing.push_back(
            {study_.entryOf(engine).name, began_ + slackOfAnswers * seconds / mostOfAnswers});
      }
    }
    return missing;
  }

  /// By kind, engine and setting.
  Points points() const {
    Points all;
    for (const auto& [at, points] : found_) all.insert(all.end(), points.begin(), points.end());
    return all;
  }

  double budgetForTheRest = 0.0;  ///< for what did not fit, all else kept [s]

 private:
  using Place = std::tuple<CostKind, std::size_t, std::size_t>;

  /// Of the budget for endpoints, where each engine's first one takes more than their share, and
  /// for how much longer than predicted these may take.
  static constexpr double mostOfAnswers = 0.8, slackOfAnswers = 1.2;
  static constexpr std::size_t fewestRounds = 3;  ///< of an interval that says something

  /// A point and what it has so far.
  struct Rounds {
    PlannedPoint point;
    std::vector<CostRun> runs = {};
    std::optional<CostRun> ended = {};  ///< failed, refused or not run: no further round
    double committed = 0.0;             ///< predicted time of its further rounds [s]
    bool cut = false;                   ///< the budget ended before its last rounds
  };

  /// Time of the case's own step until it answers, by engine, the fastest first [s].
  std::vector<std::pair<double, std::size_t>> firstAnswers(const ErrorKind& kind) const {
    std::vector<std::pair<double, std::size_t>> answers;
    for (const PlannedPoint& point : planned(kind))
      if (point.setting == 0 && study_.settingOf(point).refusal.empty())
        answers.emplace_back(
            std::min(point.seconds, point.round * static_cast<double>(fewestRounds)), point.engine);
    std::ranges::sort(answers);
    return answers;
  }

  /// Of so many engines as there is time for; at least of the fastest, or of none [s].
  double timeForAnswers(const ErrorKind& kind, double left) const {
    double needed = slackOfAnswers * kind.commonTime(std::min(fewestRounds, kind.rounds()));
    double found = 0.0;
    for (const auto& [takes, engine] : firstAnswers(kind)) {
      needed += slackOfAnswers * takes;
      if (needed <= (found > 0.0 ? mostOfAnswers : 1.0) * left) found = needed;
    }
    return found;
  }

  bool hasAnswer(std::size_t engine) const {
    return std::ranges::any_of(found_, [&](const auto& one) {
      const auto& [kind, of, setting] = one.first;
      return kind == CostKind::averages && of == engine &&
             std::ranges::any_of(one.second, [&](const CostPoint& point) {
               return point.ran() || (setting == 0 && point.status != Status::notRun);
             });
    });
  }

  /// @param until  when it has to end, since the command began [s]
  void measureKind(ErrorKind& kind, double until) {
    until_ = until;
    paces_.clear();
    const std::vector<PlannedPoint> plan = planned(kind);
    // References serve nothing where no point fits beside them.
    const auto answers = firstAnswers(kind);
    const auto lack = [&](std::size_t rounds) {
      const double common = kind.commonTime(rounds);
      return common > 0.0 && !answers.empty() ? lackOfTime(common + answers.front().first) : "";
    };
    std::size_t rounds = kind.rounds();
    if (!lack(rounds).empty()) rounds = std::min(rounds, fewestRounds);
    const std::string why = lack(rounds);
    if (why.empty()) kind.makeReferences(rounds);
    std::vector<Rounds> all;
    for (const PlannedPoint& point : plan) {
      const CostSetting& setting = study_.settingOf(point);
      if (!setting.refusal.empty()) {
        put(kind, point, Status::refused, setting.refusal);
      } else if (!why.empty() && (point.seconds > 0.0 || !kind.keptSuffice())) {
        put(kind, point, Status::notRun, "its reference and first points " + why);
        budgetForTheRest += point.seconds;
      } else {
        all.push_back({point});
      }
    }
    for (std::size_t round = 0; round < rounds; ++round) runRound(kind, all, round);
    budgetForTheRest += kind.commonTime(kind.rounds());
    for (const Rounds& one : all)
      if (one.ended)
        putEnded(kind, one.point, *one.ended);
      else
        found_[placeOf(one.point)] = kind.points(one.point, one.runs);
  }

  static Place placeOf(const PlannedPoint& point) {
    return {point.kind, point.engine, point.setting};
  }

  void put(const ErrorKind& kind, const PlannedPoint& point, Status status,
           const std::string& reason) {
    found_[placeOf(point)] = without(study_, kind, point, status, reason);
  }

  /// With the time that it took, if it is known, as plots show those that failed, too.
  void putEnded(const ErrorKind& kind, const PlannedPoint& point, const CostRun& run) {
    put(kind, point, run.status, run.reason);
    for (CostPoint& row : found_[placeOf(point)]) {
      if (run.wallSeconds > 0.0) row.wallSeconds = run.wallSeconds;
      if (run.cpuSeconds > 0.0) row.cpuSeconds = run.cpuSeconds;
    }
  }

  void runRound(ErrorKind& kind, std::vector<Rounds>& all, std::size_t round) {
    std::vector<CachedTask<CostRun>> tasks;
    std::vector<Rounds*> run;
    for (Rounds& one : all) {
      if (one.ended || one.cut) continue;
      const PlannedPoint& point = one.point;
      const CostSetting& setting = study_.settingOf(point);
      tasks.push_back(
          {.name = study_.nameOf(point, round),
           .label = fmt::format("{}, {}: {} {}", study_.entryOf(point.engine).name,
                                toString(point.kind), setting.knob, setting.setting),
           .key = study_.keyOf(point, round),
           .weight = point.seconds,
           .work = [this, &kind, &one, round](const auto&) { return affordable(kind, one, round); },
           .priority = -static_cast<double>(tasks.size())});
      run.push_back(&one);
    }
    const auto results = runOrLoad(tasks, study_.campaign.store(), study_.campaign.progress(),
                                   fmt::format("errors of {}, one at a time, round {} of {}",
                                               toString(kind.kind()), round + 1, kind.rounds()),
                                   1);
    for (std::size_t k = 0; k < results.size(); ++k)
      if (results[k].status == Status::finished)
        run[k]->runs.push_back(results[k]);
      else if (results[k].status == Status::notRun && run[k]->runs.size() > 1)
        run[k]->cut = true;
      else
        run[k]->ended = results[k];
  }

  std::vector<PlannedPoint> planned(const ErrorKind& kind) const {
    std::vector<PlannedPoint> plan;
    for (std::size_t e = 0; e < study_.engines.size(); ++e) {
      const std::vector<CostSetting>& settings = study_.settingsOf(e, kind.kind());
      for (std::size_t s = 0; s < settings.size(); ++s) {
        PlannedPoint& point = plan.emplace_back(PlannedPoint{e, kind.kind(), s});
        if (!settings[s].refusal.empty()) continue;
        const double all = kind.predicted(e, settings[s]);
        point.round = all / static_cast<double>(kind.rounds());
        point.seconds = all * shareMissing(study_, point, kind.rounds());
      }
    }
    const auto otherThanStep = [&](const PlannedPoint& point) {
      return study_.settingOf(point).knob != "time_step";
    };
    std::ranges::stable_sort(plan, {}, [&](const PlannedPoint& point) {
      return std::tuple(otherThanStep(point), point.setting != 0, point.seconds);
    });
    std::map<std::pair<bool, std::size_t>, std::size_t> turns;
    for (PlannedPoint& point : plan) point.turn = turns[{otherThanStep(point), point.engine}]++;
    std::ranges::stable_sort(plan, {}, [&](const PlannedPoint& point) {
      return std::tuple(otherThanStep(point), point.turn,
                        point.seconds + kind.ownTime(point.engine));
    });
    return plan;
  }

  /// "would take about 90 s, 8 s are left of its share of the budget of 20 s"; empty: there is time
  /// for it.
  std::string lackOfTime(double seconds, std::optional<std::size_t> engine = {},
                         double overrun = 1.0) const {
    const double left = until_ - study_.campaign.elapsed() - pace() * committed_;
    seconds *= pace(engine);
    if (!(seconds > 0.0) || seconds <= overrun * left) return {};
    return fmt::format(
        "would take about {}, {:.3g} s are left of its share of the budget of {:.3g} s",
        readableDuration(seconds), std::max(left, 0.0), budget_);
  }

  /// How many times longer points take than predicted, by those of the engine so far, or of all: a
  /// load or a step that was timed once may be far off, and other work may have begun since.
  double pace(std::optional<std::size_t> engine = {}) const {
    constexpr double enough = 0.5, least = 0.02;  // [s], [-]
    double expected = 0.0, took = 0.0;
    for (const auto& [of, one] : paces_)
      if (!engine || of == *engine) expected += one.expected, took += one.took;
    return expected > enough ? std::max(least, took / expected) : 1.0;
  }

  /// One round of a point. @param seconds  that it is expected to take
  Measured timed(ErrorKind& kind, const PlannedPoint& point, std::size_t round, double seconds) {
    const double before = study_.campaign.elapsed();
    // Other work on the machine takes a few times as long; what blows up may never end.
    constexpr double atLeast = 20.0, times = 10.0;  // [s], [-]
    const double most = std::max(atLeast, times * seconds * pace(point.engine));
    const double longest = std::min(most, std::max(5.0, budget_ - before));
    Measured measured = measure(study_, kind, point, round, longest);
    if (seconds > 0.0 &&
        measured.result.status == Status::finished) {  // what blows up takes for ever
      Pace& pace = paces_[point.engine];
      pace.took += study_.campaign.elapsed() - before;
      pace.expected += seconds;
    }
    return measured;
  }

  static Measured notRun(const std::string& reason) {
    CostRun none;
    none.status = Status::notRun;
    none.reason = reason;
    return {none, false, reason};
  }

  /// A point's first round commits the budget to as many as an interval takes; the first point of
  /// an engine and kind pays for the references of its own.
  Measured affordable(ErrorKind& kind, Rounds& of, std::size_t round) {
    throwIfInterrupted();
    const PlannedPoint& point = of.point;
    const std::size_t needed = of.runs.size() < fewestRounds
                                   ? std::min(fewestRounds - of.runs.size(), kind.rounds() - round)
                                   : 1;
    double takes = point.round * static_cast<double>(needed);
    if (of.committed > 0.0) {
      committed_ -= of.committed;
      if (study_.campaign.elapsed() > until_)
        return notRun(
            fmt::format("its share of the budget of {:.3g} s ended after {} of its {} rounds",
                        budget_, of.runs.size(), kind.rounds()));
    } else {
      const std::pair group(point.kind, point.engine);
      if (!begun_.contains(group)) takes += kind.ownTime(point.engine);
      // An engine's first point shows how good its predictions are: it may take twice what is left.
      const double overrun = paces_.contains(point.engine) ? 1.0 : 2.0;
      if (const std::string why = lackOfTime(takes, point.engine, overrun); !why.empty()) {
        budgetForTheRest += point.round * static_cast<double>(kind.rounds() - round);
        return notRun(why);
      }
      begun_.insert(group);
    }
    of.committed = point.round * static_cast<double>(needed - 1);
    Measured measured = timed(kind, point, round, takes - of.committed);
    if (measured.result.status != Status::finished) of.committed = 0.0;
    committed_ += of.committed;
    return measured;
  }

  CostStudy& study_;
  double budget_;           ///< of the command [s]
  double began_;            ///< since the command began [s]
  double until_ = 0.0;      ///< when the kind at hand has to end, since the command began [s]
  double committed_ = 0.0;  ///< predicted time of further rounds of begun points [s]
  struct Pace {
    double expected = 0.0, took = 0.0;  ///< of an engine's rounds so far [s]
  };
  std::map<std::size_t, Pace> paces_;  ///< of the kind at hand
  std::map<Place, Points> found_;
  std::set<std::pair<CostKind, std::size_t>> begun_;
};

/// Adds the start-up times of engines, and marks those that failed for other reasons than a step
/// beyond the stability limit.
void addEngines(CostResults& results, const CostStudy& study) {
  for (std::size_t e = 0; e < study.engines.size(); ++e)
    if (const TimedEngine& engine = study.engines[e]; engine.takesPart)
      results.startup.push_back({study.entryOf(e).name, engine.start, engine.scene.load});
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
  const double budget = costBudget(options);
  Measuring measuring(study, budget);
  measuring.measureKinds(kinds);

  CostResults results;
  results.missingAnswers = measuring.missingAnswers(kinds);
  results.points = measuring.points();
  const bool timesSteps = study.setup.cost.has("disks") || study.setup.cost.has("threads");
  if (timesSteps && !results.lacksEndpoints())
    results.steps = timeSizes(study, budget - study.campaign.elapsed());
  FlowStudy couette = study.campaign.study(kindCost);
  static_cast<FlowFrame&>(results) = couette;
  if (!study.setup.law.soft())
    results.notes.emplace_back(
        "Of rigid bodies endpoints alone are measured: their contacts take no time that steps of a "
        "collision could be counted in, and no reference has their paths.");
  results.elapsed = couette.elapsed;
  results.engines = std::move(couette.engines);
  results.packings = std::move(couette.packings);
  results.budget = budget;
  results.impacts = study.impacts;
  results.budgetForTheRest = measuring.budgetForTheRest;
  for (const auto& kind : kinds) kind->addTo(results);
  addEngines(results, study);
  if (options.target) results.target = accuracyOf(*options.target, !study.setup.law.soft());
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
        settings.finished += shareMissing(study, {e, kind->kind(), s}, kind->rounds()) == 0.0;
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
  if (outcome.status == exitPassed && results.lacksEndpoints()) {
    outcome.status = exitFailed;
    outcome.nothingJudged = "the budget has no room for any endpoint of the scene";
  }
  return outcome;
}

}  // namespace

const Study<CostOptions, CostResults> costStudy = {
    "cost",
    {.packings = true, .shards = false},
    Keeps::oneCase,
    [](CostOptions& own, CommandLine&) {
      return std::vector<StudyOption>{
          {"--budget", "the longest that the command may take, e.g. 90s, 10m, 1h (default: 10m)",
           &own.budget},
          {"--want",
           "accuracy, e.g. 1% or 1e-3, of rigid bodies in margins, e.g. 1 or 0.5: prints the "
           "cheapest setting of each engine",
           &own.target},
          {"--disks",
           "sizes of the scene [bodies], a step of which is timed (default: its own, and four "
           "times it)",
           &own.disks, "N,N"},
          {"--threads",
           "threads, or ranks of an engine that has them, that share a step (default: 1, 2, 4, … "
           "up to the cores)",
           &own.threads, "P,P"}};
    },
    casesOfCost,
    planOfCost,
    runCost,
    outcomeOfCost};

}  // namespace crossgrain::inline studies

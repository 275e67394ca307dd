#include "studies/thesis/campaign.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "cases/couette.hpp"
#include "cases/preparation.hpp"
#include "cases/time_step.hpp"
#include "results/collision.hpp"
#include "results/lockstep_text.hpp"
#include "results/run.hpp"
#include "results/schema.hpp"
#include "results/thesis.hpp"
#include "studies/core/engine_running.hpp"
#include "studies/core/study.hpp"
#include "studies/flow/frame.hpp"
#include "studies/flow/unfinished_run.hpp"
#include "studies/lockstep/lockstep.hpp"
#include "studies/thesis/case_run.hpp"
#include "support/bad_input.hpp"
#include "support/files.hpp"
#include "support/fingerprint.hpp"
#include "support/interrupt.hpp"

namespace crossgrain::inline studies {
namespace {

/// What snapshots and averages add to the steps' own time, before any run has shown it.
constexpr double besidesSteps = 1.2;

double durationOf(const Case& setup) {
  return flowDuration(setup);
}

/// Sizes of a run that its time goes by: steps of the case's dt, the ring's shrinking included,
/// times disks.
double workOf(const Case& setup) {
  return (preparationSteps(setup) + durationOf(setup) / timeStep(setup)) *
         (couetteIn(setup).particles.small + couetteIn(setup).particles.large);
}

Packing preparedPacking(const Case& setup, int index) {
  const auto inHouse = engineRegistry().front().make();
  return packingOf(setup, index, timeStep(setup), *inHouse, [](double) { throwIfInterrupted(); });
}

/// What a run depends on, as a fingerprint; not on which build of this program made it.
std::string keyOfRun(const Case& setup, const CaseKeys& task) {
  return fmt::format(
      "{:016x}", fnv1a(Json(resultAffectingKeys(setup.resolvedToml)).dump() + Json(task).dump()));
}

std::string roughly(double seconds) {
  return seconds < 100.0 ? fmt::format("{:.0f} s", seconds)
                         : fmt::format("{:.0f} min", seconds / 60.0);
}

ThesisCase rowOf(const SweepCase& own) {
  const Case& setup = own.setup;
  const auto& [cell, particles, filling, times] = couetteIn(setup);
  ThesisCase row;
  row.name = own.name;
  row.purpose = own.purpose;
  row.file = setup.file.string();
  row.families = own.families;
  row.cell = flowFrame(kindThesis, setup, "", diskKinds(particles).radius).cell;
  row.label = own.label;
  row.kn = setup.law.kn;
  row.mu = setup.law.mu;
  row.bottomFriction = setup.bottom.has_value();
  row.settleRotations = times.settleRotations;
  row.averagedRotations = times.rotations;
  row.caseToml = setup.resolvedToml;
  return row;
}

/// One sentence for each other program that made some of the runs.
std::vector<std::string> madeByOthers(const std::vector<ThesisRun>& runs) {
  std::map<std::string, std::size_t> counts;
  for (const ThesisRun& run : runs)
    if (!run.program.empty() && run.program != thisProgram()) ++counts[run.program];
  std::vector<std::string> sentences;
  for (const auto& [program, count] : counts)
    sentences.push_back(fmt::format("{} of {} runs {} made by crossgrain {}, the others by {}.",
                                    count, runs.size(), count == 1 ? "was" : "were", program,
                                    thisProgram()));
  return sentences;
}

}  // namespace

EarlierRuns readEarlierRuns(const std::filesystem::path& file) {
  const nlohmann::json document = readResultsFile(file);
  if (document.at("kind") != kindThesis)
    throw BadInput(
        fmt::format("--from {}: its results are of 'crossgrain {}', not of a parameter "
                    "sweep",
                    file.string(), document.at("kind").get<std::string>()));
  EarlierRuns runs;
  for (ThesisRun& run : understood(file, [&] { return thesisFromJson(document); }).runs)
    if (!run.key.empty() && run.run.status != Status::failed) runs.emplace(run.key, std::move(run));
  return runs;
}

ThesisCampaign::ThesisCampaign(const ThesisSweep& sweep, const RunCommand& command, RunStore& store,
                               double budget, EarlierRuns earlier)
    : sweep_(sweep),
      command_(command),
      store_(store),
      budget_(budget),
      earlier_(std::move(earlier)),
      progress_(command.quiet) {
  for (EngineEntry& entry : selectEngines(command.engines)) engines_.push_back({std::move(entry)});
  for (const SweepCase& own : sweep.cases) checkEngineSections(own.setup);
}

void ThesisCampaign::ask(ThesisEngine& own) {
  throwIfInterrupted();
  try {
    const auto engine = startEngine(own.entry, store_.scratch("ask-" + own.entry.name),
                                    sweep_.cases.front().setup.run.timeout);
    own.can = engine->capabilities();
    own.version = own.can->version;
  } catch (const EngineFailure& failure) {
    progress_.say(failure.what());  // its runs will fail, one by one
  }
}

void ThesisCampaign::askEngines() {
  for (ThesisEngine& own : engines_) ask(own);
  listRuns();
  store_.begin();
}

void ThesisCampaign::compareWithMirrors(std::size_t starts) {
  const auto forAll =
      std::ranges::find_if(sweep_.stages, [](const auto& stage) { return stage.engines.empty(); });
  if (forAll == sweep_.stages.end()) return;
  const Case& setup = sweep_.cases[forAll->cases.front()].setup;
  std::vector<LockstepEngine> compared;
  for (const ThesisEngine& own : engines_) {
    if (!own.can) continue;
    for (const EngineEntry& mirror : mirrorsOf({own.entry}))
      if (standsForItsPeer(mirror, setup.law) && !isNamed(command_.engines, mirror)) {
        compared.push_back({own.entry, own.version});
        surrogates_.push_back({own.entry.name, mirror.name, false, {}, 0, ""});
        break;
      }
  }
  if (compared.empty()) return;
  const LockstepFindings found = holdAgainstMirrors(
      compared, setup, {{preparedPacking(setup, 0)}, timeStep(setup), starts, command_.jobs},
      store_, progress_);
  for (ThesisSurrogate& surrogate : surrogates_) {
    const auto row = std::ranges::find(found.rows, surrogate.engine, &LockstepRow::engine);
    if (row == found.rows.end()) continue;
    surrogate.accepted =
        row->failure.empty() && row->equivalent &&
        (row->verdict == Equivalence::sameToRounding || row->verdict == Equivalence::sameLaw);
    surrogate.equivalent = row->equivalent;
    surrogate.starts = row->starts;
    surrogate.why = row->failure.empty() ? results::describe(*row, found.rules) : row->failure;
    if (!surrogate.accepted) continue;
    for (ThesisEngine& own : engines_)
      if (own.entry.name == surrogate.engine) own.part = SweepEngine::Part::throughMirror;
    engines_.push_back({*findEngine(surrogate.mirror), SweepEngine::Part::mirror});
    ask(engines_.back());
  }
  listRuns();
}

/// Without those that an engine cannot run, each of which is noted once a case.
void ThesisCampaign::listRuns() {
  std::vector<SweepEngine> engines;
  for (const ThesisEngine& own : engines_) engines.push_back({own.entry.name, own.part});
  wanted_ = runsOf(sweep_, engines);
  refusals_.clear();
  std::map<std::pair<std::size_t, std::size_t>, std::string> why;
  std::erase_if(wanted_, [&](const SweepRun& wanted) {
    const ThesisEngine& own = engines_[wanted.engine];
    const auto [entry, isNew] = why.try_emplace({wanted.setup, wanted.engine});
    if (isNew && own.can) {
      const Case& setup = sweep_.cases[wanted.setup].setup;
      Packing unplaced;
      unplaced.disks = diskKinds(couetteIn(setup).particles);
      try {
        checkSuitable(*own.can, own.entry, setup, couetteScene(setup, unplaced, timeStep(setup)));
      } catch (const UnsupportedScene& refusal) {
        entry->second = refusal.what();
        refusals_.push_back(
            fmt::format("{} was left out: {}", sweep_.cases[wanted.setup].name, refusal.what()));
      }
    }
    return !entry->second.empty();
  });
}

double ThesisCampaign::elapsed() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - started_).count();
}

double ThesisCampaign::predicted(const SweepRun& wanted) const {
  const std::scoped_lock lock(learning_);
  return engines_[wanted.engine].perStep * workOf(sweep_.cases[wanted.setup].setup);
}

/// The mean over runs: a machine that is busy now is likely to stay so.
void ThesisCampaign::learn(const SweepRun& wanted, double seconds, double share) const {
  const double perStep = seconds / (share * workOf(sweep_.cases[wanted.setup].setup));
  const std::scoped_lock lock(learning_);
  ThesisEngine& own = engines_[wanted.engine];
  const auto seen = static_cast<double>(own.seen++);
  own.perStep = (own.perStep * seen + perStep) / (seen + 1.0);
}

/// A tenth of a second of steps on the first case that it is to run.
void ThesisCampaign::timeStepsOf(ThesisEngine& own) {
  const auto index = static_cast<std::size_t>(&own - engines_.data());
  const auto first = std::ranges::find(wanted_, index, &SweepRun::engine);
  if (first == wanted_.end()) return;
  const Case& setup = sweep_.cases[first->setup].setup;
  try {
    const double dt = timeStep(setup);
    const Packing packing = preparedPacking(setup, first->packing);
    const auto engine =
        startEngine(own.entry, store_.scratch("time-" + own.entry.name), setup.run.timeout);
    const BriefTiming timing =
        briefTiming(*engine, own.entry, setup, couetteScene(setup, packing, dt));
    own.perStep = besidesSteps * timing.secondsPerStep * (dt / timing.effective.dt) /
                  static_cast<double>(packing.disks.size());
  } catch (const std::runtime_error& failure) {
    throwIfInterrupted();
    progress_.say(failure.what());  // its runs will fail, one by one
  }
}

CachedTask<ThesisRun> ThesisCampaign::taskOf(const SweepRun& wanted) const {
  const SweepCase& own = sweep_.cases[wanted.setup];
  const ThesisEngine& engine = engines_[wanted.engine];
  CachedTask<ThesisRun> task;
  task.label = fmt::format("{} {} packing {}", engine.entry.name, own.name, wanted.packing);
  task.name = fmt::format("{}-{}-p{}", own.name, engine.entry.name, wanted.packing);
  task.key = runKey(own.setup, engine.entry.name, engine.version);
  task.key["leg"] = own.name;
  task.key["packing"] = packingHash(own.setup, wanted.packing, timeStep(own.setup));
  task.key["finer_rings"] = fmt::format("{}", fmt::join(sweep_.finerRings, ","));
  task.key["settling_snapshots"] = fmt::to_string(sweep_.settlingSnapshots);
  task.weight = predicted(wanted);
  task.priority = -static_cast<double>(&wanted - wanted_.data());
  task.work = [this, &wanted, name = task.name,
               key = task.key](const std::function<void(double)>& progress) {
    return make(wanted, name, key, progress);
  };
  return task;
}

const ThesisRun* ThesisCampaign::earlier(const SweepRun& wanted, const CaseKeys& key) const {
  const auto found = earlier_.find(keyOfRun(sweep_.cases[wanted.setup].setup, key));
  return found == earlier_.end() ? nullptr : &found->second;
}

ThesisCampaign::Outcome ThesisCampaign::make(const SweepRun& wanted, const std::string& name,
                                             const CaseKeys& key,
                                             const std::function<void(double)>& progress) const {
  if (const ThesisRun* found = earlier(wanted, key))
    return {*found, true, "made earlier, by crossgrain " + found->program};
  const SweepCase& own = sweep_.cases[wanted.setup];
  const EngineEntry& entry = engines_[wanted.engine].entry;
  ThesisRun result;
  const auto identify = [&] {
    result.setup = own.name;
    result.engine = result.run.engine = entry.name;
    result.packing = result.run.packing = wanted.packing;
    result.seed = own.setup.preparation.seed;
  };
  // What is left of a run half done: of a whole one 1, and never nothing.
  const double toDo = std::max(
      0.01, 1.0 - timeReached(store_.unfinished(name), Json(key).dump()) / durationOf(own.setup));
  if (const double left = budget_ - elapsed(), needs = toDo * predicted(wanted); needs > left) {
    identify();
    result.run.status = Status::notRun;
    result.run.reason =
        fmt::format("it would take about {}, of the budget {} {} left", roughly(needs),
                    left > 0.0 ? roughly(left) : "nothing", left > 0.0 ? "were" : "was");
    return {result, false, "left out: " + result.run.reason};
  }
  const double began = elapsed();
  try {
    const double dt = timeStep(own.setup);
    const Packing packing = preparedPacking(own.setup, wanted.packing);
    const FlowTask task{&own.setup,
                        entry,
                        wanted.packing,
                        &packing,
                        dt,
                        store_.scratch(name),
                        store_.snapshots(name),
                        store_.unfinished(name),
                        Json(key).dump()};
    result = runCase(task, sweep_.finerRings, sweep_.settlingSnapshots, progress);
    result.setup = own.name;
    result.key = keyOfRun(own.setup, key);
    result.program = thisProgram();
    learn(wanted, elapsed() - began, toDo);
    return {result, true, roughly(result.run.stats->wallSeconds)};
  } catch (const Interrupted&) {
    throw;
  } catch (const OutputError&) {
    throw;  // nothing more can be kept
  } catch (const std::exception& error) {
    identify();
    result.run.status = Status::failed;
    result.run.reason = fmt::format("{}, packing {}: {}", own.name, wanted.packing, error.what());
    return {result, false, fmt::format("failed: {}", error.what())};
  }
}

void ThesisCampaign::run() {
  for (ThesisEngine& own : engines_) {
    throwIfInterrupted();
    if (own.can) timeStepsOf(own);
  }
  std::vector<CachedTask<ThesisRun>> tasks;
  for (const SweepRun& wanted : wanted_) tasks.push_back(taskOf(wanted));
  runs_ = runOrLoad(tasks, store_, progress_, "running", command_.jobs);
}

std::string ThesisCampaign::plan() const {
  std::map<std::size_t, PlannedWork> works;
  for (const SweepRun& wanted : wanted_) {
    PlannedWork& work = works[wanted.engine];
    work.engine = engines_[wanted.engine].entry.name;
    work.what = "runs";
    const auto task = taskOf(wanted);
    std::optional<nlohmann::json> run;
    if (const auto kept = store_.findAs<ThesisRun>(task.name, task.key))
      run = jsonOf(kept->run);
    else if (const ThesisRun* before = earlier(wanted, task.key))
      run = jsonOf(before->run);
    count(work, run);
  }
  std::string head = fmt::format("{}: {} cases\n", sweep_.file.string(), sweep_.cases.size());
  for (const SweepStage& stage : sweep_.stages) {
    double millions = 0.0;  // of the case's dt, for one engine
    for (const std::size_t index : stage.cases) {
      const Case& setup = sweep_.cases[index].setup;
      millions += 1e-6 * stage.packings * durationOf(setup) / timeStep(setup);
    }
    head += fmt::format("  {}: cases {}, packings of each {}, {:.1f} million steps\n", stage.name,
                        stage.cases.size(), stage.packings, millions);
  }
  for (const std::string& refusal : refusals_) head += "  " + refusal + "\n";
  std::vector<PlannedWork> list;
  for (auto& [engine, work] : works) list.push_back(std::move(work));
  return describeDryRun(head, list, store_, command_);
}

ThesisResults ThesisCampaign::results() const {
  ThesisResults results;
  results.head = headOf(kindThesis, sweep_.cases.front().setup, command_.commandLine);
  results.head.setup = {sweep_.name, "", sweep_.file.string(), readFile(sweep_.file).value_or("")};
  for (const ThesisEngine& own : engines_)
    results.engines.push_back(
        {own.entry.name, own.entry.summary, own.version, own.entry.mirrors, Status::finished, ""});
  for (const SweepCase& own : sweep_.cases) results.cases.push_back(rowOf(own));
  results.surrogates = surrogates_;
  results.notes = refusals_;
  for (const ThesisRun& run : runs_) {
    if (run.run.status == Status::notRun) {
      results.notes.push_back(fmt::format("{}, {}, packing {} was left out: {}.", run.setup,
                                          run.engine, run.packing, run.run.reason));
      continue;
    }
    results.runs.push_back(run);
    if (run.run.status != Status::failed) continue;
    EngineRow& engine = *std::ranges::find(results.engines, run.engine, &EngineRow::name);
    if (engine.status == Status::failed) continue;
    engine.status = Status::failed;
    engine.reason = run.run.reason;
  }
  std::ranges::copy(madeByOthers(results.runs), std::back_inserter(results.notes));
  return results;
}

}  // namespace crossgrain::inline studies

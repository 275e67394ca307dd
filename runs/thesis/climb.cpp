#include "runs/thesis/climb.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "cases/couette.hpp"
#include "cases/preparation.hpp"
#include "cases/time_step.hpp"
#include "results/schema.hpp"
#include "results/thesis_fields.hpp"
#include "runs/common/engine_running.hpp"
#include "runs/common/run_store.hpp"
#include "runs/common/study.hpp"
#include "runs/couette/frame.hpp"
#include "runs/couette/unfinished_run.hpp"
#include "runs/thesis/carrying.hpp"
#include "runs/thesis/leg_run.hpp"
#include "support/files.hpp"
#include "support/interrupt.hpp"

namespace crossgrain::inline runs {

namespace {

/// What snapshots and averages add to the steps' own time, before any run has shown it.
constexpr double besidesSteps = 1.2;

/// Sizes of a run that its time goes by: steps of the case's dt, the ring's shrinking included,
/// times disks.
double workOf(const Case& setup) {
  const double run =
      (setup.averaging.settleRotations + setup.averaging.rotations) * rotationTime(setup);
  return (preparationSteps(setup) + run / timeStep(setup)) *
         (setup.particles.small + setup.particles.large);
}

/// What is left of a run that has come to that time [s]: of a whole one 1, and never nothing.
double shareToDo(const Case& setup, double reached) {
  const double whole =
      (setup.averaging.settleRotations + setup.averaging.rotations) * rotationTime(setup);
  return std::max(0.01, 1.0 - reached / whole);
}

std::string roughly(double seconds) {
  return seconds < 100.0 ? fmt::format("{:.0f} s", seconds)
                         : fmt::format("{:.0f} min", seconds / 60.0);
}

}  // namespace

Climb::Climb(const ThesisLadder& ladder, const RunCommand& command, RunStore& store, double budget,
             EarlierRuns earlier)
    : ladder_(ladder),
      command_(command),
      store_(store),
      budget_(budget),
      earlier_(std::move(earlier)),
      progress_(command.quiet) {
  for (EngineEntry& entry : selectEngines(command.engines)) engines_.push_back({std::move(entry)});
  for (const LadderLeg& leg : ladder.legs) checkEngineSections(leg.setup);
}

void Climb::ask(ClimbingEngine& own) {
  throwIfInterrupted();
  try {
    const auto engine = startEngine(own.entry, store_.scratch("ask-" + own.entry.name),
                                    ladder_.legs.front().setup.run.timeout);
    own.can = engine->capabilities();
    own.version = own.can->version;
  } catch (const EngineFailure& failure) {
    progress_.say(failure.what());  // its runs will tell, one by one
  }
}

void Climb::askEngines() {
  for (ClimbingEngine& own : engines_) ask(own);
  takeSteps();
  store_.begin();
}

void Climb::holdAgainstMirrors(std::size_t starts) {
  const auto forAll = std::ranges::find_if(
      ladder_.rungs, [](const LadderRung& rung) { return rung.engines.empty(); });
  if (forAll == ladder_.rungs.end()) return;
  std::vector<LockstepEngine> engines;
  for (const ClimbingEngine& own : engines_)
    if (own.can) engines.push_back({own.entry, own.version});
  carriers_ = findCarriers(engines, ladder_.legs[forAll->legs.front()], starts, command_, store_,
                           progress_);
  for (const ThesisCarrier& carrier : carriers_) {
    if (!carrier.carries) continue;
    std::ranges::find(engines_, carrier.engine, [](const ClimbingEngine& own) {
      return own.entry.name;
    })->part = LadderEngine::Part::carried;
    engines_.push_back({*findEngine(carrier.mirror), LadderEngine::Part::carrier});
    ask(engines_.back());
  }
  takeSteps();
}

/// Without those that an engine cannot run, of which it is told once a leg.
void Climb::takeSteps() {
  std::vector<LadderEngine> engines;
  for (const ClimbingEngine& own : engines_) engines.push_back({own.entry.name, own.part});
  steps_ = stepsOf(ladder_, engines);
  refusals_.clear();
  std::map<std::pair<std::size_t, std::size_t>, std::string> why;
  std::erase_if(steps_, [&](const LadderStep& step) {
    const ClimbingEngine& own = engines_[step.engine];
    const auto [entry, isNew] = why.try_emplace({step.leg, step.engine});
    if (isNew && own.can) {
      const Case& setup = ladder_.legs[step.leg].setup;
      Packing unplaced;
      unplaced.disks = diskKinds(setup.particles);
      try {
        checkSuitable(*own.can, own.entry, setup, couetteScene(setup, unplaced, timeStep(setup)));
      } catch (const UnsupportedScene& refusal) {
        entry->second = refusal.what();
        refusals_.push_back(
            fmt::format("{} was left out: {}", ladder_.legs[step.leg].name, refusal.what()));
      }
    }
    return !entry->second.empty();
  });
}

std::string Climb::label(const LadderStep& step) const {
  return fmt::format("{} {} packing {}", engines_[step.engine].entry.name,
                     ladder_.legs[step.leg].name, step.packing);
}

double Climb::elapsed() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - started_).count();
}

double Climb::predicted(const LadderStep& step) const {
  const std::scoped_lock lock(learning_);
  return engines_[step.engine].perStep * workOf(ladder_.legs[step.leg].setup);
}

/// The mean over runs: a machine that is busy now is likely to stay so.
void Climb::learn(const LadderStep& step, double seconds, double share) const {
  const double perStep = seconds / (share * workOf(ladder_.legs[step.leg].setup));
  const std::scoped_lock lock(learning_);
  ClimbingEngine& own = engines_[step.engine];
  const auto seen = static_cast<double>(own.seen++);
  own.perStep = (own.perStep * seen + perStep) / (seen + 1.0);
}

/// A tenth of a second of steps on the first leg that it is to run.
void Climb::timeStepsOf(ClimbingEngine& own) {
  const auto index = static_cast<std::size_t>(&own - engines_.data());
  const auto first = std::ranges::find(steps_, index, &LadderStep::engine);
  if (first == steps_.end()) return;
  const Case& setup = ladder_.legs[first->leg].setup;
  try {
    const double dt = timeStep(setup);
    const auto inHouse = engineRegistry().front().make();
    const Packing packing =
        packingOf(setup, first->packing, dt, *inHouse, [](double) { throwIfInterrupted(); });
    const auto engine =
        startEngine(own.entry, store_.scratch("time-" + own.entry.name), setup.run.timeout);
    const BriefTiming timing =
        briefTiming(*engine, own.entry, setup, couetteScene(setup, packing, dt));
    own.perStep = besidesSteps * timing.secondsPerStep * (dt / timing.realised.dt) /
                  static_cast<double>(packing.disks.size());
  } catch (const std::runtime_error& failure) {
    throwIfInterrupted();
    progress_.say(failure.what());  // its runs will tell, one by one
  }
}

KeptTask<ThesisRun> Climb::taskOf(const LadderStep& step) const {
  const LadderLeg& leg = ladder_.legs[step.leg];
  const ClimbingEngine& own = engines_[step.engine];
  KeptTask<ThesisRun> task;
  task.label = label(step);
  task.name = fmt::format("{}-{}-p{}", leg.name, own.entry.name, step.packing);
  task.key = runKey(leg.setup, own.entry.name, own.version);
  task.key["leg"] = leg.name;
  task.key["packing"] = packingHash(leg.setup, step.packing, timeStep(leg.setup));
  task.key["finer_rings"] = fmt::format("{}", fmt::join(ladder_.finerRings, ","));
  task.key["settling_snapshots"] = fmt::to_string(ladder_.settlingSnapshots);
  task.weight = predicted(step);
  task.priority = -static_cast<double>(&step - steps_.data());
  task.work = [this, &step, name = task.name,
               key = task.key](const std::function<void(double)>& progress) {
    return runStep(step, name, key, progress);
  };
  return task;
}

const ThesisRun* Climb::earlier(const LadderStep& step, const CaseKeys& key) const {
  const auto found = earlier_.find(keyOfRun(ladder_.legs[step.leg].setup, key));
  return found == earlier_.end() ? nullptr : &found->second;
}

Climb::Outcome Climb::runStep(const LadderStep& step, const std::string& name, const CaseKeys& key,
                              const std::function<void(double)>& progress) const {
  if (const ThesisRun* found = earlier(step, key))
    return {*found, true, "made earlier, by crossgrain " + found->program};
  const LadderLeg& leg = ladder_.legs[step.leg];
  const EngineEntry& entry = engines_[step.engine].entry;
  ThesisRun result;
  result.run.status = RunStatus::missing;
  const double toDo = shareToDo(leg.setup, timeReached(store_.unfinished(name), Json(key).dump()));
  if (const double left = budget_ - elapsed(), needs = toDo * predicted(step); needs > left) {
    result.run.reason =
        fmt::format("it would take about {}, of the budget {} {} left", roughly(needs),
                    left > 0.0 ? roughly(left) : "nothing", left > 0.0 ? "were" : "was");
    result.leg = leg.name;
    result.engine = entry.name;
    result.packing = step.packing;
    return {result, false, "left out: " + result.run.reason};
  }
  const double began = elapsed();
  try {
    const double dt = timeStep(leg.setup);
    const auto inHouse = engineRegistry().front().make();
    const Packing packing =
        packingOf(leg.setup, step.packing, dt, *inHouse, [](double) { throwIfInterrupted(); });
    const CouetteTask task{&leg.setup,
                           entry,
                           step.packing,
                           &packing,
                           dt,
                           store_.scratch(name),
                           store_.snapshots(name),
                           store_.unfinished(name),
                           Json(key).dump()};
    result = runLeg(task, {ladder_.finerRings, ladder_.settlingSnapshots}, progress);
    result.leg = leg.name;
    result.key = keyOfRun(leg.setup, key);
    result.program = thisProgram();
    learn(step, elapsed() - began, toDo);
    return {result, true, roughly(result.run.stats->wallSeconds)};
  } catch (const Interrupted&) {
    throw;
  } catch (const OutputError&) {
    throw;  // nothing more can be kept
  } catch (const std::exception& error) {
    result.leg = leg.name;
    result.engine = result.run.engine = entry.name;
    result.packing = result.run.packing = step.packing;
    result.seed = leg.setup.preparation.seed;
    result.run.status = RunStatus::failed;
    result.run.reason = fmt::format("{}, packing {}: {}", leg.name, step.packing, error.what());
    return {result, false, fmt::format("failed: {}", error.what())};
  }
}

void Climb::run() {
  for (ClimbingEngine& own : engines_) {
    throwIfInterrupted();
    if (own.can) timeStepsOf(own);
  }
  std::vector<KeptTask<ThesisRun>> tasks;
  for (const LadderStep& step : steps_) tasks.push_back(taskOf(step));
  runs_ = doOrTakeUp(tasks, store_, progress_, "climbing", command_.jobs);
}

}  // namespace crossgrain::inline runs

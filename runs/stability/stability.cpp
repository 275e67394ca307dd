#include "runs/stability/stability.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "cases/case_files.hpp"
#include "cases/flow.hpp"
#include "cases/loader.hpp"
#include "cases/preparation.hpp"
#include "cases/time_step.hpp"
#include "results/head_fields.hpp"
#include "results/schema.hpp"
#include "results/stability_fields.hpp"
#include "runs/common/executor.hpp"
#include "runs/common/run_store.hpp"
#include "runs/common/study.hpp"
#include "runs/stability/recorder.hpp"
#include "runs/stability/run.hpp"
#include "runs/stability/transforms.hpp"
#include "stability/measures.hpp"
#include "support/bad_input.hpp"
#include "support/interrupt.hpp"

namespace crossgrain::inline runs {

namespace fs = std::filesystem;

/// The rows of one engine and case, kept together: they share the run that all are held against.
struct TransformRows {
  std::vector<StabilityRun> rows;
};
void fields(auto& io, TransformRows& all) {
  io("rows", all.rows);
}

namespace {

std::vector<fs::path> filesOf(const fs::path& input) {
  return fs::is_directory(input) ? caseFilesIn(input) : std::vector{input};
}

bool belongsTo(SuitePart part, const Stability& hard) {
  if (part == SuitePart::quick) return hard.quick;
  return part == SuitePart::withLong || !hard.longRun;
}

}  // namespace

std::vector<Case> hardCases(const std::vector<fs::path>& inputs,
                            const std::vector<std::string>& overrides, SuitePart part) {
  std::vector<Case> cases;
  for (const fs::path& input : inputs)
    for (const fs::path& file : filesOf(input))
      for (Case& setup : loadCase(file, overrides)) {
        if (!setup.stability)
          throw BadInput(fmt::format("{}: has no [stability]: it is no hard case", file.string()));
        cases.push_back(std::move(setup));
      }
  requireOwnNames(cases);
  if (std::ranges::none_of(cases, [&](const Case& c) { return belongsTo(part, *c.stability); }))
    throw BadInput(part == SuitePart::quick ? "none of these cases has stability.quick = true"
                                            : "all of these cases are long: --long runs them");
  std::erase_if(cases, [&](const Case& c) { return !belongsTo(part, *c.stability); });
  return cases;
}

std::vector<Case> casesToTransform(const std::vector<fs::path>& inputs,
                                   const std::vector<std::string>& overrides) {
  std::vector<Case> cases;
  for (const fs::path& input : inputs)
    for (const fs::path& file : filesOf(input))
      std::ranges::move(loadCase(file, overrides), std::back_inserter(cases));
  requireOwnNames(cases);
  return cases;
}

namespace {

class Suite {
 public:
  Suite(const std::vector<Case>& cases, std::vector<EngineEntry> engines, const RunCommand& command,
        RunStore& store, SuiteAsks asks, double budget = std::numeric_limits<double>::infinity())
      : cases_(cases),
        asks_(asks),
        command_(command),
        engines_(std::move(engines)),
        store_(store),
        progress_(command.quiet),
        packings_(cases.size()),
        unprepared_(cases.size()),
        versions_(engines_.size()),
        budget_(budget, cases.size() * engines_.size(), command.jobs) {
    for (const Case& setup : cases) checkEngineSections(setup);
    for (const EngineEntry& entry : engines_)
      if (entry.missing && !entry.missing().empty())
        startEngine(entry, {}, 1.0);  // throws, saying why
  }

  void askVersions() {
    std::vector<std::string> failures(engines_.size());
    std::vector<Task> tasks;
    for (std::size_t e = 0; e < engines_.size(); ++e)
      tasks.push_back(
          {1.0, [this, e, &failures] {
             const EngineEntry& entry = engines_[e];
             try {
               const Capabilities can =
                   startEngine(entry, store_.scratch("ask-" + entry.name), 60.0)->capabilities();
               versions_[e] = can.version;
               for (const Case& setup : cases_)
                 settingsFor(setup, entry.name, can);  // throws for one that is wrong
             } catch (const EngineFailure& failure) {
               failures[e] = failure.what();  // its runs will tell, one by one
             }
           }});
    runTasks(tasks, command_.jobs);
    for (const std::string& failure : failures)
      if (!failure.empty()) progress_.say(failure);
    store_.begin();
  }

  void preparePackings() {
    for (std::size_t c = 0; c < cases_.size(); ++c) {
      if (cases_[c].kind != CaseKind::couette) continue;
      const auto engine = engineRegistry().front().make();
      progress_.begin("preparing packings", {1.0});
      try {
        packings_[c] = packingOf(cases_[c], 0, timeStep(cases_[c]), *engine, [&](double fraction) {
          throwIfInterrupted();
          progress_.update(0, cases_[c].name, fraction);
        });
        progress_.finish(0, cases_[c].name + ": packing ready");
      } catch (const Interrupted&) {
        throw;
      } catch (const BadInput&) {
        throw;
      } catch (const std::exception& failure) {  // the other cases go on
        unprepared_[c] = fmt::format("no packing was prepared: {}", failure.what());
        progress_.finish(0, fmt::format("{}: {}", cases_[c].name, unprepared_[c]));
      }
    }
  }

  /// What run() would do.
  std::string plan() {
    for (std::size_t c = 0; c < cases_.size(); ++c)
      if (cases_[c].kind == CaseKind::couette)
        packings_[c].hash = packingHash(cases_[c], 0, timeStep(cases_[c]));
    std::vector<PlannedWork> works;
    for (std::size_t e = 0; e < engines_.size(); ++e) {
      PlannedWork work{engines_[e].name, "hard cases"};
      for (std::size_t c = 0; c < cases_.size(); ++c) {
        const auto task = taskOf<StabilityRun>(c, e);
        count(work, store_.find(task.name, task.key));
      }
      works.push_back(work);
    }
    std::string head;
    for (const Case& setup : cases_)
      head += fmt::format("{}{}{}", head.empty() ? "" : ", ", setup.name,
                          setup.variant.empty() ? "" : " " + setup.variant);
    return dryRunInWords(head + "\n", works, store_, command_);
  }

  void run() {
    if (asks_ == SuiteAsks::limits)
      runs_ = doAll<StabilityRun>("hard cases");
    else
      for (TransformRows& all : doAll<TransformRows>("transforms"))
        std::ranges::move(all.rows, std::back_inserter(runs_));
    sayWhatIsAlwaysNew(engines_, progress_);
  }

  StabilityResults results() const {
    StabilityResults results;
    results.head = headOf(kindStability, cases_.front(), command_.commandLine);
    const bool one =
        std::ranges::all_of(cases_, [&](const Case& c) { return c.name == cases_.front().name; });
    const char* const many = asks_ == SuiteAsks::transforms ? "cases told otherwise" : "hard cases";
    results.head.setup = {one ? cases_.front().name : many, "",
                          cases_.front().file.parent_path().string(), ""};
    for (const Case& setup : cases_)
      std::ranges::move(rowsOf(setup), std::back_inserter(results.cases));
    results.runs = runs_;
    for (std::size_t e = 0; e < engines_.size(); ++e)
      results.engines.push_back({engines_[e].name, engines_[e].summary, versions_[e],
                                 engines_[e].mirrors, EngineStatus::ran, ""});
    return results;
  }

 private:
  /// Roughly, in seconds: the longest start first.
  double predicted(const Case& setup, const EngineEntry& entry) const {
    const double perStep = entry.command ? 3e-5 : 2e-6;
    double steps = 1e4;
    if (setup.kind == CaseKind::assembly && setup.assembly.steps) steps = *setup.assembly.steps;
    if (setup.kind == CaseKind::assembly && setup.assembly.duration)
      steps = *setup.assembly.duration / timeStep(setup);
    std::size_t disks = 1;
    for (const DiskGroup& group : setup.assembly.disks) disks += group.places.size();
    return (entry.command ? 2.0 : 0.1) + steps * perStep * static_cast<double>(disks + 3);
  }

  const Case& originalOf(const Case& setup) const {
    return *std::ranges::find(cases_, setup.name, &Case::name);
  }

  template <typename Result>
  std::vector<Result> doAll(const std::string& stage) {
    std::vector<KeptTask<Result>> tasks;
    for (std::size_t c = 0; c < cases_.size(); ++c)
      for (std::size_t e = 0; e < engines_.size(); ++e) tasks.push_back(taskOf<Result>(c, e));
    return doOrTakeUp(tasks, store_, progress_, stage, command_.jobs);
  }

  KeptTask<StabilityRun>::Outcome done(const StabilityTask& task,
                                       const std::function<void(double)>& progress,
                                       StabilityRun* /*of*/) {
    StabilityRun run = runStability(task, progress);
    const std::string verdict(nameOf(run.verdict));
    const bool finished = run.status != HardRunStatus::failed;
    return {std::move(run), finished, verdict};
  }

  KeptTask<TransformRows>::Outcome done(const StabilityTask& task,
                                        const std::function<void(double)>& progress,
                                        TransformRows* /*of*/) {
    TransformRows all{runTransforms(task, budget_.next(), progress)};
    const auto count = [&](auto member, auto value) {
      return std::ranges::count(all.rows, value, member);
    };
    const auto broken = count(&StabilityRun::verdict, StabilityVerdict::unstable);
    const auto late = count(&StabilityRun::status, HardRunStatus::notRun);
    const bool finished = late + count(&StabilityRun::status, HardRunStatus::failed) == 0;
    return {std::move(all), finished,
            fmt::format("{}{}", broken == 0 ? "nothing breaks" : fmt::format("{} break", broken),
                        late == 0 ? "" : fmt::format(", {} not run", late))};
  }

  template <typename Result>
  KeptTask<Result> taskOf(std::size_t c, std::size_t e) {
    const Case& setup = cases_[c];
    const EngineEntry& entry = engines_[e];
    KeptTask<Result> task;
    task.label = fmt::format("{} {}{}{}", entry.name, setup.name, setup.variant.empty() ? "" : " ",
                             setup.variant);
    task.name = task.label;
    std::ranges::replace(task.name, ' ', '-');
    task.key = runKey(setup, entry.name, versions_[e]);
    if (!packings_[c].hash.empty()) task.key["packing"] = packings_[c].hash;
    if (!setup.assembly.starts.files.empty())  // the case has their paths only
      task.key["packing"] = expectedPacking(setup, 0, timeStep(setup)).hash;
    const Case& original = originalOf(setup);
    if (asks_ == SuiteAsks::transforms)
      task.name += "-transforms";
    else if (stabilityMeasure(setup.stability->measure).protocol != StabilityProtocol::oneRun)
      task.key["held against"] = original.variant;
    task.weight = predicted(setup, entry);
    // What is over soon leaves its part to the others.
    if (asks_ == SuiteAsks::transforms) task.priority = -task.weight;
    task.work = [this, &setup, &original, &entry, c,
                 name = task.name](const std::function<void(double)>& progress) {
      return done({&setup, &original, entry, &packings_[c], store_.scratch(name), unprepared_[c]},
                  progress, static_cast<Result*>(nullptr));
    };
    return task;
  }

  std::vector<HardCase> rowsOf(const Case& setup) const {
    if (asks_ == SuiteAsks::transforms) return transformRows(setup);
    const Stability& hard = *setup.stability;
    const StabilityMeasure& measure = stabilityMeasure(hard.measure);
    return {{setup.name, setup.variant, setup.file.string(), hard.tests, hard.measure,
             std::string(measure.what), std::string(measure.unit), hard.limit, hard.degraded,
             hard.why, setup.resolvedToml}};
  }

  const std::vector<Case>& cases_;
  SuiteAsks asks_;
  const RunCommand& command_;
  std::vector<EngineEntry> engines_;
  RunStore& store_;
  Progress progress_;
  std::vector<Packing> packings_;        ///< of Couette cases
  std::vector<std::string> unprepared_;  ///< why they have none
  std::vector<std::string> versions_;
  TimeBudget budget_;
  std::vector<StabilityRun> runs_;  ///< case by case, engine by engine
};

}  // namespace

StabilityResults testStability(const std::vector<Case>& cases, std::vector<EngineEntry> engines,
                               const RunCommand& command, RunStore& store, SuiteAsks asks,
                               double budget) {
  const auto started = std::chrono::steady_clock::now();
  Suite suite(cases, std::move(engines), command, store, asks, budget);
  suite.askVersions();
  suite.preparePackings();
  suite.run();
  StabilityResults results = suite.results();
  results.elapsed =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  return results;
}

std::string stabilityPlan(const std::vector<Case>& cases, std::vector<EngineEntry> engines,
                          const RunCommand& command, RunStore& store, SuiteAsks asks) {
  Suite suite(cases, std::move(engines), command, store, asks);
  suite.askVersions();
  return suite.plan();
}

}  // namespace crossgrain::inline runs

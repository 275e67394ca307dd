#include "studies/stability/stability.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <iterator>
#include <set>

#include "adapters/worker/json.hpp"
#include "cases/case_files.hpp"
#include "cases/effect_switch.hpp"
#include "cases/flow.hpp"
#include "cases/loader.hpp"
#include "cases/preparation.hpp"
#include "cases/time_step.hpp"
#include "results/scene_picture.hpp"
#include "results/schema.hpp"
#include "results/stability.hpp"
#include "stability/measures.hpp"
#include "studies/core/engine_access.hpp"
#include "studies/core/executor.hpp"
#include "studies/core/study.hpp"
#include "studies/stability/run.hpp"
#include "studies/stability/transforms.hpp"
#include "support/bad_input.hpp"
#include "support/data_folder.hpp"
#include "support/interrupt.hpp"

namespace crossgrain::inline studies {

namespace fs = std::filesystem;

namespace {

/// All cases of files and folders. @throws BadInput
std::vector<Case> casesOf(const std::vector<fs::path>& inputs,
                          const std::vector<std::string>& overrides) {
  std::vector<Case> cases;
  for (const fs::path& input : inputs)
    for (const fs::path& file : fs::is_directory(input) ? caseFilesIn(input) : std::vector{input})
      std::ranges::move(loadCase(file, overrides), std::back_inserter(cases));
  return cases;
}

bool belongsTo(SuitePart part, const Stability& hard) {
  if (part == SuitePart::quick) return hard.quick;
  return part == SuitePart::withLong || !hard.longRun;
}

bool comparesVariants(const Stability& hard) {
  return stabilityMeasure(hard.measure).protocol == StabilityProtocol::againstOriginal;
}

/// Whether the case is the one that others are compared with, which has no verdict of its own.
/// @param all  whole files
/// @throws BadInput if its file has no others
bool isOriginal(const Case& setup, const std::vector<Case>& all) {
  if (!comparesVariants(*setup.stability)) return false;
  if (std::ranges::count(all, setup.file, &Case::file) < 2)
    throw BadInput(
        fmt::format("{}: stability.measure = \"{}\" compares every variant with the file's first: "
                    "it takes two [[variants]] at least",
                    setup.file.string(), setup.stability->measure));
  return &setup == &*std::ranges::find(all, setup.file, &Case::file);
}

/// A variant's label where the case runs in a plane of space.
std::string inSpaceLabel(const std::string& variant) {
  return variant.empty() ? "in space" : variant + ", in space";
}

/// Reference of a case: the first variant of its file, whichever part of the suite is run.
/// @throws std::logic_error if that is the case itself, as any run is like itself
Case originalOf(const Case& setup) {
  Case first = loadCase(setup.file, setup.overrides).front();
  if (setup.variant == first.variant || setup.variant == inSpaceLabel(first.variant))
    throw std::logic_error(fmt::format("{} would be compared with itself", fullName(setup)));
  return first;
}

}  // namespace

namespace {

/// Measures and limits for a scene that is no hard case of its own.
const struct SceneAudit {
  const char* name;
  Stability asks;
  bool (*applies)(const Case&) = nullptr;  ///< null: always
} sceneAudits[] = {
    {"overlap",
     {"No two bodies sink through each other.", "max_overlap", 1.0, 1.0,
      "soft laws reach what a scene presses them to; beyond a radius centres pass each other"}},
    {"walls",
     {"No body goes through another or a wall.", "tunnelled", 0.0, 0.0, "bodies are impenetrable"}},
    {"energy",
     {"No energy comes from nowhere.", "energy_gain", 0.01, 0.1,
      "walls that stand still do no work; a hundredth is what steps of t_c/50 leave"},
     [](const Case& setup) { return !effectsOf(setup).contains(Effect::movingWalls); }},
    {"wall forces",
     {"What walls and gravity give is what the bodies get: momentum and angular momentum.",
      "wall_balance", 0.1, 0.3,
      "forces of instants beside velocities of up to half a step away: 1/16 at most of eight "
      "steps, "
      "with either sign, and arms that leave a hundredth of a radius"},
     [](const Case& setup) { return !effectsOf(setup).contains(Effect::bottomFriction); }},
    {"rest",
     {"What has come to rest stays at rest.", "wakes", 1e-6, 1.0,
      "a hundred times what counts as rest; what stands unstably may fall, so that alone is no "
      "instability"},
     [](const Case& setup) { return !effectsOf(setup).contains(Effect::movingWalls); }},
    {"restart",
     {"A run taken up at its middle is the same run.", "restart_differs", 0.0, 1e-9,
      "a checkpoint holds all that the future depends on: to the bit"}},
    {"invariances",
     {"Turned, mirrored, in other units, renumbered, restarted and unwatched it is the same scene.",
      "invariances", 1.0, 1.0,
      "what rounding may do, as found by runs whose start is nudged by one"}},
    {"largest step",
     {"The case's time step is one that the scene bears.", "largest_step", 1.0, 1.0,
      "1: the case's own step is the largest; less: there is room"}}};

/// One case for each, of a flow.
std::vector<Case> auditsOf(const Case& setup) {
  std::vector<Case> audits;
  for (const SceneAudit& audit : sceneAudits) {
    if (audit.applies && !audit.applies(setup)) continue;
    Case& one = audits.emplace_back(setup);
    one.stability = audit.asks;
    one.stability->quick = one.stability->measure != "largest_step";
    one.variant = setup.variant.empty() ? audit.name : setup.variant + ", " + audit.name;
  }
  return audits;
}

/// Cases with [stability] as they are, of flows without one their audits. @throws BadInput
std::vector<Case> withAudits(const std::vector<Case>& cases) {
  std::vector<Case> all;
  for (const Case& setup : cases) {
    if (setup.stability) {
      all.push_back(setup);
      continue;
    }
    if (!hasFlow(setup))
      throw BadInput(
          fmt::format("{}: has no [stability]: it is no hard case, and no flow whose run could be "
                      "audited",
                      setup.file.string()));
    std::ranges::move(auditsOf(setup), std::back_inserter(all));
  }
  return all;
}

}  // namespace

std::vector<Case> hardCases(const std::vector<fs::path>& inputs,
                            const std::vector<std::string>& overrides, SuitePart part) {
  std::vector<Case> cases = withAudits(casesOf(inputs, overrides));
  requireOwnNames(cases);
  std::vector<Case> judged;
  for (const Case& setup : cases)
    if (!isOriginal(setup, cases) && belongsTo(part, *setup.stability)) judged.push_back(setup);
  cases = std::move(judged);
  if (cases.empty())
    throw BadInput(part == SuitePart::quick ? "none of these cases has stability.quick = true"
                                            : "all of these cases are long: --long runs them");
  return cases;
}

namespace {

/// The rows of one engine and case: one, or those of all transforms, which share the run that they
/// are compared with.
using Rows = std::vector<StabilityRun>;

/// Cases, engines and shared data of the tasks, which it outlives.
struct Suite {
  const std::vector<Case>& cases;
  const std::vector<EngineEntry>& engines;
  const RunCommand& command;
  RunStore& store;
  SuiteAsks asks;
  Progress progress{command.quiet};
  std::vector<std::string> versions = {};           ///< of engines; empty: it did not answer
  std::vector<Packing> packings = {};               ///< of cases that are Couette cells
  std::vector<std::string> unprepared = {};         ///< why they have none
  std::vector<std::optional<Case>> originals = {};  ///< of cases that are compared with one
  TimeBudget* budget = nullptr;                     ///< of transforms
  bool inSpace = false;                             ///< StabilityTask::inSpace
};

/// Makes room for data of each case, and loads the variants that cases are compared with.
void makeRoom(Suite& suite) {
  suite.packings.resize(suite.cases.size());
  suite.unprepared.resize(suite.cases.size());
  suite.originals.resize(suite.cases.size());
  if (suite.asks == SuiteAsks::transforms) return;
  for (std::size_t c = 0; c < suite.cases.size(); ++c)
    if (comparesVariants(*suite.cases[c].stability))
      suite.originals[c] = originalOf(suite.cases[c]);
}

void askEngines(Suite& suite) {
  for (const Case& setup : suite.cases) checkEngineSections(setup);
  requireInstalled(suite.engines);
  suite.versions.resize(suite.engines.size());
  std::vector<std::string> failures(suite.engines.size());
  std::vector<Task> tasks;
  for (std::size_t e = 0; e < suite.engines.size(); ++e)
    tasks.push_back(
        {1.0, [&suite, e, &failures] {
           const EngineEntry& entry = suite.engines[e];
           try {
             const Capabilities can =
                 startEngine(entry, suite.store.scratch("ask-" + entry.name), 60.0)->capabilities();
             suite.versions[e] = can.version;
             for (const Case& setup : suite.cases)
               settingsFor(setup, entry.name, can);  // throws for one that is wrong
           } catch (const EngineFailure& failure) {
             failures[e] = failure.what();  // its runs will report it, one by one
           }
         }});
  runTasks(tasks, suite.command.jobs);
  for (const std::string& failure : failures)
    if (!failure.empty()) suite.progress.say(failure);
  suite.store.begin();
  printNotes();
}

void preparePackings(Suite& suite) {
  for (std::size_t c = 0; c < suite.cases.size(); ++c) {
    const Case& setup = suite.cases[c];
    if (!cellOf(setup)) continue;
    const auto engine = engineRegistry().front().make();
    suite.progress.begin("preparing packings", {1.0});
    try {
      suite.packings[c] = packingOf(setup, 0, timeStep(setup), *engine, [&](double fraction) {
        throwIfInterrupted();
        suite.progress.update(0, setup.name, fraction);
      });
      suite.progress.finish(0, setup.name + ": packing ready");
    } catch (const Interrupted&) {
      throw;
    } catch (const BadInput&) {
      throw;
    } catch (const std::exception& failure) {  // the other cases go on
      suite.unprepared[c] = fmt::format("no packing was prepared: {}", failure.what());
      suite.progress.finish(0, fmt::format("{}: {}", setup.name, suite.unprepared[c]));
    }
  }
}

/// Roughly, in seconds: the longest start first.
double predicted(const Case& setup, const EngineEntry& entry) {
  const double perStep = entry.command ? 3e-5 : 2e-6;
  const bool collision = isCollision(setup);
  const double steps = collision ? 1e4 : flowDuration(setup) / timeStep(setup);
  std::size_t disks = 1;
  if (isAssembly(setup))
    withAssembly(setup, [&](const auto& assembly) {
      for (const auto& group : assembly.disks) disks += group.places.size();
    });
  return (entry.command ? 2.0 : 0.1) + steps * perStep * static_cast<double>(disks + 3);
}

CachedTask<Rows>::Outcome limitsOf(const StabilityTask& task,
                                   const std::function<void(double)>& progress) {
  StabilityRun run = runStability(task, progress);
  const std::string verdict(nameOf(run.verdict, stabilityNames));
  const bool finished = run.status != Status::failed;
  return {{std::move(run)}, finished, verdict};
}

CachedTask<Rows>::Outcome transformsOf(const StabilityTask& task, TimeBudget& budget,
                                       const std::function<void(double)>& progress) {
  Rows rows = runTransforms(task, budget.next(), progress);
  const auto count = [&](auto member, auto value) {
    return std::ranges::count(rows, value, member);
  };
  const auto broken = count(&StabilityRun::verdict, Verdict::fail);
  const auto late = count(&StabilityRun::status, Status::notRun);
  const auto refused = count(&StabilityRun::verdict, Verdict::notApplicable);
  const bool finished = late + count(&StabilityRun::status, Status::failed) == 0;
  std::vector<std::string> parts;  // of the rows, so that what did not run is no success
  if (broken > 0) parts.push_back(fmt::format("{} break", broken));
  if (broken == 0 && refused + late < std::ssize(rows)) parts.emplace_back("nothing breaks");
  if (refused == std::ssize(rows)) parts.emplace_back("refused");
  if (late > 0) parts.push_back(fmt::format("{} not run", late));
  return {std::move(rows), finished, fmt::format("{}", fmt::join(parts, ", "))};
}

CachedTask<Rows> taskOf(const Suite& suite, std::size_t c, std::size_t e) {
  const Case& setup = suite.cases[c];
  const EngineEntry& entry = suite.engines[e];
  const Case* const original = suite.originals[c] ? &*suite.originals[c] : nullptr;
  const bool transforms = suite.asks == SuiteAsks::transforms;
  CachedTask<Rows> task;
  task.of = {entry.name, fullName(setup)};
  task.label = entry.name + " " + fullName(setup);
  task.name = task.label;
  std::ranges::replace(task.name, ' ', '-');
  task.key = runKey(setup, entry.name, suite.versions[e]);
  if (const std::string& hash = suite.packings[c].hash; !hash.empty()) task.key["packing"] = hash;
  if (isAssembly(setup) && packingsAreFiles(setup))  // the case has their paths only
    task.key["packing"] = expectedPacking(setup, 0, timeStep(setup)).hash;
  if (suite.inSpace) task.key["in space"] = true;
  task.weight = predicted(setup, entry);
  if (transforms) {
    task.name += "-transforms";
    task.priority = -task.weight;  // what is over soon leaves its part of the budget to the others
  } else if (original) {
    for (const auto& [name, value] : runKey(*original, entry.name, suite.versions[e]))
      task.key["compared with, " + name] = value;
  }
  task.work = [&suite, &setup, original, &entry, c, transforms,
               scratch = suite.store.scratch(task.name)](const auto& progress) {
    const StabilityTask own{
        &setup, original, entry, &suite.packings[c], scratch, suite.unprepared[c], suite.inSpace};
    return transforms ? transformsOf(own, *suite.budget, progress) : limitsOf(own, progress);
  };
  return task;
}

/// Case by case, engine by engine.
std::vector<CachedTask<Rows>> tasksOf(const Suite& suite) {
  std::vector<CachedTask<Rows>> tasks;
  for (std::size_t c = 0; c < suite.cases.size(); ++c)
    for (std::size_t e = 0; e < suite.engines.size(); ++e) tasks.push_back(taskOf(suite, c, e));
  return tasks;
}

std::vector<HardCase> describe(const Case& setup, SuiteAsks asks) {
  if (asks == SuiteAsks::transforms) return transformRows(setup);
  const Stability& hard = *setup.stability;
  const StabilityMeasure& measure = stabilityMeasure(hard.measure);
  return {{setup.name, setup.variant, setup.file.string(), hard.tests, hard.measure,
           std::string(measure.what), std::string(measure.unit), hard.limit, hard.degraded,
           hard.why, setup.resolvedToml}};
}

std::vector<Case> casesToTest(const CommandLine& line, StabilityOptions& own) {
  if (own.budget && !own.transforms) throw BadInput("--budget: goes with --transforms only");
  if (own.budget) secondsOf(*own.budget);  // throws for what is none
  std::vector<fs::path> inputs = line.inputs;
  if (inputs.empty()) inputs.push_back(hereOrInstalled("cases/hard"));
  std::vector<Case> cases;
  if (own.transforms) {  // of any cases
    cases = casesOf(inputs, line.overrides);
    requireOwnNames(cases);
  } else {
    cases = hardCases(inputs, line.overrides,
                      line.quick      ? SuitePart::quick
                      : own.longCases ? SuitePart::withLong
                                      : SuitePart::usual);
  }
  if (own.inSpace) {
    std::erase_if(cases, [](const Case& setup) { return setup.dimension == 3; });
    if (cases.empty())
      throw BadInput("--in-space takes scenes of the plane: these are in space as they are");
  }
  if (line.only) cases = selectedCases(cases, *line.only);
  reportKeysWithoutUse(cases, "stability", line.json ? stderr : stdout);
  for (Case& setup : cases)
    if (own.inSpace) setup.variant = inSpaceLabel(setup.variant);
  return cases;
}

std::string stabilityPlan(const StudyWork& work, const StabilityOptions& own) {
  const std::vector<EngineEntry> engines = selectEngines(work.line.run.engines);
  Suite suite{work.cases, engines, work.line.run, work.store, own.asks()};
  suite.inSpace = own.inSpace;
  makeRoom(suite);
  askEngines(suite);
  std::string head;
  for (std::size_t c = 0; c < work.cases.size(); ++c) {
    const Case& setup = work.cases[c];
    if (cellOf(setup)) suite.packings[c].hash = packingHash(setup, 0, timeStep(setup));
    head += (head.empty() ? "" : ", ") + fullName(setup);
  }
  return describeDryRun(head + "\n", plannedWork(tasksOf(suite), "hard cases", work.store),
                        work.store, work.line.run);
}

StabilityResults stability(const StudyWork& work, const StabilityOptions& own) {
  return testStability(
      work.cases, selectEngines(work.line.run.engines), work.line.run, work.store, own.asks(),
      own.budget ? secondsOf(*own.budget) : std::numeric_limits<double>::infinity(), own.inSpace);
}

Outcome outcomeOfStability(const StabilityResults& results, const CommandLine&,
                           const StabilityOptions&) {
  const auto count = [&](Verdict verdict) {
    return std::ranges::count(results.runs, verdict, &StabilityRun::verdict);
  };
  const auto all = std::ssize(results.runs), refused = count(Verdict::notApplicable);
  if (refused == all)
    return notJudged(
        fmt::format("all runs were refused; of the first: {}", results.runs.front().reason));
  if (refused + count(Verdict::notMeasured) == all)
    return notJudged("the budget ended before any run could be judged");
  const auto unstable = count(Verdict::fail);
  if (unstable == 0) return {};
  return {.status = exitFailed,
          .fails = {fmt::format("{} of {} runs unstable", unstable, all - refused)}};
}

}  // namespace

StabilityResults testStability(const std::vector<Case>& cases,
                               const std::vector<EngineEntry>& engines, const RunCommand& command,
                               RunStore& store, SuiteAsks asks, double seconds, bool inSpace) {
  const auto started = std::chrono::steady_clock::now();
  TimeBudget budget(seconds, cases.size() * engines.size(), command.jobs);
  Suite suite{cases, engines, command, store, asks};
  suite.budget = &budget;
  suite.inSpace = inSpace;
  makeRoom(suite);
  askEngines(suite);
  preparePackings(suite);
  StabilityResults results;
  for (Rows& rows :
       runOrLoad(tasksOf(suite), store, suite.progress,
                 asks == SuiteAsks::limits ? "hard cases" : "transforms", command.jobs))
    std::ranges::move(rows, std::back_inserter(results.runs));
  reportNonReusableWorkers(engines, suite.progress);
  results.head = headOf(kindStability, cases.front(), command.commandLine);
  std::set<std::string> names;
  for (const Case& setup : cases) names.insert(setup.name);
  results.head.setup = {names.size() == 1
                            ? cases.front().name
                            : fmt::format("{} {}cases", names.size(),
                                          asks == SuiteAsks::transforms ? "transformed " : ""),
                        "", cases.front().file.parent_path().string(), ""};
  for (const Case& setup : cases)
    std::ranges::move(describe(setup, asks), std::back_inserter(results.cases));
  for (std::size_t e = 0; e < engines.size(); ++e)
    results.engines.push_back(engineRow(engines[e], suite.versions[e]));
  results.elapsed =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  return results;
}

const Study<StabilityOptions, StabilityResults> stabilityStudy = {
    "stability",
    {.input = SharedOptions::Input::anyCases,
     .inputIs = "case files or folders of them (default: cases/hard)",
     .selection = true},
    Keeps::eachCase,
    [](StabilityOptions& own, CommandLine& line) {
      return std::vector<StudyOption>{
          {"--quick", "only cases marked as quick", &line.quick},
          {"--long", "also cases marked as long", &own.longCases},
          {"--transforms",
           "check that each case gives the same when turned, mirrored, in other units, renumbered, "
           "restarted and without snapshots",
           &own.transforms},
          {"--in-space",
           "each case in a plane of space, its disks as spheres; refused once they leave it",
           &own.inSpace},
          {"--budget",
           "with --transforms: start no run that would end after this time, e.g. 90s, 10m, 1h "
           "(default: no limit)",
           &own.budget, "TIME"}};
    },
    casesToTest,
    stabilityPlan,
    stability,
    outcomeOfStability,
    {{"--quick", "--long"},
     {"--transforms", "--quick"},
     {"--transforms", "--long"},
     {"--transforms", "--in-space"}}};

}  // namespace crossgrain::inline studies

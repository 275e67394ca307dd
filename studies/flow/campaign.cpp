#include "studies/flow/campaign.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <iterator>
#include <numeric>
#include <utility>

#include "adapters/registry.hpp"
#include "cases/case_keys.hpp"
#include "cases/flow.hpp"
#include "cases/time_step.hpp"
#include "results/run.hpp"
#include "studies/core/engine_running.hpp"
#include "studies/core/study.hpp"
#include "studies/flow/endpoint_values.hpp"
#include "studies/flow/frame.hpp"
#include "studies/flow/run.hpp"
#include "support/bad_input.hpp"
#include "support/files.hpp"
#include "support/interrupt.hpp"
#include "support/numbers.hpp"
#include "support/task_pool.hpp"

namespace crossgrain::inline studies {

namespace {

void requireStable(const Case& setup, double dt, std::optional<LightestPair> lightest = {}) {
  const char* const key = setup.run.dt ? "run.dt" : "run.steps_per_contact";
  if (const std::string why = unstableStepFault(setup, dt, key, lightest); !why.empty())
    throw BadInput(fmt::format("{}: {}", whereSaid(setup, key), why));
}

double stepOf(const Case& setup) {
  if (!setup.run.dt && packingFile(setup))  // whose masses are not known yet
    throw BadInput(setup.file.string() + ": a packing file needs [run] dt, the time step in s");
  const double dt = timeStep(setup);
  requireStable(setup, dt);
  return dt;
}

/// A step that is too large ends a run in any way, and no engine names it.
std::string stepHint(const Case& setup, double dt) {
  const std::string why = riskyStepFault(setup, dt);
  return why.empty() ? why : "; " + why;
}

}  // namespace

Campaign::Campaign(const Case& setup, const RunCommand& command, std::vector<EngineEntry> engines,
                   RunStore& store)
    : setup_(setup),
      command_(command),
      dt_(stepOf(setup)),
      store_(store),
      progress_(command.quiet) {
  for (EngineEntry& entry : engines) engines_.push_back({std::move(entry)});
}

void Campaign::requireAble(std::size_t fewest) const {
  std::size_t able = 0;
  std::vector<std::string> refusals, lacks;
  bool mayDiffer = true;
  for (const CampaignEngine& own : engines_) {
    if (!own.entry.mirrors.empty() && !isNamed(command_.engines, own.entry)) continue;
    able += own.refusal.empty() ? 1 : 0;
    if (own.refusal.empty()) continue;
    refusals.push_back(own.refusal);
    mayDiffer &= !own.lacks.empty();
    lacks.insert(lacks.end(), own.lacks.begin(), own.lacks.end());
  }
  if (able >= fewest || refusals.empty()) return;
  if (mayDiffer && refusals.size() > 1) {
    lacks.insert(lacks.end(), setup_.run.mayDiffer.begin(), setup_.run.mayDiffer.end());
    refusals.push_back(fmt::format("all of them run it with [run] may_differ = [\"{}\"]",
                                   fmt::join(briefly(lacks), "\", \"")));
  }
  throw AllRefused(std::move(refusals));
}

void Campaign::forEachEngine(const std::function<void(CampaignEngine&)>& work, std::size_t fewest) {
  struct Ending {
    std::exception_ptr thrown;  ///< error that the user is to resolve
    std::string failure;        ///< of it, or of an engine named that refuses
  };
  std::vector<Ending> endings(engines_.size());
  // A mirror asks what its peer can do: the peer's worker waits by then, and no other is started.
  std::vector<Task> ofPeers, ofMirrors;
  for (std::size_t e = 0; e < engines_.size(); ++e) {
    std::vector<Task>& tasks = engines_[e].entry.mirrors.empty() ? ofPeers : ofMirrors;
    tasks.push_back({1.0, [this, e, &endings, &work] {
                       throwIfInterrupted();
                       CampaignEngine& own = engines_[e];
                       if (!own.refusal.empty()) return;
                       try {
                         work(own);
                       } catch (const UnsupportedScene& refusal) {
                         own.refusal = refusal.what();
                         if (const auto* const some =
                                 dynamic_cast<const UnlistedDifferences*>(&refusal))
                           own.lacks = some->names;
                         if (isNamed(command_.engines, own.entry)) endings[e].failure = own.refusal;
                       } catch (const EngineFailure& failure) {
                         endings[e].failure = failure.what();  // its runs will tell, one by one
                       } catch (const BadInput&) {
                         endings[e].thrown = std::current_exception();
                       }
                     }});
  }
  runTasks(ofPeers, command_.jobs);
  runTasks(ofMirrors, command_.jobs);
  for (const Ending& ending : endings)
    if (ending.thrown) std::rethrow_exception(ending.thrown);
  requireAble(fewest);
  for (const Ending& ending : endings)
    if (!ending.failure.empty()) progress_.say(ending.failure);
  std::ranges::stable_partition(engines_,
                                [](const CampaignEngine& own) { return own.refusal.empty(); });
}

void Campaign::askEngines(std::size_t fewest) {
  const bool enginesRun = runsEngines();
  forEachEngine(
      [&](CampaignEngine& own) {
        if (own.entry.ofFiles()) {
          own.version = "files" + (own.entry.format.empty() ? "" : ", " + own.entry.format);
          own.copies = dropCopies(own.entry, setup_);
          for (const std::string& copy : own.copies) progress_.say(own.entry.name + ": " + copy);
          own.first = openRun(runOf(own.entry, 0), setup_, own.entry.name);
          own.radii = own.first->radius;
          // Says what is wrong with a file before engines run for hours.
          for (std::size_t run = 1; enginesRun && run < own.entry.files.size(); ++run)
            openRun(runOf(own.entry, run), setup_, own.entry.name);
          return;
        }
        const auto engine =
            startEngine(own.entry, store_.scratch("ask-" + own.entry.name), setup_.run.timeout);
        const Capabilities can = engine->capabilities();
        own.version = can.version;
        inDimensionOf(setup_, [&]<int D>() {
          checkSuitable(*engine, own.entry, setup_, unplacedScene<D>(setup_, dt_));
        });
        if (command_.dryRun) own.can = can;
      },
      fewest);
}

bool Campaign::hasFiles() const {
  return std::ranges::any_of(engines(), &EngineEntry::ofFiles);
}

bool Campaign::runsEngines() const {
  return std::ranges::any_of(engines_, [](const CampaignEngine& own) {
    return !own.entry.ofFiles() && own.refusal.empty();
  });
}

int Campaign::runsOf(std::size_t engine) const {
  const EngineEntry& entry = engines_[engine].entry;
  return static_cast<int>(entry.ofFiles() ? entry.files.size() : packings_.size());
}

void Campaign::preparePackings(int count) {
  if (!runsEngines()) {
    store_.begin();
    return;
  }
  const std::size_t before = packings_.size();
  packings_.resize(std::max(before, static_cast<std::size_t>(count)));
  std::vector<int> missing;  // also those that lookForPackings() left without disks
  for (int k = 0; k < count; ++k)
    if (const Packing& own = packings_[static_cast<std::size_t>(k)];
        own.disks.size() + own.spheres.size() == 0)
      missing.push_back(k);
  if (missing.empty()) return;
  std::vector<std::string> failures(packings_.size());
  std::vector<double> seconds(packings_.size());
  progress_.begin("preparing packings", std::vector<double>(missing.size(), 1.0));
  std::vector<Task> tasks;
  for (std::size_t place = 0; place < missing.size(); ++place) {
    tasks.push_back(
        {1.0, [this, k = missing[place], place, &failures, &seconds] {
           const auto began = std::chrono::steady_clock::now();
           const auto at = static_cast<std::size_t>(k);
           const std::string label = fmt::format("packing {}", k);
           try {
             const auto engine = engineRegistry().front().make();
             packings_[at] = flowPacking(setup_, k, dt_, *engine, [&](double fraction) {
               throwIfInterrupted();
               progress_.update(place, label, fraction);
             });
             const Packing& packing = packings_[at];
             if (packing.fromCache)
               progress_.keep(1, "packing");
             else
               seconds[at] =
                   std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
             std::string line;  // only of one that was prepared, which assemblies and files are not
             if (!packing.fromCache && cellOf(setup_) && !packingFile(setup_))
               line = label + ": prepared";
             if (!packing.anew.empty()) line += " anew: " + packing.anew;
             if (!packing.notCached.empty())
               line += ", not kept for next time: " + packing.notCached;
             progress_.finish(place, line);
           } catch (const Interrupted&) {
             throw;
           } catch (const std::exception& error) {
             const Couette* const cell = cellOf(setup_);
             failures[at] =
                 error.what() + stepHint(setup_, cell ? cell->filling.dt.value_or(dt_) : dt_);
           }
         }});
  }
  runTasks(tasks, command_.jobs);
  for (const std::string& failure : failures)
    if (!failure.empty()) throw BadInput(failure);
  std::ranges::copy_if(seconds, std::back_inserter(preparedIn_), [](double s) { return s > 0.0; });
  if (packingFile(setup_))  // its disks may be lighter than the case says
    for (const Packing& packing : packings_)
      requireStable(setup_, dt_, lightestPair(packing.disks, true));
  if (before > 0) return;
  store_.begin();
  printNotes();
}

void Campaign::timeEngine(CampaignEngine& own, const Case& setup) {
  const auto engine =
      startEngine(own.entry, store_.scratch("time-" + own.entry.name), setup.run.timeout);
  own.effective = inDimensionOf(setup, [&]<int D>() {
    return loadScene(*engine, own.entry, setup, flowScene<D>(setup, packings_.front(), dt_));
  });
  own.can = engine->capabilities();
  const double dt = own.effective->dt;
  own.predicted = briefSteps(*engine, dt).wall * flowDuration(setup) / dt;
}

void Campaign::timeEngines() {
  if (!runsEngines()) return;
  forEachEngine([&](CampaignEngine& own) {
    if (!own.entry.ofFiles()) timeEngine(own, setup_);
  });
  reportNonReusableWorkers(engines(), progress_);
}

std::size_t Campaign::inHouse() {
  const EngineEntry& entry = engineRegistry().front();
  for (std::size_t e = 0; e < engines_.size(); ++e)
    if (engines_[e].entry.name == entry.name && engines_[e].can) return e;
  CampaignEngine own{entry};
  timeEngine(own, setup_);
  own.version = own.can->version;
  engines_.push_back(std::move(own));
  return engines_.size() - 1;
}

double Campaign::predictedSeconds(std::size_t engine, const Case& setup) {
  preparePackings(1);
  CampaignEngine own{engines_[engine].entry};
  timeEngine(own, setup);
  return own.predicted;
}

CaseKeys Campaign::keyOf(std::size_t engine, int packing, const std::string& part) const {
  const EngineEntry& entry = engines_[engine].entry;
  CaseKeys key = runKey(setup_, entry.name, engines_[engine].version);
  const auto k = static_cast<std::size_t>(packing);
  if (entry.ofFiles())
    key["files"] = fingerprintOf(entry, k);
  else
    key["packing"] =
        k < packings_.size() ? packings_[k].hash : expectedPacking(setup_, packing, dt_).hash;
  if (!part.empty()) key["part"] = part;
  return key;
}

namespace {

/// Keys that make a variant another run than the case's.
const std::string& partOf(const Variant& variant) {
  return variant.without.empty() ? variant.changed : variant.without;
}

/// "grain packing 0", "grain without friction packing 0"
std::string labelOf(const EngineEntry& entry, const Variant& variant, int packing) {
  return fmt::format("{}{}{} packing {}", entry.name,
                     variant.without.empty() ? "" : " without " + variant.without,
                     variant.changed.empty() ? "" : " with " + variant.changed, packing);
}

std::string runName(const EngineEntry& entry, const Variant& variant, int packing) {
  return fmt::format("{}{}{}-p{}", entry.name,
                     variant.without.empty() ? "" : "-without-" + variant.without,
                     variant.changed.empty() ? "" : "-with-" + variant.changed, packing);
}

}  // namespace

FlowRun Campaign::runOfFiles(const CampaignEngine& own, int run,
                             const std::function<void(double)>& progress) const {
  const EngineEntry& entry = own.entry;
  const SnapshotRun files = runOf(entry, static_cast<std::size_t>(run));
  auto opened = run == 0 ? std::exchange(own.first, std::nullopt) : std::nullopt;
  if (!opened) opened = openRun(files, setup_, entry.name);
  AveragedRun averaged = opened->average(progress);
  averaged.run.endpointErrors = endpointErrors(setup_, *averaged.averages, averaged.run);
  averaged.run.engine = entry.name;
  averaged.run.packing = run;
  return std::move(averaged.run);
}

CachedTask<FlowRun>::Outcome Campaign::runOne(const Variant& variant, int packing,
                                              const std::function<void(double)>& progress) const {
  const EngineEntry& entry = engines_[variant.engine].entry;
  if (entry.ofFiles())  // what is wrong with a file is the user's to mend
    return {runOfFiles(engines_[variant.engine], packing, progress), true, "averaged"};
  const std::string name = runName(entry, variant, packing);
  FlowRun run;
  run.engine = entry.name;
  run.packing = packing;
  try {
    const FlowTask task{variant.setup,
                        entry,
                        packing,
                        &packings_[static_cast<std::size_t>(packing)],
                        dt_,
                        store_.scratch(name),
                        store_.snapshots(name),
                        store_.unfinished(name),
                        Json(keyOf(variant.engine, packing, partOf(variant))).dump(),
                        variant.engine == 0 && !cellOf(setup_)};
    run = inDimensionOf(setup_, [&]<int D>() { return runFlow<D>(task, progress); });
    run.without = variant.without;
    return {run, true, fmt::format("{:.1f} s", run.stats->wallSeconds)};
  } catch (const Interrupted&) {
    throw;
  } catch (const OutputError&) {
    throw;  // nothing more can be kept
  } catch (const std::exception& error) {
    run.without = variant.without;
    run.status = Status::failed;
    const std::string why = error.what() + stepHint(*variant.setup, dt_);
    run.reason = fmt::format("packing {}: {}", packing, why);
    return {run, false, "failed: " + why};
  }
}

std::vector<Variant> Campaign::wholeCase() const {
  std::vector<Variant> variants;
  for (std::size_t e = 0; e < engines_.size(); ++e)
    if (engines_[e].refusal.empty()) variants.push_back({e, "", &setup_});
  return variants;
}

void Campaign::run(const std::vector<Variant>& variants) {
  const PlannedRuns all{variants, {0, static_cast<int>(packings_.size())}};
  runs_ = runOrLoad(tasksOf(all), store_, progress_, "running engines", command_.jobs);
}

RunsById Campaign::runSome(const std::vector<PlannedRuns>& lists, const std::string& stage) {
  std::vector<CachedTask<FlowRun>> tasks;
  for (const PlannedRuns& list : lists) std::ranges::move(tasksOf(list), std::back_inserter(tasks));
  return byId(tasks, runOrLoad(tasks, store_, progress_, stage, command_.jobs));
}

double Campaign::elapsed() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - started_).count();
}

double Campaign::secondsOfPreparing(int count) const {
  if (preparedIn_.empty()) return 0.0;
  int missing = 0;
  for (int k = static_cast<int>(packings_.size()); k < count; ++k)
    missing += !expectedPacking(setup_, k, dt_).there;
  return missing * std::accumulate(preparedIn_.begin(), preparedIn_.end(), 0.0) /
         static_cast<double>(preparedIn_.size());
}

double Campaign::secondsOf(const std::vector<PlannedRuns>& lists) const {
  double all = 0.0, longest = 0.0;
  for (const PlannedRuns& list : lists)
    for (const auto& task : tasksOf(list)) {
      if (store_.find(task.name, task.key)) continue;
      all += task.weight;
      longest = std::max(longest, task.weight);
    }
  return std::max(all / std::max(command_.jobs, 1), longest);
}

std::size_t Campaign::missingRuns(const PlannedRuns& list) const {
  return static_cast<std::size_t>(std::ranges::count_if(
      tasksOf(list), [&](const auto& task) { return !store_.find(task.name, task.key); }));
}

void Campaign::add(RunsById runs) {
  for (auto& [id, run] : runs) runs_.push_back(std::move(run));
  const auto place = [this](const FlowRun& run) {
    const auto own = std::ranges::find(engines_, run.engine,
                                       [](const CampaignEngine& one) { return one.entry.name; });
    return std::pair(own - engines_.begin(), run.packing);
  };
  std::ranges::stable_sort(runs_, {}, place);
}

std::vector<CachedTask<FlowRun>> Campaign::tasksOf(const PlannedRuns& list) const {
  std::vector<CachedTask<FlowRun>> tasks;
  for (const Variant& variant : list.variants) {
    const CampaignEngine& own = engines_[variant.engine];
    const int to = own.entry.ofFiles() ? runsOf(variant.engine) : list.packings.to;
    for (int k = list.packings.from; k < to; ++k)
      tasks.push_back({runName(own.entry, variant, k), labelOf(own.entry, variant, k),
                       keyOf(variant.engine, k, partOf(variant)), own.predicted,
                       [this, &variant, k](const std::function<void(double)>& progress) {
                         return runOne(variant, k, progress);
                       },
                       std::nullopt, RunId{own.entry.name, partOf(variant), k}});
  }
  return tasks;
}

void Campaign::lookForPackings(int count) {
  if (!runsEngines()) return;
  const std::size_t there = packings_.size();
  packings_.resize(std::max(there, static_cast<std::size_t>(count)));
  for (std::size_t k = there; k < packings_.size(); ++k) {
    const ExpectedPacking expected = expectedPacking(setup_, static_cast<int>(k), dt_);
    packings_[k].hash = expected.hash;
    packings_[k].fromCache = expected.there;
  }
}

void Campaign::lookForPackings() {
  if (runsEngines()) checkPackings(setup_, packingCount(), dt_);
  if (packingFile(setup_))
    requireStable(setup_, dt_, lightestPair(readPacking(*packingFile(setup_), setup_).disks, true));
  lookForPackings(packingCount());
}

std::string Campaign::planHead() const {
  return fmt::format("{}: {}, {} of them prepared already\n", setup_.name,
                     counted(packings_.size(), "packing"),
                     std::ranges::count_if(packings_, &Packing::fromCache));
}

std::vector<PlannedWork> Campaign::plan(const std::vector<Variant>& variants) const {
  std::vector<PlannedWork> works;
  for (const Variant& variant : variants) {
    const std::string& name = engines_[variant.engine].entry.name;
    PlannedWork work{name + (variant.without.empty() ? "" : " without " + variant.without), "runs"};
    const PlannedRuns list{{variant}, {0, static_cast<int>(packings_.size())}};
    for (const auto& task : tasksOf(list)) count(work, store_.find(task.name, task.key));
    works.push_back(work);
  }
  for (const CampaignEngine& own : engines_)
    if (!own.refusal.empty()) works.push_back({own.entry.name, "runs", own.refusal});
  return works;
}

std::vector<EngineRow> Campaign::engineRows() const {
  std::vector<EngineRow> rows;
  for (const CampaignEngine& own : engines_) {
    EngineRow row{own.entry.name,    own.entry.summary, own.version,
                  own.entry.mirrors, Status::finished,  own.refusal};
    if (!own.refusal.empty()) row.status = Status::refused;
    for (const FlowRun& run : runs_)
      if (run.engine == row.name && run.status == Status::failed && row.reason.empty()) {
        row.status = Status::failed;
        row.reason = run.reason;
      }
    rows.push_back(std::move(row));
  }
  return rows;
}

namespace {

/// Of the first packing; without any, of a run that is a file [m].
const std::vector<double>& radiiOf(const std::vector<Packing>& packings,
                                   const std::vector<double>& ofFile) {
  if (packings.empty()) return ofFile;
  const Packing& first = packings.front();
  return first.spheres.size() > 0 ? first.spheres.radius : first.disks.radius;
}

}  // namespace

FlowStudy Campaign::study(std::string_view kind) const {
  FlowStudy study;
  static_cast<FlowFrame&>(study) =
      flowFrame(kind, setup_, command_.commandLine, radiiOf(packings_, engines_.front().radii));
  study.engines = engineRows();
  for (std::size_t k = 0; k < packings_.size(); ++k)
    study.packings.push_back(
        {k, setup_.preparation.seed, packings_[k].hash, packings_[k].fromCache});
  study.runs = runs_;
  for (const CampaignEngine& own : engines_)
    for (const std::string& copy : own.copies) study.notes.push_back(own.entry.name + ": " + copy);
  const bool all = std::ranges::find(command_.engines, "all") != command_.engines.end();
  for (const EngineEntry& entry : engineRegistry())
    if (all && entry.missing && !entry.missing().empty())
      study.notes.push_back(
          fmt::format("{} was left out: it is not installed ({}).", entry.name, entry.missing()));
  if (const EngineRow& first = study.engines.front(); !all && !command_.engines.empty() &&
                                                      first.name != command_.engines.front() &&
                                                      first.mirrors.empty())
    study.notes.push_back(
        fmt::format("{} was named first and cannot run the case: the reference is {}.",
                    command_.engines.front(), first.name));
  study.elapsed = elapsed();
  return study;
}

}  // namespace crossgrain::inline studies

#include "studies/scale/scale.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>

#include "cases/case_keys.hpp"
#include "cases/couette.hpp"
#include "cases/preparation.hpp"
#include "cases/scaled_cell.hpp"
#include "cases/time_step.hpp"
#include "results/scale.hpp"
#include "results/schema.hpp"
#include "studies/core/engine_access.hpp"
#include "studies/core/executor.hpp"
#include "studies/core/study.hpp"
#include "studies/core/study_cases.hpp"
#include "studies/scale/timing.hpp"
#include "support/bad_input.hpp"
#include "support/interrupt.hpp"

namespace crossgrain::inline studies {

namespace {

/// Settings that share a step among workers, and so have their name.
constexpr const char* sharingSettings[] = {"threads", "ranks"};

/// "threads", "ranks"; empty: the engine has neither.
std::string sharingOf(const Capabilities& can) {
  for (const char* name : sharingSettings)
    if (std::ranges::find(can.settings, name, &SettingSpec::name) != can.settings.end())
      return name;
  return {};
}

ScaleCell scaleCell(const Case& scaled) {
  const Cell& cell = couetteIn(scaled).cell;
  const int walls = wallDiskCount(cell, cell.innerRadius) + wallDiskCount(cell, cell.outerRadius);
  return {static_cast<std::size_t>(couetteIn(scaled).particles.small +
                                   couetteIn(scaled).particles.large),
          static_cast<std::size_t>(walls), cell.outerRadius, volumeFraction(scaled), ""};
}

/// An engine whose steps are timed.
struct TimedEngine {
  EngineEntry entry;
  std::string version;   ///< empty: it did not answer
  std::string failure;   ///< why it did not; its points fail, the others are timed
  ScaleSharing sharing;  ///< how its steps are shared
};

/// @throws BadInput for a setting that it does not have
TimedEngine asked(const EngineEntry& entry, const StudyWork& work) {
  throwIfInterrupted();
  const Case& setup = work.setup();
  TimedEngine own{entry, "", "", {entry.name, {}}};
  try {
    const auto engine = startNew(entry, work.store.scratch("ask-" + entry.name), setup.run.timeout);
    const Capabilities can = engine->capabilities();
    settingsFor(setup, entry.name, can);
    own.version = can.version;
    own.sharing.workers = sharingOf(can);
  } catch (const EngineFailure& failure) {
    own.failure = failure.what();
  }
  return own;
}

std::string outcomeOf(const ScalePoint& point) {
  if (point.status != Status::finished)
    return fmt::format("{}: {}", nameOf(point.status, engineStatusNames), point.reason);
  return fmt::format("{:.3g} µs a step", 1e6 * std::ranges::min(point.seconds));
}

/// The points of the plan and their tasks, of one size all engines in turn.
class ScaleTimings {
 public:
  ScaleTimings(const StudyWork& work, ScalePlan plan)
      : work_(work), plan_(std::move(plan)), progress_(work.line.run.quiet) {
    const std::vector<EngineEntry> entries = selectEngines(work.line.run.engines);
    checkEngineSections(work.setup());
    std::vector<bool> shares;
    for (const EngineEntry& entry : entries) {
      engines_.push_back(asked(entry, work));
      shares.push_back(!engines_.back().sharing.workers.empty());
    }
    for (const PlannedTiming& planned : plannedPoints(plan_, shares)) add(planned);
  }

  /// What run() would do.
  std::string describePlan() const {
    std::vector<std::size_t> sizes;
    for (const ScaleCell& cell : cells_) sizes.push_back(cell.disks);
    return describeDryRun(fmt::format("scale: cells of {} disks\n", fmt::join(sizes, ", ")),
                          plannedWork(tasks_, "timings", work_.store), work_.store, work_.line.run);
  }

  void run() {
    work_.store.begin();
    for (std::size_t k = 0; k < points_.size(); ++k)
      if (auto before = work_.store.findAs<ScalePoint>(tasks_[k].name, tasks_[k].key)) {
        points_[k] = *std::move(before);
        loaded_[k] = true;
      }
    std::vector<double> weights;
    for (const auto& task : tasks_) weights.push_back(task.weight);
    progress_.begin("timing steps", weights);
    for (std::size_t k = 0; k < points_.size(); ++k)
      if (loaded_[k])
        progress_.finish(k, tasks_[k].label + ": finished in an earlier run");
      else if (points_[k].status == Status::failed)
        finish(k);
    for (std::size_t from = 0, to = 0; from < points_.size(); from = to) {
      while (to < points_.size() && points_[to].disks == points_[from].disks) ++to;
      measureSize(from, to);
    }
  }

  ScaleResults results() const {
    ScaleResults results;
    results.head = headOf(kindScale, work_.setup(), work_.line.run.commandLine);
    results.head.setup.name = "scaled cell";
    results.repetitions = static_cast<std::size_t>(plan_.repetitions);
    for (const TimedEngine& own : engines_) {
      results.engines.push_back(rowOf(own));
      results.sharing.push_back(own.sharing);
    }
    results.cells = cells_;
    results.points = points_;
    return results;
  }

 private:
  void add(const PlannedTiming& planned) {
    const TimedEngine& own = engines_[planned.engine];
    ScalePoint point;
    point.engine = own.entry.name;
    point.disks = planned.disks;
    point.workers = planned.workers;
    point.steps = plan_.steps.value_or(stepsFor(planned.disks));
    if (!own.failure.empty()) {
      point.status = Status::failed;
      point.reason = own.failure;
    }
    CachedTask<ScalePoint> task;
    task.of = {point.engine};
    task.name = fmt::format("{}-{}-disks-{}", point.engine, point.disks, point.workers);
    task.label = fmt::format("{}, {} disks, {}", point.engine, point.disks,
                             describeWorkers(own.sharing, point.workers));
    task.key = runKey(work_.setup(), point.engine, own.version);
    task.key["steps"] = fmt::format("{}", point.steps);
    task.key["repetitions"] = fmt::format("{}", plan_.repetitions);
    task.weight = static_cast<double>(point.disks) * static_cast<double>(point.steps) + 1e6;
    if (points_.empty() || points_.back().disks != point.disks)
      cells_.push_back(scaleCell(scaledCase(point.disks, work_.line.overrides)));
    tasks_.push_back(std::move(task));
    points_.push_back(std::move(point));
    loaded_.push_back(false);
  }

  bool isOpen(std::size_t k) const { return !loaded_[k] && points_[k].status == Status::finished; }

  void finish(std::size_t k) {
    progress_.finish(k, tasks_[k].label + ": " + outcomeOf(points_[k]));
  }

  /// Points from … to, which have one size.
  void measureSize(std::size_t from, std::size_t to) {
    std::vector<std::size_t> open;
    for (std::size_t k = from; k < to; ++k) {
      if (!isOpen(k)) continue;
      if (const auto lack = lackOfMemory(points_, k)) {
        points_[k].status = Status::refused;
        points_[k].reason = *lack;
        finish(k);
      } else {
        open.push_back(k);
      }
    }
    if (open.empty()) return;
    const Case scaled = scaledCase(points_[from].disks, work_.line.overrides);
    const Scene scene = sceneOf(scaled, open.front());
    for (int repetition = 0; repetition < plan_.repetitions; ++repetition)
      for (const std::size_t k : open)
        if (isOpen(k)) timed(k, scaled, scene, repetition);
    for (const std::size_t k : open) {
      if (isOpen(k)) work_.store.keep(tasks_[k].name, tasks_[k].key, jsonOf(points_[k]));
      finish(k);
    }
  }

  Scene sceneOf(const Case& scaled, std::size_t shownAs) {
    const std::string label = fmt::format("preparing {} disks", points_[shownAs].disks);
    const Packing packing = scaledPacking(scaled, packingCache(), [&](double fraction) {
      throwIfInterrupted();
      progress_.update(shownAs, fmt::format("{}, {:.0f} %", label, 100.0 * fraction), 0.0);
    });
    if (!packing.anew.empty()) progress_.say("the packing is made anew: " + packing.anew);
    if (!packing.notCached.empty())
      progress_.say("the packing cannot be kept for next time: " + packing.notCached);
    std::ranges::find(cells_, points_[shownAs].disks, &ScaleCell::disks)->packing = packing.hash;
    return couetteScene(scaled, packing, timeStep(scaled));
  }

  /// @throws Interrupted, BadInput
  void timed(std::size_t k, const Case& scaled, const Scene& scene, int repetition) {
    ScalePoint& point = points_[k];
    throwIfInterrupted();
    progress_.update(k, tasks_[k].label, static_cast<double>(repetition) / plan_.repetitions);
    if (point.measured.empty()) point.measured = timeStamp();
    try {
      const TimedEngine& own = *std::ranges::find(
          engines_, point.engine, [](const TimedEngine& one) { return one.entry.name; });
      timeSteps(point, own.entry, own.sharing.workers, scaled, scene,
                work_.store.scratch(tasks_[k].name));
    } catch (const UnsupportedScene& refusal) {
      point.status = Status::refused;
      point.reason = refusal.what();
    } catch (const EngineFailure& failure) {
      point.status = Status::failed;
      point.reason = failure.what();
    }
  }

  /// Failed where any of its points did, refused where all were; with the first reason.
  EngineRow rowOf(const TimedEngine& own) const {
    EngineRow row = engineRow(own.entry, own.version);
    row.status = Status::refused;
    for (const ScalePoint& point : points_) {
      if (point.engine != row.name) continue;
      if (point.status == Status::failed) {
        row.status = Status::failed;
        row.reason = point.reason;
        return row;
      }
      if (point.status == Status::finished) row.status = Status::finished;
      if (row.reason.empty()) row.reason = point.reason;
    }
    if (row.status == Status::finished) row.reason.clear();
    return row;
  }

  const StudyWork& work_;
  ScalePlan plan_;
  Progress progress_;
  std::vector<TimedEngine> engines_;
  std::vector<ScalePoint> points_;
  std::vector<CachedTask<ScalePoint>> tasks_;  ///< of points_, in its order
  std::vector<bool> loaded_;                   ///< likewise: finished by an earlier command
  std::vector<ScaleCell> cells_;
};

/// @throws BadInput for a change of the case that is none of engines' settings or of [run]
Case scaleCase(const std::vector<std::string>& overrides) {
  for (const std::string& each : overrides) {
    const std::string key = each.substr(0, each.find('='));
    if (!key.starts_with("engines.") && !key.starts_with("run."))
      throw BadInput(fmt::format(
          "--set {}: scale has a cell of its own; it takes engines.NAME.… and run.… alone", each));
    for (const char* sharing : sharingSettings)
      if (key.starts_with("engines.") && key.ends_with(std::string(".") + sharing))
        throw BadInput(fmt::format("--set {}: --threads says how many there are", each));
  }
  return scaledCase(leastScaled, overrides);
}

std::size_t soleNumber(const std::string& option, const std::string& text, std::size_t most) {
  const auto numbers = wholeNumbers(option, text, 1, most);
  if (numbers.size() > 1)
    throw BadInput(fmt::format("{} '{}': one number is wanted", option, text));
  return numbers.front();
}

/// @throws BadInput for an option that is none
ScalePlan planOf(const ScaleOptions& own, bool quick) {
  constexpr std::size_t mostWorkers = 1024, mostSteps = 100'000'000, mostRepetitions = 1000;
  ScalePlan plan;
  plan.disks =
      wholeNumbers("--disks", own.disks.value_or(quick ? "1000,2000" : "1000,10000,100000,1000000"),
                   leastScaled, mostScaled);
  plan.workers = usualWorkers(std::thread::hardware_concurrency());
  if (own.threads) {
    plan.workers.clear();
    for (const std::size_t count : wholeNumbers("--threads", *own.threads, 1, mostWorkers))
      plan.workers.push_back(static_cast<int>(count));
  }
  if (quick) {
    plan.steps = 200;
    plan.repetitions = 2;
  }
  if (own.steps) plan.steps = soleNumber("--steps", *own.steps, mostSteps);
  if (own.repetitions)
    plan.repetitions =
        static_cast<int>(soleNumber("--repetitions", *own.repetitions, mostRepetitions));
  return plan;
}

std::vector<Case> caseToScale(const CommandLine& line, ScaleOptions& own) {
  planOf(own, line.quick);  // throws for an option that is none
  const Case cell = scaleCase(line.overrides);
  for (const std::string& key : keysWithoutUse(cell, "scale"))
    if (const std::string where = whereSaid(cell, key); where.starts_with("--set "))
      throw BadInput(fmt::format("{}: scale does not use {}", where, key));
  return {cell};
}

ScaleResults scale(const StudyWork& work, const ScaleOptions& own) {
  const auto started = std::chrono::steady_clock::now();
  ScaleTimings timings(work, planOf(own, work.line.quick));
  timings.run();
  ScaleResults results = timings.results();
  results.elapsed =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  return results;
}

Outcome outcomeOfScale(const ScaleResults& results, const CommandLine&, const ScaleOptions&) {
  Outcome outcome;
  for (const ScalePoint& point : results.points)
    if (point.status == Status::failed) outcome.failures.push_back(point.reason);
  if (!outcome.failures.empty())
    outcome.status = exitEngineFailed;
  else if (std::ranges::find(results.points, Status::finished, &ScalePoint::status) ==
           results.points.end())
    return {exitFailed, {"nothing was timed: " + results.points.front().reason}};
  return outcome;
}

}  // namespace

const Study<ScaleOptions, ScaleResults> scaleStudy = {
    "scale",
    {.input = SharedOptions::Input::none, .inHouse = true, .jobs = false},
    Keeps::oneCase,
    [](ScaleOptions& own, CommandLine& line) {
      return std::vector<StudyOption>{
          {"--disks",
           "sizes of the cell (default: 1000,10000,100000,1000000); 10^7 take about an hour to "
           "prepare, once",
           &own.disks, "N,N"},
          {"--threads",
           "threads, or ranks of an engine that has them, that share a step; one is always timed "
           "(default: 1, 2, 4, … "
           "up to the cores)",
           &own.threads, "P,P"},
          {"--steps", "timed in each repetition (default: 2*10^7 over disks, at least 50)",
           &own.steps, "N"},
          {"--repetitions", "of each timing (default: 3)", &own.repetitions, "N"},
          {"--quick", "two small cells and few steps, to see that it works", &line.quick}};
    },
    caseToScale,
    [](const StudyWork& work, const ScaleOptions& own) {
      return ScaleTimings(work, planOf(own, work.line.quick)).describePlan();
    },
    scale,
    outcomeOfScale};

}  // namespace crossgrain::inline studies

#include "runs/scale/scale.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "cases/couette.hpp"
#include "cases/preparation.hpp"
#include "cases/scaled_cell.hpp"
#include "cases/time_step.hpp"
#include "results/scale_fields.hpp"
#include "results/schema.hpp"
#include "runs/common/dry_run.hpp"
#include "runs/common/engine_access.hpp"
#include "runs/common/head.hpp"
#include "runs/common/progress.hpp"
#include "runs/scale/timing.hpp"
#include "support/bad_input.hpp"
#include "support/interrupt.hpp"

namespace crossgrain::inline runs {

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

ScaleCell cellOf(const Case& scaled) {
  const Cell& cell = scaled.cell;
  const int walls = wallDiskCount(cell, cell.innerRadius) + wallDiskCount(cell, cell.outerRadius);
  return {static_cast<std::size_t>(scaled.particles.small + scaled.particles.large),
          static_cast<std::size_t>(walls), cell.outerRadius, volumeFraction(scaled), ""};
}

class ScaleStudy {
 public:
  ScaleStudy(const ScalePlan& plan, const std::vector<std::string>& overrides,
             const RunCommand& command, RunStore& store)
      : plan_(plan),
        overrides_(overrides),
        command_(command),
        store_(store),
        base_(scaleCase(overrides)),
        engines_(selectEngines(command.engines)),
        progress_(command.quiet) {
    checkEngineSections(base_);
  }

  void askEngines() {
    std::vector<bool> shares;
    for (const EngineEntry& entry : engines_) {
      throwIfInterrupted();
      versions_.emplace_back();
      failures_.emplace_back();
      sharing_.push_back({entry.name, {}});
      try {
        const auto engine = startNew(entry, store_.scratch("ask-" + entry.name), base_.run.timeout);
        const Capabilities can = engine->capabilities();
        settingsFor(base_, entry.name, can);  // throws for one that it does not have
        versions_.back() = can.version;
        sharing_.back().workers = sharingOf(can);
      } catch (const EngineFailure& failure) {
        failures_.back() = failure.what();  // of its own points; the others are timed
      }
      shares.push_back(!sharing_.back().workers.empty());
    }
    for (const PlannedTiming& planned : plannedPoints(plan_, shares)) {
      ScalePoint point;
      point.engine = engines_[planned.engine].name;
      point.disks = planned.disks;
      point.workers = planned.workers;
      point.steps = plan_.steps.value_or(stepsFor(planned.disks));
      if (const std::string& why = failures_[planned.engine]; !why.empty()) {
        point.status = EngineStatus::failed;
        point.reason = why;
      }
      if (points_.empty() || points_.back().disks != point.disks)
        cells_.push_back(cellOf(scaledCase(point.disks, overrides_)));
      planned_.push_back(planned);
      points_.push_back(std::move(point));
    }
  }

  void run() {
    store_.begin();
    takeUp();
    std::vector<double> weights;
    for (const ScalePoint& point : points_)
      weights.push_back(static_cast<double>(point.disks) * static_cast<double>(point.steps) + 1e6);
    progress_.begin("timing steps", weights);
    for (std::size_t k = 0; k < points_.size(); ++k)
      if (taken_[k])
        progress_.finish(k, labelOf(k) + ": finished in an earlier run");
      else if (points_[k].status == EngineStatus::failed)
        progress_.finish(k, labelOf(k) + ": " + outcomeOf(points_[k]));
    for (std::size_t from = 0, to = 0; from < points_.size(); from = to) {
      while (to < points_.size() && points_[to].disks == points_[from].disks) ++to;
      measureSize(from, to);
    }
  }

  ScaleResults results() const {
    ScaleResults results;
    results.head = headOf(kindScale, base_, command_.commandLine);
    results.head.setup.name = "scaled cell";
    results.repetitions = static_cast<std::size_t>(plan_.repetitions);
    for (std::size_t e = 0; e < engines_.size(); ++e) results.engines.push_back(rowOf(e));
    results.sharing = sharing_;
    results.cells = cells_;
    results.points = points_;
    return results;
  }

  /// What run() would do.
  std::string planInWords() {
    std::vector<PlannedWork> works;
    for (const EngineEntry& entry : engines_) {
      PlannedWork work{entry.name, "timings"};
      for (std::size_t k = 0; k < points_.size(); ++k)
        if (points_[k].engine == entry.name) count(work, store_.find(nameOf(k), keyOf(k)));
      works.push_back(work);
    }
    std::vector<std::size_t> sizes;
    for (const ScaleCell& cell : cells_) sizes.push_back(cell.disks);
    return dryRunInWords(fmt::format("scale: cells of {} disks\n", fmt::join(sizes, ", ")), works,
                         store_, command_);
  }

 private:
  /// What an earlier command has timed.
  void takeUp() {
    taken_.assign(points_.size(), false);
    for (std::size_t k = 0; k < points_.size(); ++k)
      if (auto before = store_.findAs<ScalePoint>(nameOf(k), keyOf(k))) {
        points_[k] = *std::move(before);
        taken_[k] = true;
      }
  }

  std::string nameOf(std::size_t k) const {
    return fmt::format("{}-{}-disks-{}", points_[k].engine, points_[k].disks, points_[k].workers);
  }

  std::string labelOf(std::size_t k) const {
    const ScalePoint& point = points_[k];
    return fmt::format("{}, {} disks, {}", point.engine, point.disks,
                       workersInWords(sharing_[planned_[k].engine], point.workers));
  }

  CaseKeys keyOf(std::size_t k) const {
    CaseKeys key = runKey(base_, points_[k].engine, versions_[planned_[k].engine]);
    key["steps"] = fmt::format("{}", points_[k].steps);
    key["repetitions"] = fmt::format("{}", plan_.repetitions);
    return key;
  }

  /// Points from … to, which have one size.
  void measureSize(std::size_t from, std::size_t to) {
    for (std::size_t k = from; k < to; ++k)
      if (!taken_[k] && points_[k].status == EngineStatus::ran) refuseWithoutMemory(k);
    const auto isOpen = [&](std::size_t k) {
      return !taken_[k] && points_[k].status == EngineStatus::ran;
    };
    std::vector<std::size_t> open;
    for (std::size_t k = from; k < to; ++k)
      if (isOpen(k)) open.push_back(k);
    if (open.empty()) return;
    const Case scaled = scaledCase(points_[from].disks, overrides_);
    const Scene scene = sceneOf(scaled, open.front());
    for (int repetition = 0; repetition < plan_.repetitions; ++repetition)
      for (const std::size_t k : open)
        if (isOpen(k)) timed(k, scaled, scene, repetition);
    for (const std::size_t k : open) {
      if (isOpen(k)) store_.keep(nameOf(k), keyOf(k), jsonOf(points_[k]));
      progress_.finish(k, labelOf(k) + ": " + outcomeOf(points_[k]));
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
    progress_.update(k, labelOf(k), static_cast<double>(repetition) / plan_.repetitions);
    if (point.measured.empty()) point.measured = timeStamp();
    try {
      const std::size_t e = planned_[k].engine;
      timeSteps(point, engines_[e], sharing_[e].workers, scaled, scene, store_.scratch(nameOf(k)));
    } catch (const UnsupportedScene& refusal) {
      point.status = EngineStatus::refused;
      point.reason = refusal.what();
    } catch (const EngineFailure& failure) {
      point.status = EngineStatus::failed;
      point.reason = failure.what();
    }
  }

  void refuseWithoutMemory(std::size_t k) {
    const auto lack = lackOfMemory(points_, k);
    if (!lack) return;
    points_[k].status = EngineStatus::refused;
    points_[k].reason = *lack;
    progress_.finish(k, labelOf(k) + ": refused: " + *lack);
  }

  static std::string outcomeOf(const ScalePoint& point) {
    if (point.status != EngineStatus::ran)
      return fmt::format("{}: {}", results::nameOf(point.status), point.reason);
    return fmt::format("{:.3g} µs a step", 1e6 * std::ranges::min(point.seconds));
  }

  EngineRow rowOf(std::size_t e) const {
    EngineRow row{engines_[e].name,    engines_[e].summary,   versions_[e],
                  engines_[e].mirrors, EngineStatus::refused, ""};
    for (const ScalePoint& point : points_) {
      if (point.engine != row.name) continue;
      if (point.status == EngineStatus::failed) return failedRow(row, point);
      if (point.status == EngineStatus::ran) row.status = EngineStatus::ran;
      if (row.reason.empty()) row.reason = point.reason;
    }
    if (row.status == EngineStatus::ran) row.reason.clear();
    return row;
  }

  static EngineRow failedRow(EngineRow row, const ScalePoint& point) {
    row.status = EngineStatus::failed;
    row.reason = point.reason;
    return row;
  }

  const ScalePlan& plan_;
  const std::vector<std::string>& overrides_;
  const RunCommand& command_;
  RunStore& store_;
  Case base_;
  std::vector<EngineEntry> engines_;
  Progress progress_;
  std::vector<std::string> versions_;  ///< of the engines
  std::vector<std::string> failures_;  ///< likewise: why one did not even answer; empty: it did
  std::vector<ScaleSharing> sharing_;  ///< likewise
  std::vector<PlannedTiming> planned_;
  std::vector<ScalePoint> points_;  ///< of `planned_`, in its order
  std::vector<bool> taken_;         ///< up from an earlier command
  std::vector<ScaleCell> cells_;
};

}  // namespace

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

ScaleResults measureScale(const ScalePlan& plan, const std::vector<std::string>& overrides,
                          const RunCommand& command, RunStore& store) {
  const auto started = std::chrono::steady_clock::now();
  ScaleStudy study(plan, overrides, command, store);
  study.askEngines();
  study.run();
  ScaleResults results = study.results();
  results.elapsed =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  return results;
}

std::string scalePlan(const ScalePlan& plan, const std::vector<std::string>& overrides,
                      const RunCommand& command, RunStore& store) {
  ScaleStudy study(plan, overrides, command, store);
  study.askEngines();
  return study.planInWords();
}

}  // namespace crossgrain::inline runs

#include "runs/stability/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "adapters/worker/json.hpp"
#include "runs/common/advance.hpp"
#include "runs/common/picture.hpp"
#include "runs/common/records.hpp"
#include "runs/stability/recorder.hpp"
#include "runs/stability/step_limit_run.hpp"
#include "stability/measures.hpp"
#include "stability/verdict.hpp"
#include "support/bad_input.hpp"
#include "support/interrupt.hpp"

namespace crossgrain::inline runs {

using nlohmann::json;

namespace {

json rowOf(const StabilityTask& task) {
  const Stability& hard = *task.setup->stability;
  return {{"engine", task.entry.name},
          {"case", task.setup->name},
          {"variant", task.setup->variant},
          {"status", "finished"},
          {"verdict", "refused"},
          {"measure", hard.measure},
          {"value", nullptr},
          {"limit", hard.limit},
          {"degraded_limit", hard.degraded},
          {"unit", stabilityMeasure(hard.measure).unit},
          {"step", nullptr},
          {"time_s", nullptr},
          {"reason", ""},
          {"curve", {{"t_s", json::array()}, {"value", json::array()}}},
          {"picture", nullptr},
          {"realised", nullptr},
          {"stats", nullptr}};
}

void refuse(json& row, const std::string& reason) {
  row["status"] = row["verdict"] = "refused";
  row["reason"] = reason;
}

/// A figure that is one number.
void judgeNumber(json& row, const Stability& hard, double value) {
  const StabilityVerdict judged = stabilityVerdict(hard, {value});
  row["verdict"] = judged.verdict;
  row["value"] = judged.value;
}

void placeInTime(json& row, const Recording& run, std::size_t look) {
  const double time = run.snapshots[look].positionTime;
  row["time_s"] = time;
  row["step"] = std::llround(time / run.realised.dt);
}

/// Every few looks are enough for a plot.
void keepCurve(json& row, const Recording& run, const std::vector<double>& curve) {
  constexpr std::size_t most = 200;
  const std::size_t stride = std::max<std::size_t>(1, (curve.size() + most - 1) / most);
  for (std::size_t k = 0; k < curve.size(); ++k) {
    if (k % stride != 0 && k + 1 != curve.size()) continue;
    row["curve"]["t_s"].push_back(run.snapshots[k].positionTime);
    row["curve"]["value"].push_back(curve[k]);
  }
}

json pictureAt(const Recording& run, std::size_t look) {
  json picture = pictureOf(run.scene, run.snapshots[look], 0.0);
  picture["planes"] = json::array();
  for (const Plane& plane : planesAt(run.scene, run.snapshots[look].positionTime))
    picture["planes"].push_back(
        {plane.point.x(), plane.point.y(), plane.normal.x(), plane.normal.y()});
  return picture;
}

/// The engine did not get to the end.
void judgeFailure(json& row, const Recording& run) {
  row["status"] = "failed";
  row["verdict"] = "unstable";
  row["reason"] = "failed: " + run.failure;
  if (run.snapshots.empty()) return;
  placeInTime(row, run, run.snapshots.size() - 1);
  row["picture"] = pictureAt(run, run.snapshots.size() - 1);
}

void judgeCurve(json& row, const Stability& hard, const Recording& run,
                const std::vector<double>& curve) {
  if (curve.empty()) return refuse(row, "does not show what the measure takes");
  const StabilityVerdict judged = stabilityVerdict(hard, curve);
  row["verdict"] = judged.verdict;
  row["value"] = judged.value;
  keepCurve(row, run, curve);
  if (!judged.passed) return;
  placeInTime(row, run, *judged.passed);
  row["worst_time_s"] = run.snapshots[judged.worst].positionTime;
  row["picture"] = pictureAt(run, judged.worst);
}

/// What is common to all measures that look at a run.
void describe(json& row, const Recording& run, const Engine& engine) {
  if (!run.realised.engine.empty()) row["realised"] = toJson(run.realised);
  if (run.failure.empty()) row["stats"] = statsJson(engine.stats());
}

/// A run, and with copies_differ the original's before it.
void judgeRun(json& row, const StabilityTask& task, const HardScene& hard, Engine& engine,
              const std::function<void(double)>& progress) {
  const StabilityMeasure& measure = stabilityMeasure(task.setup->stability->measure);
  std::optional<Recording> original;
  HardScene originalScene;
  if (!measure.curve) {
    originalScene = hardScene(*task.original, *task.packing);
    original = record(engine, task.entry, originalScene, [&](double f) { progress(0.5 * f); });
    if (!original->failure.empty()) return judgeFailure(row, *original);
  }
  const Recording run =
      record(engine, task.entry, hard, [&](double f) { progress(original ? 0.5 + 0.5 * f : f); });
  describe(row, run, engine);
  if (!run.failure.empty()) return judgeFailure(row, run);
  judgeCurve(row, *task.setup->stability, run,
             original ? copiesDiffer(*original, run) : measure.curve(run));
}

/// Twice the same run, the second time in a new worker from a checkpoint at the middle.
void judgeRestart(json& row, const StabilityTask& task, const HardScene& hard, Engine& engine) {
  if (!engine.capabilities().checkpoints) return refuse(row, "has no checkpoints");
  const std::filesystem::path file = std::filesystem::absolute(task.scratch) / "middle";
  const Realised realised = loadScene(engine, task.entry, *task.setup, hard.scene);
  row["realised"] = toJson(realised);
  const double middle = 0.5 * hard.duration;
  advanceInPieces(engine, realised, 0.0, middle);
  engine.checkpoint(file);
  advanceInPieces(engine, realised, middle, hard.duration);
  const Snapshot whole = engine.snapshot(ContactReport::none);

  const LoadedEngine second =
      loadEngine(task.entry, *task.setup, hard.scene, task.scratch / "second");
  second.engine->restore(file);
  advanceInPieces(*second.engine, second.realised, middle, hard.duration);
  const Snapshot resumed = second.engine->snapshot(ContactReport::none);
  judgeNumber(row, *task.setup->stability, largestDistance(hard.scene, whole, resumed));
}

void judgeStepLimit(json& row, const StabilityTask& task, const HardScene& hard, Engine& engine,
                    const std::function<void(double)>& progress) {
  const StepLimit found = measureStepLimit(engine, task.entry, hard, progress);
  judgeNumber(row, *task.setup->stability, std::max(0.0, 1.0 - found.measured / found.theory));
  row["reason"] = fmt::format(
      "steps up to {:.4g} s were stable, {:.3f} of the 2/ω = {:.4g} s of all contacts together; "
      "the "
      "estimate from the coordination number is {:.4g} s",
      found.measured, found.measured / found.theory, found.theory, found.coordination);
}

/// The start is one that must be refused, by the harness or by the engine.
void judgeAcceptance(json& row, const StabilityTask& task, Engine& engine,
                     const std::function<void(double)>& progress) {
  try {
    const HardScene hard = hardScene(*task.setup, *task.packing);
    const Recording run = record(engine, task.entry, hard, progress);
    if (!run.failure.empty()) return judgeFailure(row, run);
    judgeNumber(row, *task.setup->stability, 1.0);
    row["reason"] = "was not refused";
  } catch (const UnsupportedScene& refusal) {
    judgeNumber(row, *task.setup->stability, 0.0);
    row["reason"] = fmt::format("refused: {}", refusal.what());
  } catch (const BadInput& refusal) {
    judgeNumber(row, *task.setup->stability, 0.0);
    row["reason"] = fmt::format("refused: {}", refusal.what());
  }
}

void judge(json& row, const StabilityTask& task, Engine& engine,
           const std::function<void(double)>& progress) {
  const std::string& measure = task.setup->stability->measure;
  if (measure == "accepted") return judgeAcceptance(row, task, engine, progress);
  const HardScene hard = hardScene(*task.setup, *task.packing);
  if (measure == "restart_differs") return judgeRestart(row, task, hard, engine);
  if (measure == "step_limit") return judgeStepLimit(row, task, hard, engine, progress);
  judgeRun(row, task, hard, engine, progress);
}

}  // namespace

json runStability(const StabilityTask& task, const std::function<void(double)>& progress) {
  json row = rowOf(task);
  try {
    const auto engine = startEngine(task.entry, task.scratch, task.setup->run.timeout);
    judge(row, task, *engine, progress);
  } catch (const Interrupted&) {
    throw;
  } catch (const UnsupportedScene& refusal) {
    refuse(row, refusal.what());
  } catch (const BadInput& refusal) {
    refuse(row, refusal.what());
  } catch (const std::exception& failure) {
    row["status"] = "failed";
    row["verdict"] = "unstable";
    row["reason"] = std::string("failed: ") + failure.what();
  }
  return row;
}

}  // namespace crossgrain::inline runs

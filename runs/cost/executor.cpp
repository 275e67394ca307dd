#include "runs/cost/executor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <tuple>

#include "runs/cost/collision.hpp"
#include "runs/cost/limits.hpp"
#include "support/bad_input.hpp"
#include "support/files.hpp"
#include "support/interrupt.hpp"

namespace crossgrain::inline runs {

namespace {

/// Whether a failure is what was to be expected of so large a step.
bool isBeyondLimit(const std::string& reason) {
  return reason.find(beyondLimit) != std::string::npos;
}

class Executor {
 public:
  Executor(const CostPlan& plan, CostStudy& study, const ErrorKinds& kinds)
      : plan_(plan), study_(study), kinds_(kinds), spent_(study.engines.size(), 0.0) {}

  std::vector<CostPoint> run();

 private:
  using Points = std::vector<CostPoint>;

  /// Places in the plan, in the order of measuring.
  std::vector<std::size_t> inTurn() const;
  Points pointsOf(const PlannedPoint& point);
  Points measured(const PlannedPoint& point);
  Points failed(const PlannedPoint& point, const std::string& reason);
  Points pastLimit(const PlannedPoint& point, const std::string& reason);
  /// One per measure that says why there is no number.
  Points without(const PlannedPoint& point, CostStatus status, const std::string& reason) const;
  ErrorKind& kindOf(const PlannedPoint& point) const { return errorKindOf(kinds_, point.kind); }

  const CostPlan& plan_;
  CostStudy& study_;
  const ErrorKinds& kinds_;
  std::vector<double> spent_;  ///< by engine [s]
};

/// How a point ended, for the progress.
std::string endInWords(const CostPoint& point) {
  if (!point.ran()) return fmt::format("{}: {}", toString(point.status), point.reason);
  const auto error = measuredError(point);
  return error ? fmt::format("{:.3g}", error->value) : "no number";
}

Executor::Points Executor::run() {
  std::vector<double> weights;
  for (const PlannedPoint& point : plan_.points) weights.push_back(point.seconds);
  Progress& progress = study_.campaign.progress();
  progress.begin("measuring, one at a time", weights);
  std::map<std::tuple<CostKind, std::size_t, std::size_t>, Points> found;
  for (const std::size_t k : inTurn()) {
    throwIfInterrupted();
    const PlannedPoint& point = plan_.points[k];
    const CostSetting& setting = study_.settingOf(point);
    const std::string label = fmt::format("{}, {}: {} {}", study_.entryOf(point.engine).name,
                                          toString(point.kind), setting.knob, setting.setting);
    progress.update(k, label, 0.0);
    Points& points = found[{point.kind, point.engine, point.setting}] = pointsOf(point);
    progress.finish(k, label + ": " + endInWords(points.front()));
  }
  Points all;
  for (const auto& [at, points] : found) all.insert(all.end(), points.begin(), points.end());
  return all;
}

std::vector<std::size_t> Executor::inTurn() const {
  std::vector<std::size_t> order, rank;
  std::map<std::pair<std::size_t, CostKind>, std::size_t> count;
  for (const PlannedPoint& point : plan_.points) {
    order.push_back(order.size());
    rank.push_back(count[{point.engine, point.kind}]++);
  }
  std::ranges::stable_sort(order, {},
                           [&](std::size_t k) { return std::pair(plan_.points[k].kind, rank[k]); });
  return order;
}

Executor::Points Executor::pointsOf(const PlannedPoint& point) {
  const CostSetting& setting = study_.settingOf(point);
  const double share = plan_.shares[point.engine];
  double& spent = spent_[point.engine];
  if (!setting.refusal.empty()) return without(point, CostStatus::refused, setting.refusal);
  if (const auto reason = study_.knownFailure(point))
    return without(point, CostStatus::failed, *reason);
  std::string obstacle = kindOf(point).obstacle(point);
  if (obstacle.empty()) obstacle = point.notMeasured;
  // Predictions may be off; an engine's share is not.
  if (obstacle.empty() && spent + point.seconds > 1.2 * share + 5.0)
    obstacle = doesNotFit(point.seconds, share - spent, share);
  if (!obstacle.empty()) return without(point, CostStatus::notMeasured, obstacle);
  const auto start = std::chrono::steady_clock::now();
  Points points = measured(point);
  spent += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return points;
}

Executor::Points Executor::measured(const PlannedPoint& point) {
  try {
    return kindOf(point).measure(point);
  } catch (const Interrupted&) {
    throw;
  } catch (const OutputError&) {
    throw;
  } catch (const BadInput&) {
    throw;
  } catch (const UnsupportedScene& refusal) {
    return without(point, CostStatus::refused, refusal.what());
  } catch (const std::exception& error) {
    return failed(point, error.what());
  }
}

Executor::Points Executor::failed(const PlannedPoint& point, const std::string& reason) {
  if (isBeyondLimit(reason)) return pastLimit(point, reason);
  study_.workers.drop(point.engine);
  const Case& setup = study_.settingOf(point).setup;
  const double theory =
      point.kind == CostKind::collision ? stabilityLimit(setup) : packingLimit(setup);
  // What the case's own step bears and a longer one does not is past a limit, wherever theory puts
  // it: it knows no dashpots.
  const double limit = std::min(theory, study_.stepOf(point.engine, study_.setup));
  if (study_.stepOf(point.engine, setup) > limit)
    return pastLimit(point, fmt::format("{}: {}", beyondLimit, reason));
  study_.engineFailures.push_back(reason);
  return without(point, CostStatus::failed, reason);
}

Executor::Points Executor::pastLimit(const PlannedPoint& point, const std::string& reason) {
  study_.keepFailure(point, reason);
  return without(point, CostStatus::failed, reason);
}

Executor::Points Executor::without(const PlannedPoint& point, CostStatus status,
                                   const std::string& reason) const {
  const CostSetting& setting = study_.settingOf(point);
  CostPoint row = pointOf(study_.entryOf(point.engine).name, setting, point.kind,
                          study_.stepOf(point.engine, setting.setup));
  row.status = status;
  row.reason = BadInput(reason).what();  // in one line
  Points points;
  for (const std::string& measure : kindOf(point).measures()) {
    row.measure = measure;
    points.push_back(row);
  }
  return points;
}

}  // namespace

std::vector<CostPoint> execute(const CostPlan& plan, CostStudy& study, const ErrorKinds& kinds) {
  for (const auto& kind : kinds)
    if (!plan.impossible.contains(kind->kind())) kind->makeReferences();
  return Executor(plan, study, kinds).run();
}

}  // namespace crossgrain::inline runs

#include "runs/cost/collision.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "cases/time_step.hpp"
#include "runs/cost/limits.hpp"
#include "support/interrupt.hpp"

namespace crossgrain::inline runs {

Case collisionOf(const Case& setup) {
  Case pair = setup;
  pair.kind = CaseKind::collision;
  pair.bottom.reset();
  Collision& collision = pair.collision;
  const Cost& cost = setup.cost;
  for (int k = 0; k < cost.psiCount; ++k)
    collision.psi.push_back(cost.psiMax * k / (cost.psiCount - 1));
  collision.vn = {cost.speed};
  for (const int side : {0, 1}) {
    collision.radius[side] = setup.particles.smallRadius;
    collision.mass[side] = setup.particles.smallMass;
  }
  collision.inertiaFactor = setup.particles.inertiaFactor;
  return pair;
}

CollisionReference collisionReference(const Case& setup) {
  const Case pair = collisionOf(setup);
  const auto starts = collisionStarts(pair);
  return {starts, oracleCurve(pair, starts)};
}

double stabilityLimit(const Case& setup) {
  return 2.0 * std::sqrt(lightestReducedMass(setup) / setup.law.kn);
}

namespace {

struct SweepTime {
  double wall, cpu;
};

/// Of one sweep among `copies` that run side by side.
SweepTime timeSweeps(Engine& engine, const EngineEntry& entry, const Case& pair, double dt,
                     const std::vector<CollisionStart>& starts, int copies) {
  std::vector<CollisionStart> many;
  for (int k = 0; k < copies; ++k) many.insert(many.end(), starts.begin(), starts.end());
  const Realised realised = loadScene(engine, entry, pair, collisionScene(pair, many, dt));
  engine.advance(sweepEnd(pair, dt, realised.dt));
  const Stats stats = engine.stats();
  return {stats.wallSeconds / copies, stats.cpuSeconds / copies};
}

/// The shortest of some repeats, each long enough to be measured.
SweepTime shortestSweep(Engine& engine, const EngineEntry& entry, const Case& pair, double dt,
                        const std::vector<CollisionStart>& starts, double single) {
  constexpr int mostCopies = 50;
  const int copies =
      std::clamp(static_cast<int>(std::ceil(pair.cost.timed / single)), 1, mostCopies);
  SweepTime best{INFINITY, INFINITY};
  for (int repeat = 0; repeat < pair.cost.repeats; ++repeat) {
    throwIfInterrupted();
    const SweepTime time = timeSweeps(engine, entry, pair, dt, starts, copies);
    best.wall = std::min(best.wall, time.wall);
    best.cpu = std::min(best.cpu, time.cpu);
  }
  return best;
}

/// Why a sweep says nothing about the case, empty if it does.
std::string failureOf(const CollisionCurve& sweep, const Case& pair, double dt) {
  const double ofLimit = dt / stabilityLimit(pair);
  const std::string limit =
      ofLimit > 1.0 ? fmt::format("{} (dt = {:.3g} · 2/ω): ", beyondLimit, ofLimit) : "";
  if (sweep.status != SweepStatus::finished) return limit + sweep.reason;
  double largest = 0.0;
  for (std::size_t k = 0; k < sweep.points.size(); ++k)
    if (const auto en = sweep.points.at(QuantityId::en, k))
      largest = std::max(largest, std::abs(*en));
  if (largest > 1.0)
    return fmt::format("{}pairs part {:.3g} times as fast as they met",
                       limit.empty() ? fmt::format("{}: ", beyondLimit) : limit, largest);
  return {};
}

/// √(mean of squares) of what `errorOf` says of each sweep; absent where it says nothing of one.
template <class ErrorOf>
std::optional<double> rmsOver(const std::vector<CollisionCurve>& sweeps, ErrorOf errorOf) {
  double squares = 0.0;
  for (const CollisionCurve& sweep : sweeps) {
    const std::optional<double> error = errorOf(sweep);
    if (!error) return std::nullopt;
    squares += *error * *error;
  }
  return std::sqrt(squares / static_cast<double>(sweeps.size()));
}

/// Against the engine's own limit, beside the point against the case's law.
CostPoint ownPoint(CostPoint point, const std::vector<CollisionCurve>& sweeps, QuantityId measure,
                   const CollisionReference& reference, const CollisionLimit& own) {
  const std::string name = point.measure;
  point.measure = ownOf(name);
  point.error.reset();
  if (!point.ran()) return point;
  const auto ends = own.ends.find(name);
  if (ends == own.ends.end()) {
    point.status = CostStatus::refused;
    point.reason = fmt::format("its own limit of small steps was not found: {}", own.reason);
    return point;
  }
  const double unit = unitOf(reference, measure);
  point.error = rmsOver(sweeps, [&](const CollisionCurve& sweep) {
    return rmsDifference(numbersOf(sweep.points, measure), ends->second, unit);
  });
  if (const auto error = own.error.find(name); error != own.error.end() && error->second > 0.0)
    point.referenceError = error->second;
  return point;
}

}  // namespace

std::vector<CostPoint> measureCollision(Engine& engine, const EngineEntry& entry,
                                        const CostSetting& setting,
                                        const CollisionReference& reference,
                                        const CollisionLimit& own) {
  Case pair = collisionOf(setting.setup);
  const double dt = timeStep(setting.setup);
  std::vector<CollisionCurve> sweeps;
  for (int k = 0; k < collisionPhases; ++k) {
    pair.collision.startPhase = (k + 0.5) / collisionPhases;
    sweeps.push_back(
        runSweep(engine, entry, pair, dt, reference.starts, reference.oracle, /*watch=*/false));
  }
  const CollisionCurve& first = sweeps.front();
  CostPoint point = pointOf(entry.name, setting, CostKind::collision, first.dt);
  countWork(point, first.stats->steps, first.stats->contactEvaluations);
  for (const CollisionCurve& each : sweeps)
    if (point.reason.empty()) point.reason = failureOf(each, pair, first.dt);
  if (!point.reason.empty()) point.status = CostStatus::failed;
  const SweepTime time = shortestSweep(engine, entry, pair, dt, reference.starts,
                                       std::max(first.stats->wallSeconds, 1e-6));
  point.wallSeconds = time.wall;
  point.cpuSeconds = time.cpu;

  std::vector<CostPoint> points;
  for (const QuantityId measure : collisionMeasures) {
    point.measure = collisionQuantity(measure).name;
    point.error.reset();
    if (point.ran())
      point.error = rmsOver(sweeps, [&](const CollisionCurve& sweep) {
        const auto& score = sweep.score.of[measure];
        return score ? std::optional(score->rms) : std::nullopt;
      });
    points.push_back(point);
    points.push_back(ownPoint(point, sweeps, measure, reference, own));
  }
  return points;
}

}  // namespace crossgrain::inline runs

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

/// What a point takes from a sweep of collisions.
struct SweepScore {
  double dt = 0.0;  ///< [s]
  std::uint64_t steps = 0, contactEvaluations = 0;
  double wallSeconds = 0.0;  ///< [s]
  std::string failure = {};  ///< why it did not finish; empty if it did
  double largestEn = 0.0;    ///< |e_n|
  std::map<std::string, double> rms = {};
};

SweepScore sweepScore(Engine& engine, const EngineEntry& entry, const Case& pair, double dt,
                      const CollisionReference& reference) {
  const nlohmann::json sweep =
      runSweep(engine, entry, pair, dt, reference.starts, reference.oracle, /*look=*/false);
  SweepScore score{.dt = sweep["dt"],
                   .steps = sweep["stats"]["steps"],
                   .contactEvaluations = sweep["stats"]["contact_evaluations"],
                   .wallSeconds = sweep["stats"]["wall_s"]};
  if (sweep["status"] != "finished") score.failure = sweep["reason"];
  if (const auto found = sweep["points"].find("e_n"); found != sweep["points"].end())
    for (const nlohmann::json& en : *found)
      if (en.is_number()) score.largestEn = std::max(score.largestEn, std::abs(en.get<double>()));
  for (const char* const measure : collisionMeasures)
    if (sweep["score"].contains(measure)) score.rms[measure] = sweep["score"][measure]["rms"];
  return score;
}

/// Why a sweep says nothing about the case, empty if it does.
std::string failureOf(const SweepScore& sweep, const Case& pair, double dt) {
  const double ofLimit = dt / stabilityLimit(pair);
  const std::string limit =
      ofLimit > 1.0 ? fmt::format("{} (dt = {:.3g} · 2/ω): ", beyondLimit, ofLimit) : "";
  if (!sweep.failure.empty()) return limit + sweep.failure;
  if (sweep.largestEn > 1.0)
    return fmt::format("{}pairs part {:.3g} times as fast as they met",
                       limit.empty() ? fmt::format("{}: ", beyondLimit) : limit, sweep.largestEn);
  return {};
}

/// √(mean of squares) of a score over sweeps; absent where one has none.
std::optional<double> rmsOf(const std::vector<SweepScore>& sweeps, const std::string& measure) {
  double squares = 0.0;
  for (const SweepScore& sweep : sweeps) {
    const auto found = sweep.rms.find(measure);
    if (found == sweep.rms.end()) return std::nullopt;
    squares += found->second * found->second;
  }
  return std::sqrt(squares / static_cast<double>(sweeps.size()));
}

}  // namespace

std::vector<CostPoint> measureCollision(Engine& engine, const EngineEntry& entry,
                                        const CostSetting& setting,
                                        const CollisionReference& reference) {
  Case pair = collisionOf(setting.setup);
  const double dt = timeStep(setting.setup);
  std::vector<SweepScore> sweeps;
  for (int k = 0; k < collisionPhases; ++k) {
    pair.collision.startPhase = (k + 0.5) / collisionPhases;
    sweeps.push_back(sweepScore(engine, entry, pair, dt, reference));
  }
  const SweepScore& first = sweeps.front();
  CostPoint point = pointOf(entry.name, setting, CostKind::collision, first.dt);
  countWork(point, first.steps, first.contactEvaluations);
  for (const SweepScore& each : sweeps)
    if (point.reason.empty()) point.reason = failureOf(each, pair, first.dt);
  if (!point.reason.empty()) point.status = CostStatus::failed;
  const SweepTime time =
      shortestSweep(engine, entry, pair, dt, reference.starts, std::max(first.wallSeconds, 1e-6));
  point.wallSeconds = time.wall;
  point.cpuSeconds = time.cpu;

  std::vector<CostPoint> points;
  for (const char* const measure : collisionMeasures) {
    point.measure = measure;
    point.error = point.ran() ? rmsOf(sweeps, measure) : std::nullopt;
    points.push_back(point);
  }
  return points;
}

}  // namespace crossgrain::inline runs

#include "runs/cost/trajectory.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cases/couette.hpp"
#include "cases/time_step.hpp"
#include "runs/common/engine_access.hpp"
#include "runs/common/engine_running.hpp"
#include "runs/cost/limits.hpp"

namespace crossgrain::inline runs {

namespace {

double diameterOf(const Case& setup) {
  return 2.0 * setup.particles.smallRadius;
}

Scene sceneOf(const Case& setup, const Packing& packing) {
  return couetteScene(setup, packing, timeStep(setup));
}

}  // namespace

Track followPacking(Engine& engine, const EngineEntry& entry, const Case& setup, const Scene& scene,
                    const std::vector<double>& times) {
  const Realised realised = loadScene(engine, entry, setup, scene);
  Track track;
  track.dt = realised.dt;
  double now = 0.0;
  for (const double time : times) {
    advanceInPieces(engine, realised, now, time);
    now = time;
    Snapshot seen = engine.snapshot(ContactReport::none);
    if (const std::string wild = blowUp(setup, seen); !wild.empty()) throw EngineFailure(wild);
    // A step that does not divide the window ends a little beside it.
    for (std::size_t k = 0; k < seen.position.size(); ++k)
      seen.position[k] += (time - seen.positionTime) * seen.velocity[k];
    track.positions.push_back(std::move(seen.position));
  }
  const Stats stats = engine.stats();
  track.wallSeconds = stats.wallSeconds;
  track.cpuSeconds = stats.cpuSeconds;
  track.steps = stats.steps;
  track.contactEvaluations = stats.contactEvaluations;
  return track;
}

ChaosStudy studyChaos(Engine& engine, const EngineEntry& entry, const Case& setup, const Case& fine,
                      const Case& coarse, const Packing& packing) {
  constexpr int samples = 100;
  const Cost& cost = setup.cost;
  const double diameter = diameterOf(setup);
  std::vector<double> times;
  for (int k = 1; k <= samples; ++k) times.push_back(cost.growthTime * k / samples);
  const Scene scene = sceneOf(setup, packing);
  const Track one = followPacking(engine, entry, setup, scene, times);
  const Track other =
      followPacking(engine, entry, setup, perturbed(scene, cost.perturbation * diameter), times);
  ChaosStudy study;
  study.separations.push_back({0.0, cost.perturbation});
  for (std::size_t k = 0; k < times.size(); ++k)
    study.separations.push_back(
        {times[k], rmsDistance(one.positions[k], other.positions[k], diameter)});
  study.growth = fitGrowth(study.separations, cost.separation);

  const double unit = std::min(5.0, cost.windowMost) * costContactTime(setup);
  const double error = trajectoryReference(engine, entry, fine, coarse, packing, unit).error;
  study.window = trajectoryWindow(study.growth, error, unit, cost.separation, unit,
                                  cost.windowMost * costContactTime(setup));
  return study;
}

TrajectoryReference trajectoryReference(Engine& engine, const EngineEntry& entry, const Case& fine,
                                        const Case& coarse, const Packing& packing, double window) {
  const auto at = [&](const Case& setup) {
    return followPacking(engine, entry, setup, sceneOf(setup, packing), {window}).positions.front();
  };
  const auto twice = at(coarse);
  TrajectoryReference reference{at(fine), 0.0};
  reference.error = rmsDistance(reference.positions, twice, diameterOf(fine));
  return reference;
}

std::vector<CostPoint> measureTrajectory(Engine& engine, const EngineEntry& entry,
                                         const CostSetting& setting, const Packing& packing,
                                         double window, const TrajectoryReference& own,
                                         const TrajectoryReference& inHouse) {
  const Case& setup = setting.setup;
  const Scene scene = sceneOf(setup, packing);
  Track track = followPacking(engine, entry, setup, scene, {window});
  // Short runs begin with what every start costs, so they are warmed up and repeated.
  if (track.wallSeconds < 10.0 * setup.cost.timed)
    for (int repeat = 1; repeat < setup.cost.repeats; ++repeat) {
      const Track again = followPacking(engine, entry, setup, scene, {window});
      track.wallSeconds = std::min(track.wallSeconds, again.wallSeconds);
      track.cpuSeconds = std::min(track.cpuSeconds, again.cpuSeconds);
    }
  CostPoint point = pointOf(entry.name, setting, CostKind::trajectory, track.dt);
  point.wallSeconds = track.wallSeconds;
  point.cpuSeconds = track.cpuSeconds;
  countWork(point, track.steps, track.contactEvaluations);
  std::vector<CostPoint> points;
  const auto add = [&](const std::string& measure, const TrajectoryReference& reference) {
    point.measure = measure;
    point.error = rmsDistance(track.positions.front(), reference.positions, diameterOf(setup));
    point.referenceError = reference.error;
    points.push_back(point);
  };
  add("position_rms_own", own);
  add("position_rms_" + engineRegistry().front().name, inHouse);
  return points;
}

}  // namespace crossgrain::inline runs

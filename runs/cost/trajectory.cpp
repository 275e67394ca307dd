#include "runs/cost/trajectory.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cases/couette.hpp"
#include "cases/loader.hpp"
#include "cases/time_step.hpp"
#include "runs/common/advance.hpp"
#include "runs/common/engine_access.hpp"

namespace crossgrain::inline runs {

namespace {

double diameterOf(const Case& setup) {
  return 2.0 * setup.particles.smallRadius;
}

}  // namespace

Track followPacking(Engine& engine, const EngineEntry& entry, const Case& setup,
                    const Packing& packing, double time) {
  const Scene scene = couetteScene(setup, packing, timeStep(setup));
  const Realised realised = loadScene(engine, entry, setup, scene);
  advanceInPieces(engine, realised, 0.0, time);
  Snapshot snapshot = engine.snapshot(ContactReport::none);
  requireSound(setup, snapshot);
  // A step that does not divide the window ends a little beside it.
  for (std::size_t k = 0; k < snapshot.position.size(); ++k)
    snapshot.position[k] += (time - snapshot.positionTime) * snapshot.velocity[k];
  const Stats stats = engine.stats();
  return {
      std::move(snapshot.position), realised.dt, stats.wallSeconds, stats.cpuSeconds, stats.steps,
      stats.contactEvaluations};
}

double rmsDistance(const std::vector<Vec2>& a, const std::vector<Vec2>& b, double diameter) {
  double squares = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) squares += (a[k] - b[k]).squaredNorm();
  return std::sqrt(squares / static_cast<double>(a.size())) / diameter;
}

namespace {

/// @param fine, coarse  the case at the reference's step and at twice that
TrajectoryReference makeReference(Engine& engine, const EngineEntry& entry, const Case& fine,
                                  const Case& coarse, const Packing& packing, double window) {
  const auto at = [&](const Case& setup) {
    return followPacking(engine, entry, setup, packing, window).positions;
  };
  const auto twice = at(coarse);
  TrajectoryReference reference{at(fine), 0.0};
  reference.error = rmsDistance(reference.positions, twice, diameterOf(fine));
  return reference;
}

}  // namespace

std::vector<std::string> TrajectoryErrors::measures() const {
  return {"position_rms_own", "position_rms_" + study_.inHouse.name};
}

double TrajectoryErrors::window() const {
  return study_.setup.cost.windowMost * costContactTime(study_.setup);
}

double TrajectoryErrors::predicted(std::size_t engine, const CostSetting& setting) const {
  const TimedEngine& timed = study_.engines[engine];
  const Cost& cost = study_.setup.cost;
  const double once = window() / study_.stepOf(engine, setting.setup) * timed.step;
  const double runs = once < 10.0 * cost.timed ? cost.repeats : 1;
  return runs * (once + timed.load);
}

double TrajectoryErrors::commonTime() const {
  // One at the reference's step and one at twice that.
  return 1.5 * study_.setup.cost.trajectoryReference * window() / costContactTime(study_.setup) *
         study_.inHouseStep;
}

double TrajectoryErrors::ownTime(std::size_t engine) const {
  double references = 0.0;
  for (const std::string& integrator : integratorsOf(engine))
    references += !isCommon(engine, integrator);
  return references * 1.5 * study_.setup.cost.trajectoryReference * window() /
         costContactTime(study_.setup) * study_.engines[engine].step;
}

std::vector<CostPoint> TrajectoryErrors::measure(const PlannedPoint& planned) {
  const CostSetting& setting = study_.settingOf(planned);
  const Case& setup = setting.setup;
  const EngineEntry& entry = study_.entryOf(planned.engine);
  const TrajectoryReference inHouse = referenceOf({});
  const TrajectoryReference own = isCommon(planned.engine, setting.integrator())
                                      ? inHouse
                                      : referenceOf(planned.engine, setting.integrator());
  Engine& engine = study_.workerOf(planned.engine);
  Track track = followPacking(engine, entry, setup, packing(), window());
  // Short runs begin with what every start costs, so they are warmed up and repeated.
  if (track.wallSeconds < 10.0 * setup.cost.timed)
    for (int repeat = 1; repeat < setup.cost.repeats; ++repeat) {
      const Track again = followPacking(engine, entry, setup, packing(), window());
      track.wallSeconds = std::min(track.wallSeconds, again.wallSeconds);
      track.cpuSeconds = std::min(track.cpuSeconds, again.cpuSeconds);
    }
  CostPoint point = pointOf(entry.name, setting, kind(), track.dt);
  point.wallSeconds = track.wallSeconds;
  point.cpuSeconds = track.cpuSeconds;
  countWork(point, track.steps, track.contactEvaluations);
  std::vector<CostPoint> points;
  const std::vector<std::string> names = measures();
  for (const auto& [measure, reference] : {std::pair(&names[0], &own), {&names[1], &inHouse}}) {
    point.measure = *measure;
    point.error = rmsDistance(track.positions, reference->positions, diameterOf(setup));
    point.referenceError = reference->error;
    points.push_back(point);
  }
  return points;
}

TrajectoryErrors::ReferenceRun TrajectoryErrors::referenceRun(std::optional<std::size_t> engine,
                                                              const std::string& integrator) const {
  const std::string law =
      integrator.empty() ? integrator : fmt::format("[law]\nintegrator = \"{}\"\n\n", integrator);
  const std::string& name = engine ? study_.entryOf(*engine).name : study_.inHouse.name;
  const Capabilities can = engine ? study_.canOf(*engine) : study_.inHouseEngine->capabilities();
  const auto at = [&](double steps) {
    return caseWith(study_.setup, law + stepFragment(study_.setup, name, can, steps));
  };
  const double steps = study_.setup.cost.trajectoryReference;
  return {"reference-trajectory-" + (engine ? name + integrator : "in-house"),
          engine ? study_.campaign.keyOf(*engine, 0, "cost: reference " + integrator)
                 : study_.inHouseKey(0, "cost: reference"),
          at(steps), at(steps / 2.0)};
}

TrajectoryReference TrajectoryErrors::referenceOf(std::optional<std::size_t> engine,
                                                  const std::string& integrator) {
  const ReferenceRun run = referenceRun(engine, integrator);
  return keptOr(study_.campaign.store(), run.name, run.key, [&] {
    return makeReference(engine ? study_.workerOf(*engine) : *study_.inHouseEngine,
                         engine ? study_.entryOf(*engine) : study_.inHouse, run.fine, run.coarse,
                         packing(), window());
  });
}

std::vector<std::string> TrajectoryErrors::integratorsOf(std::size_t engine) const {
  std::vector<std::string> integrators;
  for (const CostSetting& setting : study_.settingsOf(engine, kind()))
    if (setting.refusal.empty() &&
        std::ranges::find(integrators, setting.integrator()) == integrators.end())
      integrators.push_back(setting.integrator());
  std::ranges::sort(integrators);
  return integrators;
}

void TrajectoryErrors::addTo(CostResults& results) const {
  const double steps = study_.setup.cost.trajectoryReference;
  const auto kept = [&](std::optional<std::size_t> engine, const std::string& integrator) {
    const ReferenceRun run = referenceRun(engine, integrator);
    return study_.campaign.store().findAs<TrajectoryReference>(run.name, run.key);
  };
  const auto add = [&](const std::string& engine, const std::string& integrator, double error) {
    results.references.push_back(
        {kind(), engine,
         fmt::format("{}t_c/{:g}", integrator.empty() ? "" : integrator + ", ", steps), error,
         "distance to the same at twice the step"});
  };
  results.window = window();
  const auto inHouse = kept({}, "");
  if (inHouse) add(study_.inHouse.name, "", inHouse->error);
  for (std::size_t e = 0; e < study_.engines.size(); ++e) {
    if (!study_.engines[e].takesPart) continue;
    const std::string& name = study_.entryOf(e).name;
    for (const std::string& integrator : integratorsOf(e)) {
      const auto own = isCommon(e, integrator) ? std::nullopt : kept(e, integrator);
      if (!own) continue;
      add(name, integrator, own->error);
      if (!integrator.empty() || !inHouse) continue;
      const double model =
          rmsDistance(own->positions, inHouse->positions, 2.0 * study_.setup.particles.smallRadius);
      const double unsure = own->error + inHouse->error;
      results.models.push_back({name, kind(), "position_rms_" + study_.inHouse.name, model,
                                std::max(0.0, model - unsure), model + unsure});
    }
  }
}

}  // namespace crossgrain::inline runs

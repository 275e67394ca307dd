#include "runs/cost/trajectory.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "cases/couette.hpp"
#include "cases/loader.hpp"
#include "cases/time_step.hpp"
#include "runs/common/engine_access.hpp"
#include "runs/common/engine_running.hpp"

namespace crossgrain::inline runs {

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

/// What packings' paths are compared with.
struct TrajectoryReference {
  std::vector<Vec2> positions;  ///< at the window's end [m]
  double error = 0.0;           ///< distance to the same at twice the step [d]
};

void fields(auto& io, TrajectoryReference& reference) {
  std::vector<std::array<double, 2>> pairs;
  for (const Vec2& at : reference.positions) pairs.push_back({at.x(), at.y()});
  io("error", reference.error);
  io("positions", pairs);
  if (reference.positions.empty())  // to be read
    for (const auto& [x, y] : pairs) reference.positions.emplace_back(x, y);
}

class TrajectoryErrors final : public ErrorKind {
 public:
  using ErrorKind::ErrorKind;

  CostKind kind() const override { return CostKind::trajectory; }

  std::vector<std::string> measures() const override {
    return {"position_rms_own", "position_rms_" + study_.inHouse.name};
  }

  double predicted(std::size_t engine, const CostSetting& setting) const override {
    const TimedEngine& timed = study_.engines[engine];
    const Cost& cost = study_.setup.cost;
    const double once = window() / study_.stepOf(engine, setting.setup) * timed.step;
    const double runs = once < 10.0 * cost.timed ? cost.repeats : 1;
    return runs * (once + timed.load);
  }

  double commonTime() const override { return referenceSteps() * study_.inHouseStep; }

  double ownTime(std::size_t engine) const override {
    double references = 0.0;
    for (const std::string& integrator : integratorsOf(engine))
      references += !isCommon(engine, integrator);
    return references * referenceSteps() * study_.engines[engine].step;
  }

  /// The shortest time of `cost.repeats`, where a run is shorter than `cost.timed`.
  std::vector<CostPoint> measure(const PlannedPoint& planned) override {
    const CostSetting& setting = study_.settingOf(planned);
    const Case& setup = setting.setup;
    const EngineEntry& entry = study_.entryOf(planned.engine);
    const TrajectoryReference inHouse = referenceOf({}, {});
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
    std::vector<CostPoint> points(2, point);
    const std::vector<std::string> names = measures();
    for (std::size_t k = 0; k < 2; ++k) {
      const TrajectoryReference& reference = k == 0 ? own : inHouse;
      points[k].measure = names[k];
      points[k].error = rmsDistance(track.positions, reference.positions, diameter());
      points[k].referenceError = reference.error;
    }
    return points;
  }

  void addTo(CostResults& results) const override {
    const auto kept = [&](std::optional<std::size_t> engine, const std::string& integrator) {
      const auto [name, key] = referenceFile(engine, integrator);
      return study_.campaign.store().findAs<TrajectoryReference>(name, key);
    };
    const auto add = [&](const std::string& engine, const std::string& integrator, double error) {
      results.references.push_back(
          {kind(), engine,
           fmt::format("{}t_c/{:g}", integrator.empty() ? "" : integrator + ", ",
                       study_.setup.cost.trajectoryReference),
           error, "distance to the same at twice the step"});
    };
    results.window = window();
    const auto inHouse = kept({}, {});
    if (inHouse) add(study_.inHouse.name, "", inHouse->error);
    for (std::size_t e = 0; e < study_.engines.size(); ++e) {
      if (!study_.engines[e].takesPart) continue;
      const std::string& name = study_.entryOf(e).name;
      for (const std::string& integrator : integratorsOf(e)) {
        const auto own = isCommon(e, integrator) ? std::nullopt : kept(e, integrator);
        if (!own) continue;
        add(name, integrator, own->error);
        if (!integrator.empty() || !inHouse) continue;
        const double model = rmsDistance(own->positions, inHouse->positions, diameter());
        const double unsure = own->error + inHouse->error;
        results.models.push_back({name, kind(), "position_rms_" + study_.inHouse.name, model,
                                  std::max(0.0, model - unsure), model + unsure});
      }
    }
  }

 private:
  const Packing& packing() const { return study_.campaign.packings().front(); }
  double diameter() const { return 2.0 * study_.setup.particles.smallRadius; }  // [m]
  double window() const {                                                       // [s]
    return study_.setup.cost.windowMost * costContactTime(study_.setup);
  }
  /// Of a reference: at its step and at twice that.
  double referenceSteps() const {
    return 1.5 * study_.setup.cost.trajectoryReference * study_.setup.cost.windowMost;
  }
  /// The in-house engine's own reference is everybody's.
  bool isCommon(std::size_t engine, const std::string& integrator) const {
    return integrator.empty() && study_.entryOf(engine).name == study_.inHouse.name;
  }

  /// Name and key of a reference, which is kept. @param engine  absent: the in-house one, for all
  std::pair<std::string, CaseKeys> referenceFile(std::optional<std::size_t> engine,
                                                 const std::string& integrator) const {
    const std::string name = engine ? study_.entryOf(*engine).name + integrator : "in-house";
    return {"reference-trajectory-" + name,
            engine ? study_.campaign.keyOf(*engine, 0, "cost: reference " + integrator)
                   : study_.inHouseKey(0, "cost: reference")};
  }

  /// Made when it is first needed.
  TrajectoryReference referenceOf(std::optional<std::size_t> engine,
                                  const std::string& integrator) {
    const auto [file, key] = referenceFile(engine, integrator);
    return keptOr(study_.campaign.store(), file, key, [&] {
      const EngineEntry& entry = engine ? study_.entryOf(*engine) : study_.inHouse;
      Engine& running = engine ? study_.workerOf(*engine) : *study_.inHouseEngine;
      const std::string law =
          integrator.empty() ? "" : fmt::format("[law]\nintegrator = \"{}\"\n\n", integrator);
      const auto at = [&](double steps) {
        const Case setup =
            caseWith(study_.setup,
                     law + stepFragment(study_.setup, entry.name, running.capabilities(), steps));
        return followPacking(running, entry, setup, packing(), window()).positions;
      };
      const double steps = study_.setup.cost.trajectoryReference;
      const auto twice = at(steps / 2.0);
      TrajectoryReference reference{at(steps)};
      reference.error = rmsDistance(reference.positions, twice, diameter());
      return reference;
    });
  }

  /// Integrators of the settings that an engine has.
  std::vector<std::string> integratorsOf(std::size_t engine) const {
    std::vector<std::string> integrators;
    for (const CostSetting& setting : study_.settingsOf(engine, kind()))
      if (setting.refusal.empty() &&
          std::ranges::find(integrators, setting.integrator()) == integrators.end())
        integrators.push_back(setting.integrator());
    std::ranges::sort(integrators);
    return integrators;
  }
};

}  // namespace

std::unique_ptr<ErrorKind> trajectoryErrors(CostStudy& study) {
  return std::make_unique<TrajectoryErrors>(study);
}

}  // namespace crossgrain::inline runs

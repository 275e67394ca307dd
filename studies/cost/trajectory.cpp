#include "studies/cost/trajectory.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "averaging/agreement.hpp"
#include "averaging/statistics.hpp"
#include "cases/flow.hpp"
#include "cases/loader.hpp"
#include "cases/time_step.hpp"
#include "studies/core/engine_access.hpp"
#include "studies/core/engine_running.hpp"

namespace crossgrain::inline studies {

namespace {

template <int D>
Track trackOf(Engine& engine, const EngineEntry& entry, const Case& setup, const Packing& packing,
              double time) {
  const SceneOf<D> scene = flowScene<D>(setup, packing, timeStep(setup));
  const EffectiveParameters effective = loadScene(engine, entry, setup, scene);
  advanceInPieces(engine, effective, 0.0, time);
  const SnapshotOf<D> snapshot = snapshotOf<D>(engine, ContactReport::none);
  requireSound<D>(scene, snapshot);
  Track track;
  for (std::size_t k = 0; k < snapshot.position.size(); ++k) {
    VecOf<D> place = snapshot.position[k];
    const VecOf<D>& start = scene.disks.position[k];
    if (scene.box) place = start + scene.box->nearest(place - start);
    // A step that does not divide the window ends a little beside it.
    place += (time - snapshot.positionTime) * snapshot.velocity[k];
    track.positions.emplace_back(Vec3::Zero()).template head<D>() = place;
  }
  const Stats stats = engine.stats();
  track.cost = {effective.dt, stats.wallSeconds, stats.cpuSeconds, stats.steps,
                stats.contactEvaluations};
  return track;
}

}  // namespace

Track followPacking(Engine& engine, const EngineEntry& entry, const Case& setup,
                    const Packing& packing, double time) {
  return inDimensionOf(setup,
                       [&]<int D>() { return trackOf<D>(engine, entry, setup, packing, time); });
}

double rmsDistance(const std::vector<Vec3>& a, const std::vector<Vec3>& b, double diameter) {
  double squares = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) squares += (a[k] - b[k]).squaredNorm();
  return std::sqrt(squares / static_cast<double>(a.size())) / diameter;
}

namespace {

/// A mean over packings and the half width of its 95 % interval; that is absent of one packing.
struct PackingMean {
  double mean;
  std::optional<double> standardError, half;
};
PackingMean overPackings(const std::vector<std::optional<double>>& numbers) {
  constexpr double confidence = 0.95;
  const auto mean = ensembleMean(numbers);
  PackingMean found{mean->mean, mean->standardError, {}};
  if (mean->standardError)
    found.half = *mean->standardError * studentQuantile(confidence, mean->packings - 1);
  return found;
}

/// Reference for a packing's path.
struct TrajectoryReference {
  std::vector<Vec3> positions;  ///< at the window's end, in the plane z = 0 [m]
  double error = 0.0;           ///< distance to the same at twice the step [d]
};

void fields(auto& io, TrajectoryReference& reference) {
  const bool flat =
      std::ranges::all_of(reference.positions, [](const Vec3& at) { return at.z() == 0.0; });
  std::vector<std::vector<double>> places;
  for (const Vec3& at : reference.positions)
    places.emplace_back(at.data(), at.data() + (flat ? 2 : 3));
  io("error", reference.error);
  io("positions", places);
  if (reference.positions.empty())  // to be read
    for (const std::vector<double>& place : places) {
      Vec3& at = reference.positions.emplace_back(Vec3::Zero());
      for (std::size_t k = 0; k < std::min<std::size_t>(place.size(), 3); ++k)
        at[static_cast<Eigen::Index>(k)] = place[k];
    }
}

class TrajectoryErrors final : public ErrorKind {
 public:
  using ErrorKind::ErrorKind;

  CostKind kind() const override { return CostKind::trajectory; }

  std::vector<std::string> measures() const override {
    return {"position_rms_own", "position_rms_" + study_.inHouse.name};
  }

  std::size_t rounds() const override {
    return std::min(study_.campaign.packings().size(),
                    static_cast<std::size_t>(study_.setup.cost.trajectoryPackings));
  }

  double predicted(std::size_t engine, const CostSetting& setting) const override {
    const SceneTimes& timed = study_.engines[engine].scene;
    const double once = window() / study_.stepOf(engine, setting.setup) * timed.step;
    return static_cast<double>(rounds()) * (once + timed.load);
  }

  double commonTime(std::size_t of) const override {
    std::size_t missing = 0;
    for (std::size_t round = 0; round < of; ++round) {
      const auto [name, key] = referenceFile({}, {}, round);
      missing += !study_.campaign.store().find(name, key);
    }
    return referenceSteps() * study_.inHouseStep * static_cast<double>(missing) /
           static_cast<double>(rounds());
  }

  double ownTime(std::size_t engine) const override {
    double references = 0.0;
    for (const std::string& integrator : integratorsOf(engine))
      references += !isCommon(engine, integrator);
    return references * referenceSteps() * study_.engines[engine].scene.step;
  }

  CostRun run(const PlannedPoint& planned, std::size_t round, double) override {
    const CostSetting& setting = study_.settingOf(planned);
    const TrajectoryReference inHouse = referenceOf({}, {}, round);
    const TrajectoryReference own = isCommon(planned.engine, setting.integrator())
                                        ? inHouse
                                        : referenceOf(planned.engine, setting.integrator(), round);
    Track track = followPacking(study_.workerOf(planned.engine), study_.entryOf(planned.engine),
                                setting.setup, packing(round), window());
    const std::vector<std::string> names = measures();
    for (std::size_t k = 0; k < 2; ++k) {
      const TrajectoryReference& reference = k == 0 ? own : inHouse;
      const double error = rmsDistance(track.positions, reference.positions, diameter());
      track.cost.numbers[names[k]] = {std::optional(error), std::optional(reference.error)};
    }
    return track.cost;
  }

  std::vector<CostPoint> points(const PlannedPoint& planned,
                                const std::vector<CostRun>& runs) const override {
    std::vector<CostPoint> points;
    for (const std::string& measure : measures()) {
      CostPoint& point = points.emplace_back(
          timedPoint(study_.entryOf(planned.engine).name, study_.settingOf(planned), kind(), runs));
      point.measure = measure;
      std::vector<std::optional<double>> errors, references;
      for (const CostRun& run : runs) {
        errors.push_back(run.numbers.at(measure).at(0));
        references.push_back(run.numbers.at(measure).at(1));
      }
      const PackingMean error = overPackings(errors);
      point.error = error.mean;
      point.statistical = error.standardError;
      point.referenceError = overPackings(references).mean;
      if (!error.half) continue;
      point.intervalLow = std::max(0.0, error.mean - *error.half - *point.referenceError);
      point.intervalHigh = error.mean + *error.half + *point.referenceError;
    }
    return points;
  }

  void addTo(CostResults& results) const override {
    const auto add = [&](const std::string& engine, const std::string& integrator, double error) {
      results.references.push_back(
          {kind(), engine,
           fmt::format("{}t_c/{:g}", integrator.empty() ? "" : integrator + ", ",
                       study_.setup.cost.trajectoryReference),
           error, "distance to the same at twice the step"});
    };
    results.window = window();
    const auto inHouse = kept({}, {});
    if (!inHouse.empty()) add(study_.inHouse.name, "", meanError(inHouse));
    for (std::size_t e = 0; e < study_.engines.size(); ++e) {
      if (!study_.engines[e].takesPart) continue;
      const std::string& name = study_.entryOf(e).name;
      for (const std::string& integrator : integratorsOf(e)) {
        if (isCommon(e, integrator)) continue;
        const auto own = kept(e, integrator);
        if (own.empty()) continue;
        add(name, integrator, meanError(own));
        if (integrator.empty()) addModel(results, name, own, inHouse);
      }
    }
  }

 private:
  const Packing& packing(std::size_t round) const { return study_.trajectoryStarts()[round]; }
  double diameter() const { return flowDiameter(study_.setup); }  // [m]
  double window() const {                                         // [s]
    return study_.setup.cost.windowMost * costContactTime(study_.setup);
  }
  /// Of references of all packings: at their step and at twice that.
  double referenceSteps() const {
    return 1.5 * study_.setup.cost.trajectoryReference * study_.setup.cost.windowMost *
           static_cast<double>(rounds());
  }
  /// The in-house engine's own reference is everybody's.
  bool isCommon(std::size_t engine, const std::string& integrator) const {
    return integrator.empty() && study_.entryOf(engine).name == study_.inHouse.name;
  }

  using References = std::map<std::size_t, TrajectoryReference>;  ///< by packing

  /// Those that were made.
  References kept(std::optional<std::size_t> engine, const std::string& integrator) const {
    References found;
    for (std::size_t round = 0; round < rounds(); ++round) {
      const auto [name, key] = referenceFile(engine, integrator, round);
      if (auto one = study_.campaign.store().findAs<TrajectoryReference>(name, key))
        found[round] = std::move(*one);
    }
    return found;
  }

  static double meanError(const References& references) {
    double sum = 0.0;
    for (const auto& [round, one] : references) sum += one.error;
    return sum / static_cast<double>(references.size());
  }

  /// How far an engine's own references are from the in-house one's, over packings that both have.
  void addModel(CostResults& results, const std::string& engine, const References& own,
                const References& inHouse) const {
    std::vector<std::optional<double>> distances;
    double unsure = 0.0;
    for (const auto& [round, one] : own) {
      const auto other = inHouse.find(round);
      if (other == inHouse.end()) continue;
      distances.push_back(rmsDistance(one.positions, other->second.positions, diameter()));
      unsure = std::max(unsure, one.error + other->second.error);
    }
    if (distances.empty()) return;
    const PackingMean model = overPackings(distances);
    if (!model.half) return;
    const double half = *model.half + unsure;
    results.models.push_back({engine, kind(), "position_rms_" + study_.inHouse.name, model.mean,
                              std::max(0.0, model.mean - half), model.mean + half});
  }

  /// Name and key of a reference, which is kept. @param engine  absent: the in-house one, for all
  std::pair<std::string, CaseKeys> referenceFile(std::optional<std::size_t> engine,
                                                 const std::string& integrator,
                                                 std::size_t round) const {
    const std::string name = engine ? study_.entryOf(*engine).name + integrator : "in-house";
    return {fmt::format("reference-trajectory-{}-p{}", name, round),
            engine ? study_.campaign.keyOf(*engine, static_cast<int>(round),
                                           "cost: reference " + integrator)
                   : study_.inHouseKey(round, "cost: reference")};
  }

  /// Made when it is first needed.
  TrajectoryReference referenceOf(std::optional<std::size_t> engine, const std::string& integrator,
                                  std::size_t round) {
    const auto [file, key] = referenceFile(engine, integrator, round);
    return keptOr(study_.campaign.store(), file, key, [&] {
      const EngineEntry& entry = engine ? study_.entryOf(*engine) : study_.inHouse;
      Engine& running = engine ? study_.workerOf(*engine) : *study_.inHouseEngine;
      const std::string law =
          integrator.empty() ? "" : fmt::format("[law]\nintegrator = \"{}\"\n\n", integrator);
      const auto at = [&](double steps) {
        const Case setup =
            caseWith(study_.setup,
                     law + stepFragment(study_.setup, entry.name, running.capabilities(), steps));
        return followPacking(running, entry, setup, packing(round), window()).positions;
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

}  // namespace crossgrain::inline studies

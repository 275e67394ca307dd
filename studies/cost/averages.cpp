#include "studies/cost/averages.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "adapters/audit.hpp"
#include "averaging/agreement.hpp"
#include "averaging/profiles.hpp"
#include "averaging/statistics.hpp"
#include "cases/couette.hpp"
#include "cases/flow.hpp"
#include "cases/time_step.hpp"
#include "studies/core/engine_access.hpp"
#include "studies/core/engine_running.hpp"
#include "studies/core/executor.hpp"
#include "studies/flow/endpoint_values.hpp"
#include "studies/flow/run.hpp"
#include "studies/flow/summary.hpp"

namespace crossgrain::inline studies {

namespace {

constexpr const char* profileMeasures[] = {"azimuthal_velocity", "stress_rr", "volume_fraction"};

std::map<std::string, std::vector<std::optional<double>>> numbersOf(
    const Case& setup, const std::vector<Profile>& profiles) {
  std::map<std::string, std::vector<std::optional<double>>> numbers;
  const double rim = couetteIn(setup).cell.omega * couetteIn(setup).cell.innerRadius;
  for (const Profile& profile : profiles) {
    if (std::ranges::find(profileMeasures, profile.field) == std::end(profileMeasures)) continue;
    auto& rings = numbers[profile.field];
    const double unit = profile.field == profileMeasures[0] ? rim : 1.0;
    for (const auto& mean : profile.mean)
      rings.push_back(mean ? std::optional(*mean / unit) : std::nullopt);
  }
  for (const FitRow& fit : couetteFits(setup, profiles)) {
    if (!fit.value) continue;
    if (fit.name == "velocity_decay") numbers["shear_band_width"] = {*fit.value};
    if (fit.name == "velocity_amplitude") numbers["wall_slip"] = {1.0 - *fit.value};
  }
  if (const auto stress = numbers.find("stress_rr"); stress != numbers.end())
    if (const auto level = ensembleMean(stress->second)) numbers["stress_level"] = {level->mean};
  return numbers;
}

/// The case's endpoints of a whole run of one packing, as compare has them. Its time is that of a
/// second of the scene.
CostRun endpointsOfRun(const EngineEntry& entry, const Case& setup, const Packing& packing,
                       const std::function<void(double)>& progress) {
  const FlowRun run = runWithoutFiles(entry, setup, 0, packing, timeStep(setup), progress);
  const double seconds = flowDuration(setup);
  const auto perSecond = [&](std::uint64_t count) {
    return static_cast<std::uint64_t>(std::llround(static_cast<double>(count) / seconds));
  };
  CostRun cost{run.effective->dt, run.stats->wallSeconds / seconds, run.stats->cpuSeconds / seconds,
               perSecond(run.stats->steps), perSecond(run.stats->contactEvaluations)};
  for (const auto& [name, margin] : setup.averaging.endpoints)
    cost.numbers[name] = {endpointOf(endpointNamed(setup, name), setup, run)};
  return cost;
}

/// Averages one packing on one engine over the case's rotations, after settling.
/// @throws EngineFailure (also of a packing that blew up), UnsupportedScene, BadInput, Interrupted
CostRun averagePacking(Engine& engine, const EngineEntry& entry, const Case& setup,
                       const Packing& packing, const std::function<void(double)>& progress) {
  const Scene scene = couetteScene(setup, packing, timeStep(setup));
  const EffectiveParameters effective = loadScene(engine, entry, setup, scene);
  const ContactReport report =
      engine.capabilities().instantContacts ? ContactReport::instant : ContactReport::accumulated;
  const FlowTimes times = flowTimes(setup);
  const auto [settled, interval, samples] = times;
  const double end = times.end();
  double now = 0.0;
  const Scene asRun = sceneFor(engine.capabilities(), entry, setup, scene).scene;
  const AuditBasis basis = auditBasis(asRun, engine.capabilities(), effective);
  const auto advanceTo = [&](double time) {
    advanceInPieces(engine, effective, now, time);
    now = time;
    progress(time / end);
  };
  const auto sample = [&] {
    Snapshot snapshot = engine.snapshot(report);
    requireSound<2>(setup, scene, snapshot);
    if (const std::string why = auditFault(snapshot, basis); !why.empty()) {
      discardWorker(engine);
      throw EngineFailure(fmt::format("{}, {} at t = {:g} s: its snapshot cannot be: {}",
                                      entry.name, setup.name, snapshot.positionTime, why));
    }
    return snapshot;
  };

  // What blows up does so soon: long before it has settled.
  for (int k = 1; k <= 16; ++k) {
    advanceTo(settled * k / 16);
    sample();
  }
  const Stats before = engine.stats();
  ProfileAccumulator profiles(
      ringsOf(setup), weightsOf(setup, std::vector<std::string>{setup.averaging.methods.front()}),
      scene);
  for (int taken = 1; taken <= samples; ++taken) {
    advanceTo(settled + taken * interval);
    profiles.add(sample());
  }
  const Stats after = engine.stats();

  const double rotations = couetteIn(setup).times.rotations;
  const auto perRotation = [&](std::uint64_t count) {
    return static_cast<std::uint64_t>(std::llround(static_cast<double>(count) / rotations));
  };
  return {.dt = effective.dt,
          .wallSeconds = (after.wallSeconds - before.wallSeconds) / rotations,
          .cpuSeconds = (after.cpuSeconds - before.cpuSeconds) / rotations,
          .steps = perRotation(after.steps - before.steps),
          .contactEvaluations = perRotation(after.contactEvaluations - before.contactEvaluations),
          .numbers = numbersOf(setup, profiles.profiles())};
}

/// A measure at a ring; absent where the run has none.
std::optional<double> valueAt(const CostRun& run, const std::string& measure, std::size_t ring) {
  const auto found = run.numbers.find(measure);
  return found == run.numbers.end() || ring >= found->second.size() ? std::nullopt
                                                                    : found->second[ring];
}

std::size_t ringsIn(const CostRun& run, const std::string& measure) {
  const auto found = run.numbers.find(measure);
  return found == run.numbers.end() ? 0 : found->second.size();
}

}  // namespace

std::optional<PairedError> pairedError(const std::vector<CostRun>& runs,
                                       const std::vector<CostRun>& reference,
                                       const std::string& measure, double alpha,
                                       std::optional<double> unit) {
  double differences = 0.0, variances = 0.0, scale = 0.0, low = 0.0, high = 0.0;
  std::size_t rings = 0, withError = 0, all = 0;
  for (const CostRun& run : reference) all = std::max(all, ringsIn(run, measure));
  for (std::size_t ring = 0; ring < all; ++ring) {
    std::vector<std::optional<double>> paired, level;
    for (std::size_t k = 0; k < std::min(runs.size(), reference.size()); ++k) {
      const auto one = valueAt(runs[k], measure, ring);
      const auto other = valueAt(reference[k], measure, ring);
      level.push_back(other);
      paired.push_back(one && other ? std::optional(*one - *other) : std::nullopt);
    }
    if (const auto mean = ensembleMean(level)) scale = std::max(scale, std::abs(mean->mean));
    const auto difference = ensembleMean(paired);
    if (!difference) continue;
    ++rings;
    differences += difference->mean * difference->mean;
    if (!difference->standardError) continue;
    ++withError;
    variances += *difference->standardError * *difference->standardError;
    const double half =
        *difference->standardError *
        studentQuantile(1.0 - alpha / static_cast<double>(all), difference->packings - 1);
    low += std::pow(std::max(0.0, std::abs(difference->mean) - half), 2);
    high += std::pow(std::abs(difference->mean) + half, 2);
  }
  if (unit) scale = *unit;
  if (rings == 0 || !(scale > 0.0)) return std::nullopt;
  const auto count = static_cast<double>(rings);
  PairedError found{std::sqrt(differences / count) / scale, {}, {}, {}, {}};
  if (withError < rings) return found;
  found.statistical = std::sqrt(variances / count) / scale;
  found.systematic = std::sqrt(std::max(0.0, differences - variances) / count) / scale;
  found.low = std::sqrt(low / count) / scale;
  found.high = std::sqrt(high / count) / scale;
  return found;
}

namespace {

class AverageErrors final : public ErrorKind {
 public:
  using ErrorKind::ErrorKind;

  CostKind kind() const override { return CostKind::averages; }

  std::vector<std::string> measures() const override {
    if (isCell())
      return {"azimuthal_velocity", "stress_rr", "volume_fraction",
              "shear_band_width",   "wall_slip", "stress_level"};
    std::vector<std::string> names;
    for (const auto& [name, margin] : study_.setup.averaging.endpoints) names.push_back(name);
    return names;
  }

  std::size_t rounds() const override { return packings().size(); }

  double predicted(std::size_t engine, const CostSetting& setting) const override {
    const TimedEngine& timed = study_.engines[engine];
    constexpr double sample = 1e-3;
    return study_.packingCount() *
           (duration() / study_.stepOf(engine, setting.setup) * timed.step + timed.load +
            (isCell() ? 0.0 : timed.start) + sample * flowTimes(setting.setup).samples);
  }

  double commonTime() const override {
    const Cost& cost = study_.setup.cost;
    int missing = 0;
    for (std::size_t k = 0; k < packings().size(); ++k)
      missing += !study_.campaign.store().find(referenceName(k), referenceKey(k));
    return duration() * cost.averageReference / costContactTime(study_.setup) * study_.inHouseStep *
           missing / std::min<double>(study_.jobs, study_.packingCount());
  }

  double ownTime(std::size_t) const override { return 0.0; }
  bool keptSuffice() const override { return false; }

  void makeReferences() override {
    const EngineEntry& entry = study_.inHouse;
    const Case setup = atSteps(study_.setup, entry.name, study_.inHouseEngine->capabilities(),
                               study_.setup.cost.averageReference);
    std::vector<CachedTask<CostRun>> tasks;
    for (std::size_t k = 0; k < packings().size(); ++k)
      tasks.push_back({referenceName(k), fmt::format("packing {}", k), referenceKey(k), 1.0,
                       [&, k](const std::function<void(double)>& progress) {
                         const auto engine = entry.make();
                         return CachedTask<CostRun>::Outcome{
                             averagesOf(*engine, entry, setup, packings()[k], progress), true,
                             "done"};
                       }});
    reference_ = runOrLoad(tasks, study_.campaign.store(), study_.campaign.progress(),
                           "references of the averages", study_.jobs);
  }

  CostRun run(const PlannedPoint& planned, std::size_t round) override {
    return averagesOf(study_.workerOf(planned.engine), study_.entryOf(planned.engine),
                      study_.settingOf(planned).setup, packings()[round], [](double) {});
  }

  std::vector<CostPoint> points(const PlannedPoint& planned,
                                const std::vector<CostRun>& runs) const override {
    const CostPoint row =
        timedPoint(study_.entryOf(planned.engine).name, study_.settingOf(planned), kind(), runs);
    const double alpha =
        (1.0 - study_.setup.averaging.confidence) / static_cast<double>(measures().size());
    std::vector<CostPoint> points;
    for (const std::string& measure : measures()) {
      CostPoint& point = points.emplace_back(row);
      point.measure = measure;
      const auto error = pairedError(runs, reference_, measure, alpha, unitOf(measure));
      if (!error) continue;
      point.error = error->error;
      point.statistical = error->statistical;
      point.systematic = error->systematic;
      point.intervalLow = error->low;
      point.intervalHigh = error->high;
    }
    return points;
  }

  void addTo(CostResults& results) const override {
    if (!reference_.empty())
      results.references.push_back(
          {.kind = kind(),
           .engine = study_.inHouse.name,
           .setting = fmt::format("t_c/{:g}", study_.setup.cost.averageReference),
           .note = fmt::format("{} packings, paired: its statistical error is part of each point's",
                               reference_.size())});
  }

 private:
  const std::vector<Packing>& packings() const { return study_.campaign.packings(); }
  bool isCell() const { return cellOf(study_.setup) != nullptr; }
  double duration() const { return flowDuration(study_.setup); }  // [s]

  CostRun averagesOf(Engine& engine, const EngineEntry& entry, const Case& setup,
                     const Packing& packing, const std::function<void(double)>& progress) const {
    return isCell() ? averagePacking(engine, entry, setup, packing, progress)
                    : endpointsOfRun(entry, setup, packing, progress);
  }

  /// What errors are in units of where that is not the reference's size: wall slip is a share of
  /// the rim's speed already; of an endpoint with an absolute margin, ten margins, so that a margin
  /// is a tenth of it as one of a tenth of the value is.
  std::optional<double> unitOf(const std::string& measure) const {
    if (isCell()) return measure == "wall_slip" ? std::optional(1.0) : std::nullopt;
    const Margin& margin = study_.setup.averaging.endpoints.at(measure);
    if (endpointNamed(study_.setup, measure).byRatio) return std::nullopt;
    return 10.0 * margin.value;
  }

  std::string referenceName(std::size_t packing) const {
    return fmt::format("reference-averages-p{}", packing);
  }
  CaseKeys referenceKey(std::size_t packing) const {
    return study_.inHouseKey(packing, "cost: reference averages");
  }

  std::vector<CostRun> reference_;  ///< by packing
};

}  // namespace

std::unique_ptr<ErrorKind> averageErrors(CostStudy& study) {
  return std::make_unique<AverageErrors>(study);
}

}  // namespace crossgrain::inline studies

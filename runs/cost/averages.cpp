#include "runs/cost/averages.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "adapters/audit.hpp"
#include "averaging/agreement.hpp"
#include "averaging/profiles.hpp"
#include "averaging/statistics.hpp"
#include "cases/couette.hpp"
#include "cases/time_step.hpp"
#include "runs/common/engine_access.hpp"
#include "runs/common/engine_running.hpp"
#include "runs/cost/limits.hpp"
#include "runs/couette/run.hpp"
#include "runs/couette/summary.hpp"

namespace crossgrain::inline runs {

namespace {

constexpr const char* profileMeasures[] = {"azimuthal_velocity", "stress_rr", "volume_fraction"};

int snapshotsOf(const Case& setup) {
  const Averaging& averaging = setup.averaging;
  return std::max(
      1, static_cast<int>(std::lround(averaging.snapshotsPerRotation * averaging.rotations)));
}

}  // namespace

const std::vector<std::string>& averageMeasures() {
  static const std::vector<std::string> names = {"azimuthal_velocity", "stress_rr",
                                                 "volume_fraction",    "shear_band_width",
                                                 "wall_slip",          "stress_level"};
  return names;
}

std::string nameOf(const Sampling& sampling) {
  std::string name = sampling.method;
  if (sampling.every > 1) name += fmt::format("/{}", sampling.every);
  if (sampling.fraction < 1.0) name += fmt::format("@{:g}", sampling.fraction);
  return name;
}

Sampling samplingOf(const Case& setup, const CostSetting& setting) {
  const Averaging& averaging = setting.setup.averaging;
  return {averaging.methods.front(),
          std::max(1, setup.averaging.snapshotsPerRotation / averaging.snapshotsPerRotation)};
}

std::vector<Sampling> allSamplings(const Case& setup) {
  const std::string first = setup.averaging.methods.front();
  std::vector<Sampling> samplings = {{first}};
  for (const std::string& method : setup.cost.texts.at("method"))
    if (method != first) samplings.push_back({method});
  const int all = setup.averaging.snapshotsPerRotation;
  for (const double every : setup.cost.numbers.at("snapshots"))
    if (every > 1.0) samplings.push_back({first, all / snapshotsPerRotation(setup, every)});
  for (const double fraction : {0.25, 0.5}) samplings.push_back({first, 1, fraction});
  return samplings;
}

namespace {

/// One sampling's sums.
class SampledAverages {
 public:
  SampledAverages(const Sampling& sampling, const Case& setup, const Scene& scene)
      : sampling_(sampling),
        setup_(setup),
        most_(static_cast<int>(std::lround(sampling.fraction * snapshotsOf(setup)))),
        profiles_(ringsOf(setup), weightsOf(setup, std::vector<std::string>{sampling.method}),
                  scene) {}

  /// @param count  of snapshots, this one included
  void add(const Snapshot& snapshot, int count) {
    if (count % sampling_.every == 0 && (count <= most_ || profiles_.snapshots() == 0))
      profiles_.add(snapshot);
  }

  AveragedPacking::Numbers numbers() const {
    AveragedPacking::Numbers numbers;
    const std::vector<Profile> profiles = profiles_.profiles();
    const double rim = setup_.cell.omega * setup_.cell.innerRadius;
    for (const Profile& profile : profiles) {
      if (std::ranges::find(profileMeasures, profile.field) == std::end(profileMeasures)) continue;
      auto& rings = numbers[profile.field];
      const double unit = profile.field == profileMeasures[0] ? rim : 1.0;
      for (const auto& mean : profile.mean)
        rings.push_back(mean ? std::optional(*mean / unit) : std::nullopt);
    }
    for (const FitRow& fit : couetteFits(setup_, profiles)) {
      if (!fit.value) continue;
      if (fit.name == "velocity_decay") numbers["shear_band_width"] = {*fit.value};
      if (fit.name == "velocity_amplitude") numbers["wall_slip"] = {1.0 - *fit.value};
    }
    if (const auto stress = numbers.find("stress_rr"); stress != numbers.end())
      if (const auto level = ensembleMean(stress->second)) numbers["stress_level"] = {level->mean};
    return numbers;
  }

 private:
  Sampling sampling_;
  const Case& setup_;
  int most_;
  ProfileAccumulator profiles_;
};

}  // namespace

AveragedPacking averagePacking(Engine& engine, const EngineEntry& entry, const Case& setup,
                               const Packing& packing, const std::vector<Sampling>& samplings,
                               const std::function<void(double)>& progress) {
  const Scene scene = couetteScene(setup, packing, timeStep(setup));
  const Realised realised = loadScene(engine, entry, setup, scene);
  const ContactReport report =
      engine.capabilities().instantContacts ? ContactReport::instant : ContactReport::accumulated;
  const double settled = setup.averaging.settleRotations * rotationTime(setup);
  const int samples = snapshotsOf(setup);
  const double interval = setup.averaging.rotations * rotationTime(setup) / samples;
  const double end = settled + samples * interval;
  double now = 0.0;
  const Scene asRun = sceneFor(engine.capabilities(), entry, setup, scene).scene;
  const AuditBasis basis = auditBasis(asRun, engine.capabilities(), realised);
  const auto advanceTo = [&](double time) {
    advanceInPieces(engine, realised, now, time);
    now = time;
    progress(time / end);
  };
  const auto sample = [&] {
    Snapshot seen = engine.snapshot(report);
    if (const std::string wild = blowUp(setup, seen); !wild.empty()) throw EngineFailure(wild);
    if (const std::string why = whyUnsound(seen, basis); !why.empty()) {
      distrust(engine);
      throw EngineFailure(fmt::format("{}, {} at t = {:g} s: its snapshot cannot be: {}",
                                      entry.name, setup.name, seen.positionTime, why));
    }
    return seen;
  };

  // What blows up does so soon: it need not settle for long to be seen.
  for (int k = 1; k <= 16; ++k) {
    advanceTo(settled * k / 16);
    sample();
  }
  const Stats before = engine.stats();
  std::vector<SampledAverages> averages;
  averages.reserve(samplings.size());
  for (const Sampling& sampling : samplings) averages.emplace_back(sampling, setup, scene);
  for (int taken = 1; taken <= samples; ++taken) {
    advanceTo(settled + taken * interval);
    const Snapshot seen = sample();
    for (SampledAverages& each : averages) each.add(seen, taken);
  }
  const Stats after = engine.stats();

  const double rotations = setup.averaging.rotations;
  const auto perRotation = [&](std::uint64_t count) {
    return static_cast<std::uint64_t>(std::llround(static_cast<double>(count) / rotations));
  };
  AveragedPacking run{
      .dt = realised.dt,
      .wallSeconds = (after.wallSeconds - before.wallSeconds) / rotations,
      .cpuSeconds = (after.cpuSeconds - before.cpuSeconds) / rotations,
      .steps = perRotation(after.steps - before.steps),
      .contactEvaluations = perRotation(after.contactEvaluations - before.contactEvaluations)};
  for (std::size_t k = 0; k < samplings.size(); ++k)
    run.samplings[nameOf(samplings[k])] = averages[k].numbers();
  return run;
}

namespace {

/// A measure over rings; empty where the run has none.
const std::vector<std::optional<double>>& valuesOf(const AveragedPacking& run,
                                                   const std::string& sampling,
                                                   const std::string& measure) {
  static const std::vector<std::optional<double>> none;
  const auto sampled = run.samplings.find(sampling);
  if (sampled == run.samplings.end()) return none;
  const auto found = sampled->second.find(measure);
  return found == sampled->second.end() ? none : found->second;
}

std::optional<double> valueAt(const std::vector<std::optional<double>>& rings, std::size_t ring) {
  return ring < rings.size() ? rings[ring] : std::nullopt;
}

}  // namespace

std::optional<WeakError> weakError(const std::vector<AveragedPacking>& runs,
                                   const std::string& sampling,
                                   const std::vector<AveragedPacking>& reference,
                                   const std::string& referenceSampling, const std::string& measure,
                                   double alpha) {
  double differences = 0.0, variances = 0.0, scale = 0.0;
  ErrorInterval squares;
  std::size_t rings = 0, withError = 0, all = 0;
  for (const AveragedPacking& run : reference)
    all = std::max(all, valuesOf(run, referenceSampling, measure).size());
  for (std::size_t ring = 0; ring < all; ++ring) {
    std::vector<std::optional<double>> paired, level;
    for (std::size_t k = 0; k < std::min(runs.size(), reference.size()); ++k) {
      const auto one = valueAt(valuesOf(runs[k], sampling, measure), ring);
      const auto other = valueAt(valuesOf(reference[k], referenceSampling, measure), ring);
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
    squares.low += std::pow(std::max(0.0, std::abs(difference->mean) - half), 2);
    squares.high += std::pow(std::abs(difference->mean) + half, 2);
  }
  if (measure == "wall_slip") scale = 1.0;  // it is a fraction of the rim's speed already
  if (rings == 0 || !(scale > 0.0)) return std::nullopt;
  const auto count = static_cast<double>(rings);
  WeakError found{std::sqrt(differences / count) / scale, {}, {}, {}};
  if (withError < rings) return found;
  found.statistical = std::sqrt(variances / count) / scale;
  found.systematic = std::sqrt(std::max(0.0, differences - variances) / count) / scale;
  found.interval = {std::sqrt(squares.low / count) / scale,
                    std::sqrt(squares.high / count) / scale};
  return found;
}

}  // namespace crossgrain::inline runs

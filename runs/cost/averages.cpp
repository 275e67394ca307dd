#include "runs/cost/averages.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "averaging/agreement.hpp"
#include "averaging/profiles.hpp"
#include "averaging/statistics.hpp"
#include "cases/couette.hpp"
#include "cases/time_step.hpp"
#include "runs/common/advance.hpp"
#include "runs/common/audited_looks.hpp"
#include "runs/common/engine_access.hpp"
#include "runs/couette/run.hpp"
#include "runs/couette/summary.hpp"
#include "runs/lockstep/lockstep.hpp"
#include "support/task_pool.hpp"

namespace crossgrain::inline runs {

namespace {

constexpr const char* profileMeasures[] = {"azimuthal_velocity", "stress_rr", "volume_fraction"};

int snapshotsOf(const Case& setup) {
  const Averaging& averaging = setup.averaging;
  return std::max(
      1, static_cast<int>(std::lround(averaging.snapshotsPerRotation * averaging.rotations)));
}

std::map<std::string, std::vector<std::optional<double>>> numbersOf(
    const Case& setup, const std::vector<Profile>& profiles) {
  std::map<std::string, std::vector<std::optional<double>>> numbers;
  const double rim = setup.cell.omega * setup.cell.innerRadius;
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

}  // namespace

const std::vector<std::string>& averageMeasures() {
  static const std::vector<std::string> names = {"azimuthal_velocity", "stress_rr",
                                                 "volume_fraction",    "shear_band_width",
                                                 "wall_slip",          "stress_level"};
  return names;
}

AveragedPacking averagePacking(Engine& engine, const EngineEntry& entry, const Case& setup,
                               const Packing& packing,
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
  const AuditedLooks audited(engine, entry, setup, scene, realised);
  const auto advanceTo = [&](double time) {
    advanceInPieces(engine, realised, now, time);
    now = time;
    progress(time / end);
  };
  const auto sample = [&] {
    Snapshot snapshot = engine.snapshot(report);
    requireSound(setup, snapshot);
    audited.require(snapshot, std::nullopt);
    return snapshot;
  };

  // What blows up does so soon: it need not settle for long to be seen.
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

  const double rotations = setup.averaging.rotations;
  const auto perRotation = [&](std::uint64_t count) {
    return static_cast<std::uint64_t>(std::llround(static_cast<double>(count) / rotations));
  };
  return {.dt = realised.dt,
          .wallSeconds = (after.wallSeconds - before.wallSeconds) / rotations,
          .cpuSeconds = (after.cpuSeconds - before.cpuSeconds) / rotations,
          .steps = perRotation(after.steps - before.steps),
          .contactEvaluations = perRotation(after.contactEvaluations - before.contactEvaluations),
          .numbers = numbersOf(setup, profiles.profiles())};
}

namespace {

/// A measure at a ring; absent where the run has none.
std::optional<double> valueAt(const AveragedPacking& run, const std::string& measure,
                              std::size_t ring) {
  const auto found = run.numbers.find(measure);
  return found == run.numbers.end() || ring >= found->second.size() ? std::nullopt
                                                                    : found->second[ring];
}

std::size_t ringsIn(const AveragedPacking& run, const std::string& measure) {
  const auto found = run.numbers.find(measure);
  return found == run.numbers.end() ? 0 : found->second.size();
}

}  // namespace

std::optional<PairedError> pairedError(const std::vector<AveragedPacking>& runs,
                                       const std::vector<AveragedPacking>& reference,
                                       const std::string& measure, double alpha) {
  double differences = 0.0, variances = 0.0, scale = 0.0, low = 0.0, high = 0.0;
  std::size_t rings = 0, withError = 0, all = 0;
  for (const AveragedPacking& run : reference) all = std::max(all, ringsIn(run, measure));
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
  if (measure == "wall_slip") scale = 1.0;  // it is a fraction of the rim's speed already
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

/// Settling and averaging [s].
double lengthOf(const Case& setup) {
  return (setup.averaging.settleRotations + setup.averaging.rotations) * rotationTime(setup);
}

/// By what the reference's runs with the case's law are kept.
constexpr const char* sceneLaw = "in-house";

std::string referenceName(const std::string& name, std::size_t packing) {
  return fmt::format("reference-averages-{}-p{}", name, packing);
}

std::string ofPacking(const std::string& point, std::size_t packing) {
  return fmt::format("{}-p{}", point, packing);
}

/// Whether two scenes differ at most in how time is stepped.
bool sameInTheLimit(const Scene& one, const Scene& other) {
  ContactLaw law = one.law;
  law.conventions.integrator = other.law.conventions.integrator;
  law.conventions.dampingVelocity = other.law.conventions.dampingVelocity;
  law.conventions.springUpdate = other.law.conventions.springUpdate;
  return law == other.law && one.bottom == other.bottom && one.gravity == other.gravity &&
         one.rotation == other.rotation;
}

}  // namespace

std::vector<std::string> AverageErrors::measures() const {
  std::vector<std::string> names;
  for (const std::string& measure : averageMeasures()) {
    names.push_back(measure);
    names.push_back(ownOf(measure));
  }
  return names;
}

double AverageErrors::predicted(std::size_t engine, const CostSetting& setting) const {
  const TimedEngine& timed = study_.engines[engine];
  const Case& setup = setting.setup;
  constexpr double sample = 1e-3;
  return study_.packingCount() *
         (lengthOf(setup) / study_.stepOf(engine, setup) * timed.step + timed.load +
          sample * setup.averaging.rotations * setup.averaging.snapshotsPerRotation);
}

double AverageErrors::commonTime() const {
  return referenceSeconds(sceneLaw);
}

double AverageErrors::ownTime(std::size_t engine) const {
  const OwnReference own = ownReferenceOf(engine);
  return own.mirror ? referenceSeconds(own.mirror->name) : 0.0;
}

bool AverageErrors::isKept(const PlannedPoint& point) const {
  const auto last = static_cast<int>(study_.campaign.packings().size()) - 1;
  return ErrorKind::isKept(point) ||
         study_.campaign.store()
             .find(ofPacking(study_.nameOf(point), static_cast<std::size_t>(last)),
                   study_.keyOf(point, last))
             .has_value();
}

double AverageErrors::referenceSeconds(const std::string& name) const {
  const Case& setup = study_.setup;
  int missing = 0;
  for (std::size_t k = 0; k < study_.campaign.packings().size(); ++k)
    if (!study_.campaign.store().find(referenceName(name, k), referenceKey(name, k))) ++missing;
  return lengthOf(setup) * setup.cost.averageReference / costContactTime(setup) *
         study_.inHouseStep * missing / std::min<double>(study_.jobs, study_.packingCount());
}

CaseKeys AverageErrors::referenceKey(const std::string& name, std::size_t packing) const {
  return study_.inHouseKey(packing, "cost: reference " + name);
}

std::vector<AveragedPacking> AverageErrors::referenceRuns(
    const std::string& name, const EngineEntry& entry, const Case& setup,
    const std::function<void(std::size_t packing, double fraction)>& progress) const {
  const std::vector<Packing>& packings = study_.campaign.packings();
  std::vector<AveragedPacking> runs(packings.size());
  std::vector<Task> tasks;
  for (std::size_t k = 0; k < packings.size(); ++k)
    tasks.push_back({1.0, [&, k] {
                       runs[k] = keptOr(study_.campaign.store(), referenceName(name, k),
                                        referenceKey(name, k), [&] {
                                          const auto engine = entry.make();
                                          return averagePacking(*engine, entry, setup, packings[k],
                                                                [&](double f) { progress(k, f); });
                                        });
                     }});
  runTasks(tasks, study_.jobs);
  return runs;
}

Case AverageErrors::fine(const std::string& engine, const Capabilities& can) const {
  return atSteps(study_.setup, engine, can, study_.setup.cost.averageReference);
}

void AverageErrors::makeReferences() {
  Progress& progress = study_.campaign.progress();
  progress.begin("references of the averages",
                 std::vector<double>(study_.campaign.packings().size(), 1.0));
  reference_ = referenceRuns(sceneLaw, study_.inHouse,
                             fine(study_.inHouse.name, study_.inHouseEngine->capabilities()),
                             [&](std::size_t packing, double fraction) {
                               const std::string label = fmt::format("packing {}", packing);
                               if (fraction < 1.0)
                                 progress.update(packing, label, fraction);
                               else
                                 progress.finish(packing, label + ": done");
                             });
}

AverageErrors::OwnReference AverageErrors::ownReferenceOf(std::size_t engine) const {
  const EngineEntry& entry = study_.entryOf(engine);
  const Capabilities& can = study_.canOf(engine);
  const Scene scene =
      couetteScene(study_.setup, study_.campaign.packings().front(), study_.campaign.dt());
  OwnReference own;
  try {
    own.isTheScenes = sameInTheLimit(sceneFor(can, entry, study_.setup, scene).scene, scene);
  } catch (const UnsupportedScene& refusal) {
    own.reason = refusal.what();
  }
  if (own.isTheScenes || !own.reason.empty()) return own;
  own.reason = whyNoMirror(entry, can, study_.setup);
  if (!own.reason.empty()) return own;
  for (const EngineEntry& mirror : engineRegistry())
    if (mirror.mirrors == entry.name && standsForItsPeer(mirror, study_.setup.law))
      own.mirror = &mirror;
  if (!own.mirror) own.reason = "no mirror has the law that it declares";
  return own;
}

std::vector<AveragedPacking> AverageErrors::ownRuns(std::size_t engine,
                                                    const OwnReference& own) const {
  if (own.isTheScenes) return reference_;
  if (!own.mirror) return {};
  return referenceRuns(own.mirror->name, *own.mirror,
                       fine(study_.entryOf(engine).name, study_.canOf(engine)),
                       [](std::size_t, double) {});
}

std::vector<CostPoint> AverageErrors::measure(const PlannedPoint& planned) {
  const CostSetting& setting = study_.settingOf(planned);
  const EngineEntry& entry = study_.entryOf(planned.engine);
  std::vector<AveragedPacking> runs;
  for (std::size_t k = 0; k < study_.campaign.packings().size(); ++k)
    runs.push_back(keptOr(study_.campaign.store(), ofPacking(study_.nameOf(planned), k),
                          study_.keyOf(planned, static_cast<int>(k)), [&] {
                            return averagePacking(study_.workerOf(planned.engine), entry,
                                                  setting.setup, study_.campaign.packings()[k],
                                                  [](double) {});
                          }));
  CostPoint row = pointOf(entry.name, setting, kind(), runs.front().dt);
  row.wallSeconds = row.cpuSeconds = std::numeric_limits<double>::infinity();
  std::uint64_t steps = 0, contactEvaluations = 0;
  for (const AveragedPacking& run : runs) {
    row.wallSeconds = std::min(*row.wallSeconds, run.wallSeconds);
    row.cpuSeconds = std::min(*row.cpuSeconds, run.cpuSeconds);
    steps += run.steps / runs.size();
    contactEvaluations += run.contactEvaluations / runs.size();
  }
  countWork(row, steps, contactEvaluations);

  const OwnReference own = ownReferenceOf(planned.engine);
  const std::vector<AveragedPacking> ownLaw = ownRuns(planned.engine, own);
  const auto against = [&](const std::vector<AveragedPacking>& reference,
                           const std::string& measure) {
    CostPoint point = row;
    const auto error = pairedError(runs, reference, measure, alpha());
    if (!error) return point;
    point.error = error->error;
    point.statistical = error->statistical;
    point.systematic = error->systematic;
    point.intervalLow = error->low;
    point.intervalHigh = error->high;
    return point;
  };
  std::vector<CostPoint> points;
  for (const std::string& measure : averageMeasures()) {
    points.push_back(against(reference_, measure));
    points.back().measure = measure;
    points.push_back(against(ownLaw, measure));
    points.back().measure = ownOf(measure);
    if (own.reason.empty()) continue;
    points.back().status = CostStatus::refused;
    points.back().reason = "averages of its own law are not known: " + own.reason;
  }
  return points;
}

double AverageErrors::alpha() const {
  return (1.0 - study_.setup.averaging.confidence) / static_cast<double>(averageMeasures().size());
}

void AverageErrors::addTo(CostResults& results) const {
  if (reference_.empty()) return;
  const auto add = [&](const std::string& engine) {
    results.references.push_back(
        {.kind = kind(),
         .engine = engine,
         .setting = fmt::format("t_c/{:g}", study_.setup.cost.averageReference),
         .note = fmt::format("{} packings, paired: its statistical error is part of each point's",
                             reference_.size())});
  };
  add(study_.inHouse.name);
  for (std::size_t e = 0; e < study_.engines.size(); ++e) {
    const std::string& name = study_.entryOf(e).name;
    const bool measured = std::ranges::any_of(results.points, [&](const CostPoint& point) {
      return point.engine == name && point.kind == kind() && point.measured();
    });
    if (!measured) continue;
    const OwnReference own = ownReferenceOf(e);
    if (!own.mirror) continue;
    add(own.mirror->name);
    const std::vector<AveragedPacking> runs = ownRuns(e, own);
    for (const std::string& measure : averageMeasures())
      if (const auto model = pairedError(runs, reference_, measure, alpha()); model && model->low)
        results.models.push_back({name, kind(), measure, model->error, *model->low, *model->high});
  }
}

}  // namespace crossgrain::inline runs

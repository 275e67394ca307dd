#include "runs/cost/average_errors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "cases/couette.hpp"
#include "cases/loader.hpp"
#include "cases/time_step.hpp"
#include "runs/cost/kept.hpp"
#include "runs/couette/run.hpp"
#include "runs/lockstep/lockstep.hpp"
#include "support/task_pool.hpp"

namespace crossgrain::inline runs {

namespace {

/// Settling and averaging [s].
double lengthOf(const Case& setup) {
  return (setup.averaging.settleRotations + setup.averaging.rotations) * rotationTime(setup);
}

/// By what the reference's runs with the case's law are kept.
constexpr const char* sceneLaw = "in-house";

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
  if (setting.isSampling()) return 0.0;
  if (setting.windowsOnly) return bounds_.predicted(engine, setting);
  const TimedEngine& timed = study_.engines[engine];
  const Case& setup = setting.setup;
  constexpr double sample = 1e-3;
  return study_.packingCount() *
             (lengthOf(setup) / study_.stepOf(engine, setup) * timed.step + timed.load +
              sample * setup.averaging.rotations * setup.averaging.snapshotsPerRotation) +
         bounds_.predicted(engine, setting);
}

ReferenceCost AverageErrors::referenceCost(const std::vector<bool>& anew, double budget) const {
  const double common = referenceSeconds(sceneLaw) +
                        static_cast<double>(bounds_.constants()) * referenceSeconds(sceneLaw);
  constexpr double largestPart = 0.8;
  if (common > largestPart * budget)
    return {.impossible = fmt::format("the reference alone would take about {:.3g} s of {:.3g} s",
                                      common, budget),
            .budgetLeftOut = common / largestPart};
  ReferenceCost cost{.common = common, .own = std::vector<double>(anew.size(), 0.0)};
  for (std::size_t e = 0; e < anew.size(); ++e) {
    if (!anew[e]) continue;
    const OwnReference own = ownLawOf(e);
    if (own.mirror) cost.own[e] += referenceSeconds(own.mirror->name);
    if (own.reason.empty()) cost.own[e] += bounds_.predictedReference(e);
  }
  return cost;
}

double AverageErrors::referenceSeconds(const std::string& name) const {
  const Case& setup = study_.setup;
  int missing = 0;
  for (std::size_t k = 0; k < study_.campaign.packings().size(); ++k)
    if (!study_.campaign.store().find(referenceName(name, k), referenceKey(name, k))) ++missing;
  return lengthOf(setup) * setup.cost.averageReference / costContactTime(setup) *
         study_.inHouseStep * missing / std::min<double>(study_.jobs, study_.packingCount());
}

std::string AverageErrors::referenceName(const std::string& name, std::size_t packing) const {
  return fmt::format("reference-averages-{}-p{}", name, packing);
}

CaseKeys AverageErrors::referenceKey(const std::string& name, std::size_t packing) const {
  return study_.inHouseKey(packing, "cost: reference " + name);
}

std::vector<AveragedPacking> AverageErrors::referenceRuns(
    const std::string& name, const EngineEntry& entry, const Case& setup,
    const std::function<void(std::size_t packing, double fraction)>& progress) {
  const std::vector<Packing>& packings = study_.campaign.packings();
  std::vector<AveragedPacking> runs(packings.size());
  std::vector<Task> tasks;
  for (std::size_t k = 0; k < packings.size(); ++k)
    tasks.push_back({1.0, [&, k] {
                       runs[k] = keptOr(study_.campaign.store(), referenceName(name, k),
                                        referenceKey(name, k), [&] {
                                          const auto engine = entry.make();
                                          return averagePacking(*engine, entry, setup, packings[k],
                                                                allSamplings(study_.setup),
                                                                [&](double f) { progress(k, f); });
                                        });
                     }});
  runTasks(tasks, study_.jobs);
  return runs;
}

std::vector<AveragedPacking> AverageErrors::inHouseRuns(const std::string& name,
                                                        const Case& setup) {
  Progress& progress = study_.campaign.progress();
  progress.begin("references of the averages: " + name,
                 std::vector<double>(study_.campaign.packings().size(), 1.0));
  return referenceRuns(name, study_.inHouse, setup, [&](std::size_t packing, double fraction) {
    const std::string label = fmt::format("packing {}", packing);
    if (fraction < 1.0)
      progress.update(packing, label, fraction);
    else
      progress.finish(packing, label + ": done");
  });
}

void AverageErrors::makeReferences() {
  const auto fine = [&](const Case& setup) {
    return caseWith(setup,
                    stepFragment(setup, study_.inHouse.name, study_.inHouseEngine->capabilities(),
                                 setup.cost.averageReference));
  };
  const Case reference = fine(study_.setup);
  reference_ = inHouseRuns(sceneLaw, reference);
  bounds_.respond(reference_, [&](const std::string& name, const Case& changed) {
    Case setup = reference;  // its step, and the changed law
    setup.run.dt = timeStep(reference);
    setup.law = changed.law;
    return inHouseRuns(name, setup);
  });
}

AverageErrors::OwnReference AverageErrors::ownLawOf(std::size_t engine) const {
  const EngineEntry& entry = study_.entryOf(engine);
  const Capabilities& can = *study_.campaign.capabilities(engine);
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

const AverageErrors::OwnReference& AverageErrors::ownReference(std::size_t engine) {
  if (const auto found = own_.find(engine); found != own_.end()) return found->second;
  OwnReference own = ownLawOf(engine);
  if (own.mirror)
    own.runs =
        referenceRuns(own.mirror->name, *own.mirror,
                      caseWith(study_.setup, stepFragment(study_.setup, study_.entryOf(engine).name,
                                                          *study_.campaign.capabilities(engine),
                                                          study_.setup.cost.averageReference)),
                      [](std::size_t, double) {});
  return own_[engine] = std::move(own);
}

std::string AverageErrors::obstacle(const PlannedPoint& point) const {
  return study_.settingOf(point).isSampling() && !caseRuns_.contains(point.engine)
             ? "another look at runs of the case as it is, and there are none"
             : "";
}

std::vector<AveragedPacking> AverageErrors::runsOf(const PlannedPoint& point) {
  const CostSetting& setting = study_.settingOf(point);
  const std::vector<Sampling> samplings =
      point.setting == 0 ? allSamplings(study_.setup)
                         : std::vector<Sampling>{samplingOf(study_.setup, setting)};
  std::vector<AveragedPacking> runs;
  for (std::size_t k = 0; k < study_.campaign.packings().size(); ++k) {
    const auto packing = static_cast<int>(k);
    runs.push_back(keptOr(
        study_.campaign.store(), study_.nameOf(point, packing), study_.keyOf(point, packing), [&] {
          return averagePacking(study_.workers.of(point.engine), study_.entryOf(point.engine),
                                setting.setup, study_.campaign.packings()[k], samplings,
                                [](double) {});
        }));
  }
  return runs;
}

std::vector<CostPoint> AverageErrors::measure(const PlannedPoint& point) {
  const CostSetting& setting = study_.settingOf(point);
  std::vector<AveragedPacking> runs;
  if (!setting.windowsOnly)
    runs = setting.isSampling() ? caseRuns_.at(point.engine) : runsOf(point);
  if (point.setting == 0) caseRuns_[point.engine] = runs;
  const OwnReference& own = ownReference(point.engine);
  std::optional<SettingWindows> windows;
  if (bounds_.appliesTo(point.engine, setting)) windows = bounds_.windowsOf(point);

  const CostPoint row = rowOf(point, runs, windows);
  const auto bounded = [&](const std::string& measure) {
    return row.equivalent ? bounds_.bound(*row.equivalent, measure) : std::nullopt;
  };
  std::vector<CostPoint> points;
  for (const std::string& measure : averageMeasures()) {
    points.push_back(against(row, runs, reference_, setting, measure));
    if (own.isTheScenes) points.back().bound = bounded(measure);
    points.push_back(against(row, runs, own.isTheScenes ? reference_ : own.runs, setting, measure));
    CostPoint& ofOwn = points.back();
    ofOwn.measure = ownOf(measure);
    ofOwn.bound = bounded(measure);
    if (own.reason.empty()) continue;
    ofOwn.status = CostStatus::refused;
    ofOwn.reason = "averages of its own law are not known: " + own.reason;
  }
  return points;
}

CostPoint AverageErrors::rowOf(const PlannedPoint& point, const std::vector<AveragedPacking>& runs,
                               const std::optional<SettingWindows>& windows) const {
  const std::string& engine = study_.entryOf(point.engine).name;
  const CostSetting& setting = study_.settingOf(point);
  CostPoint row = pointOf(engine, setting, kind(), runs.empty() ? windows->dt : runs.front().dt);
  if (windows) row.equivalent = windows->equivalent;
  if (runs.empty()) {
    row.wallSeconds = windows->wallSeconds;
    row.cpuSeconds = windows->cpuSeconds;
    countWork(row, windows->steps, windows->contactEvaluations);
    return row;
  }
  row.wallSeconds = row.cpuSeconds = std::numeric_limits<double>::infinity();
  std::uint64_t steps = 0, contactEvaluations = 0;
  for (const AveragedPacking& run : runs) {
    row.wallSeconds = std::min(*row.wallSeconds, run.wallSeconds);
    row.cpuSeconds = std::min(*row.cpuSeconds, run.cpuSeconds);
    steps += run.steps / runs.size();
    contactEvaluations += run.contactEvaluations / runs.size();
  }
  countWork(row, steps, contactEvaluations);
  return row;
}

CostPoint AverageErrors::against(CostPoint row, const std::vector<AveragedPacking>& runs,
                                 const std::vector<AveragedPacking>& reference,
                                 const CostSetting& setting, const std::string& measure) const {
  row.measure = measure;
  const auto error = weakError(runs, nameOf(samplingOf(study_.setup, setting)), reference,
                               nameOf(allSamplings(study_.setup).front()), measure, alpha());
  if (!error) return row;
  row.error = error->error;
  row.statistical = error->statistical;
  row.systematic = error->systematic;
  if (!error->interval) return row;
  row.low = error->interval->low;
  row.high = error->interval->high;
  return row;
}

double AverageErrors::alpha() const {
  return (1.0 - study_.setup.averaging.confidence) / static_cast<double>(averageMeasures().size());
}

std::vector<StatisticalFall> AverageErrors::falls() const {
  std::vector<StatisticalFall> falls;
  const Averaging& averaging = study_.setup.averaging;
  for (const auto& [engine, runs] : caseRuns_)
    for (const std::string& measure : averageMeasures())
      for (const double fraction : {0.25, 0.5, 1.0}) {
        const std::string sampling = nameOf({averaging.methods.front(), 1, fraction});
        const auto error = weakError(runs, sampling, reference_, sampling, measure, alpha());
        if (error && error->statistical)
          falls.push_back({study_.entryOf(engine).name, measure, fraction * averaging.rotations,
                           *error->statistical});
      }
  return falls;
}

void AverageErrors::addTo(CostResults& results) const {
  results.averages.falls = falls();
  results.averages.responses = bounds_.responses();
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
  for (const auto& [engine, own] : own_) {
    if (own.mirror) add(own.mirror->name);
    addModel(results, engine, own);
  }
}

void AverageErrors::addModel(CostResults& results, std::size_t engine,
                             const OwnReference& own) const {
  if (!own.mirror) return;
  const std::string whole = nameOf(allSamplings(study_.setup).front());
  for (const std::string& measure : averageMeasures())
    if (const auto model = weakError(own.runs, whole, reference_, whole, measure, alpha());
        model && model->interval)
      results.models.push_back({study_.entryOf(engine).name, kind(), measure, model->error,
                                model->interval->low, model->interval->high});
}

}  // namespace crossgrain::inline runs

#include "runs/cost/average_errors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "cases/couette.hpp"
#include "cases/loader.hpp"
#include "runs/cost/kept.hpp"
#include "runs/couette/run.hpp"
#include "support/task_pool.hpp"

namespace crossgrain::inline runs {

namespace {

/// Settling and averaging [s].
double lengthOf(const Case& setup) {
  return (setup.averaging.settleRotations + setup.averaging.rotations) * rotationTime(setup);
}

}  // namespace

double AverageErrors::predicted(std::size_t engine, const CostSetting& setting) const {
  if (setting.isSampling()) return 0.0;
  const TimedEngine& timed = study_.engines[engine];
  const Case& setup = setting.setup;
  constexpr double sample = 1e-3;
  return study_.packingCount() *
         (lengthOf(setup) / study_.stepOf(engine, setup) * timed.step + timed.load +
          sample * setup.averaging.rotations * setup.averaging.snapshotsPerRotation);
}

ReferenceCost AverageErrors::referenceCost(const std::vector<bool>&, double budget) const {
  const Case& setup = study_.setup;
  int missing = 0;
  for (std::size_t k = 0; k < study_.campaign.packings().size(); ++k)
    if (!study_.campaign.store().find(referenceName(k), referenceKey(k))) ++missing;
  const double takes = lengthOf(setup) * setup.cost.averageReference / costContactTime(setup) *
                       study_.inHouseStep * missing /
                       std::min<double>(study_.jobs, study_.packingCount());
  constexpr double largestPart = 0.8;
  if (takes <= largestPart * budget) return {.common = takes};
  return {.impossible = fmt::format("the reference alone would take about {:.3g} s of {:.3g} s",
                                    takes, budget),
          .budgetLeftOut = takes / largestPart};
}

std::string AverageErrors::referenceName(std::size_t packing) const {
  return fmt::format("reference-averages-p{}", packing);
}

CaseKeys AverageErrors::referenceKey(std::size_t packing) const {
  return study_.inHouseKey(packing, "cost: reference");
}

void AverageErrors::makeReferences() {
  Campaign& campaign = study_.campaign;
  const std::size_t count = campaign.packings().size();
  reference_.resize(count);
  campaign.progress().begin("reference of the averages", std::vector<double>(count, 1.0));
  const Case fine = caseWith(study_.setup, stepFragment(study_.setup, study_.inHouse.name,
                                                        study_.inHouseEngine->capabilities(),
                                                        study_.setup.cost.averageReference));
  std::vector<Task> tasks;
  for (std::size_t k = 0; k < count; ++k)
    tasks.push_back(
        {1.0, [&, k] {
           const std::string label = fmt::format("reference, packing {}", k);
           reference_[k] = keptOr(campaign.store(), referenceName(k), referenceKey(k), [&] {
             const auto engine = study_.inHouse.make();
             return averagePacking(*engine, study_.inHouse, fine, campaign.packings()[k],
                                   allSamplings(study_.setup),
                                   [&](double f) { campaign.progress().update(k, label, f); });
           });
           campaign.progress().finish(k, label + ": done");
         }});
  runTasks(tasks, study_.jobs);
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
  const std::vector<AveragedPacking> runs =
      setting.isSampling() ? caseRuns_.at(point.engine) : runsOf(point);
  if (point.setting == 0) caseRuns_[point.engine] = runs;

  CostPoint row = pointOf(study_.entryOf(point.engine).name, setting, kind(), runs.front().dt);
  row.wallSeconds = row.cpuSeconds = std::numeric_limits<double>::infinity();
  std::uint64_t steps = 0, contactEvaluations = 0;
  for (const AveragedPacking& run : runs) {
    row.wallSeconds = std::min(*row.wallSeconds, run.wallSeconds);
    row.cpuSeconds = std::min(*row.cpuSeconds, run.cpuSeconds);
    steps += run.steps / runs.size();
    contactEvaluations += run.contactEvaluations / runs.size();
  }
  countWork(row, steps, contactEvaluations);
  const std::string sampling = nameOf(samplingOf(study_.setup, setting));
  const std::string whole = nameOf(allSamplings(study_.setup).front());
  std::vector<CostPoint> points;
  for (const std::string& measure : averageMeasures()) {
    row.measure = measure;
    const auto error = weakError(runs, sampling, reference_, whole, measure);
    row.error = error ? std::optional(error->error) : std::nullopt;
    row.statistical = error ? error->statistical : std::nullopt;
    row.systematic = error ? error->systematic : std::nullopt;
    points.push_back(row);
  }
  return points;
}

std::vector<StatisticalFall> AverageErrors::falls() const {
  std::vector<StatisticalFall> falls;
  const Averaging& averaging = study_.setup.averaging;
  for (const auto& [engine, runs] : caseRuns_)
    for (const std::string& measure : averageMeasures())
      for (const double fraction : {0.25, 0.5, 1.0}) {
        const std::string sampling = nameOf({averaging.methods.front(), 1, fraction});
        const auto error = weakError(runs, sampling, reference_, sampling, measure);
        if (error && error->statistical)
          falls.push_back({study_.entryOf(engine).name, measure, fraction * averaging.rotations,
                           *error->statistical});
      }
  return falls;
}

void AverageErrors::addTo(CostResults& results) const {
  results.averages.falls = falls();
  if (reference_.empty()) return;
  results.references.push_back(
      {.kind = kind(),
       .engine = study_.inHouse.name,
       .setting = fmt::format("t_c/{:g}", study_.setup.cost.averageReference),
       .note = fmt::format("{} packings, paired: its statistical error is part of each point's",
                           reference_.size())});
}

}  // namespace crossgrain::inline runs

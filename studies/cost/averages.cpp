#include "studies/cost/averages.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "averaging/agreement.hpp"
#include "averaging/statistics.hpp"
#include "cases/flow.hpp"
#include "cases/time_step.hpp"
#include "results/flow_numbers.hpp"
#include "studies/core/engine_access.hpp"
#include "studies/core/executor.hpp"
#include "studies/flow/endpoint_values.hpp"
#include "studies/flow/run.hpp"
#include "support/numbers.hpp"

namespace crossgrain::inline studies {

namespace {

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

/// Absent where the run has no such number.
std::optional<double> valueOf(const CostRun& run, const std::string& measure) {
  const auto found = run.numbers.find(measure);
  return found == run.numbers.end() || found->second.empty() ? std::nullopt : found->second.front();
}

}  // namespace

std::optional<PairedError> pairedError(const std::vector<CostRun>& runs,
                                       const std::vector<CostRun>& reference,
                                       const std::string& measure, double alpha,
                                       std::optional<double> unit) {
  std::vector<std::optional<double>> paired, level;
  for (std::size_t k = 0; k < std::min(runs.size(), reference.size()); ++k) {
    const auto one = valueOf(runs[k], measure), other = valueOf(reference[k], measure);
    level.push_back(other);
    paired.push_back(one && other ? std::optional(*one - *other) : std::nullopt);
  }
  const auto mean = ensembleMean(level), difference = ensembleMean(paired);
  const double scale = unit.value_or(mean ? std::abs(mean->mean) : 0.0);
  if (!difference || !(scale > 0.0)) return std::nullopt;
  const double size = std::abs(difference->mean) / scale;
  PairedError found{size, {}, {}, {}, {}};
  if (!difference->standardError) return found;
  const double scatter = *difference->standardError / scale;
  const double half = scatter * studentQuantile(1.0 - alpha, difference->packings - 1);
  found.statistical = scatter;
  found.systematic = std::sqrt(std::max(0.0, size * size - scatter * scatter));
  found.low = std::max(0.0, size - half);
  found.high = size + half;
  return found;
}

std::optional<PairedError> exactError(const std::vector<CostRun>& runs, const std::string& measure,
                                      double expected, double unit) {
  std::vector<double> errors;
  for (const CostRun& run : runs) {
    const auto value = valueOf(run, measure);
    if (!value) return std::nullopt;
    errors.push_back(std::abs(*value - expected) / unit);
  }
  if (errors.empty()) return std::nullopt;
  const auto [low, high] = std::ranges::minmax(errors);
  return PairedError{high, 0.0, high, low, high};
}

namespace {

class AverageErrors final : public ErrorKind {
 public:
  using ErrorKind::ErrorKind;

  CostKind kind() const override { return CostKind::averages; }

  std::vector<std::string> measures() const override {
    std::vector<std::string> names;
    for (const auto& [name, margin] : study_.setup.averaging.endpoints) names.push_back(name);
    return names;
  }

  std::size_t rounds() const override {
    return exact_ ? static_cast<std::size_t>(study_.setup.cost.repeats) : packings().size();
  }

  double predicted(std::size_t engine, const CostSetting& setting) const override {
    const TimedEngine& timed = study_.engines[engine];
    constexpr double sample = 1e-3;
    return static_cast<double>(rounds()) *
           (duration() / study_.stepOf(engine, setting.setup) * timed.scene.step +
            timed.scene.load + timed.start + sample * flowTimes(setting.setup).samples);
  }

  double commonTime(std::size_t rounds) const override {
    if (exact_) return 0.0;
    const Cost& cost = study_.setup.cost;
    int missing = 0;
    for (std::size_t k = 0; k < rounds; ++k)
      missing += !study_.campaign.store().find(referenceName(k), referenceKey(k));
    return duration() * cost.averageReference / costContactTime(study_.setup) * study_.inHouseStep *
           missing / std::min<double>(study_.jobs, std::max(missing, 1));
  }

  double ownTime(std::size_t) const override { return 0.0; }
  bool keptSuffice() const override { return exact_; }

  void makeReferences(std::size_t rounds) override {
    if (exact_) return;
    const EngineEntry& entry = study_.inHouse;
    const Case setup = atSteps(study_.setup, entry.name, study_.inHouseEngine->capabilities(),
                               study_.setup.cost.averageReference);
    std::vector<CachedTask<CostRun>> tasks;
    for (std::size_t k = 0; k < rounds; ++k)
      tasks.push_back({referenceName(k), fmt::format("packing {}", k), referenceKey(k), 1.0,
                       [&, k](const std::function<void(double)>& progress) {
                         return CachedTask<CostRun>::Outcome{
                             endpointsOfRun(entry, setup, packings()[k], progress), true, "done"};
                       }});
    reference_ = runOrLoad(tasks, study_.campaign.store(), study_.campaign.progress(),
                           "references of the averages", study_.jobs);
  }

  CostRun run(const PlannedPoint& planned, std::size_t round, double longest) override {
    Case setup = study_.settingOf(planned).setup;
    setup.run.timeout = std::min(setup.run.timeout, longest);
    const double begin = study_.campaign.elapsed();
    const Packing& packing = packings()[exact_ ? 0 : round];
    return endpointsOfRun(study_.entryOf(planned.engine), setup, packing, [&](double) {
      if (study_.campaign.elapsed() - begin > longest)
        throw TakesTooLong(fmt::format("takes more than {:.3g} s, predicted were {:.3g} s", longest,
                                       planned.round));
    });
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
      const auto error =
          exact_ ? exactError(runs, measure, endpointNamed(study_.setup, measure).expected.value(),
                              *unitOf(measure))
                 : pairedError(runs, reference_, measure, alpha, unitOf(measure));
      if (!error) continue;
      point.error = error->error;
      point.statistical = error->statistical;
      point.systematic = error->systematic;
      point.intervalLow = error->low;
      point.intervalHigh = error->high;
    }
    const auto isMeasured = [](const CostPoint& point) { return point.measured(); };
    if (inMargins() && points.size() > 1 && std::ranges::all_of(points, isMeasured)) {
      points.push_back(*std::ranges::max_element(points, {}, &CostPoint::error));
      points.back().measure = largestError;
    }
    return points;
  }

  void addTo(CostResults& results) const override {
    for (const std::string& measure : measures())
      results.margins.push_back(
          {measure, unitOf(measure) ? 1.0 / marginsInUnit() : marginOf(measure).value});
    results.inMargins = inMargins();
    if (exact_)
      results.references.push_back({.kind = kind(),
                                    .engine = closedFormName,
                                    .setting = "expected values of the case",
                                    .note = fmt::format("one start, run {} times", rounds())});
    if (!reference_.empty())
      results.references.push_back(
          {.kind = kind(),
           .engine = study_.inHouse.name,
           .setting = fmt::format("t_c/{:g}", study_.setup.cost.averageReference),
           .note = fmt::format("{}, paired: its statistical error is part of each point's",
                               counted(reference_.size(), "packing"))});
  }

 private:
  /// Of rigid bodies no other kind of error is in other units.
  bool inMargins() const { return !study_.setup.law.soft(); }
  double marginsInUnit() const { return inMargins() ? 1.0 : 10.0; }

  const std::vector<Packing>& packings() const { return study_.campaign.packings(); }
  double duration() const { return flowDuration(study_.setup); }  // [s]

  const Margin& marginOf(const std::string& measure) const {
    return study_.setup.averaging.endpoints.at(measure);
  }

  /// In units of which errors are, where that is not the reference's size: of an endpoint with an
  /// absolute margin, as all closed forms have, ten margins, so that a margin is a tenth of it as
  /// one of a tenth of the value is; of rigid bodies one margin.
  std::optional<double> unitOf(const std::string& measure) const {
    if (endpointNamed(study_.setup, measure).byRatio) return std::nullopt;
    return marginsInUnit() * marginOf(measure).value;
  }

  std::string referenceName(std::size_t packing) const {
    return fmt::format("reference-averages-p{}", packing);
  }
  CaseKeys referenceKey(std::size_t packing) const {
    return study_.inHouseKey(packing, "cost: reference averages");
  }

  const bool exact_ = hasClosedForms(study_.setup);
  std::vector<CostRun> reference_;  ///< by packing
};

}  // namespace

std::unique_ptr<ErrorKind> averageErrors(CostStudy& study) {
  return std::make_unique<AverageErrors>(study);
}

}  // namespace crossgrain::inline studies

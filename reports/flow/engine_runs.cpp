#include "reports/flow/engine_runs.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "reports/common/engines.hpp"
#include "support/numbers.hpp"

namespace crossgrain::reports {

namespace {

/// A member of the ensemble, else of the only finished run.
template <typename T>
const T& meansOf(const EngineRuns& engine, T CouetteEnsemble::*ofEnsemble, T FlowRun::*ofRun) {
  static const T none;
  if (engine.ensemble) return engine.ensemble->*ofEnsemble;
  return engine.finished.empty() ? none : engine.finished.front()->*ofRun;
}

void addTo(std::optional<double>& sum, std::optional<double> value) {
  if (value) sum = sum.value_or(0.0) + *value;
}

}  // namespace

const std::vector<Profile>& EngineRuns::profiles() const {
  return meansOf(*this, &CouetteEnsemble::profiles, &FlowRun::profiles);
}
const std::vector<Distribution>& EngineRuns::distributions() const {
  return meansOf(*this, &CouetteEnsemble::distributions, &FlowRun::distributions);
}
const std::vector<FitRow>& EngineRuns::fits() const {
  return meansOf(*this, &CouetteEnsemble::fits, &FlowRun::fits);
}
const std::vector<HeadNumber>& EngineRuns::head() const {
  return meansOf(*this, &CouetteEnsemble::head, &FlowRun::head);
}

const EffectiveParameters* EngineRuns::effective() const {
  for (const FlowRun* run : runs)
    if (run->effective) return &*run->effective;
  return nullptr;
}

std::string EngineRuns::snapshots() const {
  std::optional<std::pair<std::size_t, std::size_t>> range;
  for (const FlowRun* run : finished) {
    const std::size_t count = run->series ? valuesOf(*run->series, "t_s").size() : 0;
    if (count == 0) continue;
    range = range ? std::pair(std::min(range->first, count), std::max(range->second, count))
                  : std::pair(count, count);
  }
  if (!range) return {};
  return range->first == range->second ? fmt::format("{}", range->first)
                                       : fmt::format("{} to {}", range->first, range->second);
}

void EngineRuns::takeRuns(const std::vector<FlowRun>& all,
                          const std::vector<CouetteEnsemble>& ensembles, const std::string& engine,
                          const std::string& without) {
  for (const FlowRun& run : all) {
    if (run.engine != engine || run.without != without) continue;
    runs.push_back(&run);
    if (run.finished()) finished.push_back(&run);
  }
  for (const CouetteEnsemble& mean : ensembles)
    if (mean.engine == engine && mean.without == without && finished.size() > 1) {
      ensemble = &mean;
      break;
    }
}

Engines engineRuns(const FlowStudy& study, const std::vector<CouetteEnsemble>& ensembles) {
  const std::vector<LineStyle> styles = engineStyles(study.engines);
  Engines engines;
  for (const EngineRow& row : study.engines) {
    EngineRuns engine{row, styles[engines.size()], {}, {}, nullptr};
    engine.takeRuns(study.runs, ensembles, row.name, "");
    engines.push_back(std::move(engine));
  }
  return engines;
}

Engines engineRuns(const CompareResults& results) {
  Engines engines = engineRuns(results, results.ensemble);
  const bool means =
      std::ranges::any_of(engines, [](const EngineRuns& engine) { return engine.ensemble; });
  for (EngineRuns& engine : engines) {
    engine.isSingle = means && !engine.ensemble && !engine.finished.empty();
    if (const auto* own = surrogateOf(results.endpoints.surrogates, engine.name))
      engine.surrogate = own->mirror;
    if (const auto* own = surrogateBy(results.endpoints.surrogates, engine.name))
      engine.standsFor = own->engine;
  }
  return engines;
}

Curve curveOf(const EngineRuns& engine, std::vector<Point> points, double width) {
  const std::string name = engine.standsFor.empty()
                               ? engine.name
                               : fmt::format("{} for {}", engine.name, engine.standsFor);
  return {name, engine.style, Draw::linesAndPoints, std::move(points), width};
}

std::optional<double> EngineCost::cpuPerSecond() const {
  return quotient(cpu, simulated);
}

EngineCost costOf(const EngineRuns& engine) {
  EngineCost cost;
  for (const FlowRun* run : engine.finished) {
    if (!run->stats) continue;
    const auto steps = static_cast<double>(run->stats->steps);
    addTo(cost.steps, steps);
    addTo(cost.wall, finite(run->stats->wallSeconds));
    addTo(cost.cpu, finite(run->stats->cpuSeconds));
    if (run->effective) addTo(cost.simulated, finite(steps * run->effective->dt));
  }
  return cost;
}

std::optional<double> quotient(std::optional<double> a, std::optional<double> b) {
  if (!a || !b || *b == 0.0) return std::nullopt;
  return *a / *b;
}

}  // namespace crossgrain::reports

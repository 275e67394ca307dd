#include "studies/flow/paired_runs.hpp"

#include <algorithm>
#include <cmath>

namespace crossgrain::inline studies {

namespace {

void takeLogarithms(PairedTest& test, const Margin& margin) {
  for (auto* values : {&test.sample.reference, &test.sample.other})
    for (auto& value : *values)
      if (value) value = test.sign * std::log(test.sign * *value);
  test.sample.margin = std::log1p(margin.value);
  test.logarithmic = true;
}

}  // namespace

Runs finishedRuns(std::span<const FlowRun> runs, const std::string& engine,
                  const std::string& without) {
  Runs found;
  for (const FlowRun& run : runs)
    if (run.engine == engine && run.finished() && run.without == without) found.push_back(&run);
  std::ranges::sort(found, {}, [](const FlowRun* run) { return run->packing; });
  return found;
}

Runs runsFor(std::span<const FlowRun> runs, const std::string& engine,
             const std::vector<SurrogateEngine>& surrogates, const std::string& without) {
  const SurrogateEngine* const own = surrogateOf(surrogates, engine);
  return finishedRuns(runs, own ? own->mirror : engine, without);
}

std::size_t packingsOf(std::span<const FlowRun> runs) {
  int packings = 0;
  for (const FlowRun& run : runs) packings = std::max(packings, run.packing + 1);
  return static_cast<std::size_t>(packings);
}

std::vector<Runs> referenceRuns(std::span<const FlowRun> runs, const ComparedPair& pair,
                                const std::vector<SurrogateEngine>& surrogates) {
  std::vector<Runs> references;
  for (const std::string& engine : pair.references())
    if (Runs own = runsFor(runs, engine, surrogates); !own.empty())
      references.push_back(std::move(own));
  if (references.size() < 2 && !pair.others.empty()) references.clear();
  return references;
}

Numbers medianByPacking(const std::vector<Numbers>& engines) {
  if (engines.size() == 1) return engines.front();
  std::size_t packings = 0;
  for (const Numbers& values : engines) packings = std::max(packings, values.size());
  Numbers medians(packings);
  for (std::size_t k = 0; k < packings; ++k) {
    std::vector<double> values;
    for (const Numbers& own : engines)
      if (k < own.size() && own[k]) values.push_back(*own[k]);
    if (values.size() < 2) continue;
    std::ranges::sort(values);
    const std::size_t half = values.size() / 2;
    medians[k] = values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
  }
  return medians;
}

std::size_t packingsOf(const Runs& runs) {
  int packings = 0;
  for (const FlowRun* run : runs) packings = std::max(packings, run->packing + 1);
  return static_cast<std::size_t>(packings);
}

std::vector<Numbers> fieldByRing(const Runs& runs, const std::string& method,
                                 const std::string& field, std::size_t packings,
                                 Numbers Profile::*what) {
  std::vector<Numbers> rings;
  for (const FlowRun* run : runs) {
    const Profile* profile = profileOf(run->profiles, method, field);
    if (!profile) continue;
    const Numbers& values = profile->*what;
    rings.resize(std::max(rings.size(), values.size()), Numbers(packings));
    for (std::size_t ring = 0; ring < values.size(); ++ring)
      rings[ring][static_cast<std::size_t>(run->packing)] = values[ring];
  }
  return rings;
}

PairedTest testedRing(const Margin& margin, const Numbers& reference, const Numbers& other) {
  PairedTest test{{reference, other, margin.value, 0.0, {}}};
  const auto mean = ensembleMean(reference);
  if (mean) test.reference = mean->mean;
  if (!margin.relative) return test;
  test.sample.margin *= std::abs(test.reference);
  test.sign = test.reference < 0.0 ? -1.0 : 1.0;
  const auto ofThatSign = [&](const std::optional<double>& value) {
    return !value || test.sign * *value > 0.0;
  };
  if (mean && std::ranges::all_of(reference, ofThatSign) && std::ranges::all_of(other, ofThatSign))
    takeLogarithms(test, margin);
  return test;
}

double signOf(const Numbers& values) {
  double sign = 0.0;
  for (const auto& value : values) {
    if (!value || *value == 0.0 || !std::isfinite(*value)) continue;
    const double own = *value > 0.0 ? 1.0 : -1.0;
    if (sign == -own) return 0.0;
    sign = own;
  }
  return sign;
}

PairedTest testedEndpoint(const Endpoint& endpoint, const Margin& margin, const Numbers& reference,
                          const Numbers& other) {
  PairedTest test{{reference, other, margin.value, 0.0, {}}, false, signOf(reference)};
  for (auto* values : {&test.sample.reference, &test.sample.other})
    for (auto& value : *values)
      if (value && (!std::isfinite(*value) || (endpoint.byRatio && !(test.sign * *value > 0.0))))
        value.reset();
  if (const auto mean = ensembleMean(test.sample.reference)) test.reference = mean->mean;
  if (endpoint.byRatio) takeLogarithms(test, margin);
  return test;
}

bool independentRuns(const ComparedPair& pair, const Runs& reference, const Runs& other) {
  constexpr std::size_t fewest = 4;
  const bool alike = std::ranges::equal(reference, other, {}, &FlowRun::packing, &FlowRun::packing);
  return pair.ofFiles && pair.others.empty() && (!alike || other.size() < fewest);
}

const FlowRun* addOwnErrors(PairedTest& test, const FlowRun& reference, const FlowRun& other,
                            std::string_view endpoint) {
  double sum = 0.0, squares = 0.0;
  for (const auto& [run, value] : {std::pair(&reference, test.sample.reference.front()),
                                   std::pair(&other, test.sample.other.front())}) {
    const auto own = std::ranges::find(run->endpointErrors, endpoint, &EndpointError::endpoint);
    // A run that never changes does not know how another one would differ.
    if (own == run->endpointErrors.end() || !value || own->standardError == 0.0) return run;
    const double error =
        test.logarithmic ? own->standardError / std::exp(test.sign * *value) : own->standardError;
    sum += error * error;
    squares += std::pow(error, 4) / own->dof;
  }
  test.sample.withinVariance = {sum};
  test.sample.withinDof = squares > 0.0 ? sum * sum / squares : 0.0;
  return nullptr;
}

void addWithinVariance(PairedTest& test, const Numbers& referenceError, const Numbers& otherError) {
  const auto variance = [&](const std::optional<double>& value, const std::optional<double>& error,
                            double& sum) {
    if (!value || !error) return false;
    const double relative = test.logarithmic ? *error / std::exp(test.sign * *value) : *error;
    sum += relative * relative;
    return true;
  };
  PairedSample& sample = test.sample;
  sample.withinVariance.assign(sample.reference.size(), std::nullopt);
  for (std::size_t k = 0; k < std::min(sample.reference.size(), sample.other.size()); ++k) {
    double sum = 0.0;
    if (variance(sample.reference[k], referenceError[k], sum) &&
        variance(sample.other[k], otherError[k], sum))
      sample.withinVariance[k] = sum;
  }
}

double inUnit(const PairedTest& test, double difference) {
  return test.logarithmic ? test.reference * std::expm1(test.sign * difference) : difference;
}

}  // namespace crossgrain::inline studies

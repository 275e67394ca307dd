#include "studies/flow/paired_rings.hpp"

#include <algorithm>
#include <cmath>

namespace crossgrain::inline studies {

Runs finishedRuns(std::span<const FlowRun> runs, const std::string& engine,
                  const std::string& without) {
  Runs found;
  for (const FlowRun& run : runs)
    if (run.engine == engine && run.finished() && run.without == without) found.push_back(&run);
  std::ranges::sort(found, {}, [](const FlowRun* run) { return run->packing; });
  return found;
}

std::size_t packingsOf(std::span<const FlowRun> runs) {
  int packings = 0;
  for (const FlowRun& run : runs) packings = std::max(packings, run.packing + 1);
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

TestedRing testedRing(const Margin& margin, const Numbers& reference, const Numbers& other) {
  const auto mean = ensembleMean(reference);
  TestedRing ring;
  ring.reference = mean ? std::abs(mean->mean) : 0.0;
  ring.sample = {
      reference, other, margin.relative ? margin.value * ring.reference : margin.value, 0.0, {}};
  const double sign = mean && mean->mean < 0.0 ? -1.0 : 1.0;
  const auto ofThatSign = [&](const std::optional<double>& value) {
    return !value || sign * *value > 0.0;
  };
  ring.logarithmic = margin.relative && mean && std::ranges::all_of(reference, ofThatSign) &&
                     std::ranges::all_of(other, ofThatSign);
  if (!ring.logarithmic) return ring;
  ring.sign = sign;
  for (auto* values : {&ring.sample.reference, &ring.sample.other})
    for (auto& value : *values)
      if (value) value = std::log(sign * *value);
  ring.sample.margin = std::log1p(margin.value);
  return ring;
}

void addWithinVariance(TestedRing& ring, const Numbers& referenceError, const Numbers& otherError) {
  const auto variance = [&](const std::optional<double>& value, const std::optional<double>& error,
                            double& sum) {
    if (!value || !error) return false;
    const double relative = ring.logarithmic ? *error / std::exp(*value) : *error;
    sum += relative * relative;
    return true;
  };
  const PairedSample& sample = ring.sample;
  ring.sample.withinVariance.assign(sample.reference.size(), std::nullopt);
  for (std::size_t k = 0; k < sample.reference.size(); ++k) {
    double sum = 0.0;
    if (variance(sample.reference[k], referenceError[k], sum) &&
        variance(sample.other[k], otherError[k], sum))
      ring.sample.withinVariance[k] = sum;
  }
}

double inUnit(const TestedRing& ring, double value) {
  return ring.logarithmic ? ring.sign * ring.reference * std::expm1(value) : value;
}

}  // namespace crossgrain::inline studies

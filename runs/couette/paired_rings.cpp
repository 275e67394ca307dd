#include "runs/couette/paired_rings.hpp"

#include <algorithm>
#include <cmath>

#include "runs/common/records.hpp"

namespace crossgrain::inline runs {

using nlohmann::json;

std::vector<const json*> finishedRuns(const json& runs, const std::string& engine,
                                      const std::string& without) {
  std::vector<const json*> found;
  for (const json& run : runs)
    if (run["engine"] == engine && run["status"] == "finished" &&
        run.value("without", "") == without)
      found.push_back(&run);
  std::ranges::sort(found, {}, [](const json* run) { return (*run)["packing"].get<int>(); });
  return found;
}

std::size_t packingsOf(const json& runs) {
  std::size_t packings = 0;
  for (const json& run : runs) packings = std::max(packings, run["packing"].get<std::size_t>() + 1);
  return packings;
}

const json* profileOf(const json& run, const json& method, const std::string& field) {
  for (const json& profile : run["profiles"])
    if (profile["field"] == field && profile["method"] == method) return &profile;
  return nullptr;
}

std::vector<Numbers> fieldByRing(const std::vector<const json*>& runs, const json& method,
                                 const std::string& field, std::size_t packings, const char* what) {
  std::vector<Numbers> rings;
  for (const json* run : runs) {
    const json* profile = profileOf(*run, method, field);
    if (!profile) continue;
    if (!profile->contains(what)) continue;
    const Numbers mean = optionalNumbers((*profile)[what]);
    rings.resize(std::max(rings.size(), mean.size()), Numbers(packings));
    for (std::size_t ring = 0; ring < mean.size(); ++ring)
      rings[ring][(*run)["packing"].get<std::size_t>()] = mean[ring];
  }
  return rings;
}

TestedRing testedRing(const Margin& margin, const Numbers& reference, const Numbers& other) {
  const auto mean = ensembleMean(reference);
  TestedRing ring;
  ring.reference = mean ? std::abs(mean->mean) : 0.0;
  ring.sample = {
      reference, other, margin.relative ? margin.value * ring.reference : margin.value, {}};
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

}  // namespace crossgrain::inline runs

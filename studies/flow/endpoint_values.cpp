#include "studies/flow/endpoint_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "adapters/snapshot_source.hpp"
#include "averaging/fields.hpp"
#include "averaging/statistics.hpp"
#include "studies/flow/averages.hpp"
#include "studies/flow/summary.hpp"

namespace crossgrain::inline studies {

namespace {

using Value = std::optional<double>;

/// Of all snapshots alike.
bool isMean(Reduction reduction) {
  return reduction == Reduction::mean || reduction == Reduction::slope ||
         reduction == Reduction::bin || reduction == Reduction::rate;
}

/// Needs of a field, or of a number of regionNumbers() or diskNumbers(). Forces on walls have
/// no need that profiles show: where there are none the series is empty, and says so.
Needs needsOf(const std::string& quantity, const Endpoint& how, int dimension) {
  if (how.wall) return Needs::kinematics;
  if (how.disk) return quantity.starts_with("spin") ? Needs::spin : Needs::kinematics;
  if (quantity == sceneCoordination) return Needs::contacts;
  const auto numbers = regionNumbers(dimension);
  const auto found = std::ranges::find(numbers, quantity, &RegionNumber::name);
  if (found == numbers.end()) return fieldSpec(quantity).needs;
  return found->ofContacts ? Needs::contacts : Needs::kinematics;
}

/// "no spins in its files", "it reports no spins"
std::string lacks(const FlowRun& run, const char* what) {
  return run.ofFiles() ? fmt::format("no {} in its files", what)
                       : fmt::format("it reports no {}", what);
}

/// Files that list contacts, but none of walls that bodies touch.
bool lacksWallContacts(const FlowRun& run) {
  return std::ranges::any_of(
      run.remarks, [](const std::string& remark) { return remark.starts_with(noWallContacts); });
}

/// Missing needs of the run; empty: none. A part that the law lacks no run has. Sums over
/// contacts without those of walls would be others.
std::string lackOf(Needs needs, const FlowRun& run) {
  const auto has = [&](Needs what) {
    return std::ranges::any_of(run.profiles, [&](const Profile& profile) {
      return fieldSpec(profile.field).needs == what;
    });
  };
  const bool ofContacts = needs != Needs::kinematics && needs != Needs::spin;
  if (ofContacts && has(Needs::contacts) && lacksWallContacts(run))
    return lacks(run, "contacts with walls");
  if (needs == Needs::kinematics || has(needs)) return {};
  if (needs == Needs::spin) return lacks(run, "spins");
  if (!has(Needs::contacts)) return lacks(run, "contacts");
  return needs == Needs::dissipation ? lacks(run, "heat of contacts") : std::string();
}

}  // namespace

WeightedBins weightedBins(const Case& setup, const FlowRun& run, std::string_view field) {
  const std::string& method = setup.averaging.methods.front();
  const Profile* profile = profileOf(run.profiles, method, field);
  const Profile* filling = profileOf(run.profiles, method, "volume_fraction");
  if (!profile || !filling) return {};
  const bool perVolume = fieldSpec(field).perVolume;
  const bool any = std::ranges::any_of(profile->mean, [](const Value& x) { return x.has_value(); });
  WeightedBins bins{profile->mean, {}};
  const auto places = binsOf(setup);
  // Profiles leave the overflow out.
  for (std::size_t slot = 0; slot < places->slots(); ++slot) {
    const std::size_t k = bins.weight.size();
    if (places->isOverflow(slot) || k == bins.value.size()) continue;
    const double filled = k < filling->mean.size() ? filling->mean[k].value_or(0.0) : 0.0;
    bins.weight.push_back(places->volume(slot) * (perVolume ? 1.0 : filled));
    if (perVolume && any && filled == 0.0) bins.value[k] = bins.value[k].value_or(0.0);
  }
  return bins;
}

std::optional<double> cellMean(const Case& setup, const FlowRun& run, std::string_view field) {
  const auto [value, weight] = weightedBins(setup, run, field);
  double sum = 0.0, whole = 0.0;
  for (std::size_t k = 0; k < weight.size(); ++k) {
    if (!value[k]) continue;
    sum += weight[k] * *value[k];
    whole += weight[k];
  }
  return whole > 0.0 ? Value(sum / whole) : Value{};
}

std::optional<double> endpointOf(const Endpoint& endpoint, const Case& setup, const FlowRun& run) {
  const Value value = endpointValue(endpoint, setup, run).value;
  return value && std::isfinite(*value) ? value : Value{};
}

std::string notShown(const Endpoint& endpoint, const Case& setup, const FlowRun& run) {
  if (endpoint.wall && lacksWallContacts(run)) return lacks(run, "contacts with walls");
  for (const std::string& quantity : {endpoint.quantity, endpoint.per}) {
    if (quantity.empty()) continue;
    std::string lack = lackOf(needsOf(quantity, endpoint, setup.dimension), run);
    if (!lack.empty()) return lack;
    const bool ofSliding = quantity == "sliding_fraction" && run.series;
    if (run.ofFiles() && ofSliding && presentNumbers(valuesOf(*run.series, quantity)).empty())
      return "no mark of sliding contacts in its files";
  }
  const EndpointValue found = endpointValue(endpoint, setup, run);
  return run.ofFiles() && found.notCovered ? found.why + " in its files" : std::string();
}

AbleRuns ableRuns(const Endpoint& endpoint, const Case& setup, const Runs& all) {
  AbleRuns able;
  std::string lack;
  for (const FlowRun* run : all)
    if (std::string why = notShown(endpoint, setup, *run); why.empty())
      able.runs.push_back(run);
    else
      lack = std::move(why);
  if (lack.empty()) return able;
  able.lack = fmt::format("{}: {}", all.front()->engine, lack);
  if (!able.runs.empty())
    able.lack += fmt::format(" of {} of {} runs", all.size() - able.runs.size(), all.size());
  return able;
}

std::vector<EndpointError> endpointErrors(const Case& setup, const RunAverages& averages,
                                          const FlowRun& run) {
  constexpr std::size_t mostParts = 64;
  const std::size_t parts = std::min(mostParts, averages.snapshots());
  std::vector<EndpointError> errors;
  if (parts < fewestOfOwnError) return errors;
  std::vector<FlowRun> without;
  for (std::size_t k = 0; k < parts; ++k)
    if (auto rest = averages.without(k, parts))
      without.push_back(std::move(*rest));
    else
      return errors;
  for (const Endpoint& endpoint : setup.endpoints) {
    if (!isMean(endpoint.reduction)) continue;
    const Value whole = endpointOf(endpoint, setup, run);
    std::vector<double> pseudo;
    for (const FlowRun& rest : without)
      if (const Value value = endpointOf(endpoint, setup, rest); value && whole)
        pseudo.push_back(static_cast<double>(parts) * *whole -
                         static_cast<double>(parts - 1) * *value);
    if (pseudo.size() < parts) continue;
    const MeanEstimate found = estimateMean(pseudo);
    if (found.standardError)
      errors.push_back({std::string(endpoint.name), *found.standardError, found.dof});
  }
  return errors;
}

std::string missingErrorReason(const Endpoint& endpoint, const FlowRun& run) {
  if (!isMean(endpoint.reduction))
    return "an endpoint of one time, or of an extreme, has no error within a single run";
  const std::size_t snapshots = run.series ? valuesOf(*run.series, "t_s").size() : 0;
  if (snapshots < fewestOfOwnError)
    return fmt::format("{} has a single run of {} snapshots, whose own error takes {}", run.engine,
                       snapshots, fewestOfOwnError);
  return fmt::format("{} has a single run, at rest or too short to know its own error", run.engine);
}

std::string missingValueReason(const Endpoint& endpoint, const Case& setup, const Runs& runs) {
  for (const FlowRun* run : runs)
    if (const EndpointValue found = endpointValue(endpoint, setup, *run); !found.why.empty())
      return fmt::format("{}, packing {}: {}", run->engine, run->packing, found.why);
  return {};
}

Numbers endpointByPacking(const Endpoint& endpoint, const Case& setup, const Runs& runs,
                          std::size_t packings) {
  Numbers values(packings);
  for (const FlowRun* run : runs)
    if (const auto k = static_cast<std::size_t>(run->packing); k < packings)
      values[k] = endpointOf(endpoint, setup, *run);
  return values;
}

}  // namespace crossgrain::inline studies

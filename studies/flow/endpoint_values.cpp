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

Value inRing(const Case& setup, const FlowRun& run, std::string_view field, std::size_t ring) {
  const Profile* profile = profileOf(run.profiles, setup.averaging.methods.front(), field);
  return profile && ring < profile->mean.size() ? profile->mean[ring] : Value{};
}

Value ratio(const Value& above, const Value& below) {
  return above && below && *below > 0.0 ? Value(*above / *below) : Value{};
}

/// p = (σ_rr + σ_φφ)/2 in two dimensions; a cell without contacts has none.
Value pressure(const Case& setup, const FlowRun& run) {
  const Value rr = cellMean(setup, run, "stress_rr"), pp = cellMean(setup, run, "stress_pp");
  if (!rr || !pp || !(*rr + *pp > 0.0)) return {};
  return 0.5 * (*rr + *pp);
}

Value stressRatio(const Case& setup, const FlowRun& run) {
  return ratio(cellMean(setup, run, "stress_rp"), cellMean(setup, run, "stress_rr"));
}

Value stressAnisotropy(const Case& setup, const FlowRun& run) {
  return ratio(cellMean(setup, run, "stress_pp"), cellMean(setup, run, "stress_rr"));
}

Value coordination(const Case&, const FlowRun& run) {
  for (const HeadNumber& number : run.head)
    if (number.name == "coordination") return number.value;
  return {};
}

Value meanVelocity(const Case& setup, const FlowRun& run) {
  return cellMean(setup, run, "azimuthal_velocity");
}

Value meanSpin(const Case& setup, const FlowRun& run) {
  return cellMean(setup, run, "spin");
}

Value velocityAtWheel(const Case& setup, const FlowRun& run) {
  return inRing(setup, run, "azimuthal_velocity", 0);
}

Value volumeFractionAtWheel(const Case& setup, const FlowRun& run) {
  return inRing(setup, run, "volume_fraction", 0);
}

Value spinAtWheel(const Case& setup, const FlowRun& run) {
  return inRing(setup, run, "spin", 0);
}

const OwnEndpoint* ownEndpoint(const Case& setup, std::string_view name) {
  if (!setup.average) return nullptr;
  const auto& endpoints = setup.average->endpoints;
  const auto found = std::ranges::find(endpoints, name, &OwnEndpoint::name);
  return found == endpoints.end() ? nullptr : &*found;
}

/// Of all snapshots alike.
bool isMean(Reduction reduction) {
  return reduction == Reduction::mean || reduction == Reduction::slope ||
         reduction == Reduction::bin || reduction == Reduction::rate;
}

struct Formula {
  std::string_view endpoint;
  Value (*of)(const Case& setup, const FlowRun& run);
  Needs needs;
};

constexpr std::array<Formula, 9> formulas = {
    {{"pressure", pressure, Needs::contacts},
     {"stress_ratio", stressRatio, Needs::contacts},
     {"stress_anisotropy", stressAnisotropy, Needs::contacts},
     {"coordination", coordination, Needs::contacts},
     {"mean_velocity", meanVelocity, Needs::kinematics},
     {"mean_spin", meanSpin, Needs::spin},
     {"velocity_at_wheel", velocityAtWheel, Needs::kinematics},
     {"volume_fraction_at_wheel", volumeFractionAtWheel, Needs::kinematics},
     {"spin_at_wheel", spinAtWheel, Needs::spin}}};

const Formula& formulaOf(std::string_view endpoint) {
  const auto* const found = std::ranges::find(formulas, endpoint, &Formula::endpoint);
  if (found == formulas.end())
    throw std::logic_error("no formula of endpoint " + std::string(endpoint));
  return *found;
}

/// What a field, or a number of regionNumbers() or diskNumbers(), is made of. Forces on walls have
/// no need that profiles show: where there are none the series is empty, and says so.
Needs needsOf(const std::string& quantity, const OwnEndpoint& how, int dimension) {
  if (how.wall) return Needs::kinematics;
  if (how.disk) return quantity.starts_with("spin") ? Needs::spin : Needs::kinematics;
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

/// What the run does not show of that; empty: nothing. What a law lacks no run has. Sums over
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

std::optional<double> endpointOf(const EndpointSpec& endpoint, const Case& setup,
                                 const FlowRun& run) {
  const auto finite = [](const Value& value) {
    return value && std::isfinite(*value) ? value : Value{};
  };
  if (const OwnEndpoint* own = ownEndpoint(setup, endpoint.name))
    return finite(ownEndpointOf(*own, setup, run).value);
  return finite(formulaOf(endpoint.name).of(setup, run));
}

std::string notShown(const EndpointSpec& endpoint, const Case& setup, const FlowRun& run) {
  const OwnEndpoint* const own = ownEndpoint(setup, endpoint.name);
  if (!own) return lackOf(formulaOf(endpoint.name).needs, run);
  if (own->wall && lacksWallContacts(run)) return lacks(run, "contacts with walls");
  for (const std::string& quantity : {own->quantity, own->per}) {
    if (quantity.empty()) continue;
    std::string lack = lackOf(needsOf(quantity, *own, setup.dimension), run);
    if (!lack.empty()) return lack;
    const bool ofSliding = quantity == "sliding_fraction" && run.series;
    if (run.ofFiles() && ofSliding && presentNumbers(valuesOf(*run.series, quantity)).empty())
      return "no mark of sliding contacts in its files";
  }
  const OwnValue found = ownEndpointOf(*own, setup, run);
  return run.ofFiles() && found.notCovered ? found.why + " in its files" : std::string();
}

AbleRuns ableRuns(const EndpointSpec& endpoint, const Case& setup, const Runs& all) {
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
  for (const EndpointSpec& endpoint : endpointsOf(setup)) {
    if (const OwnEndpoint* own = ownEndpoint(setup, endpoint.name); own && !isMean(own->reduction))
      continue;
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

std::string missingErrorReason(const EndpointSpec& endpoint, const Case& setup,
                               const FlowRun& run) {
  const OwnEndpoint* const own = ownEndpoint(setup, endpoint.name);
  if (own && !isMean(own->reduction))
    return "an endpoint of one time, or of an extreme, has no error within a single run";
  const std::size_t snapshots = run.series ? valuesOf(*run.series, "t_s").size() : 0;
  if (snapshots < fewestOfOwnError)
    return fmt::format("{} has a single run of {} snapshots, whose own error takes {}", run.engine,
                       snapshots, fewestOfOwnError);
  return fmt::format("{} has a single run, at rest or too short to know its own error", run.engine);
}

std::string missingValueReason(const EndpointSpec& endpoint, const Case& setup, const Runs& runs) {
  const OwnEndpoint* const own = ownEndpoint(setup, endpoint.name);
  if (own)
    for (const FlowRun* run : runs)
      if (const OwnValue found = ownEndpointOf(*own, setup, *run); !found.why.empty())
        return fmt::format("{}, packing {}: {}", run->engine, run->packing, found.why);
  return {};
}

Numbers endpointByPacking(const EndpointSpec& endpoint, const Case& setup, const Runs& runs,
                          std::size_t packings) {
  Numbers values(packings);
  for (const FlowRun* run : runs)
    if (const auto k = static_cast<std::size_t>(run->packing); k < packings)
      values[k] = endpointOf(endpoint, setup, *run);
  return values;
}

}  // namespace crossgrain::inline studies

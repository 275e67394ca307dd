#include "runs/couette/endpoint_values.hpp"

#include <array>
#include <cmath>
#include <stdexcept>

#include "runs/couette/flow_averages.hpp"
#include "runs/couette/own_endpoints.hpp"

namespace crossgrain::inline runs {

namespace {

using Value = std::optional<double>;

Value inRing(const Case& setup, const CouetteRun& run, std::string_view field, std::size_t ring) {
  const Profile* profile = profileOf(run.profiles, setup.averaging.methods.front(), field);
  return profile && ring < profile->mean.size() ? profile->mean[ring] : Value{};
}

Value ratio(const Value& above, const Value& below) {
  return above && below && *below > 0.0 ? Value(*above / *below) : Value{};
}

/// p = (σ_rr + σ_φφ)/2 in two dimensions; a cell without contacts has none.
Value pressure(const Case& setup, const CouetteRun& run) {
  const Value rr = cellMean(setup, run, "stress_rr"), pp = cellMean(setup, run, "stress_pp");
  if (!rr || !pp || !(*rr + *pp > 0.0)) return {};
  return 0.5 * (*rr + *pp);
}

Value stressRatio(const Case& setup, const CouetteRun& run) {
  return ratio(cellMean(setup, run, "stress_rp"), cellMean(setup, run, "stress_rr"));
}

Value stressAnisotropy(const Case& setup, const CouetteRun& run) {
  return ratio(cellMean(setup, run, "stress_pp"), cellMean(setup, run, "stress_rr"));
}

Value coordination(const Case&, const CouetteRun& run) {
  for (const HeadNumber& number : run.head)
    if (number.name == "coordination") return number.value;
  return {};
}

Value meanVelocity(const Case& setup, const CouetteRun& run) {
  return cellMean(setup, run, "azimuthal_velocity");
}

Value meanSpin(const Case& setup, const CouetteRun& run) {
  return cellMean(setup, run, "spin");
}

Value velocityAtWheel(const Case& setup, const CouetteRun& run) {
  return inRing(setup, run, "azimuthal_velocity", 0);
}

Value volumeFractionAtWheel(const Case& setup, const CouetteRun& run) {
  return inRing(setup, run, "volume_fraction", 0);
}

Value spinAtWheel(const Case& setup, const CouetteRun& run) {
  return inRing(setup, run, "spin", 0);
}

struct Formula {
  std::string_view endpoint;
  Value (*of)(const Case& setup, const CouetteRun& run);
};

constexpr std::array<Formula, 9> formulas = {{{"pressure", pressure},
                                              {"stress_ratio", stressRatio},
                                              {"stress_anisotropy", stressAnisotropy},
                                              {"coordination", coordination},
                                              {"mean_velocity", meanVelocity},
                                              {"mean_spin", meanSpin},
                                              {"velocity_at_wheel", velocityAtWheel},
                                              {"volume_fraction_at_wheel", volumeFractionAtWheel},
                                              {"spin_at_wheel", spinAtWheel}}};

}  // namespace

std::optional<double> cellMean(const Case& setup, const CouetteRun& run, std::string_view field) {
  const Profile* profile = profileOf(run.profiles, setup.averaging.methods.front(), field);
  if (!profile) return {};
  const auto bins = binsOf(setup);
  double sum = 0.0, area = 0.0;
  std::size_t k = 0;  // profiles leave the overflow out
  for (std::size_t slot = 0; slot < bins->slots() && k < profile->mean.size(); ++slot) {
    if (bins->isOverflow(slot)) continue;
    const auto& mean = profile->mean[k++];
    if (!mean) continue;
    const double own = bins->volume(slot);
    sum += own * *mean;
    area += own;
  }
  return area > 0.0 ? Value(sum / area) : Value{};
}

std::optional<double> endpointOf(const EndpointSpec& endpoint, const Case& setup,
                                 const CouetteRun& run) {
  if (setup.average)
    for (const OwnEndpoint& own : setup.average->endpoints)
      if (own.name == endpoint.name) {
        const Value value = ownEndpointOf(own, setup, run);
        return value && std::isfinite(*value) ? value : Value{};
      }
  for (const Formula& formula : formulas)
    if (formula.endpoint == endpoint.name) {
      const Value value = formula.of(setup, run);
      return value && std::isfinite(*value) ? value : Value{};
    }
  throw std::logic_error("no formula of endpoint " + std::string(endpoint.name));
}

Numbers endpointByPacking(const EndpointSpec& endpoint, const Case& setup, const Runs& runs,
                          std::size_t packings) {
  Numbers values(packings);
  for (const CouetteRun* run : runs)
    if (const auto k = static_cast<std::size_t>(run->packing); k < packings)
      values[k] = endpointOf(endpoint, setup, *run);
  return values;
}

}  // namespace crossgrain::inline runs

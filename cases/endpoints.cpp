#include "cases/endpoints.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>

namespace crossgrain::inline cases {

namespace {

constexpr std::array<EndpointSpec, 9> table = {{
    {"pressure", "pressure", "p", "N/m²", "mean of (σ_rr + σ_φφ)/2 over the cell", true},
    {"stress_ratio", "stress ratio", "σ_rφ/σ_rr", "-", "means of both over the cell", false},
    {"stress_anisotropy", "stress anisotropy", "σ_φφ/σ_rr", "-", "means of both over the cell",
     false},
    {"coordination", "coordination", "C", "-", "contacts of a disk, mean over disks and time",
     false},
    {"mean_velocity", "mean velocity", "⟨v_φ⟩", "m/s",
     "mean of v_φ over the disks, Σ w V v_φ / Σ w V of the cell", false},
    {"mean_spin", "mean spin", "⟨ω⟩", "rad/s",
     "mean of the spin over the disks, Σ w V ω / Σ w V of the cell", false},
    {"velocity_at_wheel", "velocity at the wheel", "v_φ1", "m/s", "v_φ in ring 1", false},
    {"volume_fraction_at_wheel", "volume fraction at the wheel", "ν_1", "-", "ν in ring 1", false},
    {"spin_at_wheel", "spin at the wheel", "ω_1", "rad/s", "spin in ring 1", false},
}};

}  // namespace

std::span<const EndpointSpec> endpointTable() {
  return table;
}

const EndpointSpec& endpointSpec(std::string_view name) {
  const auto found = std::ranges::find(table, name, &EndpointSpec::name);
  if (found == table.end())
    throw std::invalid_argument("there is no endpoint " + std::string(name));
  return *found;
}

std::vector<EndpointSpec> endpointsOf(const Case& setup) {
  std::vector<EndpointSpec> endpoints;
  if (setup.average) {
    for (const OwnEndpoint& own : setup.average->endpoints)
      endpoints.push_back({own.name, own.words, own.words, own.unit, own.definition, own.byRatio});
    return endpoints;
  }
  for (const EndpointSpec& endpoint : endpointTable())
    if (setup.averaging.endpoints.contains(std::string(endpoint.name)))
      endpoints.push_back(endpoint);
  return endpoints;
}

EndpointSpec endpointSpec(const Case& setup, std::string_view name) {
  for (const EndpointSpec& endpoint : endpointsOf(setup))
    if (endpoint.name == name) return endpoint;
  return endpointSpec(name);
}

std::span<const RegionNumber> regionNumbers() {
  static constexpr std::array<RegionNumber, 12> numbers = {{
      {"kinetic_energy", "J", "Σ ½ m v² + ½ J ω² of all disks"},
      {"max_overlap", "m", "largest overlap of all contacts", true},
      {"mean_overlap", "m", "mean overlap of all contacts", true},
      {"sliding_fraction", "-", "share of all contacts at the Coulomb bound", true},
      {"disks", "-", "disks with their centres in the averaged part"},
      {"top", "m", "highest point of those disks above the lower edge of the averaged box"},
      {"mean_x", "m", "x of their centre of mass"},
      {"mean_y", "m", "y of their centre of mass above the lower edge of the averaged box"},
      {"rms_x", "m", "their spread about it along x, √(Σ m (x − x̄)² / Σ m)"},
      {"rms_y", "m", "their spread about it along y"},
      // A triangle of base 2W and height H has ȳ = H/3 and rms_x² = W²/6, so H/W = 3ȳ/(√6 rms_x).
      {"heap_slope", "-", "slope H/W = 3 ȳ/(√6 rms_x) of the triangle with their moments"},
      {"flank_slope", "-",
       "mean steepness of two straight lines, each through the highest centres in 8 equal strips "
       "of a flank, from 0.1 to 0.5 of the way from the middle of the averaged part to its sides"},
  }};
  return numbers;
}

std::span<const RegionNumber> diskNumbers() {
  static constexpr std::array<RegionNumber, 5> numbers = {
      {{"x", "m", "x of a disk's centre"},
       {"y", "m", "y of a disk's centre"},
       {"velocity_x", "m/s", "x of a disk's velocity"},
       {"velocity_y", "m/s", "y of a disk's velocity"},
       {"spin", "rad/s", "angular velocity of a disk, counter-clockwise"}}};
  return numbers;
}

std::string OwnEndpoint::series() const {
  return disk ? fmt::format("disk_{}_{}", *disk, quantity) : quantity;
}

}  // namespace crossgrain::inline cases

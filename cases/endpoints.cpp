#include "cases/endpoints.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>

namespace crossgrain::inline cases {

namespace {

/// Of a field: its mean over the bins, or, of those that touch the wheel, the first ring's.
Endpoint ofField(const char* name, const char* symbol, std::string_view quantity, const char* unit,
                 const char* definition, Reduction reduction = Reduction::mean) {
  Endpoint endpoint;
  endpoint.words = endpoint.name = name;
  std::ranges::replace(endpoint.words, '_', ' ');
  endpoint.symbol = symbol;
  endpoint.quantity = quantity;
  endpoint.unit = unit;
  endpoint.definition = definition;
  endpoint.reduction = reduction;
  return endpoint;
}

Endpoint ofStresses(const char* name, const char* symbol, const char* above) {
  Endpoint endpoint = ofField(name, symbol, above, "-", "means of both over the cell");
  endpoint.per = "stress_rr";
  return endpoint;
}

std::vector<Endpoint> makeTable() {
  const auto atWheel = [](const char* name, const char* symbol, const char* quantity,
                          const char* unit, const char* definition) {
    Endpoint endpoint = ofField(name, symbol, quantity, unit, definition, Reduction::bin);
    endpoint.words.insert(endpoint.words.find("wheel"), "the ");
    return endpoint;
  };
  std::vector<Endpoint> table = {
      ofField("pressure", "p", planePressure, "N/m²", "mean of (σ_rr + σ_φφ)/2 over the cell"),
      ofStresses("stress_ratio", "σ_rφ/σ_rr", "stress_rp"),
      ofStresses("stress_anisotropy", "σ_φφ/σ_rr", "stress_pp"),
      ofField("coordination", "C", sceneCoordination, "-",
              "contacts of a disk, mean over disks and time"),
      ofField("mean_velocity", "⟨v_φ⟩", "azimuthal_velocity", "m/s",
              "mean of v_φ over the disks, Σ w V v_φ / Σ w V of the cell"),
      ofField("mean_spin", "⟨ω⟩", "spin", "rad/s",
              "mean of the spin over the disks, Σ w V ω / Σ w V of the cell"),
      atWheel("velocity_at_wheel", "v_φ1", "azimuthal_velocity", "m/s", "v_φ in ring 1"),
      atWheel("volume_fraction_at_wheel", "ν_1", "volume_fraction", "-", "ν in ring 1"),
      atWheel("spin_at_wheel", "ω_1", "spin", "rad/s", "spin in ring 1")};
  table.front().byRatio = true;
  return table;
}

}  // namespace

std::span<const Endpoint> endpointTable() {
  static const std::vector<Endpoint> table = makeTable();
  return table;
}

const Endpoint& endpointNamed(std::string_view name) {
  const auto found = std::ranges::find(endpointTable(), name, &Endpoint::name);
  if (found == endpointTable().end())
    throw std::invalid_argument("there is no endpoint " + std::string(name));
  return *found;
}

const Endpoint& endpointNamed(const Case& setup, std::string_view name) {
  const auto found = std::ranges::find(setup.endpoints, name, &Endpoint::name);
  return found == setup.endpoints.end() ? endpointNamed(name) : *found;
}

std::span<const RegionNumber> regionNumbers(int dimension) {
  static constexpr RegionNumber energy = {"kinetic_energy", "J", "Σ ½ m v² + ½ J ω² of all disks"},
                                largest = {"max_overlap", "m", "largest overlap of all contacts",
                                           true},
                                mean = {"mean_overlap", "m", "mean overlap of all contacts", true},
                                sliding = {"sliding_fraction", "-",
                                           "share of all contacts at the Coulomb bound", true},
                                disks = {"disks", "-",
                                         "disks with their centres in the averaged part"},
                                top = {"top", "m",
                                       "highest point of those disks above the lower edge of the "
                                       "averaged box"},
                                x = {"mean_x", "m", "x of their centre of mass"},
                                spreadX = {"rms_x", "m",
                                           "their spread about it along x, √(Σ m (x − x̄)² / Σ m)"},
                                spreadY = {"rms_y", "m", "their spread about it along y"};
  // Of two walls across the one direction in which a box is not periodic (averaging/global.hpp).
  static constexpr RegionNumber normal = {"wall_normal_stress", "N/m²",
                                          "force that pushes the lowest and the highest wall of a "
                                          "periodic box apart, over their area"},
                                shear = {
                                    "wall_shear_stress", "N/m²",
                                    "force along them with which they shear what is between, "
                                    "over their area; above 0 where the high one goes forward"};
  static constexpr std::array inPlane = {
      energy, largest, mean, sliding, disks, top, x,
      RegionNumber{"mean_y", "m",
                   "y of their centre of mass above the lower edge of the averaged box"},
      spreadX, spreadY,
      // A triangle of base 2W and height H has ȳ = H/3 and rms_x² = W²/6, so H/W = 3ȳ/(√6 rms_x).
      RegionNumber{"heap_slope", "-",
                   "slope H/W = 3 ȳ/(√6 rms_x) of the triangle with their moments"},
      RegionNumber{
          "flank_slope", "-",
          "mean steepness of two straight lines, each through the highest centres in 8 equal "
          "strips of a flank, from 0.1 to 0.5 of the way from the middle of the averaged part to "
          "its sides"},
      normal, shear};
  static constexpr std::array inSpace = {
      energy,
      largest,
      mean,
      sliding,

      disks,
      top,
      x,
      RegionNumber{"mean_y", "m", "y of their centre of mass"},
      RegionNumber{"mean_z", "m",
                   "z of their centre of mass above the lower edge of the averaged part"},
      spreadX,
      spreadY,
      RegionNumber{"rms_z", "m", "their spread about it along z"},
      normal,
      shear};
  if (dimension == 3) return inSpace;
  return inPlane;
}

std::span<const RegionNumber> diskNumbers(int dimension) {
  static constexpr RegionNumber x = {"x", "m", "x of a disk's centre"},
                                y = {"y", "m", "y of a disk's centre"},
                                vx = {"velocity_x", "m/s", "x of a disk's velocity"},
                                vy = {"velocity_y", "m/s", "y of a disk's velocity"};
  static constexpr std::array inPlane = {
      x,
      y,
      vx,
      vy,
      RegionNumber{"spin", "rad/s", "angular velocity of a disk, counter-clockwise"},
      RegionNumber{"angle", "rad",
                   "orientation of a convex body, counter-clockwise, within half a turn of that of "
                   "the snapshot before"}};
  static constexpr std::array inSpace = {
      x,
      y,
      RegionNumber{"z", "m", "z of a sphere's centre"},
      vx,
      vy,
      RegionNumber{"velocity_z", "m/s", "z of a sphere's velocity"},
      RegionNumber{"spin_x", "rad/s", "x of a sphere's angular velocity"},
      RegionNumber{"spin_y", "rad/s", "y of a sphere's angular velocity"},
      RegionNumber{"spin_z", "rad/s", "z of a sphere's angular velocity"},
      RegionNumber{"angle", "rad", "by which a convex body has turned from its start, 0 to π"},
      RegionNumber{"own_spin_x", "rad/s",
                   "a convex body's angular velocity about its axis that was along x at its start"},
      RegionNumber{"own_spin_y", "rad/s", "about that along y"},
      RegionNumber{"own_spin_z", "rad/s", "about that along z"}};
  if (dimension == 3) return inSpace;
  return inPlane;
}

std::span<const RegionNumber> wallNumbers(int dimension) {
  static constexpr RegionNumber
      normal = {normalForce, "N", "force of the disks on a plane of a wall, against its normal"},
      x = {"force_x", "N", "x of the force of the disks on a wall"},
      y = {"force_y", "N", "y of the force of the disks on a wall"},
      z = {"force_z", "N", "z of the force of the spheres on a wall"};
  static constexpr std::array inPlane = {normal, x, y};
  static constexpr std::array inSpace = {normal, x, y, z};
  if (dimension == 3) return inSpace;
  return inPlane;
}

std::string Endpoint::series() const {
  if (wall)
    return fmt::format("wall_{}_{}{}", *wall, plane ? fmt::format("plane_{}_", *plane) : "",
                       quantity);
  return disk ? fmt::format("disk_{}_{}", *disk, quantity) : quantity;
}

}  // namespace crossgrain::inline cases

#include "cases/average.hpp"

#include <fmt/format.h>

namespace crossgrain::inline cases {

std::span<const RegionNumber> regionNumbers() {
  static constexpr std::array<RegionNumber, 11> numbers = {{
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

#include "cases/average.hpp"

namespace crossgrain::inline cases {

std::span<const RegionNumber> regionNumbers() {
  static constexpr std::array<RegionNumber, 11> numbers = {{
      {"kinetic_energy", "J", "Σ ½ m v² + ½ J ω² of all disks"},
      {"max_overlap", "m", "largest overlap of all contacts"},
      {"mean_overlap", "m", "mean overlap of all contacts"},
      {"sliding_fraction", "-", "share of all contacts at the Coulomb bound"},
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

}  // namespace crossgrain::inline cases

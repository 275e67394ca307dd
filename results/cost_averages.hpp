#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace crossgrain::inline results {

/// What the averages of one packing on one engine came to; kept of every run.
struct AveragedPacking {
  double dt = 0.0;                                  ///< [s]
  double wallSeconds = 0.0, cpuSeconds = 0.0;       ///< of a rotation [s]
  std::uint64_t steps = 0, contactEvaluations = 0;  ///< of a rotation
  /// By measure; absent where the run has no such number. One per ring of "azimuthal_velocity"
  /// [ΩR_i], "stress_rr" [N/m²] and "volume_fraction"; a single one of "shear_band_width" [d],
  /// "wall_slip" (1 − v_φ/(ΩR_i) at the wheel, of the fit) and "stress_level" (σ_rr over all rings
  /// [N/m²]).
  using Numbers = std::map<std::string, std::vector<std::optional<double>>>;
  std::map<std::string, Numbers> samplings = {};  ///< by the name of a Sampling of the same run
};

}  // namespace crossgrain::inline results

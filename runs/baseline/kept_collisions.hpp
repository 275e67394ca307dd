#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace crossgrain::inline runs {

/// What an engine made of a sweep of collisions, to the bit.
struct KeptCollisions {
  std::string name, variant;    ///< of the case
  double dt = 0.0;              ///< of the scene [s]
  std::string refusal;          ///< why it was not run; empty if it was
  std::vector<double> psi, vn;  ///< of each collision: Ψ_i, speed of approach [m/s]
  /// Quantities by name, as scoredValue() has them; absent of a pair that did not part.
  std::map<std::string, std::vector<std::optional<double>>> values;
};

}  // namespace crossgrain::inline runs

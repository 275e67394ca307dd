#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "stability/limits.hpp"

namespace crossgrain::inline stability {

/// What a hard case's figure says of an engine.
struct StabilityVerdict {
  std::string verdict;                ///< "stable" | "degraded" | "unstable"
  double value = 0.0;                 ///< the largest of the curve
  std::size_t worst = 0;              ///< where that is
  std::optional<std::size_t> passed;  ///< where the limit was passed first
};

/// Stable up to the case's limit, degraded up to its second one, unstable beyond; what is no number
/// is beyond everything.
/// @param curve  not empty
StabilityVerdict stabilityVerdict(const Stability& limits, const std::vector<double>& curve);

}  // namespace crossgrain::inline stability

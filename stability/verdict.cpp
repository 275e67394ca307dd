#include "stability/verdict.hpp"

#include <cmath>
#include <limits>

namespace crossgrain::inline stability {

StabilityVerdict stabilityVerdict(const Stability& limits, const std::vector<double>& curve) {
  constexpr double most = std::numeric_limits<double>::max();
  StabilityVerdict found;
  for (std::size_t k = 0; k < curve.size(); ++k) {
    const double value = std::isfinite(curve[k]) ? curve[k] : most;
    if (value > limits.limit && !found.passed) found.passed = k;
    if (value <= found.value) continue;
    found.value = value;
    found.worst = k;
  }
  found.verdict = found.value <= limits.limit      ? "stable"
                  : found.value <= limits.degraded ? "degraded"
                                                   : "unstable";
  return found;
}

}  // namespace crossgrain::inline stability

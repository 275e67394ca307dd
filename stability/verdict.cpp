#include "stability/verdict.hpp"

#include <cmath>
#include <limits>

namespace crossgrain::inline stability {

StabilityJudgement judgeStability(const Stability& limits, const std::vector<double>& curve) {
  constexpr double most = std::numeric_limits<double>::max();
  StabilityJudgement found;
  for (std::size_t k = 0; k < curve.size(); ++k) {
    const double value = std::isfinite(curve[k]) ? curve[k] : most;
    if (value > limits.limit && !found.passed) found.passed = k;
    if (value <= found.value) continue;
    found.value = value;
    found.worst = k;
  }
  found.verdict = found.value <= limits.limit      ? Verdict::pass
                  : found.value <= limits.degraded ? Verdict::borderline
                                                   : Verdict::fail;
  return found;
}

}  // namespace crossgrain::inline stability

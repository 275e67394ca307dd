#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "stability/limits.hpp"

namespace crossgrain::inline stability {

/// What is said of an engine in a hard case, from best to worst.
enum class StabilityVerdict {
  notRun,   ///< nothing: there was no time
  refused,  ///< nothing: it lacks what the case calls for, or does not show what the measure takes
  stable,
  degraded,
  unstable  ///< also where it died, hung or returned what is no number
};
constexpr auto namesOf(StabilityVerdict) {
  return std::array<std::string_view, 5>{"not_run", "refused", "stable", "degraded", "unstable"};
}

/// Whether it says anything of the engine.
constexpr bool isJudged(StabilityVerdict verdict) {
  return verdict >= StabilityVerdict::stable;
}

/// What a hard case's figure says.
struct StabilityJudgement {
  StabilityVerdict verdict = StabilityVerdict::stable;
  double value = 0.0;                 ///< the largest of the curve
  std::size_t worst = 0;              ///< where that is
  std::optional<std::size_t> passed;  ///< where the limit was passed first
};

/// Stable up to the case's limit, degraded up to its second one, unstable beyond; what is no number
/// is beyond everything.
/// @param curve  not empty
StabilityJudgement judgeStability(const Stability& limits, const std::vector<double>& curve);

}  // namespace crossgrain::inline stability

#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "stability/limits.hpp"
#include "support/json_fields.hpp"
#include "support/verdict.hpp"

namespace crossgrain::inline stability {

/// Names in files of the verdict on an engine in a hard case, from best to worst: nothing where
/// there was no time; nothing where it lacks what the case calls for, or does not show what the
/// measure takes; and unstable also where it died, hung or returned what is no number.
inline constexpr support::EnumNames<Verdict, 5> stabilityNames{{{Verdict::notMeasured, "not_run"},
                                                                {Verdict::notApplicable, "refused"},
                                                                {Verdict::pass, "stable"},
                                                                {Verdict::borderline, "degraded"},
                                                                {Verdict::fail, "unstable"}}};

/// Verdict of a hard case's figure.
struct StabilityJudgement {
  Verdict verdict = Verdict::pass;
  double value = 0.0;                 ///< the largest of the curve
  std::size_t worst = 0;              ///< where that is
  std::optional<std::size_t> passed;  ///< where the limit was passed first
};

/// Stable up to the case's limit, degraded up to its second one, unstable beyond; what is no number
/// is beyond everything.
/// @param curve  not empty
StabilityJudgement judgeStability(const Stability& limits, const std::vector<double>& curve);

}  // namespace crossgrain::inline stability

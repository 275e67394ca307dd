#pragma once

#include <optional>

#include "reports/thesis/leg_rings.hpp"

namespace crossgrain::reports {

/// From which ring on the shear resistance is said to diverge; the defaults are those of the rule
/// that the claim about it is judged by. Places are r̃ of rings' centres.
struct DivergenceRule {
  double bandTo = 5.0;  ///< G/tr F of 0 ≤ r̃ < bandTo has the median that counts as proportional
  double from = 1.0, to = 16.0;  ///< looked at: from ≤ r̃ < to
  double factor = 2.0;           ///< above so many medians
};

/// By the rules that the results hold; the defaults where they hold none.
DivergenceRule divergenceRule(const ThesisResults& results);

/// tr F of the ring from which on, to the last that is looked at, G/tr F is above the factor times
/// its median in the band. Absent where the last ring is not; rings whose G is not positive count
/// nowhere.
std::optional<double> traceOfDivergence(const RingView& view, const DivergenceRule& rule);

}  // namespace crossgrain::reports

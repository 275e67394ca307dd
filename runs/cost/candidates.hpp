#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "results/cost_analysis.hpp"
#include "runs/cost/target.hpp"

/// Settings that were measured in several measures at once, and what they come to together.
namespace crossgrain::inline runs {

/// A setting of an engine with its points in every measure that decides.
struct Candidate {
  std::string knob, setting;
  PointIndices points;
  Standing standing = Standing::meets;
  std::size_t worst = 0;     ///< the point with the largest upper bound
  std::size_t obstacle = 0;  ///< the point with the largest lower bound if that is above the
                             ///< target, else the worst
  double time = std::numeric_limits<double>::infinity();  ///< [s]

  std::optional<double> seconds() const {
    return time < std::numeric_limits<double>::infinity() ? std::optional(time) : std::nullopt;
  }
};

/// Whether some setting meets a target in every measure.
struct Settled {
  CostVerdict verdict = CostVerdict::notMeasured;
  /// Reached: the cheapest; else the one whose largest upper bound is smallest. Absent where no
  /// setting was measured in every measure.
  std::optional<Candidate> best = {};
  /// Unless reached: the point that stands in the way, and, of undecided, what would decide on it.
  std::optional<std::size_t> obstacle = {};
  std::string decides = {};
  std::optional<double> length = {};  ///< as of Cheapest, of the measure that takes longest
};

/// @param belongs  which points decide
/// @param costKind  the kind whose time counts
Settled settle(const std::vector<CostPoint>& points,
               const std::function<bool(const CostPoint&)>& belongs, double target,
               CostKind costKind);

/// In the order of the points.
std::vector<std::string> enginesIn(const std::vector<CostPoint>& points);

}  // namespace crossgrain::inline runs

#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "results/thesis_formula.hpp"

/// What many runs say together. A run is one packing, and runs are independent of each other.
namespace crossgrain::inline studies {

struct Estimate {
  enum class Basis {
    runs,    ///< the error is over runs
    within,  ///< there is one run, and the error is within it, or nobody knows it
    exact    ///< of a calculation, without error
  };
  double value = 0.0;
  std::optional<double> standardError;
  double dof = std::numeric_limits<double>::infinity();  ///< of Student's t
  int runs = 0;
  Basis basis = Basis::runs;

  /// Half width of the interval; absent where there is no error.
  std::optional<double> half(double confidence) const;
};

/// A number of a calculation, that has no error.
Estimate exactly(double value);

/// Mean and sd/√n; of one run its own error. Absent of none.
std::optional<Estimate> meanOver(std::span<const Measured> values);

/// A run's y at its x.
struct TrendPoint {
  double x = 0.0, y = 0.0;
};

/// Kendall's τ_b, with the error that it has where y does not depend on x: the variance of S with
/// ties in x and y (Kendall 1970, chapter 4), taken as normal. Absent of fewer points than that, or
/// where all x or all y are the same.
std::optional<Estimate> rankTrend(std::span<const TrendPoint> points, int fewest);

/// Least-squares slope of y in x with a level of its own for each group. Absent where there is no
/// spread in x within a group, or no point left over for the error.
struct GroupedPoint {
  double x = 0.0, y = 0.0;
  std::size_t group = 0;
};
std::optional<Estimate> commonSlope(std::span<const GroupedPoint> points);

/// The slope through all points of all runs (one level), with the error that leaving out one run
/// after the other gives (jackknife; Efron 1982): points of one run are not independent. Absent of
/// fewer than three runs, or without spread in x.
std::optional<Estimate> slopeOverRuns(std::span<const std::vector<TrendPoint>> runs);

}  // namespace crossgrain::inline studies

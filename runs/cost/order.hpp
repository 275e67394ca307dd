#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "runs/cost/point.hpp"

namespace crossgrain::inline runs {

/// A point that a fit does not use, and why: one line.
struct LeftOut {
  std::size_t point = 0;
  std::string why;
};

/// The order p of error ∝ dt^p, fitted to the points of one engine, one scheme and one measure.
struct OrderFit {
  std::string engine, errorKind, measure;
  std::string integrator;                      ///< empty: the one the engine has by itself
  std::optional<double> order, standardError;  ///< absent: no fit
  std::optional<double> halfWidth;             ///< of the 95 % interval, Student's t
  std::optional<double> amplitude;             ///< the fit's error at dt = 1 s
  std::vector<std::size_t> used;               ///< by rising dt
  std::vector<LeftOut> leftOut;
  std::optional<double> theory;  ///< the order that is claimed
  /// "met" | "not met" | "exceeded" | "undecided" (the interval is wider than half an order) |
  /// "no claim" | "no fit"
  std::string verdict;
  std::string reason;  ///< of no fit: one line
};

/// Least squares of log error over log dt in the asymptotic range, which is what is left when these
/// are dropped: points that did not run; points at a floor, that is below three times the error of
/// the reference, the statistical error, or the level at which the error stops falling with the
/// step (local slopes below ½ from the smallest step on: rounding, or the model's own error); and
/// points outside the longest run of neighbours whose local slopes differ from their median by
/// less than ½ (of two as long, that of smaller steps). Fewer than three points give no fit.
///
/// A claim is met if it lies within the 95 % interval widened by 0.15, what higher orders bend a
/// line over steps that are factors of two apart.
/// @param points  of one engine, scheme, kind and measure; indices are into these
OrderFit fitOrder(const std::vector<CostPoint>& points, std::optional<double> theory);

/// One fit for each engine, kind, measure and integrator: points of the knobs "time_step" and
/// "integrator" (a setting "NAME" or "NAME, …"). Groups with a single step are left out; indices
/// are into all points.
/// @param theory  order claimed for "ENGINE INTEGRATOR", and for "ENGINE" the one it has by itself
std::vector<OrderFit> fitOrders(const std::vector<CostPoint>& points,
                                const std::map<std::string, double>& theory);

}  // namespace crossgrain::inline runs

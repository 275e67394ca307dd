#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "results/cost_analysis.hpp"
#include "results/cost_point.hpp"

namespace crossgrain::inline runs {

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

/// One fit for each engine, kind, measure and schemeOf(). Groups with a single step are left out;
/// indices are into all points.
/// @param theory  order claimed for "ENGINE INTEGRATOR", and for "ENGINE" the one it has by itself
std::vector<OrderFit> fitOrders(const std::vector<CostPoint>& points,
                                const std::map<std::string, int>& theory);

}  // namespace crossgrain::inline runs

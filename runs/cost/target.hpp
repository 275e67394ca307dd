#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "results/cost_point.hpp"

/// How measured points stand to an accuracy that is wanted.
namespace crossgrain::inline runs {

using PointIndices = std::vector<std::size_t>;  ///< of points

enum class Standing { meets, may, cannot };

/// @pre the point has an error or a bound
Standing standingOf(const CostPoint& point, double target);

/// Wall time, infinite where it is not known [s].
double timeOf(const CostPoint& point);

/// What would tell whether the error lies above or below the target. Repeats are taken to show the
/// same error with a smaller uncertainty.
std::string whatDecides(const CostPoint& point, double target);

/// Simulated time that makes the statistical part as small as the target, in units of what was
/// simulated; absent without such a part.
std::optional<double> lengthFor(const CostPoint& point, double target);

/// The one of smallest value; of equal ones the first. Absent of none.
template <class Value>
std::optional<std::size_t> least(const PointIndices& among, Value value) {
  const auto found = std::ranges::min_element(among, {}, value);
  return found == among.end() ? std::nullopt : std::optional(*found);
}

/// Of the points that were not run the one with the largest step that may yet be better than the
/// best: not those at the same or larger time steps of an engine's own scheme.
std::optional<std::size_t> mayYetReach(const std::vector<CostPoint>& points,
                                       const PointIndices& notRun, const CostPoint& best);

/// "t_c/100 and 2 more, which were not run: …"
std::string notRunInWords(const CostPoint& point, std::size_t count);

}  // namespace crossgrain::inline runs

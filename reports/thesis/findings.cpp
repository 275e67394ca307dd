#include "reports/thesis/findings.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "averaging/fits.hpp"
#include "reports/common/numbers.hpp"

namespace crossgrain::reports {

namespace {

constexpr double sixDiameters = 6.0;

std::string endsClause(const std::vector<Point>& points) {
  const auto middle = std::ranges::min_element(
      points, {}, [](const Point& p) { return std::abs(p.x - sixDiameters); });
  return fmt::format("{} next to the wheel, {} at {:.1f} d, {} at the outer ring",
                     readable(points.front().y), readable(middle->y), middle->x,
                     readable(points.back().y));
}

std::string extremesClause(const std::vector<Point>& points, const char* what) {
  const auto [low, high] = std::ranges::minmax_element(points, {}, &Point::y);
  return fmt::format("{}{} … {}", what, readable(low->y), readable(high->y));
}

std::string fitClause(const Fit& fit, std::size_t parameter, const char* before,
                      const char* after) {
  if (!fit.converged) return "no fit (" + fit.reason + ")";
  const FitParameter& found = fit.parameters.at(parameter);
  return before + readable(found.value, found.standardError) + after;
}

/// In units of the first x, for the power law.
std::vector<FitPoint> fitPoints(const std::vector<Point>& points, bool relative) {
  std::vector<FitPoint> result;
  for (const Point& point : points)
    result.push_back({relative ? point.x / points.front().x : point.x, point.y, point.error});
  return result;
}

}  // namespace

std::string clauseOf(const DrawnCurve& curve, Finding finding) {
  const std::vector<Point>& points = curve.points;
  if (points.empty()) return "";
  switch (finding) {
    case Finding::powerLaw:
      return fitClause(fitPowerLaw(fitPoints(points, true)), 1, "exponent ", "");
    case Finding::decay:
      return fitClause(fitVelocityDecay(fitPoints(points, false)), 1, "decay length ", " d");
    case Finding::identity: {
      std::vector<Point> ratios;
      for (const Point& point : points)
        if (point.x > 0.0) ratios.push_back({point.x, point.y / point.x, {}});
      return ratios.empty() ? "" : extremesClause(ratios, "y/x ");
    }
    case Finding::ends:
      if (curve.overRTilde) return endsClause(points);
      [[fallthrough]];
    case Finding::extremes:
      break;
  }
  return extremesClause(points, "");
}

std::string thesisAndFound(const std::string& says, const std::vector<DrawnCurve>& curves,
                           Finding finding) {
  std::vector<std::string> clauses;
  for (const DrawnCurve& curve : curves)
    if (const std::string clause = clauseOf(curve, finding); !clause.empty())
      clauses.push_back(curve.of + ": " + clause);
  return thesisAndFound(says, clauses);
}

std::string thesisAndFound(const std::string& says, const std::vector<std::string>& clauses) {
  return fmt::format("Thesis: {}. Found: {}.", says,
                     clauses.empty() ? "no data" : fmt::to_string(fmt::join(clauses, "; ")));
}

}  // namespace crossgrain::reports

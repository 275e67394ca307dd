#include "reports/thesis/drawing.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "averaging/fits.hpp"
#include "reports/common/engines.hpp"
#include "reports/common/numbers.hpp"

namespace crossgrain::reports {
namespace {

std::string endsClause(const std::vector<Point>& points) {
  const auto middle =
      std::ranges::min_element(points, {}, [](const Point& p) { return std::abs(p.x - 6.0); });
  return fmt::format("{} next to the wheel, {} at {:.1f} d, {} at the outer ring",
                     readable(points.front().y), readable(middle->y), middle->x,
                     readable(points.back().y));
}

std::string extremesClause(const std::vector<Point>& points, const char* what) {
  const auto [low, high] = std::ranges::minmax_element(points, {}, &Point::y);
  return fmt::format("{}{} … {}", what, readable(low->y), readable(high->y));
}

/// The second parameter of a fit, x in units of the first one's where wanted.
template <typename Fitted>
std::string fitClause(const std::vector<Point>& points, bool relative, Fitted fitted,
                      const char* before, const char* after) {
  std::vector<FitPoint> all;
  for (const Point& point : points)
    all.push_back({relative ? point.x / points.front().x : point.x, point.y, point.error});
  const Fit fit = fitted(all);
  if (!fit.converged) return "no fit (" + fit.reason + ")";
  const FitParameter& found = fit.parameters.at(1);
  return before + readable(found.value, found.standardError) + after;
}

/// "0.61 next to the wheel, 0.82 at 6 d, 0.80 at the outer ring"; empty without points.
std::string clauseOf(const DrawnCurve& curve, Finding finding) {
  const std::vector<Point>& points = curve.points;
  if (points.empty()) return "";
  const auto powerLaw = [](const std::vector<FitPoint>& all) { return fitPowerLaw(all); };
  const auto decay = [](const std::vector<FitPoint>& all) { return fitVelocityDecay(all); };
  if (finding == Finding::powerLaw) return fitClause(points, true, powerLaw, "exponent ", "");
  if (finding == Finding::decay) return fitClause(points, false, decay, "decay length ", " d");
  if (finding == Finding::identity) {
    std::vector<Point> ratios;
    for (const Point& point : points)
      if (point.x > 0.0) ratios.push_back({point.x, point.y / point.x, {}});
    return ratios.empty() ? "" : extremesClause(ratios, "y/x ");
  }
  return finding == Finding::ends && curve.overRTilde ? endsClause(points)
                                                      : extremesClause(points, "");
}

}  // namespace

Figure thesisFigureOf(const std::string& number, const std::string& title,
                      const std::string& caption, std::vector<Panel> panels, int columns) {
  Figure figure;
  figure.name = "figure_" + number;
  std::ranges::replace(figure.name, '.', '_');
  figure.title = "Figure " + number + ": " + title;
  figure.caption = fmt::format("Figure {}. {}. {}", number, title, caption);
  figure.panels = std::move(panels);
  figure.columns = columns;
  return figure;
}

std::string withoutBraces(std::string text) {
  std::erase_if(text, [](char c) { return c == '{' || c == '}'; });
  return text;
}

LineStyle thesisStyle(std::size_t colour, std::size_t engine) {
  return {engineStyle(colour).colour, engineStyle(engine).pointType,
          engine > 0 && colour != engine};
}

Curve guideLine(const std::string& name, std::vector<Point> points) {
  return {name, {"#888888", 0, true}, Draw::lines, std::move(points), 2.0};
}

bool fitAxis(Panel& panel, Range axis) {
  Range range = axis;
  for (const Curve& curve : panel.curves)
    for (const Point& point : curve.points) {
      if (!std::isfinite(point.y) || (panel.logY && point.y <= 0.0)) continue;
      range.low = std::min(range.low, point.y);
      range.high = std::max(range.high, point.y);
    }
  const bool below = range.low<axis.low, above = range.high> axis.high;
  if (panel.logY) {
    if (below) range.low = std::pow(10.0, std::floor(std::log10(range.low)));
    if (above) range.high = std::pow(10.0, std::ceil(std::log10(range.high)));
  } else {
    const double margin = 0.03 * (range.high - range.low);  // so that marks are not cut
    if (below) range.low -= margin;
    if (above) range.high += margin;
  }
  panel.yRange = range;
  return below || above;
}

MeanOfRuns meanOfRuns(const std::vector<std::optional<double>>& values) {
  std::vector<double> there;
  for (const auto& value : values)
    if (value) there.push_back(*value);
  if (there.empty()) return {};
  const auto count = static_cast<double>(there.size());
  double mean = 0.0, squares = 0.0;
  for (const double value : there) mean += value / count;
  for (const double value : there) squares += (value - mean) * (value - mean);
  if (there.size() < 2) return {mean, {}};
  return {mean, std::sqrt(squares / (count - 1.0) / count)};
}

std::vector<Point> meanPoints(const std::vector<CaseRun>& runs, const Formula& x, const Formula& y,
                              RingWidth width, const std::string& method) {
  std::vector<FormulaValue> across, up;
  for (const CaseRun& at : runs) {
    const RingAverages* const finest = width == RingWidth::finest ? finestOf(*at.run) : nullptr;
    const FormulaContext context{at, finest ? finest->profiles : at.run->run.profiles, method};
    if (context.profiles.empty()) continue;
    across.push_back(x.rings(context));
    up.push_back(y.rings(context));
  }
  std::vector<Point> points;
  if (up.empty()) return points;
  for (std::size_t ring = 0; ring < up.front().values.size(); ++ring) {
    std::vector<std::optional<double>> xs, ys;
    for (std::size_t k = 0; k < up.size(); ++k) {
      xs.push_back(at(across[k].values, ring));
      ys.push_back(at(up[k].values, ring));
    }
    const auto meanX = meanOfRuns(xs).mean;
    const auto [meanY, errorY] = meanOfRuns(ys);
    if (!meanX || !meanY) continue;
    points.push_back({*meanX, *meanY, up.size() == 1 ? up.front().errors[ring] : errorY});
  }
  return points;
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

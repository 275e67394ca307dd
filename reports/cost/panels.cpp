#include "reports/cost/panels.hpp"

#include <algorithm>
#include <cmath>

#include "reports/cost/words.hpp"

namespace crossgrain::reports {

namespace {

/// Whole decades around the errors, with room for what stands at the upper edge.
Range errorRange(const CostPoints& points) {
  double low = offScale, high = 0.0;
  for (const CostPoint& point : points)
    if (const auto error = countedError(point); error && *error > 0.0 && *error <= offScale) {
      low = std::min(low, *error);
      high = std::max(high, *error);
    }
  if (high == 0.0) return {0.1, offScale};
  return {std::pow(10.0, std::floor(std::log10(low) - 0.1)),
          std::pow(10.0, std::ceil(std::log10(high) + 0.3))};
}

/// The largest uncertainty of a reference of these points.
std::optional<double> referenceOf(const CostPoints& points) {
  std::optional<double> largest;
  for (const CostPoint& point : points)
    if (point.referenceError && *point.referenceError > 0.0)
      largest = std::max(*point.referenceError, largest.value_or(0.0));
  return largest;
}

}  // namespace

LineStyle openMarks(LineStyle style) {
  if (style.pointType % 2 == 1) style.pointType -= 1;
  return style;
}

CostPoints pointsOf(const CostPoints& points, const CostMeasure& measure) {
  CostPoints own;
  for (const CostPoint& point : points)
    if (measure.has(point)) own.push_back(point);
  return own;
}

Panel errorPanel(const CostPoints& points, const std::string& measure, const CostAxis& axis) {
  Panel panel;
  panel.title = measureEnhanced(measure);
  panel.xLabel = axis.label;
  panel.yLabel = "error";
  panel.logX = panel.logY = true;
  panel.yRange = errorRange(points);
  if (const auto reference = referenceOf(points); reference && *reference > panel.yRange->low)
    panel.shadedTo = std::min(*reference, panel.yRange->high);
  return panel;
}

std::optional<Point> errorPoint(const CostPoint& point, const CostAxis& axis) {
  const auto error = countedError(point), x = axis.value(point);
  if (!error || *error > offScale || !x) return std::nullopt;
  Point mark{*x, *error, {}};
  if (point.statistical && !mayBeChance(point)) mark.error = point.statistical;
  return mark;
}

Curve failures(const Panel& panel, const CostPoints& points, const CostEngine& engine,
               const CostAxis& axis) {
  constexpr double belowEdge = 1.35;
  Curve crosses{"", {engine.style.colour, crossMark, false}, Draw::points, {}, 1.5};
  for (const CostPoint& point : points) {
    const bool failed =
        point.status == CostStatus::failed || countedError(point).value_or(0.0) > offScale;
    if (const auto x = axis.value(point); failed && x && point.engine == engine.name)
      crosses.points.push_back({*x, panel.yRange->high / belowEdge, {}});
  }
  return crosses;
}

void addCurves(Panel& panel, std::vector<Curve> curves) {
  for (Curve& curve : curves)
    if (!curve.points.empty()) panel.curves.push_back(std::move(curve));
}

bool draws(const Figure& figure, const std::function<bool(const Curve&)>& isOfKind) {
  return std::ranges::any_of(figure.panels, [&](const Panel& panel) {
    return std::ranges::any_of(panel.curves, isOfKind);
  });
}

bool drawsMark(const Figure& figure, int pointType) {
  return draws(figure, [&](const Curve& curve) {
    return curve.draw == Draw::points && curve.style.pointType == pointType;
  });
}

void arrange(Figure& figure) {
  std::erase_if(figure.panels, [](const Panel& panel) { return !hasPoints(panel); });
  for (Panel& panel : figure.panels) panel.key = Key::none;
  figure.keyAbove = std::ranges::any_of(figure.panels, [](const Panel& panel) {
    return std::ranges::any_of(panel.curves,
                               [](const Curve& curve) { return !curve.name.empty(); });
  });
  figure.columns = figure.panels.size() > 1 ? 2 : 1;
  figure.panelWidth = 1040 / figure.columns;
  figure.panelHeight = 360;
}

}  // namespace crossgrain::reports

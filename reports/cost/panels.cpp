#include "reports/cost/panels.hpp"

#include <algorithm>
#include <cmath>

namespace crossgrain::reports {

namespace {

using Rows = std::vector<CostRow>;

/// Whole decades around the errors, with room for what stands at the upper edge.
Range errorRange(const Rows& rows) {
  double low = offScale, high = 0.0;
  for (const CostRow& row : rows)
    if (const auto error = row.counted(); error && *error > 0.0 && *error <= offScale) {
      low = std::min(low, *error);
      high = std::max(high, *error);
    }
  if (high == 0.0) return {0.1, offScale};
  return {std::pow(10.0, std::floor(std::log10(low) - 0.1)),
          std::pow(10.0, std::ceil(std::log10(high) + 0.3))};
}

/// The largest uncertainty of a reference of these points.
std::optional<double> referenceOf(const Rows& rows) {
  std::optional<double> largest;
  for (const CostRow& row : rows)
    if (row.reference && *row.reference > 0.0)
      largest = std::max(*row.reference, largest.value_or(0.0));
  return largest;
}

}  // namespace

LineStyle openMarks(LineStyle style) {
  if (style.pointType % 2 == 1) style.pointType -= 1;
  return style;
}

Rows rowsOf(const Rows& rows, const CostMeasure& measure) {
  Rows own;
  for (const CostRow& row : rows)
    if (measure.has(row)) own.push_back(row);
  return own;
}

Panel errorPanel(const Rows& rows, const std::string& measure, const CostAxis& axis) {
  Panel panel;
  panel.title = measureEnhanced(measure);
  panel.xLabel = axis.label;
  panel.yLabel = "error";
  panel.logX = panel.logY = true;
  panel.yRange = errorRange(rows);
  if (const auto reference = referenceOf(rows); reference && *reference > panel.yRange->low)
    panel.shadedTo = std::min(*reference, panel.yRange->high);
  return panel;
}

std::optional<Point> errorPoint(const CostRow& row, const CostAxis& axis) {
  const auto error = row.counted(), x = axis.value(row);
  if (!error || *error > offScale || !x) return std::nullopt;
  Point point{*x, *error, {}};
  if (row.statistical && !row.mayBeChance()) point.error = row.statistical;
  return point;
}

Curve failures(const Panel& panel, const Rows& rows, const EngineResults& engine,
               const CostAxis& axis) {
  constexpr double belowEdge = 1.35;
  Curve crosses{"", {engine.style.colour, crossMark, false}, Draw::points, {}, 1.5};
  for (const CostRow& row : rows) {
    const bool failed = row.status == "failed" || row.counted().value_or(0.0) > offScale;
    if (const auto x = axis.value(row); failed && x && row.engine == engine.name)
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

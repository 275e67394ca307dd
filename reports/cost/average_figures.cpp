#include <algorithm>
#include <cmath>

#include "reports/common/engines.hpp"
#include "reports/cost/panels.hpp"
#include "reports/cost/words.hpp"

namespace crossgrain::reports {

namespace {

using CostEngines = std::vector<CostEngine>;

std::optional<double> stepsOf(const CostPoint& point) {
  return point.stepsPerContact;
}

/// Time steps only: the two parts of an error that has both.
Panel partsPanel(const CostPoints& all, const CostEngines& engines, const CostMeasure& measure) {
  CostPoints points = pointsOf(all, measure);
  std::erase_if(points, [](const CostPoint& point) {
    return !point.ran() || point.knob != "time_step" || !point.statistical;
  });
  const CostAxis axis{stepsOf, "steps in a contact"};
  Panel panel = errorPanel(points, measure.name, axis);
  panel.shadedTo.reset();
  panel.yRange.reset();
  for (const CostEngine& engine : engines) {
    Curve bias{engine.name, engine.style, Draw::linesAndPoints, {}, 1.5};
    Curve bound{"", {engine.style.colour, openTriangle, false}, Draw::points, {}, 1.5};
    Curve noise{"", openMarks(engine.style), Draw::linesAndPoints, {}, 1.0};
    noise.style.dashed = true;
    for (const CostPoint& point : points) {
      const auto x = axis.value(point);
      if (point.engine != engine.name || !x) continue;
      noise.points.push_back({*x, *point.statistical, {}});
      if (mayBeChance(point))
        bound.points.push_back({*x, countedError(point).value_or(0.0), {}});
      else if (point.systematic)
        bias.points.push_back({*x, *point.systematic, point.statistical});
    }
    for (Curve* curve : {&bias, &noise}) std::ranges::sort(curve->points, {}, &Point::x);
    if (bias.points.empty()) noise.name = engine.name;
    addCurves(panel, {std::move(bias), std::move(bound), std::move(noise)});
  }
  return panel;
}

/// Through the last point with the slope that independent samples have.
Curve rootLine(const std::vector<Point>& points, const LineStyle& style) {
  Curve line{"", {style.colour, 7, true}, Draw::lines, {}, 0.8};
  const auto [first, last] = std::ranges::minmax_element(points, {}, &Point::x);
  for (const double x : {first->x, last->x})
    line.points.push_back({x, last->y * std::sqrt(last->x / x), {}});
  return line;
}

}  // namespace

Figure costPartsFigure(const CostPoints& points, const CostEngines& engines) {
  Figure figure;
  figure.name = "cost_parts";
  figure.title = "Systematic and statistical part of averages";
  figure.caption =
      "The two parts of an average's error, at the time steps. Filled, joined: the systematic "
      "part, ± the statistical one; longer runs do not lessen it. Open, dashed: the statistical "
      "part.";
  for (const CostMeasure& measure : measuresDrawn(points))
    if (measure.kind == CostKind::averages)
      figure.panels.push_back(partsPanel(points, engines, measure));
  if (drawsMark(figure, openTriangle))
    figure.caption += " ▽: the upper bound of the systematic part where it may be none.";
  arrange(figure);
  return figure;
}

Figure costFallsFigure(const CostResults& results, const CostEngines& engines) {
  Figure figure;
  figure.name = "cost_falls";
  figure.title = "Statistical part against simulated time";
  figure.caption =
      "The statistical part of averages over the first part of the runs. Dashed: falling with the "
      "root of simulated time, as independent samples do.";
  const std::vector<StatisticalFall>& falls = results.averages.falls;
  std::vector<std::string> measures;
  for (const StatisticalFall& one : falls)
    if (std::ranges::find(measures, one.measure) == measures.end()) measures.push_back(one.measure);
  for (const std::string& measure : measures) {
    Panel panel;
    panel.title = measureEnhanced(measure);
    panel.xLabel = "rotations";
    panel.yLabel = "statistical part";
    panel.logX = panel.logY = true;
    for (const CostEngine& engine : engines) {
      Curve curve{engine.name, engine.style, Draw::linesAndPoints, {}, 1.5};
      for (const StatisticalFall& one : falls)
        if (one.engine == engine.name && one.measure == measure)
          curve.points.push_back({one.rotations, one.statistical, {}});
      if (curve.points.empty()) continue;
      panel.curves.push_back(rootLine(curve.points, engine.style));
      panel.curves.push_back(std::move(curve));
    }
    figure.panels.push_back(std::move(panel));
  }
  arrange(figure);
  return figure;
}

Figure costGrowthFigure(const CostResults& results) {
  Figure figure;
  figure.name = "cost_growth";
  figure.title = "How fast trajectories part";
  figure.caption =
      "Root mean square distance of the disks of two runs of one engine that began next to alike. "
      "Shaded: the window in which trajectories are compared, before chaos takes over.";
  if (!results.trajectory) return figure;
  Panel panel;
  panel.xLabel = "time [s]";
  panel.yLabel = "separation / d";
  panel.logY = true;
  Curve grown{"", engineStyle(0), Draw::linesAndPoints, {}, 1.2};
  for (const Separation& at : results.trajectory->separations)
    grown.points.push_back({at.time, at.value, {}});
  panel.curves.push_back(std::move(grown));
  panel.shaded = Range{0.0, results.trajectory->window.length};
  figure.panels.push_back(std::move(panel));
  arrange(figure);
  return figure;
}

}  // namespace crossgrain::reports

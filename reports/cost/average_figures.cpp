#include <algorithm>
#include <cmath>

#include "reports/cost/panels.hpp"

namespace crossgrain::reports {

namespace {

using Rows = std::vector<CostRow>;
using Engines = std::vector<EngineResults>;

std::optional<double> stepsOf(const CostRow& row) {
  return row.stepsPerContact;
}

/// Time steps only: the two parts of an error that has both.
Panel partsPanel(const Rows& all, const Engines& engines, const CostMeasure& measure) {
  Rows rows = rowsOf(all, measure);
  std::erase_if(rows, [](const CostRow& row) {
    return !row.ran() || row.knob != "time_step" || !row.statistical;
  });
  const CostAxis axis{stepsOf, "steps in a contact"};
  Panel panel = errorPanel(rows, measure.name, axis);
  panel.shadedTo.reset();
  panel.yRange.reset();
  for (const EngineResults& engine : engines) {
    Curve bias{engine.name, engine.style, Draw::linesAndPoints, {}, 1.5};
    Curve bound{"", {engine.style.colour, openTriangle, false}, Draw::points, {}, 1.5};
    Curve noise{"", openMarks(engine.style), Draw::linesAndPoints, {}, 1.0};
    noise.style.dashed = true;
    for (const CostRow& row : rows) {
      const auto x = axis.value(row);
      if (row.engine != engine.name || !x) continue;
      noise.points.push_back({*x, *row.statistical, {}});
      if (row.mayBeChance())
        bound.points.push_back({*x, row.counted().value_or(0.0), {}});
      else if (row.systematic)
        bias.points.push_back({*x, *row.systematic, row.statistical});
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

Figure costPartsFigure(const Rows& rows, const Engines& engines) {
  Figure figure;
  figure.name = "cost_parts";
  figure.title = "Systematic and statistical part of averages";
  figure.caption =
      "The two parts of an average's error, at the time steps. Filled, joined: the systematic "
      "part, ± the statistical one; longer runs do not lessen it. Open, dashed: the statistical "
      "part.";
  for (const CostMeasure& measure : costMeasures(rows))
    if (measure.kind == "averages") figure.panels.push_back(partsPanel(rows, engines, measure));
  if (drawsMark(figure, openTriangle))
    figure.caption += " ▽: the upper bound of the systematic part where it may be none.";
  arrange(figure);
  return figure;
}

Figure costFallsFigure(const Json& results, const Engines& engines) {
  Figure figure;
  figure.name = "cost_falls";
  figure.title = "Statistical part against simulated time";
  figure.caption =
      "The statistical part of averages over the first part of the runs. Dashed: falling with the "
      "root of simulated time, as independent samples do.";
  const Json& falls = list(member(results, "averages"), "falls");
  std::vector<std::string> measures;
  for (const Json& one : falls)
    if (std::ranges::find(measures, text(one, "measure")) == measures.end())
      measures.push_back(text(one, "measure"));
  for (const std::string& measure : measures) {
    Panel panel;
    panel.title = measureEnhanced(measure);
    panel.xLabel = "rotations";
    panel.yLabel = "statistical part";
    panel.logX = panel.logY = true;
    for (const EngineResults& engine : engines) {
      Curve curve{engine.name, engine.style, Draw::linesAndPoints, {}, 1.5};
      for (const Json& one : falls)
        if (const auto x = number(one, "rotations"), y = number(one, "statistical");
            x && y && text(one, "engine") == engine.name && text(one, "measure") == measure)
          curve.points.push_back({*x, *y, {}});
      if (curve.points.empty()) continue;
      panel.curves.push_back(rootLine(curve.points, engine.style));
      panel.curves.push_back(std::move(curve));
    }
    figure.panels.push_back(std::move(panel));
  }
  arrange(figure);
  return figure;
}

Figure costGrowthFigure(const Json& results) {
  const Json& trajectory = member(results, "trajectory");
  Panel panel;
  panel.xLabel = "time [s]";
  panel.yLabel = "separation / d";
  panel.logY = true;
  Curve grown{"", engineStyle(0), Draw::linesAndPoints, {}, 1.2};
  for (const Json& entry : list(trajectory, "growth"))
    if (const auto time = number(entry, "t_s"), distance = number(entry, "separation");
        time && distance)
      grown.points.push_back({*time, *distance, {}});
  panel.curves.push_back(std::move(grown));
  const auto window = number(trajectory, "window_s");
  if (window) panel.shaded = Range{0.0, *window};
  Figure figure;
  figure.name = "cost_growth";
  figure.title = "How fast trajectories part";
  figure.caption =
      "Root mean square distance of the disks of two runs of one engine that began next to alike.";
  if (window)
    figure.caption +=
        " Shaded: the window in which trajectories are compared, before chaos takes over.";
  figure.panels.push_back(std::move(panel));
  arrange(figure);
  return figure;
}

}  // namespace crossgrain::reports

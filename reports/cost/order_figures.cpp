#include <algorithm>
#include <cmath>

#include "reports/cost/panels.hpp"

namespace crossgrain::reports {

namespace {

using CostEngines = std::vector<CostEngine>;

std::optional<double> dtOf(const CostPoint& point) {
  return point.dt;
}

const CostAxis& stepAxis() {
  static const CostAxis axis{dtOf, "time step [s]"};
  return axis;
}

const LineStyle claimedStyle{"#8a949e", 7, true};

/// The claimed slope through the middle of the points that were fitted.
std::optional<Curve> claimedLine(const OrderFit& fit, bool named) {
  const auto low = fit.dtLow, high = fit.dtHigh;
  if (!fit.theory || !low || !high || !fit.order || !fit.amplitude) return std::nullopt;
  constexpr double beyond = 1.4;
  const double middle = std::sqrt(*low * *high);
  const double error = *fit.amplitude * std::pow(middle, *fit.order);
  Curve line{named ? "claimed order" : "", claimedStyle, Draw::lines, {}, 1.2};
  for (const double dt : {*low / beyond, *high * beyond})
    line.points.push_back({dt, error * std::pow(dt / middle, *fit.theory), {}});
  return line;
}

/// Points of one scheme: joined; those that were fitted filled, of another integrator dashed.
void addScheme(Panel& panel, const CostPoints& all, const OrderFit& fit, const CostEngine& engine) {
  const std::string& integrator = fit.integrator;
  const std::string name = integrator.empty() ? engine.name : engine.name + ", " + integrator;
  LineStyle style = engine.style;
  style.dashed = style.dashed || !integrator.empty();
  Curve line{"", style, Draw::lines, {}, 1.2};
  Curve used{name, style, Draw::points, {}, 1.2};
  Curve left{"", openMarks(style), Draw::points, {}, 1.2};
  const auto add = [&](std::size_t place, Curve& marks) {
    const CostPoint* point = pointAt(all, place);
    const auto mark = point ? errorPoint(*point, stepAxis()) : std::nullopt;
    if (!mark) return;
    marks.points.push_back(*mark);
    line.points.push_back({mark->x, mark->y, {}});
  };
  for (const std::size_t place : fit.used) add(place, used);
  for (const LeftOut& one : fit.leftOut) add(one.point, left);
  std::ranges::sort(line.points, {}, &Point::x);
  if (used.points.empty()) left.name = name;
  addCurves(panel, {std::move(line), std::move(used), std::move(left)});
}

Panel orderPanel(const CostResults& results, const CostEngines& engines,
                 const CostMeasure& measure) {
  CostPoints steps = pointsOf(results.points, measure);
  std::erase_if(steps, [](const CostPoint& point) { return !schemeOf(point); });
  Panel panel = errorPanel(steps, measure.name, stepAxis());
  std::vector<const OrderFit*> fits;
  for (const OrderFit& fit : results.orders)
    if (fit.kind == measure.kind && fit.measure == measure.name) fits.push_back(&fit);
  for (const OrderFit* fit : fits)
    if (auto line = claimedLine(*fit, panel.curves.empty()))
      panel.curves.push_back(std::move(*line));
  for (const CostEngine& engine : engines) {
    for (const OrderFit* fit : fits)
      if (fit->engine == engine.name) addScheme(panel, results.points, *fit, engine);
    addCurves(panel, {failures(panel, steps, engine, stepAxis())});
  }
  return panel;
}

}  // namespace

Figure costOrderFigure(const CostResults& results, const CostEngines& engines, CostKind kind) {
  Figure figure;
  figure.name = "cost_orders_" + toString(kind);
  figure.title = "Order of convergence: " + toString(kind);
  figure.caption =
      "Error against the time step. Filled: the points that an order was fitted to; open: left "
      "out.";
  for (const CostMeasure& measure : measuresDrawn(results.points))
    if (measure.kind == kind) figure.panels.push_back(orderPanel(results, engines, measure));
  if (draws(figure, [](const Curve& curve) { return curve.style == claimedStyle; }))
    figure.caption += " Grey, dashed: the order that is claimed, through the middle of the fit.";
  if (drawsMark(figure, crossMark)) figure.caption += " × failed.";
  arrange(figure);
  return figure;
}

}  // namespace crossgrain::reports

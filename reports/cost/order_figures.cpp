#include <algorithm>
#include <cmath>

#include "reports/cost/panels.hpp"

namespace crossgrain::reports {

namespace {

using Rows = std::vector<CostRow>;
using Engines = std::vector<EngineResults>;

std::optional<double> dtOf(const CostRow& row) {
  return row.dt;
}

const CostAxis& stepAxis() {
  static const CostAxis axis{dtOf, "time step [s]"};
  return axis;
}

const LineStyle claimedStyle{"#8a949e", 7, true};

/// The claimed slope through the middle of the points that were fitted.
std::optional<Curve> claimedLine(const Json& order, bool named) {
  const auto theory = number(order, "theory"), low = number(order, "dt_low_s"),
             high = number(order, "dt_high_s"), fitted = number(order, "order"),
             amplitude = number(order, "amplitude");
  if (!theory || !low || !high || !fitted || !amplitude) return std::nullopt;
  constexpr double beyond = 1.4;
  const double middle = std::sqrt(*low * *high);
  const double error = *amplitude * std::pow(middle, *fitted);
  Curve line{named ? "claimed order" : "", claimedStyle, Draw::lines, {}, 1.2};
  for (const double dt : {*low / beyond, *high * beyond})
    line.points.push_back({dt, error * std::pow(dt / middle, *theory), {}});
  return line;
}

/// Points of one scheme: joined; those that were fitted filled, of another integrator dashed.
void addScheme(Panel& panel, const Rows& all, const Json& order, const EngineResults& engine) {
  const std::string integrator = text(order, "integrator");
  const std::string name = integrator.empty() ? engine.name : engine.name + ", " + integrator;
  LineStyle style = engine.style;
  style.dashed = style.dashed || !integrator.empty();
  Curve line{"", style, Draw::lines, {}, 1.2};
  Curve used{name, style, Draw::points, {}, 1.2};
  Curve left{"", openMarks(style), Draw::points, {}, 1.2};
  const auto add = [&](const Json& place, Curve& marks) {
    const CostRow* row = rowAt(all, place);
    const auto point = row ? errorPoint(*row, stepAxis()) : std::nullopt;
    if (!point) return;
    marks.points.push_back(*point);
    line.points.push_back({point->x, point->y, {}});
  };
  for (const Json& place : list(order, "used")) add(place, used);
  for (const Json& one : list(order, "left_out")) add(member(one, "point"), left);
  std::ranges::sort(line.points, {}, &Point::x);
  if (used.points.empty()) left.name = name;
  addCurves(panel, {std::move(line), std::move(used), std::move(left)});
}

Panel orderPanel(const Json& results, const Rows& all, const Engines& engines,
                 const CostMeasure& measure) {
  Rows steps = rowsOf(all, measure);
  std::erase_if(steps, [](const CostRow& row) { return !row.scheme(); });
  Panel panel = errorPanel(steps, measure.name, stepAxis());
  std::vector<const Json*> orders;
  for (const Json& order : list(results, "orders"))
    if (text(order, "error_kind") == measure.kind && text(order, "measure") == measure.name)
      orders.push_back(&order);
  for (const Json* order : orders)
    if (auto line = claimedLine(*order, panel.curves.empty()))
      panel.curves.push_back(std::move(*line));
  for (const EngineResults& engine : engines) {
    for (const Json* order : orders)
      if (text(*order, "engine") == engine.name) addScheme(panel, all, *order, engine);
    addCurves(panel, {failures(panel, steps, engine, stepAxis())});
  }
  return panel;
}

}  // namespace

Figure costOrderFigure(const Json& results, const Rows& rows, const Engines& engines,
                       const std::string& kind) {
  Figure figure;
  figure.name = "cost_orders_" + kind;
  figure.title = "Order of convergence: " + kind;
  figure.caption =
      "Error against the time step. Filled: the points that an order was fitted to; open: left "
      "out.";
  for (const CostMeasure& measure : costMeasures(rows))
    if (measure.kind == kind) figure.panels.push_back(orderPanel(results, rows, engines, measure));
  if (draws(figure, [](const Curve& curve) { return curve.style == claimedStyle; }))
    figure.caption += " Grey, dashed: the order that is claimed, through the middle of the fit.";
  if (drawsMark(figure, crossMark)) figure.caption += " × failed.";
  arrange(figure);
  return figure;
}

}  // namespace crossgrain::reports

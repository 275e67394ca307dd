#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "reports/collide_figures.hpp"
#include "reports/figures.hpp"

namespace crossgrain::reports {

std::vector<Point> pointsOf(const Json& rows, const char* x, const char* y) {
  std::vector<Point> points;
  for (const Json& row : rows) {
    const auto px = number(row, x), py = number(row, y);
    if (px && py) points.push_back({*px, *py, {}});
  }
  return points;
}

std::vector<const Json*> firstCurves(const Json& variant) {
  std::vector<const Json*> curves;
  std::set<std::string> seen;
  for (const Json& curve : list(variant, "curves"))
    if (!list(curve, "points").empty() && seen.insert(text(curve, "engine")).second)
      curves.push_back(&curve);
  return curves;
}

Range psiRange(const Json& variant) {
  double largest = 0.0;
  for (const Json& row : list(variant, "oracle"))
    largest = std::max(largest, number(row, "psi_i").value_or(0.0));
  for (const Json& curve : list(variant, "curves"))
    for (const Json& point : list(curve, "points"))
      largest = std::max(largest, number(point, "psi_i").value_or(0.0));
  return {0.0, largest > 0.0 ? largest * 1.02 : 1.0};
}

namespace {

const LineStyle asymptoteStyle{"#999999", 0, true};

/// One line per approach speed of the oracle; only the first is in the key.
std::vector<Curve> oracleCurves(const Json& variant) {
  std::map<double, std::vector<Point>> bySpeed;
  for (const Json& row : list(variant, "oracle")) {
    const auto psi = number(row, "psi_i"), after = number(row, "psi_f");
    if (psi && after) bySpeed[number(row, "v_n").value_or(0.0)].push_back({*psi, *after, {}});
  }
  std::vector<Curve> curves;
  for (auto& [speed, points] : bySpeed)
    curves.push_back(
        {curves.empty() ? "oracle" : "", oracleStyle, Draw::lines, std::move(points), 3.0});
  return curves;
}

/// Sticking Ψ_f = −e_t0 Ψ_i up to where it meets sliding Ψ_f = Ψ_i − K(1+e)µ (Luding 1998), and
/// sliding beyond zero.
std::vector<Curve> asymptotes(const Json& variant, double lastPsi) {
  std::vector<Curve> curves;
  const auto constant = number(variant, "sliding_constant");
  const auto restitution = number(member(variant, "sticking"), "e_t0");
  const double meeting = constant ? *constant / (1.0 + restitution.value_or(0.0)) : lastPsi;
  if (restitution) {
    const double end = std::min(meeting, lastPsi);
    curves.push_back(
        {"", asymptoteStyle, Draw::lines, {{0.0, 0.0, {}}, {end, -*restitution * end, {}}}, 1.0});
  }
  if (constant) {
    const double begin = std::max(0.0, *constant - 0.7);
    if (begin < lastPsi)
      curves.push_back({"asymptotes",
                        asymptoteStyle,
                        Draw::lines,
                        {{begin, begin - *constant, {}}, {lastPsi, lastPsi - *constant, {}}},
                        1.0});
  }
  return curves;
}

/// Figure 4.3 of Lätzel (2003): each engine at the first of its time steps.
Panel sweepPanel(const Json& variant, const Styles& styles) {
  Panel panel;
  panel.xLabel = "Ψ_{i} = v_{t,i} / v_{n,i}";
  panel.yLabel = "Ψ_{f} = v_{t,f} / v_{n,i}";
  panel.level = 0.0;
  panel.key = Key::topLeft;
  panel.xRange = psiRange(variant);
  panel.curves = asymptotes(variant, panel.xRange->high);
  for (Curve& curve : oracleCurves(variant)) panel.curves.push_back(std::move(curve));
  for (const Json* curve : firstCurves(variant)) {
    const std::string engine = text(*curve, "engine");
    auto points = pointsOf(list(*curve, "points"), "psi_i", "psi_f");
    if (points.empty()) continue;
    panel.curves.push_back({engine, styles.at(engine), Draw::points, std::move(points), 1.0});
  }
  return panel;
}

/// |Ψ_f − Ψ_f,oracle|, one curve per engine and time step.
Panel errorPanel(const Json& variant, const Styles& styles) {
  Panel panel;
  panel.xLabel = "Ψ_{i}";
  panel.yLabel = "|Ψ_{f} − Ψ_{f,oracle}|";
  panel.logY = true;
  panel.key = Key::none;
  panel.xRange = psiRange(variant);
  for (const Json& curve : list(variant, "curves")) {
    const std::string engine = text(curve, "engine");
    std::vector<Point> points;
    for (const Json& point : list(curve, "points")) {
      const auto psi = number(point, "psi_i"), found = number(point, "psi_f"),
                 expected = number(point, "psi_f_reference");
      if (psi && found && expected) points.push_back({*psi, std::abs(*found - *expected), {}});
    }
    std::ranges::sort(points, {}, &Point::x);
    if (!points.empty())
      panel.curves.push_back(
          {engine, styles.at(engine), Draw::linesAndPoints, std::move(points), 1.0});
  }
  return panel;
}

/// "grain: order 1.02 ± 0.03"
std::string orderInWords(const Json& order) {
  const std::string error =
      number(order, "stderr") ? fmt::format(" ± {:.2f}", *number(order, "stderr")) : std::string();
  return fmt::format("{}: order {:.2f}{}", text(order, "engine"),
                     number(order, "order").value_or(0.0), error);
}

/// The least-squares line of slope `order` through points in log–log: it goes through their mean.
std::vector<Point> fittedLine(const std::vector<Point>& points, double order) {
  double x = 0.0, y = 0.0;
  for (const Point& p : points) {
    x += std::log(p.x) / static_cast<double>(points.size());
    y += std::log(p.y) / static_cast<double>(points.size());
  }
  std::vector<Point> line;
  for (const Point& end : {points.front(), points.back()})
    line.push_back({end.x, std::exp(y + order * (std::log(end.x) - x)), {}});
  return line;
}

/// Rms error of a sweep against its time step and the order fitted to it; only engines that ran
/// with several.
Panel convergencePanel(const Json& results, const Json& variant, const Styles& styles) {
  Panel panel;
  panel.xLabel = "dt [s]";
  panel.yLabel = "rms error / range of Ψ_{f}";
  panel.logX = panel.logY = true;
  panel.key = Key::outside;
  std::map<std::string, std::map<double, double>> errors;
  for (const Json& curve : list(variant, "curves")) {
    const auto dt = number(curve, "dt"), error = number(member(curve, "score"), "rms_error");
    if (dt && error && *dt > 0.0 && *error > 0.0) errors[text(curve, "engine")][*dt] = *error;
  }
  for (const Json& order : list(results, "orders")) {
    const std::string engine = text(order, "engine");
    const auto slope = number(order, "order");
    const bool own = text(order, "variant") == text(variant, "variant") &&
                     text(order, "case") == text(variant, "case");
    if (!own || !slope || errors[engine].size() < 2) continue;
    std::vector<Point> points;
    for (const auto& [dt, error] : errors[engine]) points.push_back({dt, error, {}});
    LineStyle line = styles.at(engine);
    panel.curves.push_back({"", line, Draw::lines, fittedLine(points, *slope), 1.0});
    panel.curves.push_back({orderInWords(order), line, Draw::points, std::move(points), 1.0});
  }
  return panel;
}

}  // namespace

std::vector<Figure> collideFigures(const Json& results) {
  const std::vector<LineStyle> order = engineStyles(results);
  Styles styles;
  for (std::size_t k = 0; k < order.size(); ++k)
    styles[text(list(results, "engines")[k], "name")] = order[k];
  for (const Json& variant : list(results, "variants"))
    for (const Json& curve : list(variant, "curves"))
      styles.try_emplace(text(curve, "engine"), engineStyle(styles.size()));

  std::vector<Figure> figures;
  std::size_t index = 0;
  for (const Json& variant : list(results, "variants")) {
    Figure figure;
    figure.name = fmt::format("collision_{}", ++index);
    figure.title = "Tangential velocity after a collision against before, and its error";
    for (Panel panel : {sweepPanel(variant, styles), errorPanel(variant, styles),
                        convergencePanel(results, variant, styles)})
      if (hasPoints(panel)) figure.panels.push_back(std::move(panel));
    if (figure.panels.empty()) continue;
    figure.caption =
        "Left: every engine at the first of its time steps. Further panels: every time step, one "
        "curve each; and the rms error against the time step, with the order fitted to it.";
    figure.columns = static_cast<int>(figure.panels.size());
    figure.panelWidth = 420;
    figures.push_back(std::move(figure));
    Figure quantities = quantitiesFigure(variant, styles, figures.back().name + "_quantities");
    if (!quantities.panels.empty()) figures.push_back(std::move(quantities));
  }
  return figures;
}

}  // namespace crossgrain::reports

#include "reports/collide/figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/collide/report.hpp"
#include "reports/common/engines.hpp"
#include "reports/common/numbers.hpp"

namespace crossgrain::reports {

namespace {

const LineStyle asymptoteStyle{"#999999", 0, true};
const LineStyle noLimitStyle{"#cc3311", 4, false};  ///< open squares

bool draws(const Figure& figure, const LineStyle& style) {
  return std::ranges::any_of(figure.panels, [&](const Panel& panel) {
    return std::ranges::any_of(panel.curves, [&](const Curve& curve) {
      return curve.style == style && !curve.points.empty();
    });
  });
}

/// Ψ_f over Ψ_i; `stride` 1: all points.
std::vector<Point> pointsOf(const CollisionTable& table, std::size_t stride) {
  std::vector<Point> points;
  for (std::size_t k = 0; k < table.size(); k += stride) {
    const auto x = numberAt(table.psi, k), y = table.at(QuantityId::psiF, k);
    if (x && y) points.push_back({*x, *y, {}});
  }
  return points;
}

/// A curve of marks has at most about 14.
std::size_t markStride(const CollisionTable& table) {
  return std::max<std::size_t>(1, (table.size() + 13) / 14);
}

double largestPsi(const CollisionVariant& variant) {
  double largest = 0.0;
  const auto take = [&](const CollisionTable& table) {
    for (const double psi : table.psi)
      if (std::isfinite(psi)) largest = std::max(largest, psi);
  };
  take(variant.oracle);
  for (const CollisionCurve& curve : variant.curves) take(curve.points);
  return largest > 0.0 ? largest : 1.0;
}

/// Sticking Ψ_f = −e_t0 Ψ_i up to where it meets sliding Ψ_f = Ψ_i − K(1+e)µ (Luding 1998), and
/// sliding beyond zero.
std::vector<Curve> asymptotes(const CollisionVariant& variant, double lastPsi) {
  std::vector<Curve> curves;
  const auto constant = finite(variant.slidingConstant);
  const auto restitution = finite(variant.sticking.et0);
  const double meeting = constant ? *constant / (1.0 + restitution.value_or(0.0)) : lastPsi;
  if (restitution) {
    const double end = std::min(meeting, lastPsi);
    curves.push_back(
        {"", asymptoteStyle, Draw::lines, {{0.0, 0.0, {}}, {end, -*restitution * end, {}}}, 1.0});
  }
  if (constant) {
    const double begin = std::max(0.0, *constant - 0.7);
    if (begin < lastPsi)
      curves.push_back({"",
                        asymptoteStyle,
                        Draw::lines,
                        {{begin, begin - *constant, {}}, {lastPsi, lastPsi - *constant, {}}},
                        1.0});
  }
  return curves;
}

/// Points of the sweep at which the law has no limit of small time steps, on the oracle's line.
Curve noLimitMarks(const CollisionVariant& variant) {
  Curve marks{"", noLimitStyle, Draw::points, {}, 1.5};
  for (const NoLimitPoint& point : variant.noLimit)
    if (std::isfinite(point.psi) && std::isfinite(point.psiAfter))
      marks.points.push_back({point.psi, point.psiAfter, {}});
  return marks;
}

/// Figure 4.3 of Lätzel (2003): each engine at the largest of its time steps.
Panel sweepPanel(const CollisionVariant& variant, const Styles& styles) {
  Panel panel = panelOver(variant, "Ψ_{f}");
  panel.level = 0.0;
  panel.curves = asymptotes(variant, panel.xRange->high);
  if (auto line = pointsOf(variant.oracle, 1); !line.empty())
    panel.curves.push_back({"oracle", oracleStyle, Draw::lines, std::move(line), 3.0});
  for (const auto& [engine, style] : styles)
    if (const CollisionCurve* curve = coarsestCurve(variant, engine))
      panel.curves.push_back(
          {engine, style, Draw::points, pointsOf(curve->points, markStride(curve->points)), 1.0});
  panel.curves.push_back(noLimitMarks(variant));
  return panel;
}

/// |Ψ_f − Ψ_f,oracle| of each engine at the largest of its time steps.
Panel errorPanel(const CollisionVariant& variant, const Styles& styles) {
  Panel panel = panelOver(variant, "|Ψ_{f} − oracle|");
  panel.logY = true;
  for (const auto& [engine, style] : styles) {
    const CollisionCurve* curve = coarsestCurve(variant, engine);
    if (!curve) continue;
    const CollisionTable& table = curve->points;
    std::vector<Point> points;
    for (std::size_t k = 0; k < table.size(); ++k) {
      const auto psi = numberAt(table.psi, k), found = table.at(QuantityId::psiF, k),
                 expected = variant.reference.at(QuantityId::psiF, k);
      if (psi && found && expected) points.push_back({*psi, std::abs(*found - *expected), {}});
    }
    std::ranges::sort(points, {}, &Point::x);
    panel.curves.push_back({engine, style, Draw::lines, std::move(points), 1.2});
  }
  return panel;
}

/// Keeps the place of a panel that there is nothing to draw in.
Panel emptyPanel(const CollisionVariant& variant, const char* why) {
  Panel panel = panelOver(variant, why);
  panel.yRange = Range{0.0, 1.0};
  panel.curves.push_back({"", oracleStyle, Draw::lines, {{0.0, 0.0, {}}}, 1.0});
  return panel;
}

Figure curvesFigure(const CaseGroup& group, const Styles& styles, const std::string& name) {
  Figure figure;
  figure.name = name;
  figure.title = "Tangential velocity after a collision against before, and its error";
  for (const CollisionVariant* variant : group.variants) {
    Panel sweep = sweepPanel(*variant, styles);
    if (!hasPoints(sweep)) continue;
    figure.panels.push_back(std::move(sweep));
    Panel error = errorPanel(*variant, styles);
    if (!hasPoints(error)) error = emptyPanel(*variant, "no error: no oracle, or no run");
    figure.panels.push_back(std::move(error));
  }
  figure.caption =
      "Ψ_f = v_t/v_n of the contact point after against Ψ_i before, and its distance from the "
      "oracle (log axis), every engine at the largest of its time steps.";
  if (draws(figure, oracleStyle)) figure.caption += " Grey: the oracle.";
  if (draws(figure, asymptoteStyle))
    figure.caption += " Dashed grey: hard disks, sticking and sliding, as far as the law has them.";
  if (draws(figure, noLimitStyle))
    figure.caption +=
        " Red squares: the law has no limit of small time steps there, nothing is judged.";
  arrange(figure, 4, group.variants.size());
  return figure;
}

}  // namespace

Panel panelOver(const CollisionVariant& variant, const char* yLabel) {
  Panel panel;
  panel.name = variant.variant;
  panel.xLabel = "slide before Ψ_{i}";
  panel.yLabel = yLabel;
  panel.key = Key::none;
  panel.xRange = Range{0.0, 1.02 * largestPsi(variant)};
  return panel;
}

void arrange(Figure& figure, int panelsInLine, std::size_t variants) {
  for (Panel& panel : figure.panels)
    std::erase_if(panel.curves, [&](const Curve& curve) {
      Panel alone;
      alone.logY = panel.logY;
      alone.curves = {curve};
      return !hasPoints(alone);  // gnuplot would complain
    });
  const int panels = static_cast<int>(figure.panels.size());
  figure.columns = std::max(1, std::min(panelsInLine, panels));
  figure.panelWidth = 1240 / std::max(figure.columns, variants == 1 ? 2 : 3);
  figure.panelHeight = variants == 1 ? 320 : 235;
}

std::vector<Figure> collideFigures(const CollideResults& results) {
  const std::vector<LineStyle> order = engineStyles(results.engines);
  Styles styles;
  for (std::size_t k = 0; k < order.size(); ++k)
    styles.emplace_back(results.engines[k].name, order[k]);
  for (const CollisionVariant& variant : results.variants)
    for (const CollisionCurve& curve : variant.curves)
      if (std::ranges::find(styles, curve.engine, &Styles::value_type::first) == styles.end())
        styles.emplace_back(curve.engine, engineStyle(styles.size()));

  std::vector<Figure> figures;
  std::size_t index = 0;
  for (const CaseGroup& group : casesOf(results)) {
    const std::string name = fmt::format("collision_{}", ++index);
    for (Figure& figure : std::vector{curvesFigure(group, styles, name),
                                      energyFigure(group, styles, name + "_energy")})
      if (!figure.panels.empty()) figures.push_back(std::move(figure));
  }
  return figures;
}

}  // namespace crossgrain::reports

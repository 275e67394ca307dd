#include "reports/collide/figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/common/figures.hpp"

namespace crossgrain::reports {

namespace {

const LineStyle asymptoteStyle{"#999999", 0, true};
const LineStyle limitlessStyle{"#cc3311", 4, false};  ///< open squares

bool draws(const Figure& figure, const LineStyle& style) {
  return std::ranges::any_of(figure.panels, [&](const Panel& panel) {
    return std::ranges::any_of(panel.curves, [&](const Curve& curve) {
      return curve.style == style && !curve.points.empty();
    });
  });
}

/// Points of a column; `stride` 1: all of them.
std::vector<Point> pointsOf(const Json& table, const char* column, std::size_t stride) {
  std::vector<Point> points;
  for (std::size_t k = 0; k < rowCount(table); k += stride) {
    const auto x = at(table, "psi_i", k), y = at(table, column, k);
    if (x && y) points.push_back({*x, *y, {}});
  }
  return points;
}

double largestPsi(const Json& variant) {
  double largest = 0.0;
  for (std::size_t k = 0; k < rowCount(member(variant, "oracle")); ++k)
    largest = std::max(largest, at(member(variant, "oracle"), "psi_i", k).value_or(0.0));
  for (const Json& curve : list(variant, "curves"))
    for (std::size_t k = 0; k < rowCount(member(curve, "points")); ++k)
      largest = std::max(largest, at(member(curve, "points"), "psi_i", k).value_or(0.0));
  return largest > 0.0 ? largest : 1.0;
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
      curves.push_back({"",
                        asymptoteStyle,
                        Draw::lines,
                        {{begin, begin - *constant, {}}, {lastPsi, lastPsi - *constant, {}}},
                        1.0});
  }
  return curves;
}

/// Points of the sweep at which the law has no limit of small time steps, on the oracle's line.
Curve limitless(const Json& variant) {
  Curve marks{"", limitlessStyle, Draw::points, {}, 1.5};
  for (const Json& point : list(variant, "no_limit"))
    if (const auto psi = number(point, "psi_i"), found = number(point, "psi_f"); psi && found)
      marks.points.push_back({*psi, *found, {}});
  return marks;
}

/// Figure 4.3 of Lätzel (2003): each engine at the largest of its time steps.
Panel sweepPanel(const Json& variant, const Styles& styles) {
  Panel panel = panelOver(variant, "Ψ_{f}");
  panel.level = 0.0;
  panel.curves = asymptotes(variant, panel.xRange->high);
  if (auto line = pointsOf(member(variant, "oracle"), "psi_f", 1); !line.empty())
    panel.curves.push_back({"", oracleStyle, Draw::lines, std::move(line), 3.0});
  for (const auto& [engine, style] : styles)
    if (const Json* curve = coarsestCurve(variant, engine)) {
      const Json& table = member(*curve, "points");
      panel.curves.push_back(
          {"", style, Draw::points, pointsOf(table, "psi_f", markStride(table)), 1.0});
    }
  panel.curves.push_back(limitless(variant));
  return panel;
}

/// |Ψ_f − Ψ_f,oracle| of each engine at the largest of its time steps.
Panel errorPanel(const Json& variant, const Styles& styles) {
  Panel panel = panelOver(variant, "|Ψ_{f} − oracle|");
  panel.logY = true;
  const Json& reference = member(variant, "reference");
  for (const auto& [engine, style] : styles) {
    const Json* curve = coarsestCurve(variant, engine);
    if (!curve) continue;
    const Json& table = member(*curve, "points");
    std::vector<Point> points;
    for (std::size_t k = 0; k < rowCount(table); ++k) {
      const auto psi = at(table, "psi_i", k), found = at(table, "psi_f", k),
                 expected = at(reference, "psi_f", k);
      if (psi && found && expected) points.push_back({*psi, std::abs(*found - *expected), {}});
    }
    std::ranges::sort(points, {}, &Point::x);
    panel.curves.push_back({"", style, Draw::lines, std::move(points), 1.2});
  }
  return panel;
}

/// Keeps the place of a panel that there is nothing to draw in.
Panel emptyPanel(const Json& variant, const char* why) {
  Panel panel = panelOver(variant, why);
  panel.yRange = Range{0.0, 1.0};
  panel.curves.push_back({"", oracleStyle, Draw::lines, {{0.0, 0.0, {}}}, 1.0});
  return panel;
}

Figure curvesFigure(const CaseGroup& group, const Styles& styles, const std::string& name) {
  Figure figure;
  figure.name = name;
  figure.title = "Tangential velocity after a collision against before, and its error";
  for (const Json* variant : group.variants) {
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
  if (draws(figure, limitlessStyle))
    figure.caption +=
        " Red squares: the law has no limit of small time steps there, nothing is judged.";
  arrange(figure, 4, group.variants.size());
  return figure;
}

}  // namespace

Panel panelOver(const Json& variant, const char* yLabel) {
  Panel panel;
  panel.name = text(variant, "variant");
  panel.xLabel = "Ψ_{i}";
  panel.yLabel = yLabel;
  panel.key = Key::none;
  panel.xRange = Range{0.0, 1.02 * largestPsi(variant)};
  return panel;
}

std::size_t markStride(const Json& table) {
  return std::max<std::size_t>(1, (rowCount(table) + 13) / 14);
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
  for (const CaseGroup& group : casesOf(results)) {
    const std::string name = fmt::format("collision_{}", ++index);
    for (Figure& figure : std::vector{curvesFigure(group, styles, name),
                                      energyFigure(group, styles, name + "_energy")})
      if (!figure.panels.empty()) figures.push_back(std::move(figure));
  }
  return figures;
}

}  // namespace crossgrain::reports

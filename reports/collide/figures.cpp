#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "reports/collide/report.hpp"
#include "reports/common/engines.hpp"

namespace crossgrain::reports {

namespace {

using Styles = std::vector<std::pair<std::string, LineStyle>>;  ///< of engines, in their order

const LineStyle oracleStyle{"#999999", 0, false};
const LineStyle asymptoteStyle{"#999999", 0, true};
const LineStyle noLimitStyle{"#cc3311", 4, false};  ///< open squares
const LineStyle poissonStyle{"#117733", 0, true}, strongeStyle{"#aa4499", 0, true};

/// From 0, but for convex bodies.
Range rangeOf(const CollisionVariant& variant) {
  double least = variant.convex ? std::numeric_limits<double>::infinity() : 0.0;
  double largest = variant.convex ? -least : 0.0;
  const auto take = [&](const CollisionTable& table) {
    for (const double x : axisOf(variant, table)) {
      if (!std::isfinite(x)) continue;
      largest = std::max(largest, x);
      if (variant.convex) least = std::min(least, x);
    }
  };
  take(variant.oracle);
  for (const CollisionCurve& curve : variant.curves) take(curve.points);
  if (!variant.convex) return {0.0, 1.02 * (largest > 0.0 ? largest : 1.0)};
  const double room = least < largest ? 0.02 * (largest - least) : 1.0;
  return {least - room, largest + room};
}

/// An axis over Ψ_i, or what else is swept, for a variant, with its name above.
Panel panelOver(const CollisionVariant& variant, const char* yLabel) {
  Panel panel;
  panel.name = variant.variant;
  panel.xLabel = axisWords(variant);
  panel.yLabel = yLabel;
  panel.key = Key::none;
  panel.xRange = rangeOf(variant);
  return panel;
}

/// A grid of small panels; one variant's have more room.
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

bool draws(const Figure& figure, const LineStyle& style) {
  return std::ranges::any_of(figure.panels, [&](const Panel& panel) {
    return std::ranges::any_of(panel.curves, [&](const Curve& curve) {
      return curve.style == style && !curve.points.empty();
    });
  });
}

/// A quantity over what is swept; `stride` 1: all points.
std::vector<Point> sweepPoints(const CollisionVariant& variant, const CollisionTable& table,
                               QuantityId quantity, std::size_t stride) {
  std::vector<Point> points;
  for (std::size_t k = 0; k < table.size(); k += stride) {
    const auto x = at(axisOf(variant, table), k), y = table.at(quantity, k);
    if (x && y) points.push_back({*x, *y, {}});
  }
  return points;
}

/// A curve of marks has at most about 14.
std::size_t markStride(const CollisionTable& table) {
  return std::max<std::size_t>(1, (table.size() + 13) / 14);
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

/// Points of the sweep that are not judged, as the law has no limit of small time steps there or
/// hypotheses differ, on the oracle's line.
Curve noLimitMarks(const CollisionVariant& variant) {
  Curve marks{"", noLimitStyle, Draw::points, {}, 1.5};
  for (const NoLimitPoint& point : variant.noLimit) {
    CollisionTable place;
    place.psi = {point.psi};
    place.orientation = {point.orientation.value_or(0.0)};
    place.spin = {point.spin.value_or(0.0)};
    const double x = axisOf(variant, place).front();
    if (std::isfinite(x) && std::isfinite(point.psiAfter))
      marks.points.push_back({x, point.psiAfter, {}});
  }
  return marks;
}

/// Figure 4.3 of Lätzel (2003): each engine at the largest of its time steps. Of convex bodies also
/// by the other hypotheses of restitution.
Panel sweepPanel(const CollisionVariant& variant, const Styles& styles,
                 QuantityId quantity = QuantityId::psiF) {
  const bool psi = quantity == QuantityId::psiF;
  Panel panel = panelOver(variant, psi ? "Ψ_{f}" : "e_{n}");
  panel.level = psi ? 0.0 : 1.0;
  if (psi) panel.curves = asymptotes(variant, panel.xRange->high);
  const auto add = [&](const char* name, const CollisionTable& table, const LineStyle& style,
                       double width) {
    if (auto line = sweepPoints(variant, table, quantity, 1); !line.empty())
      panel.curves.push_back({name, style, Draw::lines, std::move(line), width});
  };
  add("oracle", variant.oracle, oracleStyle, 3.0);
  if (variant.convex) {
    add("Poisson", variant.convex->poisson, poissonStyle, 1.5);
    add("Stronge", variant.convex->stronge, strongeStyle, 1.5);
  }
  for (const auto& [engine, style] : styles)
    if (const CollisionCurve* curve = coarsestCurve(variant, engine))
      panel.curves.push_back(
          {engine, style, Draw::points,
           sweepPoints(variant, curve->points, quantity, markStride(curve->points)), 1.0});
  if (psi) panel.curves.push_back(noLimitMarks(variant));
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
      const auto psi = at(axisOf(variant, table), k), found = table.at(QuantityId::psiF, k),
                 expected = variant.reference.at(QuantityId::psiF, k);
      if (psi && found && expected) points.push_back({*psi, std::abs(*found - *expected), {}});
    }
    std::ranges::sort(points, {}, &Point::x);
    panel.curves.push_back({engine, style, Draw::lines, std::move(points), 1.2});
  }
  return panel;
}

Figure curvesFigure(const CaseGroup& group, const Styles& styles, const std::string& name) {
  Figure figure;
  figure.name = name;
  figure.title = group.variants.front()->convex
                     ? "Velocities of the contact point after a collision of convex bodies"
                     : "Tangential velocity after a collision against before, and its error";
  Names withoutError;
  for (const CollisionVariant* variant : group.variants) {
    Panel sweep = sweepPanel(*variant, styles);
    if (!hasPoints(sweep)) continue;
    figure.panels.push_back(std::move(sweep));
    if (Panel error = errorPanel(*variant, styles); hasPoints(error))
      figure.panels.push_back(std::move(error));
    else
      withoutError.push_back(variant->variant);
    if (variant->convex) figure.panels.push_back(sweepPanel(*variant, styles, QuantityId::en));
  }
  const bool convex = group.variants.front()->convex.has_value();
  figure.caption = fmt::format(
      "Ψ_f = v_t/v_n of the contact point after {}, and its distance from the "
      "oracle (log axis){}, every engine at the largest of its time steps.",
      convex ? "a collision" : "against Ψ_i before", convex ? ", and e_n there" : "");
  if (!withoutError.empty())
    figure.caption +=
        fmt::format(" No distance in {}: no oracle, or no run.", listed(withoutError));
  if (draws(figure, oracleStyle)) figure.caption += " Grey: the oracle.";
  if (convex)
    figure.caption +=
        " It is Newton's restitution; dashed green: Poisson's, dashed pink: Stronge's. Red "
        "squares: "
        "these differ there, and nothing but a gain of energy is judged.";
  if (draws(figure, asymptoteStyle))
    figure.caption += " Dashed grey: hard disks, sticking and sliding, as far as the law has them.";
  if (draws(figure, noLimitStyle) && !convex)
    figure.caption +=
        " Red squares: the law has no limit of small time steps there, nothing is judged.";
  const bool threeEach = convex && withoutError.empty();
  arrange(figure, threeEach ? 3 : 4, group.variants.size());
  return figure;
}

/// A part of the energy lost as it is drawn and described: the first is all of it, the others, but
/// for the last, add up to it.
struct EnergyPart {
  QuantityId quantity;
  const char* colour;
  int mark;  ///< gnuplot's number
  const char* words;
};
constexpr EnergyPart energyParts[] = {
    {QuantityId::energyLost, "#222222", 2, "all that was lost (black, crosses)"},
    {QuantityId::lostNormalDamping, "#0072b2", 6, "to the normal force (blue, circles)"},
    {QuantityId::lostTangentialDamping, "#009e73", 4,
     "to the tangential dashpot while the contact sticks (green, squares)"},
    {QuantityId::lostStiffening, "#cc79a7", 10,
     "to the tangential spring's stiffness, which follows the overlap, below 0 gained (pink, "
     "triangles pointing down)"},
    {QuantityId::lostSliding, "#d55e00", 8, "to sliding (orange, triangles)"},
    {QuantityId::lostStored, "#777777", 12,
     "left in the tangential spring at separation (grey, diamonds)"},
    {QuantityId::lostTangential, "#56b4e9", 14,
     "to the tangential force in all, of engines that do not report its parts (pale blue, "
     "pentagons)"}};

/// In units of J; of the whole what is left after, of all tangential parts only where they
/// are not reported.
std::optional<double> partAt(const CollisionTable& table, QuantityId part, std::size_t k) {
  if (part == QuantityId::energyLost) {
    const auto before = table.at(QuantityId::energyBefore, k),
               after = table.at(QuantityId::energyAfter, k);
    return before && after ? std::optional(*before - *after) : std::nullopt;
  }
  if (part == QuantityId::lostTangential && table.at(QuantityId::lostSliding, k))
    return std::nullopt;
  return table.at(part, k);
}

/// A part of the energy lost in units of the energy before.
std::vector<Point> fractionsOf(const CollisionVariant& variant, const CollisionTable& table,
                               QuantityId part, std::size_t stride) {
  std::vector<Point> points;
  for (std::size_t k = 0; k < table.size(); k += stride) {
    const auto psi = at(axisOf(variant, table), k), before = table.at(QuantityId::energyBefore, k),
               value = partAt(table, part, k);
    if (psi && before && value && *before > 0.0) points.push_back({*psi, *value / *before, {}});
  }
  return points;
}

/// Lines are the oracle's parts, marks the engines': colours are parts here, not
/// engines.
Panel energyPanel(const CollisionVariant& variant, const Styles& styles) {
  Panel panel = panelOver(variant, "energy lost / before");
  for (const auto& part : energyParts) {
    std::vector<Curve> curves = {{"",
                                  {part.colour, 0, false},
                                  Draw::lines,
                                  fractionsOf(variant, variant.oracle, part.quantity, 1),
                                  2.0}};
    for (const auto& [engine, style] : styles) {
      const CollisionCurve* curve = coarsestCurve(variant, engine);
      if (!curve || style.dashed) continue;  // a mirror's marks lie on its peer's
      const CollisionTable& table = curve->points;
      curves.push_back({"",
                        {part.colour, part.mark, false},
                        Draw::points,
                        fractionsOf(variant, table, part.quantity, (table.size() + 6) / 7),
                        1.0});
    }
    const auto visible = [](const Point& point) { return std::abs(point.y) > 1e-6; };
    const bool any = std::ranges::any_of(
        curves, [&](const Curve& curve) { return std::ranges::any_of(curve.points, visible); });
    if (any) std::ranges::move(curves, std::back_inserter(panel.curves));
  }
  return panel;
}

/// The parts that some panel shows, in words.
std::string drawnParts(const Figure& figure) {
  Names words;
  for (const EnergyPart& part : energyParts)
    if (std::ranges::any_of(figure.panels, [&](const Panel& panel) {
          return std::ranges::find(panel.curves, part.colour, [](const Curve& curve) {
                   return curve.style.colour;
                 }) != panel.curves.end();
        }))
      words.emplace_back(part.words);
  return fmt::format("{}.", fmt::join(words, ", "));
}

constexpr const char* captionOfMarks =
    " Lines: the oracle, whose parts add up to all that was lost. Marks: engines at the largest of "
    "their time steps; parts of those that show their contacts, recorded step by step, so that "
    "they add up as far as a sum over steps can. A slip too short for a step, as the last one "
    "before the disks part, is not seen: what the oracle loses in it stays in the spring.";

/// Where the energy of a case's collisions went: the oracle's account and every engine's at the
/// largest of its time steps. @param name  of the figure's files
Figure energyFigure(const CaseGroup& group, const Styles& styles, const std::string& name) {
  Figure figure;
  figure.name = name;
  figure.title = "Where the energy of a collision went";
  for (const CollisionVariant* variant : group.variants) {
    Panel panel = energyPanel(*variant, styles);
    if (hasPoints(panel)) figure.panels.push_back(std::move(panel));
  }
  figure.caption = "Energy lost, by the energy before: " + drawnParts(figure) + captionOfMarks;
  arrange(figure, 4, group.variants.size());
  return figure;
}

}  // namespace

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
                                      energyFigure(group, styles, name + "_energy"),
                                      causesFigure(group, name + "_causes")})
      if (!figure.panels.empty()) figures.push_back(std::move(figure));
  }
  return figures;
}

}  // namespace crossgrain::reports

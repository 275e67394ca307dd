#include <algorithm>
#include <cmath>
#include <iterator>

#include "reports/collide_figures.hpp"

namespace crossgrain::reports {

namespace {

constexpr struct {
  const char *member, *colour;
  int mark;  ///< gnuplot's number
} parts[] = {{"lost_normal_damping", "#0072b2", 6},
             {"lost_tangential_damping", "#009e73", 4},
             {"lost_sliding", "#d55e00", 8},
             {"lost_stored", "#777777", 12}};

/// A part of the energy lost in units of the energy before.
std::vector<Point> sharesOf(const Json& table, const char* part, std::size_t stride) {
  std::vector<Point> points;
  for (std::size_t k = 0; k < rowCount(table); k += stride) {
    const auto psi = at(table, "psi_i", k), before = at(table, "energy_before", k),
               value = at(table, part, k);
    if (psi && before && value && *before > 0.0) points.push_back({*psi, *value / *before, {}});
  }
  return points;
}

/// Lines are the oracle's parts, marks the engines': colours are parts here, not engines.
Panel energyPanel(const Json& variant, const Styles& styles) {
  Panel panel = panelOver(variant, "energy lost / before");
  for (const auto& part : parts) {
    std::vector<Curve> curves = {{"",
                                  {part.colour, 0, false},
                                  Draw::lines,
                                  sharesOf(member(variant, "oracle"), part.member, 1),
                                  2.0}};
    for (const auto& [engine, style] : styles) {
      const Json* curve = coarsestCurve(variant, engine);
      if (!curve || style.dashed) continue;  // a mirror's marks lie on its peer's
      const Json& table = member(*curve, "points");
      curves.push_back({"",
                        {part.colour, part.mark, false},
                        Draw::points,
                        sharesOf(table, part.member, (rowCount(table) + 6) / 7),
                        1.0});
    }
    const auto visible = [](const Point& point) { return std::abs(point.y) > 1e-6; };
    const bool any = std::ranges::any_of(
        curves, [&](const Curve& curve) { return std::ranges::any_of(curve.points, visible); });
    if (any) std::ranges::move(curves, std::back_inserter(panel.curves));
  }
  return panel;
}

}  // namespace

Figure energyFigure(const CaseGroup& group, const Styles& styles, const std::string& name) {
  Figure figure;
  figure.name = name;
  figure.title = "Where the energy of a collision went";
  figure.caption =
      "Energy lost to the normal dashpot (blue, circles), to the tangential one while the contact "
      "sticks (green, squares), to sliding (orange, triangles), and left in the tangential spring "
      "at "
      "separation (grey, diamonds). Lines: the oracle; marks: every engine that shows its "
      "contacts, "
      "looked at step by step at the largest of its time steps. A slip too short for a step, as "
      "the "
      "last one before the disks part, is not seen: what the oracle loses in it stays in the "
      "spring.";
  for (const Json* variant : group.variants) {
    Panel panel = energyPanel(*variant, styles);
    if (hasPoints(panel)) figure.panels.push_back(std::move(panel));
  }
  arrange(figure, 4, group.variants.size());
  return figure;
}

}  // namespace crossgrain::reports

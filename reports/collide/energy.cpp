#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "reports/collide/figures.hpp"

namespace crossgrain::reports {

namespace {

/// A part of the energy lost as it is drawn and told: the first is all of it, the others, but for
/// the last, add up to it.
struct Part {
  QuantityId quantity;
  const char* colour;
  int mark;  ///< gnuplot's number
  const char* words;
};
constexpr Part parts[] = {
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
     "to the tangential force in all, of engines that do not tell its parts (pale blue, "
     "pentagons)"}};

/// In units of J; of the whole what is left after, of all tangential parts only where they are not
/// told.
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
std::vector<Point> fractionsOf(const CollisionTable& table, QuantityId part, std::size_t stride) {
  std::vector<Point> points;
  for (std::size_t k = 0; k < table.size(); k += stride) {
    const auto psi = numberAt(table.psi, k), before = table.at(QuantityId::energyBefore, k),
               value = partAt(table, part, k);
    if (psi && before && value && *before > 0.0) points.push_back({*psi, *value / *before, {}});
  }
  return points;
}

/// Lines are the oracle's parts, marks the engines': colours are parts here, not engines.
Panel energyPanel(const CollisionVariant& variant, const Styles& styles) {
  Panel panel = panelOver(variant, "energy lost / before");
  for (const auto& part : parts) {
    std::vector<Curve> curves = {{"",
                                  {part.colour, 0, false},
                                  Draw::lines,
                                  fractionsOf(variant.oracle, part.quantity, 1),
                                  2.0}};
    for (const auto& [engine, style] : styles) {
      const CollisionCurve* curve = coarsestCurve(variant, engine);
      if (!curve || style.dashed) continue;  // a mirror's marks lie on its peer's
      const CollisionTable& table = curve->points;
      curves.push_back({"",
                        {part.colour, part.mark, false},
                        Draw::points,
                        fractionsOf(table, part.quantity, (table.size() + 6) / 7),
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
  std::vector<std::string> words;
  for (const Part& part : parts)
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
    "their time steps; parts of those that show their contacts, looked at step by step, so that "
    "they add up as far as a sum over steps can. A slip too short for a step, as the last one "
    "before the disks part, is not seen: what the oracle loses in it stays in the spring.";

}  // namespace

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

}  // namespace crossgrain::reports

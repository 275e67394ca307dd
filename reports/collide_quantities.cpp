#include <algorithm>

#include "reports/collide_figures.hpp"

namespace crossgrain::reports {

namespace {

Panel panelOver(const Json& variant, const char* yLabel) {
  Panel panel;
  panel.xLabel = "Ψ_{i}";
  panel.yLabel = yLabel;
  panel.level = 0.0;
  panel.key = Key::none;
  panel.xRange = psiRange(variant);
  return panel;
}

/// The oracle's line and every engine at the first of its time steps.
Panel quantityPanel(const Json& variant, const Styles& styles, const char* quantity,
                    const char* yLabel) {
  Panel panel = panelOver(variant, yLabel);
  if (auto line = pointsOf(list(variant, "oracle"), "psi_i", quantity); !line.empty())
    panel.curves.push_back({"oracle", oracleStyle, Draw::lines, std::move(line), 3.0});
  for (const Json* curve : firstCurves(variant)) {
    const std::string engine = text(*curve, "engine");
    auto points = pointsOf(list(*curve, "points"), "psi_i", quantity);
    if (!points.empty())
      panel.curves.push_back({engine, styles.at(engine), Draw::points, std::move(points), 1.0});
  }
  return panel;
}

/// Values of `part`, or before − after, in units of the energy before.
template <class Part>
std::vector<Point> sharesOf(const Json& rows, const Part& part) {
  std::vector<Point> points;
  for (const Json& row : rows) {
    const auto psi = number(row, "psi_i"), before = number(row, "energy_before");
    const std::optional<double> value = part(row);
    if (psi && before && value && *before > 0.0) points.push_back({*psi, *value / *before, {}});
  }
  return points;
}

std::optional<double> energyLost(const Json& row) {
  const auto before = number(row, "energy_before"), after = number(row, "energy_after");
  if (!before || !after) return std::nullopt;
  return *before - *after;
}

/// The oracle's account of the energy, and what each engine lost in all.
Panel energyPanel(const Json& variant, const Styles& styles) {
  Panel panel = panelOver(variant, "energy lost / energy before");
  panel.key = Key::topRight;
  panel.yRange = Range{0.0, 1.3};  // room for the key
  const Json& oracle = list(variant, "oracle");
  panel.curves.push_back(
      {"lost in all", oracleStyle, Draw::lines, sharesOf(oracle, energyLost), 3.0});
  constexpr struct {
    const char *member, *name, *colour;
  } parts[] = {{"lost_normal_damping", "normal damping", "#333333"},
               {"lost_tangential_damping", "tangential damping", "#777777"},
               {"lost_sliding", "sliding", "#333333"},
               {"lost_stored", "left in the spring", "#777777"}};
  for (std::size_t k = 0; k < std::size(parts); ++k) {
    auto points = sharesOf(oracle, [&](const Json& row) { return number(row, parts[k].member); });
    const bool any = std::ranges::any_of(points, [](const Point& p) { return p.y > 1e-12; });
    if (any)
      panel.curves.push_back(
          {parts[k].name, {parts[k].colour, 0, k >= 2}, Draw::lines, std::move(points), 1.2});
  }
  for (const Json* curve : firstCurves(variant)) {
    const std::string engine = text(*curve, "engine");
    auto points = sharesOf(list(*curve, "points"), energyLost);
    if (!points.empty())
      panel.curves.push_back({"", styles.at(engine), Draw::points, std::move(points), 1.0});
  }
  return panel;
}

}  // namespace

Figure quantitiesFigure(const Json& variant, const Styles& styles, const std::string& name) {
  Figure figure;
  figure.name = name;
  figure.title = "Contact point, centres and energy after a collision";
  figure.caption =
      "Every engine at the first of its time steps. Left: the contact point's β = −Ψ_f/Ψ_i. "
      "Middle: "
      "the centres' own tangential velocity after, a quantity of its own. Right: the oracle's "
      "account "
      "of the energy lost; marks are what engines lost in all.";
  for (Panel panel : {quantityPanel(variant, styles, "beta", "β = −Ψ_{f} / Ψ_{i}"),
                      quantityPanel(variant, styles, "centre_psi_f", "centres: v_{t,f} / v_{n,i}"),
                      energyPanel(variant, styles)})
    if (hasPoints(panel)) figure.panels.push_back(std::move(panel));
  figure.columns = std::max(1, static_cast<int>(figure.panels.size()));
  figure.panelWidth = 420;
  return figure;
}

}  // namespace crossgrain::reports

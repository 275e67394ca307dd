#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include "reports/common/figures.hpp"

namespace crossgrain::reports {

namespace {

using Engines = std::vector<EngineResults>;

constexpr const char* speedAxis = "v_{φ} / (Ω R_{i})";
constexpr const char* spinAxis = "S d / (Ω D)";

/// That of an engine's averages, or null. @param ring  from 0; absent: the whole cell's
const Json& distributionOf(const EngineResults& engine, const std::string& quantity,
                           std::optional<double> ring) {
  for (const Json& distribution : list(engine.averages(), "distributions"))
    if (text(distribution, "quantity") == quantity && number(distribution, "ring") == ring)
      return distribution;
  static const Json none;
  return none;
}

double centre(const Json& axis, std::size_t index) {
  return number(axis, "low").value_or(0.0) +
         (static_cast<double>(index) + 0.5) * number(axis, "width").value_or(1.0);
}

/// @param empty  also bins that hold nothing, which a logarithmic axis cannot show
std::vector<Point> pointsOf(const Json& distribution, bool empty) {
  std::vector<Point> points;
  const Json& axis = element(list(distribution, "axes"), 0);
  const Json& density = list(distribution, "density");
  for (std::size_t k = 0; k < density.size(); ++k)
    if (const auto value = number(density[k]); value && (empty || *value > 0.0))
      points.push_back({centre(axis, k), *value, number(element(list(distribution, "stderr"), k))});
  return points;
}

Panel densityPanel(const Engines& engines, const std::string& quantity, std::optional<double> ring,
                   const std::string& xLabel, bool logarithmic) {
  Panel panel;
  panel.xLabel = xLabel;
  panel.yLabel = "probability density";
  panel.logY = logarithmic;
  panel.key = Key::none;
  for (const EngineResults& engine : engines) {
    Curve curve{engine.name, engine.style, Draw::linesAndPoints,
                pointsOf(distributionOf(engine, quantity, ring), !logarithmic), 1.0};
    if (!curve.points.empty()) panel.curves.push_back(std::move(curve));
  }
  return panel;
}

Figure figureOf(const std::string& name, const std::string& title, const std::string& caption,
                std::vector<Panel> panels) {
  Figure figure;
  figure.name = "distribution_" + name;
  figure.title = title;
  figure.caption = caption;
  for (Panel& panel : panels) {
    if (!hasPoints(panel)) continue;
    figure.panels.push_back(std::move(panel));
  }
  figure.columns = std::min(3, static_cast<int>(figure.panels.size()));
  figure.panelWidth = 380;
  figure.panelHeight = 300;
  return figure;
}

/// Centres of the densest cells that together hold this share of what lies inside the bins.
std::vector<Point> densest(const Json& joint, double share) {
  const Json &across = element(list(joint, "axes"), 0), &up = element(list(joint, "axes"), 1);
  const auto columns = static_cast<std::size_t>(number(across, "count").value_or(1.0));
  const Json& density = list(joint, "density");
  std::vector<std::size_t> order(density.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto at = [&](std::size_t cell) { return number(density[cell]).value_or(0.0); };
  std::ranges::stable_sort(order, std::greater(), at);
  double all = 0.0;
  for (const std::size_t cell : order) all += at(cell);
  std::vector<Point> points;
  double held = 0.0;
  for (const std::size_t cell : order) {
    if (held >= share * all) break;
    held += at(cell);
    points.push_back({centre(across, cell % columns), centre(up, cell / columns), {}});
  }
  return points;
}

Panel jointPanel(const EngineResults& engine) {
  const Json& joint = distributionOf(engine, "azimuthal_velocity_and_spin", {});
  Panel panel;
  panel.title = engine.name;
  panel.xLabel = speedAxis;
  panel.yLabel = spinAxis;
  panel.xRange = Range{-0.3, 1.3};
  panel.yRange = Range{-1.3, 0.7};
  panel.key = Key::none;
  if (!joint.is_object()) return panel;
  LineStyle outer = engine.style, inner = engine.style;
  outer.pointType = 6;  // open circles
  inner.pointType = 7;  // filled
  panel.curves.push_back({"", outer, Draw::points, densest(joint, 0.9), 1.0});
  panel.curves.push_back({"", inner, Draw::points, densest(joint, 0.5), 1.0});
  panel.curves.push_back({"", {}, Draw::lines, {{0.0, -1.0, {}}, {1.3, 0.3, {}}}, 1.0});
  return panel;
}

/// Rings at the wheel, about 2, 4, 8 and 12 d from it, and at the outer ring (Lätzel 2003,
/// Fig. 6.6).
std::vector<std::size_t> directionRings(const Json& results) {
  const Json& places = list(member(results, "rings"), "r_tilde");
  std::vector<std::size_t> rings;
  if (places.empty()) return rings;
  const auto add = [&](std::size_t ring) {
    if (rings.empty() || ring > rings.back()) rings.push_back(ring);
  };
  add(0);
  for (const double wanted : {2.0, 4.0, 8.0, 12.0}) {
    std::size_t best = 0;
    const auto away = [&](std::size_t ring) {
      return std::abs(number(places[ring]).value_or(1e300) - wanted);
    };
    for (std::size_t ring = 0; ring < places.size(); ++ring)
      if (away(ring) < away(best)) best = ring;
    if (away(best) < 1.0) add(best);
  }
  add(places.size() - 1);
  return rings;
}

/// The distribution's expansion to order 6, from the Fourier fields of the same averages.
std::vector<Point> harmonics(const EngineResults& engine, std::size_t ring) {
  const auto coefficient = [&](const char* kind, int order) -> std::optional<double> {
    const std::string field = fmt::format("contact_{}_{}", kind, order);
    for (const Json& profile : list(engine.averages(), "profiles"))
      if (text(profile, "field") == field) return number(element(list(profile, "mean"), ring));
    return {};
  };
  std::vector<std::array<double, 3>> terms;  // order, a, b
  for (const int order : {2, 4, 6}) {
    const auto a = coefficient("cos", order), b = coefficient("sin", order);
    if (!a || !b) return {};
    terms.push_back({static_cast<double>(order), *a, *b});
  }
  std::vector<Point> points;
  for (int degrees = -180; degrees <= 180; degrees += 4) {
    const double angle = degrees * std::numbers::pi / 180.0;
    double density = 1.0;
    for (const auto& [order, a, b] : terms)
      density += a * std::cos(order * angle) + b * std::sin(order * angle);
    points.push_back({angle, density / (2.0 * std::numbers::pi), {}});
  }
  return points;
}

std::vector<Panel> directionPanels(const Json& results, const Engines& engines) {
  std::vector<Panel> panels;
  for (const std::size_t ring : directionRings(results)) {
    Panel panel = densityPanel(engines, "contact_direction", static_cast<double>(ring),
                               "angle of contacts from r towards φ [rad]", false);
    panel.title = fmt::format("(r − R_{{i}})/d = {:.2g}",
                              number(member(results, "rings")["r_tilde"][ring]).value_or(0.0));
    panel.xRange = Range{-std::numbers::pi, std::numbers::pi};
    panel.level = 0.5 / std::numbers::pi;
    if (!panel.curves.empty()) {
      const auto reference =
          std::ranges::find(engines, panel.curves.front().name, &EngineResults::name);
      panel.curves.push_back({"", {}, Draw::lines, harmonics(*reference, ring), 1.0});
    }
    panels.push_back(std::move(panel));
  }
  return panels;
}

}  // namespace

std::vector<Figure> distributionFigures(const Json& results, const Engines& engines) {
  std::vector<Panel> joint;
  for (const EngineResults& engine : engines)
    if (engine.mirrors.empty()) joint.push_back(jointPanel(engine));
  std::vector<Figure> figures = {
      figureOf(
          "velocities", "Distributions of velocities and spin at the wheel",
          "Radial and azimuthal velocity and spin of single disks in ring 1, next to the wheel "
          "(Lätzel 2003, section 6.4).",
          {densityPanel(engines, "radial_velocity", 0.0, "v_{r} / |Ω R_{i}|", true),
           densityPanel(engines, "azimuthal_velocity", 0.0, speedAxis, true),
           densityPanel(engines, "spin", 0.0, spinAxis, true)}),
      figureOf("joint", "Joint distribution of velocity and spin at the wheel",
               "Velocity and spin of the same disk, centres within one d of the wheel: the densest "
               "cells that hold half of the samples (filled) and nine tenths (open). On the line "
               "v_φ/(ΩR_i) = 1 + "
               "S d/(ΩD) a disk rolls on the wheel.",
               std::move(joint)),
      figureOf(
          "directions", "Directions of contacts",
          "Outward normals of the contacts of disks in some rings, from the wheel to the outer "
          "ring (Lätzel 2003, Fig. 6.6). Thin line: no preferred direction; black curve: a "
          "constant and sines of 2α, 4α, 6α fitted to the first engine's.",
          directionPanels(results, engines)),
      figureOf("contacts", "Distributions of contact forces and numbers",
               "Normal and tangential forces of all contacts over their means, and contacts per "
               "disk.",
               {densityPanel(engines, "normal_force", {}, "f_{n} / ⟨f_{n}⟩", true),
                densityPanel(engines, "tangential_force", {}, "|f_{t}| / ⟨|f_{t}|⟩", true),
                densityPanel(engines, "coordination", {}, "contacts per disk", false)})};
  std::erase_if(figures, [](const Figure& figure) { return figure.panels.empty(); });
  return figures;
}

}  // namespace crossgrain::reports

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/common/figures.hpp"
#include "reports/common/numbers.hpp"
#include "reports/couette/state_view.hpp"

namespace crossgrain::reports {

namespace {

/// What a profile is divided by before it is drawn, and the axis' name then.
struct Scaled {
  double factor = 1.0;
  std::string label;
};

/// One plot of one field. Axes: thesis-style r̃, or r/R_i where both axes are logarithmic.
struct ProfilePlot {
  std::string name, field, title, label;
  bool logX = false, logY = false;
  std::optional<double> guide;  ///< exponent of a power law to compare the slope with
};

const std::vector<ProfilePlot>& profilePlots() {
  static const std::vector<ProfilePlot> plots = {
      {"volume_fraction", "volume_fraction", "volume fraction", "ν", false, false, {}},
      {"azimuthal_velocity",
       "azimuthal_velocity",
       "azimuthal velocity",
       "v_{φ} [m/s]",
       false,
       false,
       {}},
      {"azimuthal_velocity_log",
       "azimuthal_velocity",
       "azimuthal velocity, log axis",
       "v_{φ} [m/s]",
       false,
       true,
       {}},
      {"spin", "spin", "spin", "S [rad/s]", false, false, {}},
      {"stress_rr", "stress_rr", "radial stress", "σ_{rr} [N/m^{2}]", false, false, {}},
      {"stress_pp", "stress_pp", "hoop stress", "σ_{φφ} [N/m^{2}]", false, false, {}},
      {"stress_rp", "stress_rp", "shear stress, log axes", "σ_{rφ} [N/m^{2}]", true, true, -2.0},
      {"fabric_trace", "fabric_trace", "fabric", "tr F", false, false, {}},
  };
  return plots;
}

/// v_φ/(ΩR_i) and S d/(ΩD) with D = 2R_i (Lätzel 2003, chapter 6) where the cell has a turning
/// wheel.
Scaled scaled(const ProfilePlot& plot, const Json& cell) {
  const auto omega = number(cell, "omega"), radius = number(cell, "inner_radius"),
             diameter = number(cell, "diameter");
  const bool turning = omega && radius && *omega * *radius != 0.0;
  if (turning && plot.field == "azimuthal_velocity")
    return {1.0 / (*omega * *radius), "v_{φ} / (Ω R_{i})"};
  if (turning && diameter && plot.field == "spin")
    return {*diameter / (*omega * 2.0 * *radius), "S d / (Ω D)"};
  // Shear stress follows the sense of rotation; a logarithmic axis shows no negative values.
  if (turning && *omega < 0.0 && plot.field == "stress_rp") return {-1.0, "−" + plot.label};
  return {1.0, plot.label};
}

std::vector<Point> profilePoints(const Json& results, const Json& averages, const ProfilePlot& plot,
                                 double factor) {
  const Json& profile = findByText(averages, "profiles", "field", plot.field);
  const Json& rings = member(results, "rings");
  const auto inner = number(member(results, "cell"), "inner_radius");
  std::vector<Point> points;
  for (std::size_t ring = 0; ring < list(profile, "mean").size(); ++ring) {
    const auto mean = number(list(profile, "mean")[ring]);
    const auto error = number(element(list(profile, "stderr"), ring));
    auto x = number(element(list(rings, plot.logX ? "r" : "r_tilde"), ring));
    if (x && plot.logX && inner) *x /= *inner;
    if (!x || !mean) continue;
    Point point{*x, *mean * factor, {}};
    if (error) point.error = *error * std::abs(factor);
    points.push_back(point);
  }
  return points;
}

/// A straight line of that slope on log axes, below all curves.
std::optional<Curve> powerLaw(const Panel& panel, double exponent) {
  double factor = INFINITY, first = INFINITY, last = 0.0;
  for (const Curve& curve : panel.curves)
    for (const Point& point : curve.points) {
      if (point.y <= 0.0) continue;
      factor = std::min(factor, point.y / std::pow(point.x, exponent));
      first = std::min(first, point.x);
      last = std::max(last, point.x);
    }
  if (last <= 0.0) return std::nullopt;
  Curve line{"slope " + readableSetting(exponent), {"#888888", 0, true}, Draw::lines, {}, 2.0};
  for (const double x : {first, last})
    line.points.push_back({x, 0.8 * factor * std::pow(x, exponent), {}});
  return line;
}

void makeFaint(Curve& curve) {
  curve.name.clear();
  curve.style = {"#b8bec4", 0, false};
  curve.draw = Draw::lines;
  curve.width = 1.0;
}

Panel profilePanel(const Json& results, const std::vector<EngineResults>& engines,
                   const ProfilePlot& plot, const IsFaint& faint) {
  const Scaled scale = scaled(plot, member(results, "cell"));
  Panel panel;
  panel.xLabel = plot.logX ? "r / R_{i}" : "(r − R_{i}) / d";
  panel.yLabel = scale.label;
  panel.logX = plot.logX;
  panel.logY = plot.logY;
  for (const EngineResults& engine : engines) {
    Curve curve{engine.name, engine.style, Draw::linesAndPoints,
                profilePoints(results, engine.averages(), plot, scale.factor), 1.5};
    if (faint && faint(engine, plot.field)) makeFaint(curve);
    if (!curve.points.empty()) panel.curves.push_back(std::move(curve));
  }
  std::ranges::stable_partition(panel.curves, [](const Curve& c) { return c.name.empty(); });
  if (plot.field.starts_with("stress_") && !plot.logY) chooseLogY(panel);
  if (plot.guide)
    if (auto line = powerLaw(panel, *plot.guide)) panel.curves.push_back(*line);
  const auto outer = number(member(results, "cell"), "outer_radius"),
             inner = number(member(results, "cell"), "inner_radius");
  if (!plot.logX) {
    panel.xRange = rTildeRange(results);
    if (plot.field == "spin") panel.level = 0.0;
  } else if (inner && outer && *outer > *inner) {
    panel.xRange = Range{1.0, *outer / *inner};
    panel.xTicks = {1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0};
  }
  return panel;
}

/// Velocity twice, shear stress and volume fraction: a comparison at one glance.
Figure overview(const Json& results, const std::vector<EngineResults>& engines,
                const IsFaint& faint) {
  Figure figure;
  figure.name = "overview";
  figure.title = "Azimuthal velocity, shear stress and volume fraction of all engines";
  const std::string when = averagedRotations(results);
  figure.caption = barsInWords(engines) + (when.empty() ? "" : " Averaged: " + when + ".");
  figure.columns = 2;
  figure.panelWidth = 480;
  figure.panelHeight = 330;
  figure.png = true;
  for (const char* name :
       {"azimuthal_velocity", "azimuthal_velocity_log", "stress_rp", "volume_fraction"}) {
    const auto plot = std::ranges::find(profilePlots(), name, &ProfilePlot::name);
    Panel panel = profilePanel(results, engines, *plot, faint);
    if (!hasPoints(panel)) continue;
    panel.key = figure.panels.empty() ? Key::topRight : Key::none;
    figure.panels.push_back(std::move(panel));
  }
  return figure;
}

/// A stress without the rotations that it was averaged over says little: cells drift.
std::string captionOf(const Json& results, const ProfilePlot& plot, const Panel& panel) {
  std::string caption = plot.title;
  caption[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(caption[0])));
  const bool guided = std::ranges::any_of(
      panel.curves, [](const Curve& curve) { return curve.name.starts_with("slope "); });
  if (guided)
    caption += fmt::format("; grey: the slope of a power law of exponent {}",
                           readableSetting(*plot.guide));
  const bool hidden =
      panel.logY && std::ranges::any_of(panel.curves, [](const Curve& curve) {
        return std::ranges::any_of(curve.points, [](const Point& p) { return p.y <= 0.0; });
      });
  if (hidden) caption += "; values that are not positive do not show";
  if (const std::string when = averagedRotations(results); !when.empty()) caption += "; " + when;
  return caption + ".";
}

}  // namespace

std::optional<Range> rTildeRange(const Json& results) {
  const Json& cell = member(results, "cell");
  const auto inner = number(cell, "inner_radius"), outer = number(cell, "outer_radius"),
             diameter = number(cell, "diameter");
  if (!inner || !outer || !diameter || *outer <= *inner || *diameter <= 0.0) return std::nullopt;
  return Range{0.0, (*outer - *inner) / *diameter};
}

std::string barsInWords(const std::vector<EngineResults>& engines) {
  std::string single;
  bool ensemble = false;
  for (const EngineResults& engine : engines) {
    if (engine.finished.empty()) continue;
    if (engine.ensemble)
      ensemble = true;
    else
      single += (single.empty() ? "" : ", ") + engine.name;
  }
  const std::string within =
      "± one standard error within the run: conditional on its one packing, it says nothing about "
      "other packings";
  if (!ensemble) return "Bars: " + within + ".";
  const std::string over = "Bars: ± one standard error of the mean over packings";
  return single.empty() ? over + "." : fmt::format("{}; for {}: {}.", over, single, within);
}

std::vector<Figure> profileFigures(const Json& results, const std::vector<EngineResults>& engines,
                                   const IsFaint& faint) {
  std::vector<Figure> figures;
  if (Figure all = overview(results, engines, faint); !all.panels.empty())
    figures.push_back(std::move(all));
  for (const ProfilePlot& plot : profilePlots()) {
    Panel panel = profilePanel(results, engines, plot, faint);
    if (!hasPoints(panel)) continue;
    Figure figure;
    figure.name = "profile_" + plot.name;
    figure.title = "Profile of the " + plot.title;
    figure.caption = captionOf(results, plot, panel);
    figure.panels.push_back(std::move(panel));
    figures.push_back(std::move(figure));
  }
  return figures;
}

}  // namespace crossgrain::reports

#include "reports/flow/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "reports/flow/endpoint_text.hpp"

namespace crossgrain::reports {

const std::vector<double>& binPlaces(const FlowFrame& frame) {
  return frame.region ? frame.rings.r : frame.rings.rTilde;
}

std::string binAxis(const FlowFrame& frame) {
  if (!frame.region) return "(r − R_{i}) / d";
  return (frame.region->along.empty() ? "r" : frame.region->along) + " [m]";
}

namespace {

/// Factor of a drawn profile, and the axis' name with it.
struct Scaled {
  double factor = 1.0;
  std::string label;
};

/// One plot of one field. Axes: thesis-style r̃, or where both are logarithmic r/R_i, and r without
/// a wheel.
struct ProfilePlot {
  std::string field;
  std::string scales = {};  ///< of its axes, for the title; empty: linear ones
  bool logX = false, logY = false;
  std::optional<double> guide = {};  ///< exponent of a power law to compare the slope with

  std::string title() const { return fieldWords(field) + scales; }
  /// Of its files: a field may be drawn once more with a log axis.
  std::string name() const { return field + (logY && !logX ? "_log" : ""); }
};

enum class BinKind { rings, plane, space };
BinKind kindOf(const FlowFrame& frame) {
  if (!frame.region || frame.region->bins == "rings") return BinKind::rings;
  const bool ofSpace = !frame.region->z.empty() && !frame.region->along.empty();
  return ofSpace ? BinKind::space : BinKind::plane;
}

/// The direction that is sheared where slabs lie along this one.
std::string shearedAlong(const std::string& along) {
  return along == "x" ? "y" : "x";
}

/// Of slabs in space along x, y or z: the components across them, and what shears.
std::vector<ProfilePlot> plotsOf(const FlowFrame& frame) {
  const BinKind kind = kindOf(frame);
  if (kind == BinKind::rings)
    return {{"volume_fraction"},
            {"azimuthal_velocity"},
            {"azimuthal_velocity", ", log axis", false, true},
            {"spin"},
            {"stress_rr"},
            {"stress_pp"},
            {"stress_rp", ", log axes", true, true, -2.0},
            {"fabric_trace"}};
  if (kind == BinKind::plane)
    return {{"volume_fraction"}, {"velocity_x"}, {"velocity_y"}, {"spin"},
            {"stress_xx"},       {"stress_yy"},  {"stress_xy"},  {"coordination"}};
  const std::string& along = frame.region->along;
  const std::string sheared = shearedAlong(along);
  return {{"volume_fraction"},
          {"velocity_" + sheared},
          {"granular_temperature"},
          {"stress_" + along + along},
          {"stress_" + sheared + along},
          {"coordination"},
          {"granular_temperature", ", log axis", false, true}};
}

/// v_φ/(ΩR_i) and S d/(ΩD) with D = 2R_i (Lätzel 2003, chapter 6) where the cell has a turning
/// wheel.
Scaled scaled(const ProfilePlot& plot, const CouetteCell& cell) {
  const double rim = cell.omega * cell.innerRadius;
  const bool turning = rim != 0.0;
  if (turning && plot.field == "azimuthal_velocity")
    return {1.0 / rim, "velocity v_{φ} / (Ω R_{i})"};
  if (turning && cell.diameter > 0.0 && plot.field == "spin")
    return {cell.diameter / (cell.omega * 2.0 * cell.innerRadius), "spin S d / (Ω D)"};
  // Shear stress follows the sense of rotation; a logarithmic axis shows no negative values.
  if (turning && cell.omega < 0.0 && plot.field == "stress_rp")
    return {-1.0, "− " + fieldAxis(plot.field)};
  return {1.0, fieldAxis(plot.field)};
}

void addPoints(const FlowFrame& frame, const EngineRuns& engine, const ProfilePlot& plot,
               double factor, Curve& curve) {
  const Profile* profile = profileOf(engine.profiles(), plot.field);
  if (!profile) return;
  const double inner = frame.cell.innerRadius;
  for (std::size_t ring = 0; ring < profile->mean.size(); ++ring) {
    const auto mean = at(profile->mean, ring), error = at(profile->standardError, ring);
    auto x = at(plot.logX ? frame.rings.r : binPlaces(frame), ring);
    if (x && plot.logX && inner > 0.0) *x /= inner;
    if (!x || !mean) continue;
    Point point{*x, *mean * factor, {}};
    if (error) point.error = *error * std::abs(factor);
    curve.points.push_back(point);
  }
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

Panel profilePanel(const FlowFrame& frame, const Engines& engines, const ProfilePlot& plot,
                   const IsFaint& faint) {
  const Scaled scale = scaled(plot, frame.cell);
  Panel panel;
  const double inner = frame.cell.innerRadius, outer = frame.cell.outerRadius;
  panel.xLabel = !plot.logX ? binAxis(frame) : inner > 0.0 ? "r / R_{i}" : "r [m]";
  panel.yLabel = scale.label;
  panel.logX = plot.logX;
  panel.logY = plot.logY;
  for (const EngineRuns& engine : engines) {
    Curve curve = curveOf(engine);
    addPoints(frame, engine, plot, scale.factor, curve);
    if (faint && faint(engine, plot.field)) makeFaint(curve);
    if (!curve.points.empty()) panel.curves.push_back(std::move(curve));
  }
  std::ranges::stable_partition(panel.curves, [](const Curve& c) { return c.name.empty(); });
  if (plot.field.starts_with("stress_") && !plot.logY) chooseLogY(panel);
  if (plot.guide)
    if (auto line = powerLaw(panel, *plot.guide)) panel.curves.push_back(*line);
  if (!plot.logX) {
    panel.xRange = rTildeRange(frame);
    if (plot.field == "spin") panel.level = 0.0;
  } else if (inner > 0.0 && outer > inner) {
    panel.xRange = Range{1.0, outer / inner};
    panel.xTicks = {1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0};
  }
  return panel;
}

/// Velocity twice, shear stress and volume fraction: a comparison at one glance.
Figure overview(const FlowFrame& frame, const Engines& engines, const IsFaint& faint) {
  Figure figure;
  figure.name = "overview";
  const std::vector<ProfilePlot> plots = plotsOf(frame);
  const BinKind kind = kindOf(frame);
  const bool rings = kind == BinKind::rings;
  figure.title = rings ? "Azimuthal velocity, shear stress and volume fraction of all engines"
                       : "Velocity, stresses and volume fraction of all engines";
  const std::string when = averagedRotations(frame.averaging);
  figure.caption = describeBars(engines) + (when.empty() ? "" : " Averaged: " + when + ".");
  figure.columns = 2;
  figure.panelWidth = 480;
  figure.panelHeight = 330;
  figure.png = true;
  figure.keyAbove = true;
  Names shown =
      rings ? Names{"azimuthal_velocity", "azimuthal_velocity_log", "stress_rp", "volume_fraction"}
            : Names{"velocity_x", "stress_xy", "stress_yy", "volume_fraction"};
  if (kind == BinKind::space) {
    const std::string& along = frame.region->along;
    figure.title = "Velocity, temperature, stress and volume fraction of all engines";
    shown = {"velocity_" + shearedAlong(along), "granular_temperature_log",
             "stress_" + along + along, "volume_fraction"};
  }
  for (const std::string& name : shown) {
    const auto plot = std::ranges::find(plots, name, &ProfilePlot::name);
    Panel panel = profilePanel(frame, engines, *plot, faint);
    if (!hasPoints(panel)) continue;
    panel.key = Key::none;
    figure.panels.push_back(std::move(panel));
  }
  return figure;
}

/// Single runs beside means of others, each with its surrogate's run of the same packing.
Figure singleRunsFigure(const FlowFrame& frame, const Engines& engines) {
  Engines alone;
  Names said;
  for (const EngineRuns& engine : engines) {
    if (!engine.isSingle) continue;
    const int packing = engine.finished.front()->packing;
    alone.push_back(engine);
    std::string words = fmt::format("{} on packing {}", engine.name, packing);
    if (const auto* const mirror = findBy(engines, engine.surrogate, &EngineRuns::name))
      if (const auto* const run = findBy(mirror->finished, packing, &FlowRun::packing)) {
        alone.push_back(*mirror);
        alone.back().finished = {*run};
        alone.back().ensemble = nullptr;
        alone.back().standsFor.clear();
        words += fmt::format(" beside {} on the same", mirror->name);
      }
    said.push_back(std::move(words));
  }
  if (alone.empty()) return {};
  Figure figure = overview(frame, alone, {});
  figure.name = "single_runs";
  figure.title = "Single runs: " + figure.title;
  figure.caption = fmt::format(
      "Single runs, which say nothing of other packings: {}. Bars: ± one standard error within the "
      "run.",
      listed(said));
  figure.png = false;
  return figure;
}

/// With the rotations averaged over: cells drift.
std::string captionOf(const FlowFrame& frame, const ProfilePlot& plot, const Panel& panel) {
  std::string caption = capitalised(plot.title());
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
  if (const std::string when = averagedRotations(frame.averaging); !when.empty())
    caption += "; " + when;
  return caption + ".";
}

constexpr double mostMargins = 5.0;  ///< of an axis: what lies beyond is marked at its end

/// An engine minus the reference, ring by ring, in margins; bars are ± half the ring's interval.
Curve differenceCurve(const FlowFrame& frame, const AgreementRow& row, const EngineRuns& engine) {
  Curve curve{engine.name, engine.style, Draw::linesAndPoints, {}, 1.5};
  const double sign = row.b == engine.name ? 1.0 : -1.0;
  for (const AgreementRing& ring : row.rings) {
    const auto x = at(binPlaces(frame), ring.ring), difference = finite(ring.difference),
               margin = finite(ring.margin);
    if (!x || !difference || !margin || *margin <= 0.0) continue;
    Point point{*x, sign * *difference / *margin, {}};
    if (const auto low = finite(ring.low), high = finite(ring.high); low && high)
      point.error = 0.5 * (*high - *low) / *margin;
    curve.points.push_back(std::move(point));
  }
  return curve;
}

std::optional<Range> marginRange(const Panel& panel) {
  double most = 1.5;
  for (const Curve& curve : panel.curves)
    for (const Point& point : curve.points) most = std::max(most, 1.1 * std::abs(point.y));
  most = std::min(most, mostMargins);
  return Range{-most, most};
}

/// Where a curve lies beyond the axis: a triangle at its end for each point, the farthest with its
/// number. @param above  at the upper end, else at the lower
std::optional<Curve> beyondTheAxis(const Panel& panel, const Curve& curve, bool above) {
  constexpr int upward = 9, downward = 11;  // gnuplot's filled triangles
  const double end = panel.yRange->high, sign = above ? 1.0 : -1.0;
  Curve marks{"", curve.style, Draw::points, {}, curve.width};
  marks.style.pointType = above ? upward : downward;
  double farthest = 0.0;
  std::size_t at = 0;
  for (const Point& point : curve.points) {
    const double distance = sign * point.y;
    if (distance <= end) continue;
    if (distance > farthest) at = marks.points.size();
    farthest = std::max(farthest, distance);
    marks.points.push_back({point.x, 0.97 * sign * end, {}});
  }
  if (marks.points.empty()) return std::nullopt;
  marks.points[at].label = (above ? "" : "−") + readable(farthest);
  return marks;
}

/// A curve of which nothing is within the panel is in the key by its marks.
void markWhatIsBeyond(Panel& panel) {
  const std::size_t engines = panel.curves.size();
  for (std::size_t k = 0; k < engines; ++k) {
    bool named = isSeen(panel, panel.curves[k]);
    for (const bool above : {true, false})
      if (auto marks = beyondTheAxis(panel, panel.curves[k], above)) {
        if (!named) marks->name = panel.curves[k].name;
        named = true;
        panel.curves.push_back(std::move(*marks));
      }
  }
}

}  // namespace

const char* binWord(const FlowFrame& frame) {
  return frame.region ? "bin" : "ring";
}

std::optional<Range> rTildeRange(const FlowFrame& frame) {
  const CouetteCell& cell = frame.cell;
  if (cell.outerRadius <= cell.innerRadius || cell.diameter <= 0.0) return std::nullopt;
  return Range{0.0, (cell.outerRadius - cell.innerRadius) / cell.diameter};
}

std::string describeBars(const Engines& engines) {
  const bool ensemble =
      std::ranges::any_of(engines, [](const EngineRuns& engine) { return engine.ensemble; });
  if (!ensemble)
    return "Bars: ± one standard error within the run: conditional on its one packing, it says "
           "nothing about other packings.";
  Names single, mirrors;
  for (const EngineRuns& engine : engines) {
    if (!engine.isSingle) continue;
    single.push_back(engine.name);
    if (!engine.surrogate.empty())
      mirrors.push_back(fmt::format("{} of {}", engine.surrogate, engine.name));
  }
  std::string text = "Bars: ± one standard error of the mean over packings.";
  if (!mirrors.empty())
    text += fmt::format(" Mirrors stand for engines that are evaluated through them: {}.",
                        listed(mirrors));
  if (!single.empty())
    text += fmt::format(" Single runs of {} are not drawn here; they have a part of their own.",
                        listed(single));
  return text;
}

std::vector<Figure> profileFigures(const FlowFrame& frame, const Engines& engines,
                                   const IsFaint& faint) {
  std::vector<Figure> figures;
  if (Figure all = overview(frame, only(engines, std::mem_fn(&EngineRuns::isResult)), faint);
      !all.panels.empty())
    figures.push_back(std::move(all));
  const Engines means = only(engines, std::not_fn(std::mem_fn(&EngineRuns::isSingle)));
  for (const ProfilePlot& plot : plotsOf(frame)) {
    Panel panel = profilePanel(frame, means, plot, faint);
    if (!hasPoints(panel)) continue;
    figures.push_back({"profile_" + plot.name(),
                       "Profile of the " + plot.title(),
                       captionOf(frame, plot, panel),
                       {panel}});
  }
  if (Figure single = singleRunsFigure(frame, engines); !single.panels.empty())
    figures.push_back(std::move(single));
  return figures;
}

std::vector<Figure> differenceFigures(const CompareResults& results, const Engines& engines) {
  std::vector<Figure> figures;
  if (engines.empty()) return figures;
  const std::string& reference = referenceOf(results);
  const std::string called = referenceWords(results);
  for (const std::string& field : fieldsOf(results.agreement)) {
    Panel panel;
    for (const EngineRuns& engine : engines)
      if (const AgreementRow* row = rowOf(results.agreement, reference, engine.name, field))
        if (Curve curve = differenceCurve(results, *row, engine); !curve.points.empty())
          panel.curves.push_back(std::move(curve));
    if (panel.curves.empty()) continue;
    panel.xLabel = binAxis(results);
    panel.yLabel = fmt::format("difference of {} [margins]", fieldWords(field));
    panel.xRange = rTildeRange(results);
    panel.yRange = marginRange(panel);
    panel.band = Range{-1.0, 1.0};
    panel.level = 0.0;
    const std::size_t engineCurves = panel.curves.size();
    markWhatIsBeyond(panel);
    std::string caption = capitalised(fmt::format(
        "{} minus that of {}, in the {}'s margin; blue: within it. Bars: ± half the interval that "
        "the {}'s colour rests on{}.",
        fieldWords(field), called, binWord(results), binWord(results),
        panel.curves.size() > engineCurves
            ? fmt::format(". Triangles: beyond {:g} margins; the number is an engine's farthest",
                          mostMargins)
            : ""));
    figures.push_back(
        {"difference_" + field,
         fmt::format("Difference of the {} from that of {}, in margins", fieldWords(field), called),
         std::move(caption),
         {panel}});
  }
  return figures;
}

}  // namespace crossgrain::reports

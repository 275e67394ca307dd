#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "adapters/worker/json.hpp"
#include "reports/common/engines.hpp"
#include "reports/stability/report.hpp"
#include "results/scene_picture.hpp"
#include "results/schema.hpp"
#include "results/stability.hpp"

namespace crossgrain::reports {

namespace {

/// One tile for each engine and case, in the colour of its worst verdict.
Figure mapOf(const StabilityResults& results, const std::vector<HardGroup>& groups) {
  const std::vector<EngineRow>& engines = results.engines;
  Panel panel;
  for (const HardGroup& group : groups) panel.rows.push_back(spaced(group.name));
  for (const EngineRow& engine : engines) panel.columns.push_back(engine.name);
  for (const auto& [verdict, name] : stabilityNames) {
    Curve& tiles = panel.curves.emplace_back(Curve{
        std::string(name), {std::string(lookOf(verdict).plot), 5, false}, Draw::tiles, {}, 1.0});
    for (std::size_t e = 0; e < engines.size(); ++e)
      for (std::size_t g = 0; g < groups.size(); ++g)
        if (const StabilityRun* run = worstRun(results, engines[e].name, groups[g]);
            run && run->verdict == verdict)
          tiles.points.push_back({static_cast<double>(e), static_cast<double>(g), {}});
  }
  std::erase_if(panel.curves, [](const Curve& curve) { return curve.points.empty(); });
  Figure figure;
  figure.name = "stability_map";
  figure.title = "Verdicts: hard cases in rows, engines in columns";
  figure.caption = "The worst verdict of each engine in each case.";
  figure.panels.push_back(std::move(panel));
  figure.panelWidth = 120 * static_cast<int>(std::max<std::size_t>(engines.size(), 3)) + 40;
  figure.panelHeight = 19 * static_cast<int>(groups.size()) + 130;
  figure.rowNames = 210;
  figure.png = true;
  return figure;
}

bool keptToLimit(const StabilityRun& run) {
  return run.verdict <= Verdict::pass;
}

Curve measureCurve(const StabilityRun& run, const LineStyle& style, bool logarithmic) {
  Curve curve{run.engine, style, Draw::lines, {}, 1.5};
  const auto& [time, value] = run.curve;
  for (std::size_t k = 0; k < std::min(time.size(), value.size()); ++k)
    if (std::isfinite(time[k]) && std::isfinite(value[k]) && (!logarithmic || value[k] > 0.0))
      curve.points.push_back({time[k], value[k], {}});
  return curve;
}

/// The variant with the worst run that is drawn, or null.
const HardCase* worstVariant(const StabilityResults& results, const HardGroup& group) {
  const HardCase* shown = nullptr;
  Verdict worst = Verdict::pass;
  for (const HardCase* variant : group.variants)
    for (const EngineRow& engine : results.engines) {
      const StabilityRun* run = runOf(results, engine.name, *variant);
      if (!run || keptToLimit(*run) || run->curve.time.size() < 3) continue;
      if (run->verdict > worst) {
        worst = run->verdict;
        shown = variant;
      }
    }
  return shown;
}

/// The limit as a line that the key names, over the time that is drawn.
void addLimit(Panel& panel, double limit) {
  double first = INFINITY, last = -INFINITY;
  for (const Curve& curve : panel.curves)
    for (const Point& point : curve.points) {
      first = std::min(first, point.x);
      last = std::max(last, point.x);
    }
  panel.curves.push_back(
      {"limit", {"#888888", 0, true}, Draw::lines, {{first, limit, {}}, {last, limit, {}}}, 1.5});
}

/// The worst variant over time.
std::optional<Figure> trackOf(const StabilityResults& results, const HardGroup& group,
                              std::size_t index) {
  const HardCase* shown = worstVariant(results, group);
  if (!shown) return std::nullopt;
  Panel panel;
  panel.name = shown->variant;
  panel.xLabel = "t [s]";
  panel.yLabel = spaced(shown->measure);
  panel.level = finite(shown->limit);
  panel.logY = panel.level.value_or(0.0) > 0.0;
  const std::vector<LineStyle> styles = engineStyles(results.engines);
  for (std::size_t e = 0; e < styles.size(); ++e)
    if (const StabilityRun* run = runOf(results, results.engines[e].name, *shown))
      panel.curves.push_back(measureCurve(*run, styles[e], panel.logY));
  std::erase_if(panel.curves, [](const Curve& curve) { return curve.points.empty(); });
  if (panel.curves.empty()) return std::nullopt;
  if (panel.level) addLimit(panel, *panel.level);
  Figure figure;
  figure.name = fmt::format("stability_{}", index);
  figure.title = fmt::format("{} over time, {}", spaced(shown->measure), group.name);
  figure.caption =
      fmt::format("{} [{}] over time{}{}.", spaced(shown->measure), shown->unit,
                  panel.name.empty() ? "" : ", variant " + panel.name,
                  panel.level ? "; the grey line is the limit, " + readable(panel.level) : "");
  figure.panels.push_back(std::move(panel));
  figure.panelWidth = 640;
  figure.panelHeight = 330;
  return figure;
}

double middleOf(const std::vector<double>& values) {
  std::vector<double> sorted;
  for (const double value : values)
    if (std::isfinite(value)) sorted.push_back(value);
  if (sorted.empty()) return 0.0;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::ranges::nth_element(sorted, middle);
  return *middle;
}

/// Drops disks far away from most, which would make of the rest a dot.
void dropFarAway(ScenePicture& picture) {
  constexpr double farAway = 60.0;  // radii of the largest
  const double x0 = middleOf(picture.x), y0 = middleOf(picture.y);
  double largest = 0.0;
  for (const double radius : picture.radius) largest = std::max(largest, radius);
  const double reach = largest * (farAway + 3.0 * std::sqrt(static_cast<double>(picture.x.size())));
  const auto drop = [&](std::vector<double>& x, std::vector<double>& y) {
    y.resize(x.size(), NAN);
    for (std::size_t k = 0; k < x.size(); ++k)
      if (!(std::abs(x[k] - x0) < reach && std::abs(y[k] - y0) < reach)) x[k] = y[k] = NAN;
  };
  drop(picture.x, picture.y);
  drop(picture.wallX, picture.wallY);
}

Picture pictureOf(const StabilityRun& run, std::size_t index) {
  ScenePicture shown = *run.picture;
  dropFarAway(shown);
  const auto widest = widestForce(shown);
  const std::string& variant = run.variant;
  Drawing drawing = forcesDrawing(shown, widest.value_or(1.0), 0.35);
  return {fmt::format("worst_{}", index),
          run.engine,
          fmt::format("{}: {}{}{}", run.engine, run.name, variant.empty() ? "" : ", ", variant),
          fmt::format("{}{}{}at {} s{}", run.name, variant.empty() ? " " : ", " + variant,
                      variant.empty() ? "" : " ", readable(finite(shown.time)),
                      widest ? fmt::format("; widest line: {} N", readable(widest)) : ""),
          Picture::Shows::worst,
          std::move(drawing)};
}

}  // namespace

std::vector<Figure> stabilityFigures(const StabilityResults& results) {
  const std::vector<HardGroup> groups = hardGroups(results);
  std::vector<Figure> figures;
  if (groups.empty() || results.engines.empty()) return figures;
  figures.push_back(mapOf(results, groups));
  for (std::size_t g = 0; g < groups.size(); ++g)
    if (auto figure = trackOf(results, groups[g], g + 1)) figures.push_back(std::move(*figure));
  return figures;
}

std::vector<Picture> stabilityPictures(const StabilityResults& results) {
  std::vector<Picture> pictures;
  for (const StabilityRun& run : results.runs)
    if (run.verdict == Verdict::fail && run.picture)
      pictures.push_back(pictureOf(run, pictures.size() + 1));
  return pictures;
}

}  // namespace crossgrain::reports

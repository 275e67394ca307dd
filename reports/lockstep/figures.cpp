#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/common/engines.hpp"
#include "reports/lockstep/report.hpp"
#include "reports/lockstep/words.hpp"

namespace crossgrain::reports {

namespace {

/// Whole decades, from the smallest positive point or the level to the largest.
Range decadesOf(const Panel& panel) {
  double low = *panel.level, high = *panel.level;
  for (const Curve& curve : panel.curves)
    for (const Point& point : curve.points)
      if (point.y > 0.0) {
        low = std::min(low, point.y);
        high = std::max(high, point.y);
      }
  return {std::pow(10.0, std::floor(std::log10(low))), std::pow(10.0, std::ceil(std::log10(high)))};
}

/// What rounding to the declared precision may do; no points of double precision.
Curve roundingOf(const LockstepRow& row) {
  Curve curve{"rounding of " + row.engine, {"#808080", 3, true}, Draw::linesAndPoints, {}, 1.0};
  for (const LockstepSeparation& at : row.separations)
    if (at.rounding) curve.points.push_back({at.time, *at.rounding, {}});
  return curve;
}

}  // namespace

std::vector<Figure> lockstepFigures(const LockstepResults& results) {
  const std::vector<LineStyle> styles = engineStyles(results.engines);
  Panel panel;
  panel.xLabel = "time since the start [s]";
  panel.yLabel = "largest separation from the mirror [d]";
  panel.logX = panel.logY = true;
  panel.key = Key::outside;
  panel.level = results.lockstep.rules.rounding;
  Curve yardstick{"", {"#808080", 2, true}, Draw::linesAndPoints, {}, 1.5};
  for (const LockstepRow& row : results.lockstep.rows) {
    const auto engine = std::ranges::find(results.engines, row.engine, &EngineRow::name);
    if (engine == results.engines.end() || row.track.empty()) continue;
    Curve curve{row.engine,
                styles[static_cast<std::size_t>(engine - results.engines.begin())],
                Draw::lines,
                {},
                2.0};
    for (std::size_t k = 0; k < std::min(row.track.size(), row.trackTime.size()); ++k)
      curve.points.push_back({row.trackTime[k], row.track[k], {}});
    panel.curves.push_back(std::move(curve));
    if (Curve rounding = roundingOf(row); !rounding.points.empty())
      panel.curves.push_back(std::move(rounding));
    if (yardstick.points.empty())
      for (const LockstepSeparation& at : row.separations)
        if (at.yardstick) yardstick.points.push_back({at.time, *at.yardstick, {}});
  }
  yardstick.name =
      fmt::format("mirror with {} +{:g} %", constantSymbol(results.lockstep.rules.yardstick),
                  100.0 * results.lockstep.rules.yardstickChange);
  if (!yardstick.points.empty()) panel.curves.push_back(std::move(yardstick));
  if (!hasPoints(panel)) return {};
  panel.yRange = decadesOf(panel);
  Figure figure{
      "lockstep_separation",
      "How far each engine is from its mirror, over time",
      "Of all disks and starts the one that is farthest off; an engine whose positions are "
      "its mirror's to the bit has no line. Thin: what counts as rounding of double "
      "precision. Grey: what a known change of the law does, and what rounding to another "
      "precision may do, the medians over the starts.",
      {panel}};
  figure.panelWidth = 760;
  figure.png = true;
  return {figure};
}

}  // namespace crossgrain::reports

#include <fmt/format.h>

#include <algorithm>

#include "reports/common/engines.hpp"
#include "reports/lockstep/report.hpp"

namespace crossgrain::reports {

std::vector<Figure> lockstepFigures(const LockstepResults& results) {
  const std::vector<LineStyle> styles = engineStyles(results.engines);
  Panel panel;
  panel.xLabel = "time since the start [s]";
  panel.yLabel = "largest separation from the mirror [d]";
  panel.logX = panel.logY = true;
  panel.key = Key::outside;
  panel.level = results.rules.rounding;
  Curve yardstick{"", {"#808080", 2, true}, Draw::linesAndPoints, {}, 1.5};
  for (const LockstepRow& row : results.rows) {
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
    if (yardstick.points.empty())
      for (const LockstepSeparation& at : row.separations)
        if (at.yardstick) yardstick.points.push_back({at.time, *at.yardstick, {}});
  }
  yardstick.name = fmt::format("mirror with {} +{:g} %", results.rules.yardstick,
                               100.0 * results.rules.yardstickChange);
  if (!yardstick.points.empty()) panel.curves.push_back(std::move(yardstick));
  if (!hasPoints(panel)) return {};
  Figure figure{
      "lockstep_separation",
      "How far each engine is from its mirror, over time",
      "Of all disks and starts the one that is farthest off; an engine whose positions are "
      "its mirror's to the bit has no line. Thin: what counts as rounding. Grey: what a "
      "known change of the law does, the median over the starts.",
      {panel}};
  figure.panelWidth = 760;
  figure.png = true;
  return {figure};
}

}  // namespace crossgrain::reports

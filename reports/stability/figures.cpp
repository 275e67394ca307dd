#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/common/engines.hpp"
#include "reports/common/figures.hpp"
#include "reports/common/labels.hpp"
#include "reports/common/numbers.hpp"
#include "reports/stability/table.hpp"

namespace crossgrain::reports {

namespace {

/// One tile for each engine and case, in the colour of its worst verdict.
Figure mapOf(const Json& results, const std::vector<EngineResults>& engines,
             const std::vector<HardGroup>& groups) {
  Panel panel;
  for (const HardGroup& group : groups) panel.rows.push_back(spaced(group.name));
  for (const EngineResults& engine : engines) panel.columns.push_back(engine.name);
  for (const VerdictLook& look : verdictLooks)
    panel.curves.push_back(
        {std::string(look.name), {std::string(look.colour), 5, false}, Draw::tiles, {}, 1.0});
  for (std::size_t e = 0; e < engines.size(); ++e)
    for (std::size_t g = 0; g < groups.size(); ++g) {
      const Json& run = worstRun(results, engines[e].name, groups[g]);
      if (run.is_null()) continue;
      panel.curves[verdictRank(text(run, "verdict"))].points.push_back(
          {static_cast<double>(e), static_cast<double>(g), {}});
    }
  std::erase_if(panel.curves, [](const Curve& curve) { return curve.points.empty(); });
  Figure figure;
  figure.name = "stability_map";
  figure.title = "Verdicts: hard cases in rows, engines in columns";
  figure.caption = "The worst verdict of each engine in each case.";
  figure.panels.push_back(std::move(panel));
  figure.panelWidth = 120 * static_cast<int>(std::max<std::size_t>(engines.size(), 3)) + 40;
  figure.panelHeight = 19 * static_cast<int>(groups.size()) + 90;
  figure.rowNames = 210;
  figure.png = true;
  return figure;
}

bool keptToLimit(const Json& run) {
  return verdictRank(text(run, "verdict")) <= verdictRank("stable");
}

Curve curveOf(const Json& run, const EngineResults& engine, bool logarithmic) {
  Curve curve{engine.name, engine.style, Draw::lines, {}, 1.5};
  const Json& track = member(run, "curve");
  for (std::size_t k = 0; k < list(track, "t_s").size(); ++k) {
    const auto t = number(list(track, "t_s")[k]), value = number(element(list(track, "value"), k));
    if (t && value && (!logarithmic || *value > 0.0)) curve.points.push_back({*t, *value, {}});
  }
  return curve;
}

/// The variant that somebody fared worst in, over time.
std::optional<Figure> trackOf(const Json& results, const std::vector<EngineResults>& engines,
                              const HardGroup& group, std::size_t index) {
  const Json* shown = nullptr;
  std::size_t worst = verdictRank("stable");
  for (const Json* variant : group.variants)
    for (const EngineResults& engine : engines) {
      const Json& run = runOf(results, engine.name, *variant);
      if (keptToLimit(run) || list(member(run, "curve"), "t_s").size() < 3) continue;
      if (verdictRank(text(run, "verdict")) > worst) {
        worst = verdictRank(text(run, "verdict"));
        shown = variant;
      }
    }
  if (!shown) return std::nullopt;
  Panel panel;
  panel.name = text(*shown, "variant");
  panel.xLabel = "t [s]";
  panel.yLabel = spaced(text(*shown, "measure"));
  panel.level = number(*shown, "limit");
  panel.logY = panel.level.value_or(0.0) > 0.0;
  for (const EngineResults& engine : engines)
    panel.curves.push_back(curveOf(runOf(results, engine.name, *shown), engine, panel.logY));
  std::erase_if(panel.curves, [](const Curve& curve) { return curve.points.empty(); });
  if (panel.curves.empty()) return std::nullopt;
  Figure figure;
  figure.name = fmt::format("stability_{}", index);
  figure.title = fmt::format("{} over time, {}", spaced(text(*shown, "measure")), group.name);
  figure.caption =
      fmt::format("{} [{}] over time{}{}.", spaced(text(*shown, "measure")), text(*shown, "unit"),
                  panel.name.empty() ? "" : ", variant " + panel.name,
                  panel.level ? "; the grey line is the limit, " + readable(panel.level) : "");
  figure.panels.push_back(std::move(panel));
  figure.panelWidth = 640;
  figure.panelHeight = 330;
  return figure;
}

}  // namespace

std::vector<Figure> stabilityFigures(const Json& results) {
  const std::vector<EngineResults> engines = engineResults(results);
  const std::vector<HardGroup> groups = hardGroups(results);
  std::vector<Figure> figures;
  if (groups.empty() || engines.empty()) return figures;
  figures.push_back(mapOf(results, engines, groups));
  for (std::size_t g = 0; g < groups.size(); ++g)
    if (auto figure = trackOf(results, engines, groups[g], g + 1))
      figures.push_back(std::move(*figure));
  return figures;
}

}  // namespace crossgrain::reports

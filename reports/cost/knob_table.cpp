#include <fmt/format.h>

#include "reports/common/numbers.hpp"
#include "reports/cost/cells.hpp"
#include "reports/cost/tables.hpp"
#include "reports/cost/words.hpp"

namespace crossgrain::reports {

namespace {

std::string ratioText(const CostPoint& point, const CostPoint* base) {
  if (!point.wallSeconds || !base || !base->wallSeconds || *base->wallSeconds == 0.0)
    return absentText;
  return fmt::format("{:.2f}", *point.wallSeconds / *base->wallSeconds);
}

/// One line of the table of a kind: what a setting changes in every measure. Null without a point.
Json knobRow(const CostPoints& points, CostKind kind, const CostEngine& engine,
             const OtherSetting& setting, std::size_t index) {
  Json line = headOf(engine);
  line["number"] = index + 1;
  line["setting"] = settingWords(setting.knob, setting.setting);
  line["cells"] = Json::array();
  bool any = false;
  for (const CostMeasure& measure : measuresDrawn(points)) {
    if (measure.kind != kind) continue;
    Json shown = {{"text", absentText}, {"was", ""}};
    for (const CostPoint& point : points) {
      if (!measure.has(point) || point.engine != engine.name || point.knob != setting.knob ||
          point.setting != setting.setting)
        continue;
      const CostPoint* base = baseOf(points, point);
      shown = {{"text", errorText(point)}, {"was", base ? "was " + errorText(*base) : ""}};
      if (!any) {
        line["base"] = base ? base->setting : absentText;
        line["ratio"] = ratioText(point, base);
        line["wall"] = readableDuration(point.wallSeconds);
      }
      any = true;
    }
    line["cells"].push_back(shown);
  }
  return any ? line : Json();
}

}  // namespace

Json knobGroups(const CostResults& results, const std::vector<CostEngine>& engines) {
  const CostPoints& points = results.points;
  const auto settings = otherSettings(points);
  Json groups = Json::array();
  for (const CostKind kind : kindsIn(points)) {
    Json measures = Json::array(), lines = Json::array();
    for (const CostMeasure& measure : measuresDrawn(points))
      if (measure.kind == kind) measures.push_back(measureHtml(measure.name));
    for (const CostEngine& engine : engines)
      for (std::size_t k = 0; k < settings.size(); ++k)
        if (Json line = knobRow(points, kind, engine, settings[k], k); !line.is_null())
          lines.push_back(std::move(line));
    if (!lines.empty())
      groups.push_back({{"kind", toString(kind)},
                        {"unit", timeUnit(kind)},
                        {"measures", std::move(measures)},
                        {"rows", std::move(lines)}});
  }
  return groups;
}

}  // namespace crossgrain::reports

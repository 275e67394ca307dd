#include <fmt/format.h>

#include "reports/common/numbers.hpp"
#include "reports/cost/cells.hpp"
#include "reports/cost/tables.hpp"
#include "reports/cost/words.hpp"

namespace crossgrain::reports {

namespace {

Json cheapestCell(const CostPoints& points, const Cheapest& entry) {
  const std::string verdict = toString(entry.verdict);
  const CostPoint* point = pointAt(points, entry.point);
  if (!point) return verdictCell(entry.verdict, verdict, {});
  const std::string what =
      fmt::format("{}, {}", readableDuration(point->wallSeconds), errorText(*point));
  if (entry.verdict != CostVerdict::reached)
    return verdictCell(
        entry.verdict, verdict,
        {fmt::format("{}: {}", settingWords(*point), what), decidesText(entry.decides)});
  const CostPoint* cheaper = pointAt(points, entry.cheaper);
  return verdictCell(
      entry.verdict, settingWords(*point),
      {what, lengthText(entry.length), cheaper ? "perhaps " + settingWords(*cheaper) : "",
       decidesText(entry.decides)});
}

}  // namespace

Json cheapestGroups(const CostResults& results, const std::vector<CostEngine>& engines) {
  const auto targets = costTargets(results);
  Json groups = Json::array();
  for (const CostMeasure& measure : measuresIn(results.points)) {
    Json lines = Json::array();
    for (const CostEngine& engine : engines) {
      Json line = headOf(engine);
      line["cells"] = Json::array();
      for (const double target : targets)
        for (const Cheapest& entry : results.cheapest)
          if (entry.engine == engine.name && entry.kind == measure.kind &&
              entry.measure == measure.name && entry.target == target)
            line["cells"].push_back(cheapestCell(results.points, entry));
      if (!line["cells"].empty()) lines.push_back(std::move(line));
    }
    groups.push_back(
        {{"title", fmt::format("{}: {}", toString(measure.kind), measureHtml(measure.name))},
         {"span", targets.size() + 1},
         {"rows", std::move(lines)}});
  }
  return groups;
}

}  // namespace crossgrain::reports

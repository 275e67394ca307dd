#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "reports/common/numbers.hpp"
#include "reports/cost/tables.hpp"
#include "reports/cost/words.hpp"

namespace crossgrain::reports {

Json notRunRows(const CostResults& results) {
  struct Trouble {
    const CostPoint* first;
    std::vector<std::string> measures;
  };
  std::vector<Trouble> troubles;
  for (const CostPoint& point : results.points) {
    if (point.ran()) continue;
    const auto alike = std::ranges::find_if(troubles, [&](const Trouble& one) {
      return one.first->engine == point.engine && one.first->kind == point.kind &&
             one.first->knob == point.knob && one.first->setting == point.setting &&
             one.first->status == point.status && one.first->reason == point.reason;
    });
    const bool isNew = alike == troubles.end();
    Trouble& trouble = isNew ? troubles.emplace_back(Trouble{&point, {}}) : *alike;
    trouble.measures.push_back(measureWords(point.measure));
  }
  Json lines = Json::array();
  for (const Trouble& trouble : troubles)
    lines.push_back({{"engine", trouble.first->engine},
                     {"kind", toString(trouble.first->kind)},
                     {"measures", fmt::format("{}", fmt::join(trouble.measures, ", "))},
                     {"setting", settingWords(*trouble.first)},
                     {"status", statusText(trouble.first->status)},
                     {"reason", trouble.first->reason}});
  return lines;
}

Json startupRows(const CostResults& results) {
  Json rows = Json::array();
  for (const Startup& startup : results.startup)
    rows.push_back({{"engine", startup.engine},
                    {"start", readableDuration(startup.start)},
                    {"load", readableDuration(startup.load)}});
  return rows;
}

Json referenceRows(const CostResults& results) {
  Json rows = Json::array();
  for (const CostReference& reference : results.references)
    rows.push_back({{"kind", toString(reference.kind)},
                    {"engine", reference.engine},
                    {"setting", reference.setting},
                    {"error", percentText(reference.error)},
                    {"note", reference.note}});
  return rows;
}

}  // namespace crossgrain::reports

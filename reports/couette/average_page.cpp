#include <fmt/format.h>

#include "reports/common/numbers.hpp"
#include "reports/common/page.hpp"
#include "reports/couette/compare_views.hpp"
#include "reports/couette/state_view.hpp"

namespace crossgrain::reports {

namespace {

using Engines = std::vector<EngineResults>;

/// "t = 0.5 to 1.2 s"; empty without times.
std::string timesOf(const Engines& engines) {
  for (const EngineResults& engine : engines)
    for (const Json* run : engine.finished) {
      const Json& times = list(member(*run, "series"), "t_s");
      if (times.empty()) continue;
      const auto first = number(times.front()), last = number(times.back());
      if (first && last)
        return *first == *last
                   ? fmt::format("t = {} s", readableSetting(first))
                   : fmt::format("t = {} to {} s", readableSetting(first), readableSetting(last));
    }
  return {};
}

/// "12 fields in 20 rings".
std::string extentOf(const Json& results, const Engines& engines) {
  std::size_t fields = 0;
  const std::string method = text(member(results, "averaging"), "method");
  for (const EngineResults& engine : engines)
    for (const Json& profile : list(engine.averages(), "profiles"))
      fields += text(profile, "method") == method;
  return fmt::format("{} in {}", counted(fields, "field"),
                     counted(list(member(results, "rings"), "r").size(), "ring"));
}

void addAverageSummary(Json& view, const Json& results, const Engines& engines) {
  const auto snapshots = number(member(results, "averaging"), "snapshots");
  view["sentences"] = Json::array();
  if (engines.empty() || engines.front().finished.empty()) {
    view["lead"] = "Nothing was averaged.";
    return;
  }
  view["lead"] = fmt::format("{} of {} averaged: {}.",
                             counted(static_cast<std::size_t>(snapshots.value_or(0.0)), "snapshot"),
                             engines.front().name, extentOf(results, engines));
  if (const std::string times = timesOf(engines); !times.empty())
    view["sentences"].push_back("The snapshots are of " + times + ".");
  for (const std::string& state : stateSentences(results, engines))
    view["sentences"].push_back(state);
  view["sentences"].push_back(
      "Nothing was run and nothing compared: bars are those within these snapshots, and say "
      "nothing about other packings.");
  if (snapshots == 1.0)
    view["sentences"].push_back("One snapshot is an instant, not an average over time.");
  std::size_t refused = 0, all = 0;
  for (const Json& fit : list(engines.front().averages(), "fits")) {
    ++all;
    refused += !number(fit, "value");
  }
  if (refused > 0)
    view["sentences"].push_back(
        fmt::format("{} of {} could not be had; the table of fits says why.", refused,
                    counted(all, "fitted number")));
}

}  // namespace

std::string averagePage(const Json& results, const Illustrations& shown) {
  const Engines engines = engineResults(results);
  Json view = commonView(results, shown);
  addAverageSummary(view, results, engines);
  view["columns"] = columnsView(engines);
  addStateTable(view, engines);
  addStates(view, results, engines);
  view["averages"] = averagesInWords(results);
  addFitsAndNumberChecks(view, engines);
  addFigures(view, engines, shown);
  view["files"] =
      "Beside this page: results.json (everything), profiles.csv, distributions.csv, series.csv, "
      "regimes.csv and steadiness.csv.";
  return render("report_average.html", view);
}

}  // namespace crossgrain::reports

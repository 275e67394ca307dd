#include <fmt/format.h>

#include <algorithm>

#include "reports/common/numbers.hpp"
#include "reports/common/overview.hpp"
#include "reports/common/page.hpp"
#include "reports/couette/compare_views.hpp"
#include "reports/couette/overview.hpp"
#include "reports/couette/report.hpp"
#include "reports/couette/state_view.hpp"

namespace crossgrain::reports {

namespace {

using Engines = std::vector<EngineRuns>;

/// "t = 0.5 to 1.2 s"; empty without times.
std::string timesOf(const Engines& engines) {
  for (const EngineRuns& engine : engines)
    for (const CouetteRun* run : engine.finished) {
      if (!run->series) continue;
      const Numbers& times = valuesOf(*run->series, "t_s");
      if (times.empty()) continue;
      const auto first = finite(times.front()), last = finite(times.back());
      if (first && last)
        return *first == *last
                   ? fmt::format("t = {} s", readableSetting(first))
                   : fmt::format("t = {} to {} s", readableSetting(first), readableSetting(last));
    }
  return {};
}

/// "12 fields in 20 rings".
std::string extentOf(const CompareResults& results, const Engines& engines) {
  std::ptrdiff_t fields = 0;
  for (const EngineRuns& engine : engines)
    fields += std::ranges::count(engine.profiles(), results.averaging.method, &Profile::method);
  return fmt::format("{} in {}", counted(static_cast<std::size_t>(fields), "field"),
                     counted(results.rings.r.size(), "ring"));
}

void addAverageSummary(Json& view, const CompareResults& results, const Engines& engines) {
  const auto snapshots = results.averaging.snapshots;
  view["sentences"] = Json::array();
  view["lead"] = averageLead(results, engines);
  if (engines.empty() || engines.front().finished.empty()) return;
  if (const std::string times = timesOf(engines); !times.empty())
    view["sentences"].push_back("The snapshots are of " + times + ".");
  for (const std::string& state : stateSentences(results, engines))
    view["sentences"].push_back(state);
  view["sentences"].push_back(
      "Nothing was run and nothing compared: bars are those within these snapshots, and say "
      "nothing about other packings.");
  if (snapshots == 1)
    view["sentences"].push_back("One snapshot is an instant, not an average over time.");
  const std::vector<FitRow>& fits = engines.front().fits();
  const auto refused =
      std::ranges::count_if(fits, [](const FitRow& fit) { return !finite(fit.value); });
  if (refused > 0)
    view["sentences"].push_back(
        fmt::format("{} of {} could not be had; the table of fits says why.", refused,
                    counted(fits.size(), "fitted number")));
}

}  // namespace

std::string averageLead(const CompareResults& results, const Engines& engines) {
  if (engines.empty() || engines.front().finished.empty()) return "Nothing was averaged.";
  return fmt::format("{} of {} averaged: {}.",
                     counted(static_cast<std::size_t>(results.averaging.snapshots), "snapshot"),
                     engines.front().name, extentOf(results, engines));
}

std::string averagePage(const CompareResults& results, const Illustrations& shown) {
  const Engines engines = engineRuns(results);
  Json view = studyView(results, shown);
  addAverageSummary(view, results, engines);
  addOverview(view, averageOverview(results), results.engines);
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

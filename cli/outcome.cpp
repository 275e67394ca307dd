#include "cli/outcome.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "reports/report.hpp"

namespace crossgrain::inline cli {

using nlohmann::json;

int countOf(const json& list, const char* key, const std::string& value) {
  return static_cast<int>(
      std::ranges::count_if(list, [&](const json& row) { return row.value(key, "") == value; }));
}

void printFailures(const json& rows) {
  for (const json& row : rows)
    if (row["status"] == "failed")
      fmt::print(stderr, "crossgrain: {}\n", row["reason"].get<std::string>());
}

int averaged(const CommandLine& line, RunStore& store, const json& results) {
  store.begin();
  writeReport(results, line.run.out);
  if (line.json)
    fmt::print("{}\n", (line.run.out / "results.json").string());
  else
    fmt::print("{} snapshots averaged\nreport: {}\n", results["averaging"]["snapshots"].get<int>(),
               (line.run.out / "report.html").string());
  return exitHeld;
}

int told(const std::string& plan) {
  fmt::print("{}", plan);
  return exitHeld;
}

int nothingWasJudged(const CommandLine& line, const std::string& reason, bool byRequest,
                     bool strict) {
  const std::string text = "nothing was judged: " + reason;
  if (line.json)
    fmt::print(stderr, "crossgrain: {}\n", text);
  else
    fmt::print("{}\n", text);
  return byRequest && !strict ? exitHeld : exitFellShort;
}

void printWarnings(const Case& setup) {
  for (const std::string& warning : setup.warnings) fmt::print(stderr, "caution: {}\n", warning);
}

}  // namespace crossgrain::inline cli

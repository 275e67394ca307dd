#include "cli/outcome.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "reports/common/numbers.hpp"
#include "support/busy_time.hpp"

namespace crossgrain::inline cli {

namespace {

const std::chrono::steady_clock::time_point programBegan = std::chrono::steady_clock::now();

}  // namespace

void printFailure(const std::string& reason) {
  fmt::print(stderr, "crossgrain: {}\n", reason);
}

bool printRefusals(const CommandLine& line, const std::vector<EngineRow>& engines) {
  bool any = false;
  for (const EngineRow& engine : engines) {
    if (engine.status != EngineStatus::refused ||
        std::ranges::find(line.run.engines, engine.name) == line.run.engines.end())
      continue;
    printFailure(engine.reason);
    any = true;
  }
  return any;
}

int averaged(const CommandLine& line, const CouetteAveraging& averaging, const Overview& overview) {
  if (line.json) {
    fmt::print("{}\n", (line.run.out / "results.json").string());
    return exitHeld;
  }
  fmt::print("{} snapshots averaged\n", averaging.snapshots);
  printOverview(overview);
  fmt::print("report: {}\n", (line.run.out / "report.html").string());
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

void printTimeSpent() {
  const std::chrono::duration<double> all = std::chrono::steady_clock::now() - programBegan;
  const double stepping = steppingTime().seconds(), drawing = drawingTime().seconds();
  fmt::print(stderr, "{}: engines stepped for {} ({:.0f} %), plots took {} ({:.0f} %)\n",
             reports::shortDuration(all.count()), reports::shortDuration(stepping),
             100.0 * stepping / all.count(), reports::shortDuration(drawing),
             100.0 * drawing / all.count());
}

}  // namespace crossgrain::inline cli

#include "cli/outcome.hpp"

#include <fmt/format.h>

namespace crossgrain::inline cli {

void printFailure(const std::string& reason) {
  fmt::print(stderr, "crossgrain: {}\n", reason);
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

}  // namespace crossgrain::inline cli

#include <fmt/format.h>

#include "reports/conformance/report.hpp"
#include "results/json_fields.hpp"

namespace crossgrain::reports {

std::string conformanceLead(const ConformanceResults& results) {
  using enum ConformanceOutcome;
  const std::size_t asked = results.rows.size() - results.count(skipped);
  std::string lead = fmt::format("{} ({}): {} of {} checks passed", results.engine.name,
                                 results.engine.version, results.count(passed), asked);
  if (const std::size_t count = results.count(failed)) lead += fmt::format(", {} failed", count);
  if (const std::size_t count = results.count(brokeDown))
    lead += fmt::format(", it broke down in {}", count);
  if (const std::size_t count = results.count(skipped)) lead += fmt::format("; {} skipped", count);
  return lead + ".";
}

std::string conformanceSentence(const ConformanceRow& row) {
  const char* const words[] = {"passed", "failed", "skipped", "broke down"};
  std::string sentence =
      fmt::format("{}: {} ({})", words[static_cast<std::size_t>(row.outcome)], row.name, row.what);
  if (!row.detail.empty()) sentence += ": " + row.detail;
  if (row.faults > 1) sentence += fmt::format(" (and {} more)", row.faults - 1);
  return sentence;
}

}  // namespace crossgrain::reports

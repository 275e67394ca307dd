#include <fmt/format.h>
#include <fmt/ranges.h>

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
  if (const std::size_t count = results.count(skipped)) lead += fmt::format(", {} skipped", count);
  const std::size_t unseen = results.notExamined.size();
  if (results.declared && unseen > 0)
    lead += fmt::format(
        "; {} of {} declared capabilities ({:.0f} %) not examined", unseen, *results.declared,
        100.0 * static_cast<double>(unseen) / static_cast<double>(*results.declared));
  return lead + ".";
}

std::string conformanceNotExamined(const ConformanceResults& results) {
  if (results.notExamined.empty()) return {};
  return fmt::format("not examined: {}", fmt::join(results.notExamined, "; "));
}

std::string conformanceCause(const ConformanceResults& results) {
  using enum ConformanceOutcome;
  if (!results.cause.empty()) return "most likely: " + results.cause;
  if (results.count(failed) == 0) return {};
  return "most likely: no single cause of those tried explains it";
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

#include "studies/flow/contact_notes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <numeric>
#include <optional>
#include <string>
#include <vector>

namespace crossgrain::inline studies {

namespace {

/// Over all snapshots of all finished runs of an engine.
std::optional<double> meanOf(const FlowStudy& study, const std::string& engine,
                             const char* series) {
  std::vector<double> values;
  for (const FlowRun& run : study.runs) {
    if (run.engine != engine || !run.finished() || !run.series) continue;
    for (const auto& value : valuesOf(*run.series, series))
      if (value) values.push_back(*value);
  }
  if (values.empty()) return std::nullopt;
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

}  // namespace

std::vector<std::string> contactNotes(const FlowStudy& study) {
  std::vector<std::string> differ, same;
  for (const EngineRow& engine : study.engines) {
    const std::string& name = engine.name;
    const auto counted = meanOf(study, name, "coordination");
    const auto listed = meanOf(study, name, "pairs_listed");
    if (!counted || !listed) continue;
    if (*listed == *counted)
      same.push_back(name);
    else
      differ.push_back(fmt::format("{} {:.3g} instead of {:.3g}", name, *listed, *counted));
  }
  if (differ.empty() && same.empty()) return {};
  std::string outcome;
  if (!differ.empty()) outcome = fmt::format("{}", fmt::join(differ, ", "));
  if (!same.empty())
    outcome += fmt::format("{}no other for {}", differ.empty() ? "" : "; ", fmt::join(same, ", "));
  return {fmt::format(
      "Contacts are pairs that transmit a force. With every pair that an engine lists, the "
      "coordination C (and with it the trace of the fabric, νC) would be: {}.",
      outcome)};
}

}  // namespace crossgrain::inline studies

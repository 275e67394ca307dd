#include "studies/flow/alarms.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "averaging/agreement.hpp"
#include "cases/endpoints.hpp"
#include "studies/flow/endpoint_values.hpp"
#include "studies/flow/paired_rings.hpp"

namespace crossgrain::inline studies {

namespace {

constexpr double farMargins = 10.0;
/// Of the disks: what crosses the walls' circles and comes back is a tenth of that.
constexpr double goneFraction = 0.02;

/// On how many packings exactly one of both engines has a value: what neither has parts nobody.
int onlyOneHas(const Case& setup, const std::vector<FlowRun>& runs, const EndpointRow& row) {
  const auto valuesOf = [&](const std::string& engine, const std::string& surrogate) {
    return endpointByPacking(endpointSpec(setup, row.endpoint), setup,
                             finishedRuns(runs, surrogate.empty() ? engine : surrogate),
                             packingsOf(runs));
  };
  const Numbers ours = valuesOf(row.a, row.surrogateA), theirs = valuesOf(row.b, row.surrogateB);
  int count = 0;
  for (std::size_t k = 0; k < ours.size(); ++k)
    count += ours[k].has_value() != theirs[k].has_value();
  return count;
}

void addFarEndpoints(const Case& setup, const std::vector<FlowRun>& runs,
                     const std::vector<EndpointRow>& rows, std::vector<AlarmRow>& alarms) {
  for (const EndpointRow& row : rows) {
    const std::string words(endpointSpec(setup, row.endpoint).words);
    const auto alarm = [&](std::string what) {
      alarms.push_back({row.a, row.b, row.kind, std::move(what)});
    };
    if (row.kind == PairKind::closedForm) continue;  // what is missing or far off is its answer
    if (row.lost > row.packings && onlyOneHas(setup, runs, row) > row.packings)
      alarm(fmt::format("{} is missing on {} of {} packings", words, row.lost,
                        row.lost + row.packings));
    else if (row.distance && std::abs(*row.distance) > farMargins && row.verdict != Verdict::fail)
      alarm(fmt::format("{} is {:.0f} margins off, which {} packing{} cannot prove", words,
                        std::abs(*row.distance), row.packings, row.packings == 1 ? "" : "s"));
  }
}

/// Fraction of the disks' area that is in the cell, mean over packings.
std::optional<double> filled(const Case& setup, const CompareResults& results,
                             const std::string& engine) {
  Numbers values;
  for (const FlowRun* run : finishedRuns(results.runs, engine))
    values.push_back(cellMean(setup, *run, "volume_fraction"));
  const auto mean = ensembleMean(values);
  return mean ? std::optional(mean->mean) : std::nullopt;
}

}  // namespace

std::vector<AlarmRow> alarmsOf(const Case& setup, const CompareResults& results,
                               const std::vector<EndpointRow>& rows) {
  std::vector<AlarmRow> alarms;
  addFarEndpoints(setup, results.runs, rows, alarms);
  for (const RegimesOfPair& pair : results.regimes) {
    if (2 * static_cast<int>(pair.differ.size()) > pair.packings)
      alarms.push_back(
          {pair.a, pair.b, pair.kind,
           fmt::format("another regime on {} of {} packings", pair.differ.size(), pair.packings)});
    if (setup.average) continue;  // its bins may fill and empty
    const auto ours = filled(setup, results, pair.a), theirs = filled(setup, results, pair.b);
    if (ours && theirs && *theirs < (1.0 - goneFraction) * *ours)
      alarms.push_back({pair.a, pair.b, pair.kind,
                        fmt::format("{:.0f} % of the disks are gone from the cell",
                                    100.0 * (1.0 - *theirs / *ours))});
  }
  return alarms;
}

}  // namespace crossgrain::inline studies

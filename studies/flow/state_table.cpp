#include "studies/flow/state_table.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "averaging/agreement.hpp"
#include "averaging/statistics.hpp"
#include "averaging/trend.hpp"
#include "studies/flow/paired_rings.hpp"
#include "studies/flow/state.hpp"

namespace crossgrain::inline studies {

namespace {

constexpr int packingsForAMean = 4;

std::map<int, Regime> regimesByPacking(std::span<const FlowRun> runs, const std::string& engine,
                                       const std::string& without) {
  std::map<int, Regime> regimes;
  for (const FlowRun* run : finishedRuns(runs, engine, without))
    if (run->regime && run->regime->regime) regimes[run->packing] = *run->regime->regime;
  return regimes;
}

/// What one run says of one series, or null.
const RelativeDrift* driftOf(const FlowRun& run, const std::string& quantity) {
  const auto found = std::ranges::find(run.steadiness, quantity, &SeriesDrift::quantity);
  return found == run.steadiness.end() ? nullptr : &found->drift;
}

RelativeDrift overPackings(const std::vector<std::optional<double>>& changes, double confidence) {
  RelativeDrift result;
  const auto mean = ensembleMean(changes);
  if (!mean || !mean->standardError) return result;
  result.change = mean->mean;
  result.half = studentQuantile(confidence, mean->packings - 1) * *mean->standardError;
  result.excluded = std::abs(*result.change) + *result.half;
  if (std::abs(*result.change) > *result.half)
    result.verdict = Drift::drifts;
  else if (*result.excluded <= largestUnseenDrift)
    result.verdict = Drift::notSeen;
  return result;
}

/// The same answer of all runs, in the same direction, with the least certain run's numbers.
RelativeDrift ofAllRuns(const std::vector<RelativeDrift>& drifts) {
  const RelativeDrift& first = drifts.front();
  const bool alike = std::ranges::all_of(drifts, [&](const RelativeDrift& drift) {
    return drift.verdict == first.verdict &&
           (drift.verdict != Drift::drifts || (drift.change < 0.0) == (first.change < 0.0));
  });
  RelativeDrift result = *std::ranges::max_element(
      drifts, {}, [](const RelativeDrift& drift) { return drift.half.value_or(0.0); });
  result.verdict = alike ? first.verdict : Drift::cannotTell;
  return result;
}

}  // namespace

std::vector<RegimesOfPair> regimesOf(std::span<const FlowRun> runs,
                                     const std::vector<ComparedPair>& pairs) {
  std::vector<RegimesOfPair> table;
  for (const ComparedPair& pair : pairs) {
    const auto ours = regimesByPacking(runs, pair.reference, "");
    const auto theirs = regimesByPacking(runs, pair.other, pair.without);
    RegimesOfPair row{pair.reference, pair.other, pair.kind, 0, {}};
    for (const auto& [packing, regime] : ours) {
      const auto other = theirs.find(packing);
      if (other == theirs.end()) continue;
      ++row.packings;
      if (other->second != regime) row.differ.push_back(packing);
    }
    if (row.packings > 0) table.push_back(std::move(row));
  }
  return table;
}

std::vector<EngineDrift> steadinessOf(std::span<const FlowRun> runs,
                                      const std::vector<std::string>& engines, double confidence) {
  std::vector<EngineDrift> table;
  const double shared = 1.0 - (1.0 - confidence) / static_cast<double>(std::size(watchedSeries));
  for (const std::string& engine : engines) {
    const Runs finished = finishedRuns(runs, engine);
    for (const char* quantity : watchedSeries) {
      EngineDrift row;
      row.engine = engine;
      row.quantity = quantity;
      std::vector<RelativeDrift> drifts;
      Numbers changes;
      for (const FlowRun* run : finished) {
        const RelativeDrift* drift = driftOf(*run, quantity);
        if (!drift) continue;
        drifts.push_back(*drift);
        changes.push_back(drift->change);
        if (drift->verdict == Drift::drifts) row.drifting.push_back(run->packing);
      }
      if (drifts.empty()) continue;
      const auto known =
          std::ranges::count_if(changes, [](const auto& c) { return c.has_value(); });
      row.drift = known >= packingsForAMean ? overPackings(changes, shared) : ofAllRuns(drifts);
      row.packings = static_cast<int>(drifts.size());
      table.push_back(std::move(row));
    }
  }
  return table;
}

}  // namespace crossgrain::inline studies

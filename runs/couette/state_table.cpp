#include "runs/couette/state_table.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "averaging/agreement.hpp"
#include "averaging/statistics.hpp"
#include "averaging/trend.hpp"
#include "runs/common/records.hpp"
#include "runs/couette/paired_rings.hpp"
#include "runs/couette/state.hpp"

namespace crossgrain::inline runs {

using nlohmann::json;

namespace {

constexpr int packingsForAMean = 4;

std::map<int, std::string> regimesByPacking(const json& runs, const std::string& engine,
                                            const std::string& without) {
  std::map<int, std::string> regimes;
  for (const json* run : finishedRuns(runs, engine, without))
    if (const json name = run->value("regime", json::object()).value("name", json());
        name.is_string())
      regimes[(*run)["packing"]] = name;
  return regimes;
}

/// What one run says of one series, or null.
json rowOf(const json& run, const char* quantity) {
  for (const json& row : run.value("steadiness", json::array()))
    if (row["quantity"] == quantity) return row;
  return nullptr;
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
RelativeDrift ofAllRuns(const std::vector<json>& rows) {
  const auto same = [&](const json& row) {
    if (row["verdict"] != rows.front()["verdict"]) return false;
    return row["verdict"] != toString(Drift::drifts) ||
           (row["change"] < 0.0) == (rows.front()["change"] < 0.0);
  };
  RelativeDrift result;
  const auto worst = std::ranges::max_element(
      rows, {}, [](const json& row) { return optionalNumber(row["half_width"]).value_or(0.0); });
  result.change = optionalNumber((*worst)["change"]);
  result.half = optionalNumber((*worst)["half_width"]);
  result.excluded = optionalNumber((*worst)["excluded"]);
  if (!std::ranges::all_of(rows, same)) return result;
  for (const Drift verdict : {Drift::drifts, Drift::notSeen})
    if (rows.front()["verdict"] == toString(verdict)) result.verdict = verdict;
  return result;
}

}  // namespace

json regimesOf(const json& runs, const std::vector<ComparedPair>& pairs) {
  json table = json::array();
  for (const ComparedPair& pair : pairs) {
    const auto ours = regimesByPacking(runs, pair.reference, "");
    const auto theirs = regimesByPacking(runs, pair.other, pair.without);
    json differ = json::array();
    int packings = 0;
    for (const auto& [packing, regime] : ours) {
      const auto other = theirs.find(packing);
      if (other == theirs.end()) continue;
      ++packings;
      if (other->second != regime) differ.push_back(packing);
    }
    if (packings > 0)
      table.push_back({{"a", pair.reference},
                       {"b", pair.other},
                       {"kind", pair.kind},
                       {"packings", packings},
                       {"differ", differ}});
  }
  return table;
}

json steadinessOf(const json& runs, const std::vector<std::string>& engines, double confidence) {
  json table = json::array();
  const double shared = 1.0 - (1.0 - confidence) / static_cast<double>(std::size(watchedSeries));
  for (const std::string& engine : engines) {
    const auto finished = finishedRuns(runs, engine);
    for (const char* quantity : watchedSeries) {
      std::vector<json> rows;
      std::vector<std::optional<double>> changes;
      json drifting = json::array();
      for (const json* run : finished) {
        const json row = rowOf(*run, quantity);
        if (row.is_null()) continue;
        rows.push_back(row);
        changes.push_back(optionalNumber(row["change"]));
        if (row["verdict"] == toString(Drift::drifts)) drifting.push_back((*run)["packing"]);
      }
      if (rows.empty()) continue;
      const auto known =
          std::ranges::count_if(changes, [](const auto& c) { return c.has_value(); });
      const RelativeDrift drift =
          known >= packingsForAMean ? overPackings(changes, shared) : ofAllRuns(rows);
      table.push_back({{"engine", engine},
                       {"quantity", quantity},
                       {"verdict", toString(drift.verdict)},
                       {"change", toJson(drift.change)},
                       {"half_width", toJson(drift.half)},
                       {"excluded", toJson(drift.excluded)},
                       {"packings", rows.size()},
                       {"drifting", drifting}});
    }
  }
  return table;
}

}  // namespace crossgrain::inline runs

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <set>

#include "reports/common/labels.hpp"
#include "reports/common/numbers.hpp"
#include "reports/couette/compare_views.hpp"
#include "reports/couette/engine_cost.hpp"

namespace crossgrain::reports {

namespace {

using Engines = std::vector<EngineRuns>;
using Cell = std::function<std::string(const EngineRuns&)>;

Json tableRow(const std::string& label, const std::string& unit, const Engines& engines,
              const Cell& cell) {
  Json cells = Json::array();
  for (const EngineRuns& engine : engines) cells.push_back(cell(engine));
  return {{"label", label}, {"unit", unit == "-" ? "" : unit}, {"cells", std::move(cells)}};
}

Json group(const std::string& title, const Engines& engines, Json rows) {
  return {{"title", title}, {"span", engines.size() + 2}, {"rows", std::move(rows)}};
}

Cell fromRealised(std::string Realised::*member) {
  return [member](const EngineRuns& engine) {
    const Realised* realised = engine.realised();
    return !realised || (realised->*member).empty() ? std::string(absentText)
                                                    : spaced(realised->*member);
  };
}

std::string statusOf(const EngineRuns& engine) {
  if (engine.runs.empty()) return std::string(nameOf(engine.status));
  return fmt::format("{} of {}", engine.finished.size(), engine.runs.size());
}

Json whatRan(const Engines& engines) {
  Json rows = Json::array();
  rows.push_back(
      tableRow("version", "", engines, [](const EngineRuns& engine) { return engine.version; }));
  if (std::ranges::any_of(engines, [](const auto& e) { return !e.mirrors.empty(); }))
    rows.push_back(
        tableRow("mirrors", "", engines, [](const EngineRuns& engine) { return engine.mirrors; }));
  rows.push_back(tableRow("runs finished", "", engines, statusOf));
  if (std::ranges::any_of(engines, [](const auto& e) { return !e.surrogate.empty(); }))
    rows.push_back(tableRow("verdicts rest on the runs of", "", engines, [](const auto& engine) {
      return engine.surrogate.empty() ? engine.name : engine.surrogate;
    }));
  rows.push_back(tableRow("precision", "", engines, fromRealised(&Realised::precision)));
  rows.push_back(tableRow("integrator", "", engines, fromRealised(&Realised::integrator)));
  return rows;
}

const HeadNumber* headOf(const EngineRuns& engine, const std::string& name) {
  const auto found = std::ranges::find(engine.head(), name, &HeadNumber::name);
  return found == engine.head().end() ? nullptr : &*found;
}

Json headRow(const std::string& name, const Engines& engines) {
  std::string unit;
  for (const EngineRuns& engine : engines)
    if (const HeadNumber* number = headOf(engine, name); number && unit.empty())
      unit = number->unit;
  return tableRow(headLabel(name), unit, engines, [&name](const EngineRuns& engine) {
    const HeadNumber* number = headOf(engine, name);
    return number ? readable(number->value, number->standardError) : std::string(absentText);
  });
}

/// Counters that engines keep of their own, summed over finished runs.
Json counterRows(const Engines& engines) {
  std::set<std::string> names;
  for (const EngineRuns& engine : engines)
    for (const CouetteRun* run : engine.finished)
      if (run->stats)
        for (const auto& [name, value] : run->stats->counters) names.insert(name);
  Json rows = Json::array();
  for (const std::string& name : names)
    rows.push_back(tableRow(headLabel(name), "", engines, [&name](const EngineRuns& engine) {
      std::optional<double> sum;
      for (const CouetteRun* run : engine.finished) {
        if (!run->stats) continue;
        const auto counter = run->stats->counters.find(name);
        const auto value =
            counter == run->stats->counters.end() ? std::nullopt : finite(counter->second);
        if (value) sum = sum.value_or(0.0) + *value;
      }
      return readableCount(sum);
    }));
  return rows;
}

constexpr const char* stepFraction = "dt_over_tc";

Json costRows(const Engines& engines) {
  Json rows = Json::array();
  rows.push_back(tableRow("time step dt", "s", engines, [](const EngineRuns& engine) {
    return engine.realised() ? readableSetting(engine.realised()->dt) : std::string(absentText);
  }));
  rows.push_back(headRow(stepFraction, engines));
  rows.push_back(
      tableRow("steps", "", engines, [](const auto& e) { return readableCount(costOf(e).steps); }));
  rows.push_back(tableRow("wall time", "", engines,
                          [](const auto& e) { return readableDuration(costOf(e).wall); }));
  rows.push_back(tableRow("CPU time", "", engines,
                          [](const auto& e) { return readableDuration(costOf(e).cpu); }));
  rows.push_back(tableRow("wall time per step", "µs", engines, [](const EngineRuns& engine) {
    const EngineCost cost = costOf(engine);
    const auto perStep = quotient(cost.wall, cost.steps);
    return readable(perStep ? std::optional(*perStep * 1e6) : std::nullopt);
  }));
  rows.push_back(
      tableRow("CPU time per simulated second", "s", engines,
               [](const EngineRuns& engine) { return readable(costOf(engine).cpuPerSecond()); }));
  for (Json& row : counterRows(engines)) rows.push_back(std::move(row));
  return rows;
}

Json stateRows(const Engines& engines) {
  std::vector<std::string> names;
  for (const EngineRuns& engine : engines)
    for (const HeadNumber& number : engine.head())
      if (number.name != stepFraction && std::ranges::find(names, number.name) == names.end())
        names.push_back(number.name);
  Json rows = Json::array();
  for (const std::string& name : names) rows.push_back(headRow(name, engines));
  return rows;
}

}  // namespace

void addEngineTable(Json& view, const Engines& engines) {
  view["engineGroups"] = Json::array({group("What ran", engines, whatRan(engines)),
                                      group("Cost", engines, costRows(engines)),
                                      group("State", engines, stateRows(engines))});
  view["costNote"] =
      "Cost: of the finished runs together, of stepping alone. State: means over the averaged "
      "time, with ± one standard error over packings where there are several, whatever their "
      "regime.";
}

void addStateTable(Json& view, const Engines& engines) {
  view["engineGroups"] = Json::array({group("State", engines, stateRows(engines))});
  view["hasState"] = !view["engineGroups"][0]["rows"].empty();
  view["costNote"] = "Means over the snapshots.";
}

void addTroubles(Json& view, const Engines& engines) {
  Json rows = Json::array();
  for (const EngineRuns& engine : engines) {
    if (engine.status != EngineStatus::ran)
      rows.push_back({{"engine", engine.name},
                      {"packing", "all"},
                      {"status", nameOf(engine.status)},
                      {"reason", engine.reason}});
    for (const CouetteRun* run : engine.runs)
      if (!run->finished())
        rows.push_back({{"engine", engine.name},
                        {"packing", readableCount(run->packing)},
                        {"status", nameOf(run->status)},
                        {"reason", run->reason}});
  }
  view["troubles"] = std::move(rows);
  view["hasTroubles"] = !view["troubles"].empty();
}

}  // namespace crossgrain::reports

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <set>

#include "reports/common/labels.hpp"
#include "reports/common/numbers.hpp"
#include "reports/couette/compare_views.hpp"

namespace crossgrain::reports {

namespace {

using Engines = std::vector<EngineResults>;
using Cell = std::function<std::string(const EngineResults&)>;

/// Sums over an engine's finished runs.
struct Cost {
  std::optional<double> steps, wall, cpu, simulated;  ///< [-], [s], [s], [s]
};

void addTo(std::optional<double>& sum, std::optional<double> value) {
  if (value) sum = sum.value_or(0.0) + *value;
}

Cost costOf(const EngineResults& engine) {
  Cost cost;
  for (const Json* run : engine.finished) {
    const Json& stats = member(*run, "stats");
    const auto steps = number(stats, "steps"), dt = number(member(*run, "realised"), "dt");
    addTo(cost.steps, steps);
    addTo(cost.wall, number(stats, "wall_s"));
    addTo(cost.cpu, number(stats, "cpu_s"));
    if (steps && dt) addTo(cost.simulated, *steps * *dt);
  }
  return cost;
}

std::optional<double> quotient(std::optional<double> a, std::optional<double> b) {
  if (!a || !b || *b == 0.0) return std::nullopt;
  return *a / *b;
}

Json tableRow(const std::string& label, const std::string& unit, const Engines& engines,
              const Cell& cell) {
  Json cells = Json::array();
  for (const EngineResults& engine : engines) cells.push_back(cell(engine));
  return {{"label", label}, {"unit", unit == "-" ? "" : unit}, {"cells", std::move(cells)}};
}

Json group(const std::string& title, const Engines& engines, Json rows) {
  return {
      {"title", title}, {"span", std::to_string(engines.size() + 2)}, {"rows", std::move(rows)}};
}

Cell fromRealised(const char* key) {
  return [key](const EngineResults& engine) {
    const std::string value = text(engine.realised(), key);
    return value.empty() ? std::string(absentText) : spaced(value);
  };
}

std::string statusOf(const EngineResults& engine) {
  if (engine.runs.empty()) return engine.status;
  return fmt::format("{} of {}", engine.finished.size(), engine.runs.size());
}

Json whatRan(const Engines& engines) {
  Json rows = Json::array();
  rows.push_back(tableRow("version", "", engines, [](const EngineResults& engine) {
    return text(*engine.entry, "version");
  }));
  if (std::ranges::any_of(engines, [](const auto& e) { return !e.mirrors.empty(); }))
    rows.push_back(tableRow("mirrors", "", engines,
                            [](const EngineResults& engine) { return engine.mirrors; }));
  rows.push_back(tableRow("runs finished", "", engines, statusOf));
  rows.push_back(tableRow("precision", "", engines, fromRealised("precision")));
  rows.push_back(tableRow("integrator", "", engines, fromRealised("integrator")));
  return rows;
}

const Json& headOf(const EngineResults& engine, const std::string& name) {
  return findByText(engine.averages(), "head", "name", name);
}

Json headRow(const std::string& name, const Engines& engines) {
  std::string unit;
  for (const EngineResults& engine : engines)
    if (unit.empty()) unit = text(headOf(engine, name), "unit");
  return tableRow(headLabel(name), unit, engines, [&name](const EngineResults& engine) {
    const Json& entry = headOf(engine, name);
    return readable(number(entry, "value"), number(entry, "stderr"));
  });
}

/// Counters that engines keep of their own, summed over finished runs.
Json counterRows(const Engines& engines) {
  std::set<std::string> names;
  for (const EngineResults& engine : engines)
    for (const Json* run : engine.finished)
      for (const auto& [name, value] : member(member(*run, "stats"), "counters").items())
        names.insert(name);
  Json rows = Json::array();
  for (const std::string& name : names)
    rows.push_back(tableRow(headLabel(name), "", engines, [&name](const EngineResults& engine) {
      std::optional<double> sum;
      for (const Json* run : engine.finished)
        addTo(sum, number(member(member(*run, "stats"), "counters"), name));
      return readableCount(sum);
    }));
  return rows;
}

constexpr const char* stepShare = "dt_over_tc";

Json costRows(const Engines& engines) {
  Json rows = Json::array();
  rows.push_back(tableRow("time step dt", "s", engines, [](const EngineResults& engine) {
    return readableSetting(number(engine.realised(), "dt"));
  }));
  rows.push_back(headRow(stepShare, engines));
  rows.push_back(
      tableRow("steps", "", engines, [](const auto& e) { return readableCount(costOf(e).steps); }));
  rows.push_back(tableRow("wall time", "", engines,
                          [](const auto& e) { return readableDuration(costOf(e).wall); }));
  rows.push_back(tableRow("CPU time", "", engines,
                          [](const auto& e) { return readableDuration(costOf(e).cpu); }));
  rows.push_back(tableRow("wall time per step", "µs", engines, [](const EngineResults& engine) {
    const Cost cost = costOf(engine);
    const auto perStep = quotient(cost.wall, cost.steps);
    return readable(perStep ? std::optional(*perStep * 1e6) : std::nullopt);
  }));
  rows.push_back(
      tableRow("CPU time per simulated second", "s", engines, [](const EngineResults& engine) {
        const Cost cost = costOf(engine);
        return readable(quotient(cost.cpu, cost.simulated));
      }));
  for (Json& row : counterRows(engines)) rows.push_back(std::move(row));
  return rows;
}

Json stateRows(const Engines& engines) {
  std::vector<std::string> names;
  for (const EngineResults& engine : engines)
    for (const Json& entry : list(engine.averages(), "head"))
      if (const std::string name = text(entry, "name");
          name != stepShare && std::ranges::find(names, name) == names.end())
        names.push_back(name);
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
  for (const EngineResults& engine : engines) {
    if (engine.status != "ran")
      rows.push_back({{"engine", engine.name},
                      {"packing", "all"},
                      {"status", engine.status},
                      {"reason", text(*engine.entry, "reason")}});
    for (const Json* run : engine.runs)
      if (text(*run, "status") != "finished")
        rows.push_back({{"engine", engine.name},
                        {"packing", readableCount(number(*run, "packing"))},
                        {"status", text(*run, "status")},
                        {"reason", text(*run, "reason")}});
  }
  view["troubles"] = std::move(rows);
  view["hasTroubles"] = !view["troubles"].empty();
}

}  // namespace crossgrain::reports

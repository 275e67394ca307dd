#include "reports/flow/engine_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <set>

#include "reports/common/labels.hpp"
#include "reports/common/numbers.hpp"
#include "reports/common/sentences.hpp"
#include "results/json_fields.hpp"

namespace crossgrain::reports {

namespace {

using Engines = std::vector<EngineRuns>;
using Rows = std::vector<TableRow>;
using Names = std::vector<std::string>;
using Text = std::function<std::string(const EngineRuns&)>;

TableRow tableRow(const std::string& label, const std::string& unit, const Engines& engines,
                  const Text& text) {
  TableRow row{{label}};
  for (const EngineRuns& engine : engines) row.cells.emplace_back(text(engine));
  row.cells.emplace_back(unit == "-" ? "" : unit);
  return row;
}

/// Adds rows under a heading.
void addGroup(Table& table, const std::string& title, Rows rows) {
  if (!rows.empty()) rows.front().group = title;
  for (TableRow& row : rows) table.rows.push_back(std::move(row));
}

Table emptyTable(const Engines& engines) {
  Table table{engineColumns({""}, engines), {}};
  table.columns.emplace_back("unit");
  return table;
}

Text fromEffective(std::string EffectiveParameters::*member) {
  return [member](const EngineRuns& engine) {
    const EffectiveParameters* effective = engine.effective();
    return !effective || (effective->*member).empty() ? std::string(absentText)
                                                      : spaced(effective->*member);
  };
}

std::string statusOf(const EngineRuns& engine) {
  if (engine.runs.empty()) return std::string(nameOf(engine.status, engineStatusNames));
  return fmt::format("{} of {}", engine.finished.size(), engine.runs.size());
}

Rows whatRan(const Engines& engines) {
  Rows rows;
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
  rows.push_back(
      tableRow("precision", "", engines, fromEffective(&EffectiveParameters::precision)));
  rows.push_back(
      tableRow("integrator", "", engines, fromEffective(&EffectiveParameters::integrator)));
  return rows;
}

const HeadNumber* headOf(const EngineRuns& engine, const std::string& name) {
  const auto found = std::ranges::find(engine.head(), name, &HeadNumber::name);
  return found == engine.head().end() ? nullptr : &*found;
}

TableRow headRow(const std::string& name, const Engines& engines) {
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
Rows counterRows(const Engines& engines) {
  std::set<std::string> names;
  for (const EngineRuns& engine : engines)
    for (const FlowRun* run : engine.finished)
      if (run->stats)
        for (const auto& [name, value] : run->stats->counters) names.insert(name);
  Rows rows;
  for (const std::string& name : names)
    rows.push_back(tableRow(headLabel(name), "", engines, [&name](const EngineRuns& engine) {
      std::optional<double> sum;
      for (const FlowRun* run : engine.finished) {
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

Rows costRows(const Engines& engines) {
  Rows rows;
  rows.push_back(tableRow("time step dt", "s", engines, [](const EngineRuns& engine) {
    return engine.effective() ? readableSetting(engine.effective()->dt) : std::string(absentText);
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
    return readable(times(quotient(cost.wall, cost.steps), 1e6));
  }));
  rows.push_back(
      tableRow("CPU time per simulated second", "s", engines,
               [](const EngineRuns& engine) { return readable(costOf(engine).cpuPerSecond()); }));
  for (TableRow& row : counterRows(engines)) rows.push_back(std::move(row));
  return rows;
}

Rows stateRows(const Engines& engines) {
  std::vector<std::string> names;
  for (const EngineRuns& engine : engines)
    for (const HeadNumber& number : engine.head())
      if (number.name != stepFraction && std::ranges::find(names, number.name) == names.end())
        names.push_back(number.name);
  Rows rows;
  for (const std::string& name : names) rows.push_back(headRow(name, engines));
  return rows;
}

/// Engines and runs that did not run to the end.
Table troubleTable(const Engines& engines) {
  Table table{
      {{"engine", Column::Kind::engines}, "packing", "status", {"reason", Column::Kind::remark}},
      {}};
  for (const EngineRuns& engine : engines) {
    if (engine.status != Status::finished)
      table.rows.push_back(
          {{engine.name, "all", std::string(nameOf(engine.status, engineStatusNames)),
            engine.reason}});
    for (const FlowRun* run : engine.runs)
      if (!run->finished())
        table.rows.push_back({{engine.name, readableCount(run->packing),
                               std::string(nameOf(run->status, runStatusNames)), run->reason}});
  }
  return table;
}

/// "10 slabs of width 0.01 m along y", "1 bin"
std::string binsInWords(const FlowFrame& frame) {
  const RegionRow& region = *frame.region;
  const std::size_t bins = frame.rings.r.size();
  if (region.bins == "whole") return "The whole box as one bin";
  if (region.bins == "grid") return fmt::format("A grid of {} bins", bins);
  return fmt::format("{} {} of width {} m{}", bins, region.bins, readable(frame.rings.width),
                     region.along.empty() ? "" : " along " + region.along);
}

/// "20 snapshots a run", "20 snapshots a run, 9 to 21 of mine": files have their own.
std::string snapshotsInWords(const FlowFrame& frame, const Engines& engines) {
  const auto ofFiles = [](const EngineRuns& engine) {
    return !engine.finished.empty() && engine.finished.front()->ofFiles() &&
           !engine.snapshots().empty();
  };
  Names others;
  for (const EngineRuns& engine : engines)
    if (ofFiles(engine)) others.push_back(fmt::format("{} of {}", engine.snapshots(), engine.name));
  if (engines.size() == 1 && engines.front().snapshots().find(' ') == std::string::npos)
    others.clear();  // what was averaged alone has its number in the study
  const bool files = !others.empty() && std::ranges::all_of(engines, ofFiles);
  if (files) return "snapshots a run: " + listed(others);
  const std::string words = fmt::format(
      "{} snapshots a run", readableCount(static_cast<double>(frame.averaging.snapshots)));
  return others.empty() ? words : fmt::format("{}, {}", words, listed(others));
}

}  // namespace

void addEngineTable(Blocks& blocks, const Engines& engines) {
  Table table = emptyTable(engines);
  addGroup(table, "What ran", whatRan(engines));
  addGroup(table, "Cost", costRows(engines));
  addGroup(table, "State", stateRows(engines));
  table.note =
      "Cost: of the finished runs together, of stepping alone. State: means over the averaged "
      "time, with ± one standard error over packings where there are several, whatever their "
      "regime.";
  blocks.push_back(std::move(table));
  if (Table troubles = troubleTable(engines); !troubles.rows.empty()) {
    blocks.push_back(Heading{"What did not run"});
    blocks.push_back(std::move(troubles));
  }
}

Table stateTable(const Engines& engines) {
  Table table = emptyTable(engines);
  addGroup(table, "State", stateRows(engines));
  table.note = "Means over the snapshots.";
  return table;
}

std::string describeAverages(const FlowFrame& frame, const Engines& engines) {
  const std::string snapshots = snapshotsInWords(frame, engines);
  if (frame.region)
    return fmt::format("{}, weights by {}, {}, {} to {} s after the start.", binsInWords(frame),
                       frame.averaging.method, snapshots, readableSetting(frame.region->from),
                       readableSetting(frame.region->to));
  const std::string when = averagedRotations(frame.averaging);
  return fmt::format("{} rings of width {} m, weights by {}, {}{}.", frame.rings.r.size(),
                     readable(frame.rings.width), frame.averaging.method, snapshots,
                     when.empty() ? std::string() : ", " + when);
}

std::vector<EffectiveScene> effectiveOf(const FlowFrame& frame,
                                        const std::vector<EngineRuns>& engines) {
  std::vector<EffectiveScene> effective;
  for (const EngineRuns& engine : engines)
    if (engine.effective()) effective.push_back({engine.name, engine.effective(), &frame.effects});
  return effective;
}

}  // namespace crossgrain::reports

#include <fmt/format.h>

#include <algorithm>

#include "cases/bad_input.hpp"
#include "cases/effect_switch.hpp"
#include "cases/loader.hpp"
#include "cli/commands.hpp"
#include "reports/report.hpp"
#include "runs/average.hpp"
#include "runs/compare.hpp"
#include "runs/effects.hpp"
#include "runs/rev.hpp"

namespace crossgrain {

namespace fs = std::filesystem;
using nlohmann::json;

Case onlyCase(const CommandLine& line, const char* command) {
  if (line.inputs.size() != 1)
    throw BadInput(fmt::format("{} takes one case file, not {}", command, line.inputs.size()));
  const fs::path& file = line.inputs.front();
  const std::vector<Case> cases = loadCase(file, line.overrides);
  if (cases.front().kind != CaseKind::couette)
    throw BadInput(fmt::format("{}: {} cannot run a case of this kind", file.string(), command));
  if (cases.size() > 1)
    throw BadInput(fmt::format("{}: {} takes a case without variants", file.string(), command));
  if (!line.quick) return cases.front();
  std::vector<std::string> overrides = {
      "preparation.packings=2", "preparation.rotations=0.1", "averaging.settle_rotations=0.02",
      "averaging.rotations=0.1", "averaging.snapshots_per_rotation=400"};
  overrides.insert(overrides.end(), line.overrides.begin(), line.overrides.end());
  return loadCase(file, overrides).front();
}

namespace {

int countOf(const json& list, const char* key, const std::string& value) {
  return static_cast<int>(
      std::ranges::count_if(list, [&](const json& row) { return row.value(key, "") == value; }));
}

/// Only the verdicts between engines that the user named decide the exit status.
json peerRows(const json& results) {
  json rows = json::array();
  for (const json& row : results["agreement"])
    if (row["kind"] == "peer") rows.push_back(row);
  return rows;
}

/// One line on standard error for each run, or leg, that failed.
void printFailures(const json& rows) {
  for (const json& row : rows)
    if (row["status"] == "failed")
      fmt::print(stderr, "crossgrain: {}\n", row["reason"].get<std::string>());
}

/// What the commands that only average leave and print.
int averaged(const CommandLine& line, const json& results) {
  writeReport(results, line.run.out);
  if (line.json)
    fmt::print("{}\n", (line.run.out / "results.json").string());
  else
    fmt::print("{} snapshots averaged\nreport: {}\n", results["averaging"]["snapshots"].get<int>(),
               (line.run.out / "report.html").string());
  return exitHeld;
}

}  // namespace

int compare(const CommandLine& line) {
  const Case setup = onlyCase(line, "compare");
  const json results = compareEngines(setup, line.run);
  writeReport(results, line.run.out);

  const json rows = peerRows(results);
  const int agree = countOf(rows, "verdict", "agree");
  const int disagree = countOf(rows, "verdict", "disagree");
  const int undecided = countOf(rows, "verdict", "undecided");
  const int failed = countOf(results["runs"], "status", "failed");
  if (line.json)
    fmt::print("{}\n", (line.run.out / "results.json").string());
  else {
    fmt::print("{}\n", effectsInWords(effectsOf(setup)));
    for (const json& row : rows)
      if (row["a"] == results["engines"][0]["name"])
        fmt::print("{:<16} {:<22} {}\n", row["b"].get<std::string>(),
                   row["field"].get<std::string>(), row["verdict"].get<std::string>());
    fmt::print("{} agree, {} disagree, {} undecided; {} of {} runs failed\nreport: {}\n", agree,
               disagree, undecided, failed, results["runs"].size(),
               (line.run.out / "report.html").string());
  }
  printFailures(results["runs"]);
  if (failed > 0) return exitEngineFailed;
  if (disagree > 0 || (line.strict && undecided > 0)) return exitFellShort;
  return exitHeld;
}

int average(const CommandLine& line) {
  const Case setup = onlyCase(line, "average");
  return averaged(line, averageSnapshots(setup, line.snapshots, line.run.commandLine));
}

int rev(const CommandLine& line) {
  const Case setup = onlyCase(line, "rev");
  return averaged(line, revStudy(setup, line.snapshots, line.run.commandLine, line.run.quiet));
}

namespace {

/// "grain  without friction  0.583 ± 0.012 of the time per step, 21 of 42 rings changed"
void printLeg(const json& leg) {
  const std::string engine = leg["engine"];
  if (leg["effect"] == "") return;
  const std::string name = leg["effect"];
  if (leg["status"] != "ran") {
    fmt::print("{:<16} without {:<22} {}: {}\n", engine, name, leg["status"].get<std::string>(),
               leg["reason"].get<std::string>());
    return;
  }
  int judged = 0, changed = 0;
  for (const json& field : leg["fields"])
    for (const json& ring : field["rings"]) {
      judged += ring["resolved"].is_boolean();
      changed += ring["resolved"] == true;
    }
  fmt::print("{:<16} without {:<22} {:.3f} of the time per step, {}\n", engine, name,
             leg["time_ratio"].is_number() ? leg["time_ratio"].get<double>() : NAN,
             judged == 0 ? "too few packings to tell what changed"
                         : fmt::format("{} of {} rings changed", changed, judged));
}

}  // namespace

int effects(const CommandLine& line) {
  const Case setup = onlyCase(line, "effects");
  TimingPlan plan;
  if (line.quick) plan.seconds = 0.02;
  const json results = measureEffects(setup, line.run, plan);
  writeReport(results, line.run.out);
  if (line.json)
    fmt::print("{}\n", (line.run.out / "results.json").string());
  else {
    fmt::print("{}\n", effectsInWords(effectsOf(setup)));
    for (const json& leg : results["legs"]) printLeg(leg);
    fmt::print("report: {}\n", (line.run.out / "report.html").string());
  }
  printFailures(results["legs"]);
  return countOf(results["legs"], "status", "failed") > 0 ? exitEngineFailed : exitHeld;
}

}  // namespace crossgrain

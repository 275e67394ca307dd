#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <utility>

#include "cases/case_files.hpp"
#include "cli/option_groups.hpp"
#include "cli/outcome.hpp"
#include "reports/report.hpp"
#include "runs/common/engine_access.hpp"
#include "runs/common/resumable.hpp"
#include "runs/stability/stability.hpp"
#include "support/data_folder.hpp"

namespace crossgrain::inline cli {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

void printVerdict(const json& row) {
  const std::string variant = row["variant"], reason = row["reason"];
  std::string figure;
  if (row["value"].is_number())
    figure = fmt::format("{} {:.3g} {}, limit {:.3g}", row["measure"].get<std::string>(),
                         row["value"].get<double>(), row["unit"].get<std::string>(),
                         row["limit"].get<double>());
  if (row["step"].is_number()) figure += fmt::format(", step {}", row["step"].get<long long>());
  fmt::print("{:<9} {:<16} {}{}{}: {}{}{}\n", row["verdict"].get<std::string>(),
             row["engine"].get<std::string>(), row["case"].get<std::string>(),
             variant.empty() ? "" : " ", variant, figure,
             figure.empty() || reason.empty() ? "" : "; ", reason);
}

/// One line for each engine and reason: nobody reads forty of them.
void printRefusals(const json& rows) {
  std::map<std::pair<std::string, std::string>, int> count;
  for (const json& row : rows)
    if (row["verdict"] == "refused")
      ++count[{row["engine"].get<std::string>(), row["reason"].get<std::string>()}];
  for (const auto& [what, runs] : count)
    fmt::print("refused   {:<16} {} run{}: {}\n", what.first, runs, runs == 1 ? "" : "s",
               what.second);
}

int stability(const CommandLine& line, SuitePart part) {
  std::vector<fs::path> inputs = line.inputs;
  if (inputs.empty()) inputs.push_back(hereOrInstalled("cases/hard"));
  std::vector<Case> cases = hardCases(inputs, line.overrides, part);
  if (line.only) cases = selectedCases(cases, *line.only);
  RunStore store(line.run, "stability", keysOfEach(cases));
  const std::vector<EngineEntry> engines = selectEngines(line.run.engines);
  if (line.run.dryRun) return told(stabilityPlan(cases, engines, line.run, store));
  const json results = testStability(cases, engines, line.run, store);
  writeReport(results, line.run.out);

  const auto count = [&](const char* verdict) {
    return std::ranges::count_if(results["runs"],
                                 [&](const json& row) { return row["verdict"] == verdict; });
  };
  const auto unstable = count("unstable");
  if (line.json) {
    fmt::print("{}\n", (line.run.out / "results.json").string());
  } else {
    for (const json& row : results["runs"])
      if (row["verdict"] != "stable" && row["verdict"] != "refused") printVerdict(row);
    printRefusals(results["runs"]);
    fmt::print("{} stable, {} degraded, {} unstable, {} refused\nreport: {}\n", count("stable"),
               count("degraded"), unstable, count("refused"),
               (line.run.out / "report.html").string());
  }
  if (count("refused") == static_cast<std::ptrdiff_t>(results["runs"].size()))
    return nothingWasJudged(line, fmt::format("all runs were refused, the first because it {}",
                                              results["runs"][0]["reason"].get<std::string>()));
  return unstable > 0 ? exitFellShort : exitHeld;
}

Action declare(CLI::App& app, CommandLine& line) {
  const auto longCases = std::make_shared<bool>(false);
  addInputs(app, line, "case", "case files or folders of them (default: cases/hard)", 0, anyNumber);
  addSelection(app, line);
  addRun(app, line);
  addFlag(app, "--quick", line.quick, "only cases marked as quick");
  addFlag(app, "--long", *longCases, "also cases marked as long");
  excludeEachOther(app, "--quick", "--long");
  return [&line, longCases] {
    const SuitePart part = line.quick   ? SuitePart::quick
                           : *longCases ? SuitePart::withLong
                                        : SuitePart::usual;
    return resumably(line.run, [&] { return stability(line, part); });
  };
}

}  // namespace

extern const Command stabilityCommand = {
    "stability", "hard cases: what stays stable on which engine, and what does not",
    "crossgrain stability --engines all --out out              # all of cases/hard\n"
    "crossgrain stability -k pile --engines grain --out out\n"
    "crossgrain stability cases/hard/pile.toml --engines grain,yade --out out",
    declare};

}  // namespace crossgrain::inline cli

#include <fmt/format.h>

#include <algorithm>

#include "cli/commands.hpp"
#include "reports/report.hpp"
#include "runs/engine_access.hpp"
#include "runs/stability.hpp"

namespace crossgrain {

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

}  // namespace

int stability(const CommandLine& line) {
  const SuitePart part = line.quick       ? SuitePart::quick
                         : line.longCases ? SuitePart::withLong
                                          : SuitePart::usual;
  std::vector<fs::path> inputs = line.inputs;
  if (inputs.empty()) inputs.emplace_back("cases/hard");
  const std::vector<Case> cases = hardCases(inputs, line.overrides, part);
  const json results = testStability(cases, selectEngines(line.run.engines), line.run);
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
    fmt::print("{} stable, {} degraded, {} unstable, {} refused\nreport: {}\n", count("stable"),
               count("degraded"), unstable, count("refused"),
               (line.run.out / "report.html").string());
  }
  return unstable > 0 ? exitFellShort : exitHeld;
}

}  // namespace crossgrain

#include <fmt/format.h>

#include <memory>

#include "cases/effect_switch.hpp"
#include "cli/one_case.hpp"
#include "cli/option_groups.hpp"
#include "cli/outcome.hpp"
#include "reports/report.hpp"
#include "runs/common/resumable.hpp"
#include "runs/couette/compare.hpp"

namespace crossgrain::inline cli {

using nlohmann::json;

namespace {

/// Only the verdicts between engines that the user named decide the exit status.
json peerRows(const json& results) {
  json rows = json::array();
  for (const json& row : results["agreement"])
    if (row["kind"] == "peer") rows.push_back(row);
  return rows;
}

int compare(const CommandLine& line, bool strict) {
  const Case setup = onlyCase(line, "compare");
  printWarnings(setup);
  RunStore store(line.run, "compare", soleCase(setup));
  if (line.run.dryRun) return told(comparePlan(setup, line.run, store));
  const json results = compareEngines(setup, line.run, store);
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
  int judged = exitHeld;
  if (const json nothing = results.value("nothing_judged", json()); nothing.is_object())
    judged = nothingWasJudged(line, nothing["reason"], nothing["by_request"] == true || line.quick,
                              strict);
  if (failed > 0) return exitEngineFailed;
  if (disagree > 0 || (strict && undecided > 0)) return exitFellShort;
  return judged;
}

Action declare(CLI::App& app, CommandLine& line) {
  const auto strict = std::make_shared<bool>(false);
  addCase(app, line);
  addRun(app, line);
  addPackings(app, line);
  addFlag(app, "--strict", *strict,
          "undecided verdicts count as falling short, and so does nothing judged");
  return [&line, strict] { return resumably(line.run, [&] { return compare(line, *strict); }); };
}

}  // namespace

extern const Command compareCommand = {
    "compare", "run, average, cross-check",
    "crossgrain compare cases/couette/quick.toml --engines grain,yade --out out", declare};

}  // namespace crossgrain::inline cli

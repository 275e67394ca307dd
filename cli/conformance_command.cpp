#include <fmt/format.h>

#include <memory>

#include "cases/engine_file.hpp"
#include "cli/option_groups.hpp"
#include "cli/outcome.hpp"
#include "reports/conformance/report.hpp"
#include "reports/report.hpp"
#include "runs/common/engine_access.hpp"
#include "runs/common/mirrors.hpp"
#include "runs/conformance/conformance.hpp"
#include "support/bad_input.hpp"
#include "support/files.hpp"

namespace crossgrain::inline cli {

namespace {

struct ConformanceOptions {
  std::string engine;
  std::optional<std::string> out;
};

EngineEntry entryOf(const std::string& engine) {
  if (namesEngineFile(engine)) return *findEngine(addStranger(loadEngineFile(engine)));
  if (engine == "all") throw BadInput("conformance takes one engine: a name or an engine file");
  return selectEngines({engine}).front();
}

void print(const ConformanceResults& results) {
  using enum ConformanceOutcome;
  fmt::print("{}\n", reports::conformanceLead(results));
  for (const auto outcome : {brokeDown, failed, skipped})
    for (const ConformanceRow& row : results.rows)
      if (row.outcome == outcome) fmt::print("  {}\n", reports::conformanceSentence(row));
  for (const ConformanceRow& row : results.rows)
    if (row.part == "lockstep" && row.outcome == passed) fmt::print("  {}\n", row.detail);
  for (const std::string& line :
       {reports::conformanceNotExamined(results), reports::conformanceCause(results)})
    if (!line.empty()) fmt::print("{}\n", line);
}

int conformanceOf(const CommandLine& line, const ConformanceOptions& options) {
  using enum ConformanceOutcome;
  const EngineEntry entry = entryOf(options.engine);
  if (options.out) makeDirectory(*options.out);  // before minutes of work that it is to hold
  const ConformanceResults results =
      runConformance({entry, line.only, line.run.quiet, line.run.commandLine});
  if (options.out) writeReport(results, *options.out);
  if (line.json)
    fmt::print("{}\n", toJson(results).dump());
  else
    print(results);
  if (options.out && !line.json) fmt::print("report: {}/report.html\n", *options.out);
  if (results.count(brokeDown) > 0) {
    printFailure(results.engine.reason);
    return exitEngineFailed;
  }
  if (results.count(failed) > 0) return exitFellShort;
  if (results.count(passed) == 0) return nothingWasJudged(line, "every check was skipped");
  return exitHeld;
}

Action declareConformance(CLI::App& app, CommandLine& line) {
  const auto options = std::make_shared<ConformanceOptions>();
  addArgument(app, "engine", options->engine, "engine file of your own, or the name of an engine",
              "ENGINE.toml|NAME");
  addText(app, "--out", options->out,
          "folder for results.json, junit.xml and report.html; what is there is written anew",
          "FOLDER");
  addText(app, "-k", line.only, "only checks with this in their name");
  addFlag(app, "--json", line.json, "print results.json in place of words");
  addQuiet(app, line);
  return [&line, options] { return conformanceOf(line, *options); };
}

}  // namespace

extern const Command conformanceCommand = {
    "conformance", "whether one engine does what it declares: suite, lockstep, collisions",
    "crossgrain conformance examples/python/engine.toml --out out/conformance\n"
    "crossgrain conformance yade -k Contacts",
    declareConformance};

}  // namespace crossgrain::inline cli

#include <fmt/format.h>

#include <memory>

#include "cli/option_groups.hpp"
#include "cli/outcome.hpp"
#include "reports/diff/overview.hpp"
#include "reports/diff/words.hpp"
#include "results/schema.hpp"
#include "runs/baseline/diff.hpp"

namespace crossgrain::inline cli {

namespace {

int statusOf(const CommandLine& line, const DiffResults& results) {
  bool judged = false, differs = false, failed = false;
  for (const DiffRow& row : results.rows) {
    judged |= row.verdict != DiffVerdict::notMeasured;
    differs |= row.verdict == DiffVerdict::differs;
    if (row.failure.empty()) continue;
    printFailure(row.failure);
    failed = true;
  }
  if (failed) return exitEngineFailed;
  if (!judged) return nothingWasJudged(line, results.rows.front().reason);
  return differs ? exitFellShort : exitHeld;
}

int diff(const CommandLine& line, const std::string& file) {
  const DiffResults results = diffAgainst(file, line.overrides, line.run);
  if (line.json) {
    nlohmann::json document = toJson(results);
    document["overview"] = toJson(reports::diffOverview(results));
    fmt::print("{}", toText(document));
  } else {
    fmt::print("{}", reports::diffInWords(results));
    printOverview(reports::diffOverview(results));
  }
  return statusOf(line, results);
}

Action declareDiff(CLI::App& app, CommandLine& line) {
  const auto file = std::make_shared<std::string>();
  addArgument(app, "baseline", *file, "file that `baseline` wrote", "FILE");
  addEngines(app, line);
  addOverrides(app, line);
  addQuiet(app, line);
  addFlag(app, "--json", line.json, "print what was found as JSON");
  return [&line, file] { return diff(line, *file); };
}

}  // namespace

extern const Command diffCommand = {
    "diff", "what engines do otherwise than a baseline says",
    "crossgrain diff before.h5 --engines yade\n"
    "crossgrain diff before.h5 --engines grain --set law.integrator=velocity_verlet",
    declareDiff};

}  // namespace crossgrain::inline cli

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>

#include "cases/case_files.hpp"
#include "cases/flow.hpp"
#include "cases/loader.hpp"
#include "cli/option_groups.hpp"
#include "cli/outcome.hpp"
#include "reports/regression/regression.hpp"
#include "results/schema.hpp"
#include "studies/core/engine_access.hpp"
#include "studies/core/study.hpp"
#include "studies/lockstep/rules.hpp"
#include "studies/regression/diff.hpp"
#include "studies/regression/observe.hpp"
#include "support/bad_input.hpp"
#include "support/files.hpp"
#include "support/numbers.hpp"

namespace crossgrain::inline cli {
namespace {

namespace fs = std::filesystem;

constexpr double mostStarts = 1000.0;

struct KeepOptions {
  std::string out;
  std::optional<double> starts;
  bool endpoints = false;
};

int keep(const CommandLine& line, const KeepOptions& own) {
  const auto& [out, given, endpoints] = own;
  const std::size_t starts =
      given        ? static_cast<std::size_t>(wholeNumberOf("--starts", *given, 1.0, mostStarts))
      : line.quick ? quickLockstepStarts
                   : baselineStarts;
  const fs::path file = out;
  // An older version's work cannot be done again.
  if (fs::exists(file))
    throw BadInput(fmt::format(
        "--out {}: this file exists, and a baseline is not replaced: name another file, or remove "
        "this one",
        out));
  std::vector<Case> cases = loadCase(line.inputs.front(), line.overrides);
  if (line.only) cases = selectedCases(cases, *line.only);
  if (isCollision(cases.front()))
    reportKeysWithoutUse(cases.front(), "baseline", stdout);
  else
    cases = {onlyFlow(line, {.command = "baseline", .beginsFromGrain = true})};
  if (endpoints && cases.front().averaging.endpoints.empty())
    throw BadInput(
        fmt::format("--endpoints: {} has no endpoints to keep", line.inputs.front().string()));
  if (line.run.dryRun)
    return printPlanned(line, fmt::format("would keep a baseline of {} on {} in {}",
                                          counted(selectEngines(line.run.engines).size(), "engine"),
                                          cases.front().name, out));
  // A folder that cannot be written is reported before the work is done.
  if (file.has_parent_path()) makeDirectory(file.parent_path());
  std::vector<std::string> refusals;
  const Baseline baseline = keepBaseline(cases, line.run, starts, endpoints, refusals);
  writeBaseline(baseline, file);
  std::vector<std::string> names;
  for (const BaselineEngine& engine : baseline.engines)
    names.push_back(fmt::format("{} {}", engine.name, engine.version));
  fmt::print("{}: baseline of {}\n", out, fmt::join(names, ", "));
  for (const std::string& refusal : refusals) printFailure(refusal);
  return exitPassed;
}

int diff(const CommandLine& line, const std::string& file) {
  const DiffResults results = diffAgainst(file, line.overrides, line.run);
  if (line.run.dryRun)
    return printPlanned(
        line, fmt::format("would compare {} with {}",
                          counted(selectEngines(line.run.engines).size(), "engine"), file));
  const reports::Overview overview = reports::diffOverview(results);
  if (line.json) {
    nlohmann::json document = toJson(results);
    document["overview"] = jsonOf(overview);
    fmt::print("{}", toText(document));
  } else {
    fmt::print("{}", reports::diffText(results));
    printOverview(overview);
  }
  return printOutcome(line, outcomeOf(results));
}

Action declareBaseline(CLI::App& app, CommandLine& line) {
  addCase(app, line);
  addEngines(app, line);
  addOverrides(app, line);
  addSelection(app, line);
  addPackings(app, line);
  addQuiet(app, line);
  addDryRun(app, line);
  const auto own = std::make_shared<KeepOptions>();
  addArgument(app, "--out", own->out, "file to write; it must not exist", "FILE");
  addNumber(app, "--starts", own->starts,
            "states of the flow to start from; 8 unless given, 4 with --quick");
  addFlag(app, "--endpoints", own->endpoints,
          "also averages a run from every start, as compare does, and keeps its endpoints");
  return [&line, own] { return keep(line, *own); };
}

Action declareDiff(CLI::App& app, CommandLine& line) {
  const auto file = std::make_shared<std::string>();
  addArgument(app, "baseline", *file, "file that `baseline` wrote", "FILE");
  addEngines(app, line);
  addOverrides(app, line);
  addQuiet(app, line);
  addJson(app, line);
  addDryRun(app, line);
  return [&line, file] { return diff(line, *file); };
}

}  // namespace

extern const Command baselineCommand = {
    "baseline", "keep what engines do, bit by bit, for diff",
    "crossgrain baseline cases/couette/quick.toml --engines grain,yade --out before.baseline\n"
    "crossgrain baseline cases/collision/figure-4-3.toml --engines grain --out before.baseline",
    declareBaseline};

extern const Command diffCommand = {
    "diff", "compare engines with a baseline: what differs, by how much, and why",
    "crossgrain diff before.baseline --engines yade\n"
    "crossgrain diff before.baseline --engines grain --set law.integrator=velocity_verlet",
    declareDiff};

}  // namespace crossgrain::inline cli

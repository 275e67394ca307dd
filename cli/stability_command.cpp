#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "cases/case_files.hpp"
#include "cli/one_case.hpp"
#include "cli/option_groups.hpp"
#include "cli/outcome.hpp"
#include "cli/units.hpp"
#include "reports/report.hpp"
#include "reports/stability/report.hpp"
#include "results/json_fields.hpp"
#include "runs/common/engine_access.hpp"
#include "runs/common/resumable.hpp"
#include "runs/stability/stability.hpp"
#include "support/bad_input.hpp"
#include "support/data_folder.hpp"

namespace crossgrain::inline cli {

namespace fs = std::filesystem;

namespace {

void printVerdict(const StabilityRun& run) {
  std::string figure;
  if (run.value)
    figure =
        fmt::format("{} {:.3g} {}, limit {:.3g}", run.measure, *run.value, run.unit, run.limit);
  if (run.step) figure += fmt::format(", step {}", *run.step);
  fmt::print("{:<9} {:<16} {}{}{}: {}{}{}\n", nameOf(run.verdict), run.engine, run.name,
             run.variant.empty() ? "" : " ", run.variant, figure,
             figure.empty() || run.reason.empty() ? "" : "; ", run.reason);
}

/// One line for each engine and reason of what was not judged: nobody reads forty of them.
void printUnjudged(const std::vector<StabilityRun>& runs, StabilityVerdict verdict,
                   const char* word) {
  std::map<std::pair<std::string, std::string>, int> count;
  for (const StabilityRun& run : runs)
    if (run.verdict == verdict) ++count[{run.engine, run.reason}];
  for (const auto& [what, times] : count)
    fmt::print("{:<9} {:<16} {} run{}: {}\n", word, what.first, times, times == 1 ? "" : "s",
               what.second);
}

int stability(const CommandLine& line, SuitePart part, SuiteAsks asks, double budget) {
  std::vector<fs::path> inputs = line.inputs;
  if (inputs.empty()) inputs.push_back(hereOrInstalled("cases/hard"));
  std::vector<Case> cases = asks == SuiteAsks::transforms ? casesToTransform(inputs, line.overrides)
                                                          : hardCases(inputs, line.overrides, part);
  if (line.only) cases = selectedCases(cases, *line.only);
  reportKeysWithoutUse(cases, "stability", line.json ? stderr : stdout);
  RunStore store(line.run, "stability", keysOfEach(cases));
  const std::vector<EngineEntry> engines = selectEngines(line.run.engines);
  if (line.run.dryRun) return told(stabilityPlan(cases, engines, line.run, store, asks));
  const StabilityResults results = testStability(cases, engines, line.run, store, asks, budget);
  writeReport(results, line.run.out);

  const std::vector<StabilityRun>& runs = results.runs;
  const auto count = [&](StabilityVerdict verdict) {
    return std::ranges::count(runs, verdict, &StabilityRun::verdict);
  };
  const auto unstable = count(StabilityVerdict::unstable);
  const auto refused = count(StabilityVerdict::refused), notRun = count(StabilityVerdict::notRun);
  if (line.json) {
    fmt::print("{}\n", (line.run.out / "results.json").string());
  } else {
    for (const StabilityRun& run : runs)
      if (run.verdict > StabilityVerdict::stable) printVerdict(run);
    printUnjudged(runs, StabilityVerdict::refused, "refused");
    printUnjudged(runs, StabilityVerdict::notRun, "not run");
    fmt::print("{} stable, {} degraded, {} unstable, {} refused{}\n",
               count(StabilityVerdict::stable), count(StabilityVerdict::degraded), unstable,
               refused, notRun == 0 ? "" : fmt::format(", {} not run", notRun));
    printOverview(reports::stabilityOverview(results));
    fmt::print("report: {}\n", (line.run.out / "report.html").string());
    if (!line.run.quiet) printTimeSpent();
  }
  if (refused == std::ssize(runs))
    return nothingWasJudged(
        line, fmt::format("all runs were refused, the first because it {}", runs.front().reason));
  if (refused + notRun == std::ssize(runs))
    return nothingWasJudged(line, "the budget ended before any run could be judged");
  return unstable > 0 ? exitFellShort : exitHeld;
}

Action declareStability(CLI::App& app, CommandLine& line) {
  const auto longCases = std::make_shared<bool>(false);
  const auto transforms = std::make_shared<bool>(false);
  const auto budget = std::make_shared<std::optional<std::string>>();
  addInputs(app, line, "case", "case files or folders of them (default: cases/hard)", 0, anyNumber);
  addSelection(app, line);
  addRun(app, line);
  addFlag(app, "--quick", line.quick, "only cases marked as quick");
  addFlag(app, "--long", *longCases, "also cases marked as long");
  addFlag(
      app, "--transforms", *transforms,
      "whether any case, turned, mirrored, told in other units, renumbered, restarted and in one "
      "go, does the same");
  addText(app, "--budget", *budget,
          "of --transforms: no run begins that would end later, e.g. 90s, 10m, 1h (default: none)",
          "TIME");
  excludeEachOther(app, "--quick", "--long");
  excludeEachOther(app, "--transforms", "--quick");
  excludeEachOther(app, "--transforms", "--long");
  return [&line, longCases, transforms, budget] {
    const SuitePart part = line.quick   ? SuitePart::quick
                           : *longCases ? SuitePart::withLong
                                        : SuitePart::usual;
    const SuiteAsks asks = *transforms ? SuiteAsks::transforms : SuiteAsks::limits;
    if (*budget && !*transforms) throw BadInput("--budget: goes with --transforms only");
    const double seconds = *budget ? secondsOf(**budget) : std::numeric_limits<double>::infinity();
    return resumably(line.run, [&] { return stability(line, part, asks, seconds); });
  };
}

}  // namespace

extern const Command stabilityCommand = {
    "stability", "hard cases: what stays stable on which engine, and what does not",
    "crossgrain stability --engines all --out out/stability    # all of cases/hard\n"
    "crossgrain stability -k pile --engines grain --out out/pile\n"
    "crossgrain stability cases/hard/pile.toml --engines grain,yade --out out/piles\n"
    "crossgrain stability --transforms cases/couette/quick.toml --engines grain,yade --out "
    "out/told\n"
    "crossgrain stability --transforms --budget 10m cases/couette/quick.toml --engines all --out "
    "out/brief",
    declareStability};

}  // namespace crossgrain::inline cli

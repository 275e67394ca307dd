#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <optional>

#include "adapters/registry.hpp"
#include "cli/option_groups.hpp"
#include "cli/outcome.hpp"
#include "reports/report.hpp"
#include "reports/thesis/report.hpp"
#include "runs/common/study.hpp"
#include "runs/thesis/thesis.hpp"
#include "support/data_folder.hpp"

namespace crossgrain::inline cli {

namespace {

constexpr const char* wholeSweep = "cases/couette/thesis/ladder.toml";
constexpr const char* quickSweep = "cases/couette/thesis/ladder-quick.toml";

/// Claims, then what they lack, then all of it at a glance and where the report is.
void print(const ThesisResults& results, const CommandLine& line) {
  fmt::print("{}", reports::claimsText(results));
  for (const std::string& note : results.notes) fmt::print("{}\n", note);
  printOverview(reports::thesisOverview(results));
  fmt::print("report: {}\n", (line.run.out / "report.html").string());
}

int thesis(const CommandLine& line, bool strict, double budget,
           const std::optional<std::string>& earlier) {
  const auto file = line.inputs.empty() ? hereOrInstalled(line.quick ? quickSweep : wholeSweep)
                                        : line.inputs.front();
  const ThesisSweep sweep = loadSweep(file, line.overrides);
  RunStore store(line.run, "thesis", keysOfCases(sweep));
  if (line.run.dryRun) return told(thesisPlan(sweep, line.run, store, earlier));
  const ThesisResults results = runThesis(sweep, line.run, store, budget, earlier);
  writeReport(results, line.run.out);

  if (line.json)
    fmt::print("{}\n", (line.run.out / "results.json").string());
  else
    print(results, line);
  bool failed = false;
  for (const ThesisRun& run : results.runs)
    if (run.run.status == RunStatus::failed) {
      printFailure(run.run.reason);
      failed = true;
    }
  if (failed) return exitEngineFailed;
  if (results.runs.empty()) return nothingWasJudged(line, "no run was finished");
  // A refuted claim is what was to be found out.
  const bool open = std::ranges::find(results.claims, ClaimVerdict::undecided,
                                      &ClaimRow::verdict) != results.claims.end();
  return strict && open ? exitFellShort : exitHeld;
}

Action declareThesis(CLI::App& app, CommandLine& line) {
  struct Options {
    bool strict = false;
    std::optional<std::string> budget, earlier;
  };
  const auto own = std::make_shared<Options>();
  addInputs(app, line, "sweep",
            fmt::format("what to run, in which order (default: {})", wholeSweep), 0, 1);
  addRun(app, line, engineRegistry().front().name.c_str());
  addPackings(app, line);
  addText(app, "--budget", own->budget,
          "no run begins that would end later, e.g. 90s, 10m, 2h (default: all are run)", "TIME");
  addText(
      app, "--from", own->earlier,
      "results.json of an earlier session: its finished runs are taken, whichever build made them",
      "FILE");
  addFlag(app, "--strict", own->strict, "a claim that is undecided counts as a failure");
  return [&line, own] {
    const double budget =
        own->budget ? secondsOf(*own->budget) : std::numeric_limits<double>::infinity();
    return resumably(line.run, [&] { return thesis(line, own->strict, budget, own->earlier); });
  };
}

}  // namespace

extern const Command thesisCommand = {
    "thesis", "the thesis' claims, one by one: reproduced or refuted, per engine, with a number",
    "crossgrain thesis --quick --out out/claims                       # minutes\n"
    "crossgrain thesis --budget 2h --out out/thesis                   # and again, until all is "
    "run\n"
    "crossgrain thesis --budget 2h --from out/thesis/results.json --out out/more\n"
    "crossgrain thesis --engines grain,yade --budget 8h --out out/yade",
    declareThesis};

}  // namespace crossgrain::inline cli

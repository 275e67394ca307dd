#include <fmt/format.h>

#include <cmath>
#include <memory>

#include "cli/one_case.hpp"
#include "cli/option_groups.hpp"
#include "cli/outcome.hpp"
#include "reports/lockstep/overview.hpp"
#include "reports/lockstep/words.hpp"
#include "reports/report.hpp"
#include "runs/common/study.hpp"
#include "runs/couette/lockstep_job.hpp"
#include "runs/lockstep/rules.hpp"
#include "support/bad_input.hpp"

namespace crossgrain::inline cli {

namespace {

std::size_t startsOf(const std::optional<double>& given, bool quick) {
  constexpr double most = 10000.0;
  if (!given) return quick ? quickLockstepStarts : lockstepStarts;
  if (*given != std::floor(*given) || *given < 1.0 || *given > most)
    throw BadInput(
        fmt::format("--starts: {:g} must be a whole number from 1 to {:g}", *given, most));
  return static_cast<std::size_t>(*given);
}

int statusOf(const CommandLine& line, const LockstepResults& results, bool strict) {
  bool judged = false, differs = false, failed = false;
  for (const LockstepRow& row : results.lockstep.rows) {
    judged |= row.verdict != LockstepVerdict::notMeasured;
    differs |= row.verdict == LockstepVerdict::differs ||
               (strict && row.verdict == LockstepVerdict::undecided);
    if (row.failure.empty()) continue;
    printFailure(row.failure);
    failed = true;
  }
  if (failed) return exitEngineFailed;
  if (!judged) return nothingWasJudged(line, "no engine here has a mirror in this scene");
  return differs ? exitFellShort : exitHeld;
}

int lockstep(const CommandLine& line, const std::optional<double>& given, bool strict) {
  const std::size_t starts = startsOf(given, line.quick);
  const Case setup = onlyFlow(line, "lockstep");
  RunStore store(line.run, "lockstep", soleCase(setup));
  if (line.run.dryRun) return told(lockstepPlan(setup, line.run, store, starts));
  const LockstepResults results = runLockstep(setup, line.run, store, starts);
  writeReport(results, line.run.out);
  if (line.json) {
    fmt::print("{}\n", (line.run.out / "results.json").string());
  } else {
    for (const LockstepRow& row : results.lockstep.rows)
      fmt::print("{}\n", reports::sentenceOf(row, results.lockstep.rules));
    printOverview(reports::lockstepOverview(results));
    fmt::print("report: {}\n", (line.run.out / "report.html").string());
  }
  printRefusals(line, results.engines);
  return statusOf(line, results, strict);
}

Action declareLockstep(CLI::App& app, CommandLine& line) {
  addCase(app, line);
  addRun(app, line);
  addPackings(app, line);
  const auto starts = std::make_shared<std::optional<double>>();
  addNumber(app, "--starts", *starts,
            "states of the flow to start from; 16 unless given, 4 with --quick");
  const auto strict = std::make_shared<bool>(false);
  addFlag(app, "--strict", *strict, "an engine that is undecided counts as one that differs");
  return [&line, starts, strict] {
    return resumably(line.run, [&] { return lockstep(line, *starts, *strict); });
  };
}

}  // namespace

extern const Command lockstepCommand = {
    "lockstep", "whether engines are the laws that they declare, step by step from equal states",
    "crossgrain lockstep cases/couette/quick.toml --engines yade,box2d-penalty --out out/lockstep",
    declareLockstep};

}  // namespace crossgrain::inline cli

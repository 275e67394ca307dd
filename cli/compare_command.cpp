#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "cases/effect_switch.hpp"
#include "cli/one_case.hpp"
#include "cli/option_groups.hpp"
#include "cli/outcome.hpp"
#include "reports/lockstep/words.hpp"
#include "reports/report.hpp"
#include "runs/common/resumable.hpp"
#include "runs/couette/compare.hpp"
#include "runs/lockstep/rules.hpp"

namespace crossgrain::inline cli {

namespace {

/// Only the verdicts between engines that the user named decide the exit status.
std::vector<AgreementRow> peerRows(const CompareResults& results) {
  std::vector<AgreementRow> rows = results.agreement;
  std::erase_if(rows, [](const AgreementRow& row) { return row.kind != PairKind::peer; });
  return rows;
}

int compare(const CommandLine& line, bool strict) {
  const Case setup = onlyCase(line, "compare");
  printWarnings(setup);
  RunStore store(line.run, "compare", soleCase(setup));
  if (line.run.dryRun) return told(comparePlan(setup, line.run, store));
  const CompareResults results =
      compareEngines(setup, line.run, store, line.quick ? quickLockstepStarts : lockstepStarts);
  writeReport(results, line.run.out);

  const std::vector<AgreementRow> rows = peerRows(results);
  const auto count = [&](Verdict verdict) {
    return std::ranges::count(rows, verdict, &AgreementRow::verdict);
  };
  const auto disagree = count(Verdict::disagree), undecided = count(Verdict::undecided);
  const auto failed = std::ranges::count(results.runs, RunStatus::failed, &CouetteRun::status);
  if (line.json)
    fmt::print("{}\n", (line.run.out / "results.json").string());
  else {
    fmt::print("{}\n", effectsInWords(effectsOf(setup)));
    if (results.lockstep)
      for (const LockstepRow& row : results.lockstep->rows)
        fmt::print("{}\n", reports::sentenceOf(row, results.lockstep->rules));
    for (const AgreementRow& row : rows)
      if (row.a == results.engines.front().name)
        fmt::print("{:<16} {:<22} {}\n", row.b, row.field, toString(row.verdict));
    fmt::print("{} agree, {} disagree, {} undecided; {} of {} runs failed\nreport: {}\n",
               count(Verdict::agree), disagree, undecided, failed, results.runs.size(),
               (line.run.out / "report.html").string());
  }
  for (const CouetteRun& run : results.runs)
    if (run.status == RunStatus::failed) printFailure(run.reason);
  int judged = exitHeld;
  if (const auto& nothing = results.nothingJudged)
    judged = nothingWasJudged(line, nothing->reason, nothing->byRequest || line.quick, strict);
  if (failed > 0) return exitEngineFailed;
  // Another law than it declares is a disagreement, whatever profiles make of it.
  const bool differs =
      results.lockstep && std::ranges::count(results.lockstep->rows, LockstepVerdict::differs,
                                             &LockstepRow::verdict) > 0;
  if (differs || disagree > 0 || (strict && undecided > 0)) return exitFellShort;
  return judged;
}

Action declareCompare(CLI::App& app, CommandLine& line) {
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
    "crossgrain compare cases/couette/quick.toml --engines grain,yade --out out", declareCompare};

}  // namespace crossgrain::inline cli

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cases/effect_switch.hpp"
#include "cli/one_case.hpp"
#include "cli/option_groups.hpp"
#include "cli/outcome.hpp"
#include "cli/units.hpp"
#include "reports/couette/endpoint_words.hpp"
#include "reports/couette/overview.hpp"
#include "reports/lockstep/words.hpp"
#include "reports/report.hpp"
#include "runs/common/study.hpp"
#include "runs/couette/compare.hpp"
#include "runs/lockstep/rules.hpp"

namespace crossgrain::inline cli {

namespace {

/// Only the verdicts on engines that the user named decide the exit status.
std::vector<EndpointRow> peerRows(const CompareResults& results) {
  std::vector<EndpointRow> rows = results.endpoints.rows;
  std::erase_if(rows, [](const EndpointRow& row) {
    return row.kind != PairKind::peer && row.kind != PairKind::closedForm;
  });
  return rows;
}

/// In words, before the reports' path.
void tell(const CompareResults& results, const std::vector<EndpointRow>& rows,
          std::ptrdiff_t failed) {
  const auto count = [&](Answer answer) {
    return std::ranges::count(rows, answer, &EndpointRow::answer);
  };
  if (results.lockstep)
    for (const LockstepRow& row : results.lockstep->rows)
      fmt::print("{}\n", reports::sentenceOf(row, results.lockstep->rules));
  for (const CarriedEngine& own : results.endpoints.carried)
    fmt::print("{}\n", reports::sentenceOf(own));
  for (const EndpointRow& row : rows)
    if (row.kind == PairKind::closedForm ||
        (row.a == results.engines.front().name && !results.nothingJudged))
      fmt::print("{:<16} {:<26} {}\n", row.b, row.endpoint, reports::answerInWords(row));
  for (const AlarmRow& alarm : results.endpoints.alarms)
    fmt::print("ALARM: {}\n", reports::sentenceOf(alarm));
  if (const LooksFindings& looks = results.endpoints.looks; looks.taken > 0)
    fmt::print("{}\n", reports::sentenceOf(looks));
  if (!results.nothingJudged)
    fmt::print("{} agree, {} borderline, {} disagree, {} undecided; ",
               count(Answer::noDifference) + count(Answer::smallDifference),
               count(Answer::borderline), count(Answer::disagree), count(Answer::undecided));
  fmt::print("{} of {} runs failed\n", failed, results.runs.size());
}

int compare(const CommandLine& line, bool strict, const std::optional<std::string>& budget) {
  const Case setup = onlyFlow(line, "compare");
  printWarnings(setup);
  const double seconds = budget ? secondsOf(*budget) : setup.looks.budget;
  RunStore store(line.run, "compare", soleCase(setup));
  if (line.run.dryRun) return told(comparePlan(setup, line.run, store));
  const CompareResults results = compareEngines(
      setup, line.run, store, line.quick ? quickLockstepStarts : lockstepStarts, seconds);
  writeReport(results, line.run.out);

  const std::vector<EndpointRow> rows = peerRows(results);
  const auto any = [&](Answer answer) {
    return std::ranges::find(rows, answer, &EndpointRow::answer) != rows.end();
  };
  const auto failed = std::ranges::count(results.runs, RunStatus::failed, &CouetteRun::status);
  if (line.json)
    fmt::print("{}\n", (line.run.out / "results.json").string());
  else {
    fmt::print("{}\n", effectsInWords(effectsOf(setup)));
    tell(results, rows, failed);
    printOverview(reports::compareOverview(results));
    fmt::print("report: {}\n", (line.run.out / "report.html").string());
  }
  for (const CouetteRun& run : results.runs)
    if (run.status == RunStatus::failed) printFailure(run.reason);
  const bool refused = printRefusals(line, results.engines);
  int judged = exitHeld;
  if (const auto& nothing = results.nothingJudged)
    judged = nothingWasJudged(line, nothing->reason, nothing->byRequest || line.quick, strict);
  if (failed > 0) return exitEngineFailed;
  // Another law than it declares is a disagreement, whatever averages make of it.
  const bool differs =
      results.lockstep && std::ranges::count(results.lockstep->rows, LockstepVerdict::differs,
                                             &LockstepRow::verdict) > 0;
  const bool alarmed =
      std::ranges::count(results.endpoints.alarms, PairKind::peer, &AlarmRow::kind) > 0;
  const bool open =
      any(Answer::undecided) || any(Answer::borderline) || refused ||
      (results.lockstep && std::ranges::count(results.lockstep->rows, LockstepVerdict::undecided,
                                              &LockstepRow::verdict) > 0);
  if (differs || alarmed || any(Answer::disagree) || (strict && open)) return exitFellShort;
  return judged;
}

Action declareCompare(CLI::App& app, CommandLine& line) {
  struct Options {
    bool strict = false;
    std::optional<std::string> budget;
  };
  const auto own = std::make_shared<Options>();
  addCase(app, line);
  addRun(app, line);
  addPackings(app, line);
  addText(app, "--budget", own->budget,
          "no further look at more packings begins that would end later, e.g. 90s, 10m, 1h "
          "(default: looks.budget of the case)",
          "TIME");
  addFlag(app, "--strict", own->strict,
          "undecided and borderline verdicts, engines that cannot run the case and nothing judged "
          "count as failed");
  return [&line, own] {
    return resumably(line.run, [&] { return compare(line, own->strict, own->budget); });
  };
}

}  // namespace

extern const Command compareCommand = {
    "compare", "run, average, cross-check",
    "crossgrain compare cases/couette/quick.toml --engines grain,yade --out out/compare",
    declareCompare};

}  // namespace crossgrain::inline cli

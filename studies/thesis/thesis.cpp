#include "studies/thesis/thesis.hpp"

#include <algorithm>
#include <chrono>

#include "studies/collide/collide.hpp"
#include "studies/lockstep/rules.hpp"
#include "studies/thesis/campaign.hpp"
#include "studies/thesis/claims.hpp"
#include "support/bad_input.hpp"
#include "support/data_folder.hpp"

namespace crossgrain::inline studies {
namespace {

constexpr const char* wholeSweep = "cases/couette/thesis/ladder.toml";
constexpr const char* quickSweep = "cases/couette/thesis/ladder-quick.toml";

std::vector<Case> casesOfThesis(const CommandLine& line, ThesisOptions& own) {
  if (line.inputs.size() > 1) throw BadInput("thesis runs one parameter sweep at a time");
  if (own.budget) own.seconds = secondsOf(*own.budget);
  own.sweep = loadSweep(line.inputs.empty() ? hereOrInstalled(line.quick ? quickSweep : wholeSweep)
                                            : line.inputs.front(),
                        line.overrides);
  std::vector<Case> cases;
  for (const Case& setup : own.sweep.collisions)
    cases.emplace_back(setup).name = "collisions " + setup.name;
  for (const SweepCase& each : own.sweep.cases) cases.emplace_back(each.setup).name = each.name;
  return cases;
}

ThesisCampaign campaignOf(const StudyWork& work, const ThesisOptions& own) {
  return {own.sweep, work.line.run, work.store, own.seconds,
          own.earlier ? readEarlierRuns(*own.earlier) : EarlierRuns()};
}

std::string planOfThesis(const StudyWork& work, const ThesisOptions& own) {
  ThesisCampaign campaign = campaignOf(work, own);
  campaign.askEngines();
  return campaign.plan();
}

void judge(ThesisResults& results, const ClaimRules& rules, const ClaimReasons& reasons) {
  results.reasons = reasons.text;
  results.claims = judgeClaims(results, rules);
  addReasons(results, rules, reasons, results.claims);
}

ThesisResults runThesis(const StudyWork& work, const ThesisOptions& own) {
  const auto started = std::chrono::steady_clock::now();
  const ThesisSweep& sweep = own.sweep;
  // What is wrong with them is said before anything is run.
  const ClaimRules rules = loadClaimRules(sweep.rules, &claimSchema());
  ClaimReasons reasons;
  if (sweep.reasons) reasons = loadClaimReasons(*sweep.reasons, rules);
  ThesisCampaign campaign = campaignOf(work, own);
  std::optional<CollideResults> collisions;
  if (!sweep.collisions.empty())
    collisions = collideEngines(sweep.collisions, work.line.run, work.store);
  campaign.askEngines();
  campaign.compareWithMirrors(lockstepStarts);
  campaign.run();
  ThesisResults results = campaign.results();
  results.rules = rules.text;
  results.collisions = std::move(collisions);
  results = compacted(std::move(results));
  judge(results, rules, reasons);
  results.elapsed =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  return results;
}

/// A refuted claim is what was to be found out.
Outcome outcomeOfThesis(const ThesisResults& results, const CommandLine&,
                        const ThesisOptions& own) {
  Outcome outcome;
  for (const ThesisRun& run : results.runs)
    if (run.run.status == Status::failed) outcome.failures.push_back(run.run.reason);
  if (!outcome.failures.empty())
    outcome.status = exitEngineFailed;
  else if (results.runs.empty())
    return notJudged("no run was finished");
  else if (own.strict && std::ranges::find(results.claims, Verdict::undecided,
                                           &ClaimRow::verdict) != results.claims.end())
    outcome.status = exitFailed;
  return outcome;
}

}  // namespace

const Study<ThesisOptions, ThesisResults> thesisStudy = {
    "thesis",
    {.input = SharedOptions::Input::anyCases,
     .inputIs = "parameter sweep: what to run, in which order (default: "
                "cases/couette/thesis/ladder.toml)",
     .inHouse = true,
     .packings = true},
    Keeps::eachCase,
    [](ThesisOptions& own, CommandLine&) {
      return std::vector<StudyOption>{
          {"--budget",
           "start no run that would end after this time, e.g. 90s, 10m, 2h (default: no limit)",
           &own.budget, "TIME"},
          {"--from",
           "results.json of an earlier session: its finished runs are taken, whichever build made "
           "them",
           &own.earlier, "FILE"},
          {"--strict", "status 1 also for a claim that is undecided", &own.strict}};
    },
    casesOfThesis,
    planOfThesis,
    runThesis,
    outcomeOfThesis};

ThesisResults judgedAgain(ThesisResults results,
                          const std::optional<std::filesystem::path>& reasons) {
  results = compacted(std::move(results));
  const ClaimRules rules = claimRulesOf(results.rules, &claimSchema());
  judge(results, rules,
        reasons ? loadClaimReasons(*reasons, rules) : claimReasonsOf(results.reasons, rules));
  return results;
}

}  // namespace crossgrain::inline studies

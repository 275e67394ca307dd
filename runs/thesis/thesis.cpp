#include "runs/thesis/thesis.hpp"

#include "runs/collide/collide.hpp"
#include "runs/lockstep/rules.hpp"
#include "runs/thesis/campaign.hpp"
#include "runs/thesis/claims.hpp"

namespace crossgrain::inline runs {
namespace {

EarlierRuns earlierIn(const std::optional<std::filesystem::path>& file) {
  return file ? readEarlierRuns(*file) : EarlierRuns();
}

void judge(ThesisResults& results, const ClaimRules& rules, const ClaimReasons& reasons) {
  results.reasons = reasons.text;
  results.claims = judgeClaims(results, rules);
  addReasons(results, rules, reasons, results.claims);
}

}  // namespace

std::map<std::string, CaseKeys> keysOfCases(const ThesisSweep& sweep) {
  std::map<std::string, CaseKeys> keys;
  for (auto& [name, own] : keysOfEach(sweep.collisions)) keys["collisions " + name] = own;
  for (const SweepCase& own : sweep.cases) keys[own.name] = keysThatMatter(own.setup);
  return keys;
}

ThesisResults runThesis(const ThesisSweep& sweep, const RunCommand& command, RunStore& store,
                        double budget, const std::optional<std::filesystem::path>& earlier) {
  const auto started = std::chrono::steady_clock::now();
  // What is wrong with them is said before anything is run.
  const ClaimRules rules = loadClaimRules(sweep.rules, &claimSchema());
  ClaimReasons reasons;
  if (sweep.reasons) reasons = loadClaimReasons(*sweep.reasons, rules);
  ThesisCampaign campaign(sweep, command, store, budget, earlierIn(earlier));
  std::optional<CollideResults> collisions;
  if (!sweep.collisions.empty()) collisions = collideEngines(sweep.collisions, command, store);
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

std::string thesisPlan(const ThesisSweep& sweep, const RunCommand& command, RunStore& store,
                       const std::optional<std::filesystem::path>& earlier) {
  ThesisCampaign campaign(sweep, command, store, std::numeric_limits<double>::infinity(),
                          earlierIn(earlier));
  campaign.askEngines();
  return campaign.plan();
}

ThesisResults judgedAgain(ThesisResults results,
                          const std::optional<std::filesystem::path>& reasons) {
  results = compacted(std::move(results));
  const ClaimRules rules = claimRulesOf(results.rules, &claimSchema());
  judge(results, rules,
        reasons ? loadClaimReasons(*reasons, rules) : claimReasonsOf(results.reasons, rules));
  return results;
}

}  // namespace crossgrain::inline runs

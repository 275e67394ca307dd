#include "runs/thesis/thesis.hpp"

#include <algorithm>

#include "cases/claim_reasons.hpp"
#include "results/thesis_kept.hpp"
#include "runs/collide/collide.hpp"
#include "runs/lockstep/rules.hpp"
#include "runs/thesis/claims.hpp"
#include "runs/thesis/climb.hpp"
#include "runs/thesis/reasons.hpp"

namespace crossgrain::inline runs {

std::map<std::string, CaseKeys> keysOfLegs(const ThesisLadder& ladder) {
  std::map<std::string, CaseKeys> keys;
  for (auto& [name, own] : keysOfEach(ladder.collisions)) keys["collisions " + name] = own;
  for (const LadderLeg& leg : ladder.legs) keys[leg.name] = keysThatMatter(leg.setup);
  return keys;
}

namespace {

/// Those of each engine's own collisions follow those of the law.
void addCollisions(const CollideResults& collisions, const ClaimRules& rules,
                   std::vector<ClaimRow>& claims) {
  const std::vector<ClaimRow> own = judgeCollisions(collisions, rules);
  if (own.empty()) return;
  const auto other =
      std::ranges::find_if(claims, [&](const ClaimRow& row) { return row.id != own.front().id; });
  claims.insert(other, own.begin(), own.end());
}

std::vector<ClaimRow> allClaims(const ThesisResults& results, const ClaimRules& rules,
                                const ClaimReasons& reasons) {
  std::vector<ClaimRow> claims = judgeClaims(results, rules);
  if (results.collisions) addCollisions(*results.collisions, rules, claims);
  addReasons(results, rules, reasons, claims);
  return claims;
}

EarlierRuns earlierIn(const std::optional<std::filesystem::path>& file) {
  return file ? readEarlierRuns(*file) : EarlierRuns();
}

}  // namespace

ThesisResults climbLadder(const ThesisLadder& ladder, const RunCommand& command, RunStore& store,
                          double budget, const std::optional<std::filesystem::path>& earlier) {
  const auto started = std::chrono::steady_clock::now();
  const ClaimRules rules = loadClaimRules(ladder.rules);  // what is wrong with them is said now
  ClaimReasons reasons;
  if (ladder.reasons) reasons = loadClaimReasons(*ladder.reasons, rules);
  Climb climb(ladder, command, store, budget, earlierIn(earlier));
  std::optional<CollideResults> collisions;
  if (!ladder.collisions.empty()) collisions = collideEngines(ladder.collisions, command, store);
  climb.askEngines();
  climb.holdAgainstMirrors(lockstepStarts);
  climb.run();
  ThesisResults results = climb.results();
  results.rules = rules.text;
  results.collisions = std::move(collisions);
  results = kept(std::move(results));
  results.reasons = reasons.text;
  results.claims = allClaims(results, rules, reasons);
  results.elapsed =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  return results;
}

std::string ladderPlan(const ThesisLadder& ladder, const RunCommand& command, RunStore& store,
                       const std::optional<std::filesystem::path>& earlier) {
  Climb climb(ladder, command, store, std::numeric_limits<double>::infinity(), earlierIn(earlier));
  climb.askEngines();
  return climb.plan();
}

ThesisResults judgedAgain(ThesisResults results,
                          const std::optional<std::filesystem::path>& reasonsFile) {
  results = kept(std::move(results));
  const ClaimRules rules = claimRulesOf(results.rules);
  const ClaimReasons reasons =
      reasonsFile ? loadClaimReasons(*reasonsFile, rules) : claimReasonsOf(results.reasons, rules);
  results.reasons = reasons.text;
  results.claims = allClaims(results, rules, reasons);
  return results;
}

}  // namespace crossgrain::inline runs

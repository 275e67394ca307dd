#include "runs/couette/compare.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "results/schema.hpp"
#include "runs/common/nothing_judged.hpp"
#include "runs/couette/agreement_table.hpp"
#include "runs/couette/campaign.hpp"
#include "runs/couette/contact_notes.hpp"
#include "runs/couette/lockstep_job.hpp"
#include "runs/couette/state_table.hpp"
#include "runs/couette/velocity_notes.hpp"

namespace crossgrain::inline runs {

namespace {

/// All pairs of the engines named, in the order in which they were named. A mirror that came along
/// stands between the in-house engine, which it is but for its conventions, and its peer.
std::vector<ComparedPair> pairsOf(const auto& engines, const std::vector<std::string>& names) {
  const auto named = [&](const EngineEntry& entry) {
    return entry.mirrors.empty() || isNamed(names, entry);
  };
  std::vector<ComparedPair> pairs;
  for (std::size_t a = 0; a < engines.size(); ++a)
    for (std::size_t b = a + 1; b < engines.size(); ++b)
      if (named(engines[a]) && named(engines[b]))
        pairs.push_back({engines[a].name, engines[b].name, PairKind::peer, ""});
  for (const EngineEntry& mirror : engines) {
    if (named(mirror)) continue;
    pairs.push_back({engineRegistry().front().name, mirror.name, PairKind::mirrorModel, ""});
    pairs.push_back({mirror.name, mirror.mirrors, PairKind::mirrorImplementation, ""});
  }
  return pairs;
}

/// Those whose implementation is in question: not what mirrors are made of, nor mirrors themselves.
bool hasMirror(const EngineEntry& entry) {
  return entry.mirrors.empty() && entry.name != engineRegistry().front().name;
}

}  // namespace

std::string comparePlan(const Case& setup, const RunCommand& command, RunStore& store) {
  Campaign campaign(setup, command, enginesFor(setup, command.engines), store);
  campaign.askEngines();
  campaign.lookForPackings();
  return dryRunInWords(campaign.planHead(), campaign.plan(campaign.wholeCase()), store, command);
}

CompareResults compareEngines(const Case& setup, const RunCommand& command, RunStore& store,
                              std::size_t starts) {
  Campaign campaign(setup, command, enginesFor(setup, command.engines), store);
  campaign.askEngines();
  campaign.preparePackings();
  LockstepFindings lockstep;
  if (setup.run.mirrors) lockstep = lockstepOf(campaign, setup, command, starts, hasMirror);
  campaign.timeEngines();
  campaign.run(campaign.wholeCase());
  CompareResults results{campaign.study(kindCompare), {}, {}, {}, {}, {}, {}};
  if (!lockstep.rows.empty()) results.lockstep = std::move(lockstep);
  std::vector<std::string> names;
  for (const EngineRow& engine : results.engines) names.push_back(engine.name);
  const auto pairs = pairsOf(campaign.engines(), command.engines);
  results.regimes = regimesOf(results.runs, pairs);
  results.steadiness = steadinessOf(results.runs, names, setup.averaging.confidence);
  results.ensemble = ensembleOf(results.runs, names);
  results.agreement = agreementOf(setup, results.runs, pairs);
  const auto named = std::ranges::count_if(campaign.engines(), [&](const EngineEntry& entry) {
    return entry.mirrors.empty() || isNamed(command.engines, entry);
  });
  results.nothingJudged = nothingJudged(setup, results.agreement, static_cast<std::size_t>(named));
  if (const auto& nothing = results.nothingJudged)
    results.notes.push_back(fmt::format("Nothing was judged: {}.", nothing->reason));
  std::ranges::move(velocityNotes(results), std::back_inserter(results.notes));
  std::ranges::move(contactNotes(results), std::back_inserter(results.notes));
  return results;
}

}  // namespace crossgrain::inline runs

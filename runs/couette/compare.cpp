#include "runs/couette/compare.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "runs/common/nothing_judged.hpp"
#include "runs/couette/agreement_table.hpp"
#include "runs/couette/campaign.hpp"
#include "runs/couette/contact_notes.hpp"
#include "runs/couette/state_table.hpp"
#include "runs/couette/velocity_notes.hpp"

namespace crossgrain::inline runs {

using nlohmann::json;

namespace {

/// All pairs of the engines named, in the order in which they were named. A mirror that came along
/// stands between the in-house engine, which it is but for its conventions, and its peer.
std::vector<ComparedPair> pairsOf(const std::vector<EngineEntry>& engines,
                                  const std::vector<std::string>& names) {
  const auto named = [&](const EngineEntry& entry) {
    return entry.mirrors.empty() || isNamed(names, entry);
  };
  std::vector<ComparedPair> pairs;
  for (std::size_t a = 0; a < engines.size(); ++a)
    for (std::size_t b = a + 1; b < engines.size(); ++b)
      if (named(engines[a]) && named(engines[b]))
        pairs.push_back({engines[a].name, engines[b].name, "peer", ""});
  for (const EngineEntry& mirror : engines) {
    if (named(mirror)) continue;
    pairs.push_back({engineRegistry().front().name, mirror.name, "mirror_model", ""});
    pairs.push_back({mirror.name, mirror.mirrors, "mirror_implementation", ""});
  }
  return pairs;
}

}  // namespace

std::string comparePlan(const Case& setup, const RunCommand& command, RunStore& store) {
  Campaign campaign(setup, command, enginesFor(setup, command.engines), store);
  campaign.askEngines();
  campaign.lookForPackings();
  return dryRunInWords(campaign.planHead(), campaign.plan(campaign.wholeCase()), store, command);
}

json compareEngines(const Case& setup, const RunCommand& command, RunStore& store) {
  Campaign campaign(setup, command, enginesFor(setup, command.engines), store);
  campaign.askEngines();
  campaign.preparePackings();
  campaign.timeEngines();
  campaign.run(campaign.wholeCase());
  json results = campaign.results("compare");
  std::vector<std::string> names;
  for (const EngineEntry& entry : campaign.engines()) names.push_back(entry.name);
  const auto pairs = pairsOf(campaign.engines(), command.engines);
  results["regimes"] = regimesOf(results["runs"], pairs);
  results["steadiness"] = steadinessOf(results["runs"], names, setup.averaging.confidence);
  results["ensemble"] = ensembleOf(results["runs"], names);
  results["agreement"] = agreementOf(setup, results["runs"], pairs);
  const auto named = std::ranges::count_if(campaign.engines(), [&](const EngineEntry& entry) {
    return entry.mirrors.empty() || isNamed(command.engines, entry);
  });
  if (const auto nothing =
          nothingJudged(setup, results["agreement"], static_cast<std::size_t>(named))) {
    results["nothing_judged"] = {{"reason", nothing->reason}, {"by_request", nothing->byRequest}};
    results["notes"].push_back(fmt::format("Nothing was judged: {}.", nothing->reason));
  }
  for (json& note : velocityNotes(results)) results["notes"].push_back(std::move(note));
  for (json& note : contactNotes(results)) results["notes"].push_back(std::move(note));
  return results;
}

}  // namespace crossgrain::inline runs

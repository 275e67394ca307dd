#include <fmt/format.h>

#include "runs/cost/campaign.hpp"

namespace crossgrain::inline runs {

using nlohmann::json;

std::string CostCampaign::dryRun() {
  campaign_.askEngines();
  campaign_.lookForPackings();
  std::vector<PlannedWork> works = campaign_.plan({});  // engines that refuse
  for (std::size_t e = 0; e < engines_.size(); ++e) {
    const auto& can = campaign_.capabilities(e);
    if (!can) continue;
    listSettings(e, *can);
    for (const CostKind kind : {CostKind::collision, CostKind::trajectory, CostKind::averages}) {
      const auto& settings = engines_[e].settings[static_cast<std::size_t>(kind)];
      PlannedWork work{entryOf(e).name, "settings, " + toString(kind)};
      for (std::size_t s = 0; s < settings.size(); ++s) {
        const bool looksOnly = kind == CostKind::averages && sharesRuns(settings[s]);
        if (!settings[s].refusal.empty() || looksOnly) continue;
        const bool kept = isKept({e, kind, s, 0.0, {}});
        count(work, kept ? std::optional(json()) : std::nullopt);
      }
      if (work.total > 0) works.push_back(work);
    }
  }
  return dryRunInWords(
      fmt::format("{}budget {:.0f} s; what fits into it is planned once steps have been timed\n",
                  campaign_.planHead(), request_.budget),
      works, campaign_.store(), request_.run);
}

}  // namespace crossgrain::inline runs

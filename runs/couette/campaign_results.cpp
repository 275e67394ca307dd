#include <fmt/format.h>

#include <algorithm>

#include "runs/couette/campaign.hpp"
#include "runs/couette/head.hpp"

namespace crossgrain::inline runs {

using nlohmann::json;

json Campaign::enginesJson() const {
  json list = json::array();
  for (std::size_t e = 0; e < engines_.size(); ++e) {
    std::string status = refusals_[e].empty() ? "ran" : "refused", reason = refusals_[e];
    for (const json& run : runs_)
      if (run["engine"] == engines_[e].name && run["status"] == "failed" && reason.empty()) {
        status = "failed";
        reason = run["reason"];
      }
    list.push_back({{"name", engines_[e].name},
                    {"summary", engines_[e].summary},
                    {"version", versions_[e]},
                    {"mirrors", engines_[e].mirrors},
                    {"status", status},
                    {"reason", reason}});
  }
  return list;
}

json Campaign::results(const std::string& kind) const {
  json results = couetteHead(kind, setup_, command_.commandLine, packings_.front().disks);
  results["engines"] = enginesJson();
  for (std::size_t k = 0; k < packings_.size(); ++k)
    results["packings"].push_back({{"index", k},
                                   {"seed", setup_.preparation.seed},
                                   {"hash", packings_[k].hash},
                                   {"from_cache", packings_[k].fromCache}});
  results["runs"] = runs_;
  results["notes"] = json::array();
  const bool all = std::ranges::find(command_.engines, "all") != command_.engines.end();
  for (const EngineEntry& entry : engineRegistry())
    if (all && entry.missing && !entry.missing().empty())
      results["notes"].push_back(
          fmt::format("{} was left out: it is not installed ({}).", entry.name, entry.missing()));
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - started_;
  results["elapsed_s"] = elapsed.count();
  return results;
}

}  // namespace crossgrain::inline runs

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cases/effect_switch.hpp"
#include "runs/campaign.hpp"
#include "runs/couette_run.hpp"
#include "runs/records.hpp"

namespace crossgrain {

using nlohmann::json;

namespace {

json cellJson(const Case& setup, const Disks& disks) {
  const Cell& cell = setup.cell;
  const auto small = std::ranges::count(disks.radius, setup.particles.smallRadius);
  double diskArea = 0.0;
  for (const double a : disks.radius) diskArea += a * a;
  const double cellArea = cell.outerRadius * cell.outerRadius - cell.innerRadius * cell.innerRadius;
  return {{"inner_radius", cell.innerRadius},
          {"outer_radius", cell.outerRadius},
          {"wall_radius", cell.wallRadius},
          {"wall_spacing", cell.wallSpacing},
          {"height", cell.height},
          {"omega", cell.omega},
          {"small", small},
          {"large", static_cast<std::ptrdiff_t>(disks.size()) - small},
          {"small_radius", setup.particles.smallRadius},
          {"large_radius", setup.particles.largeRadius},
          {"volume_fraction", diskArea / cellArea},
          {"diameter", 2.0 * setup.particles.smallRadius}};
}

}  // namespace

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
  json results = resultsHead(kind, setup_, command_.commandLine);
  results["cell"] = cellJson(setup_, packings_.front().disks);
  const Averaging& averaging = setup_.averaging;
  results["averaging"] = {
      {"method", averaging.methods.front()},
      {"settle_rotations", averaging.settleRotations},
      {"rotations", averaging.rotations},
      {"snapshots", std::lround(averaging.snapshotsPerRotation * averaging.rotations)},
      {"confidence", averaging.confidence}};
  for (const Effect effect : effectsOf(setup_)) results["effects"].push_back(toString(effect));
  results["engines"] = enginesJson();
  const Rings rings = ringsOf(setup_);
  for (int ring = 0; ring < rings.count(); ++ring) {
    results["rings"]["r"].push_back(rings.centre(ring));
    results["rings"]["r_tilde"].push_back(rings.rTilde(ring));
  }
  results["rings"]["width"] = rings.edge(1) - rings.edge(0);
  for (std::size_t k = 0; k < packings_.size(); ++k)
    results["packings"].push_back({{"index", k},
                                   {"seed", packingSeed(setup_, static_cast<int>(k))},
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

}  // namespace crossgrain

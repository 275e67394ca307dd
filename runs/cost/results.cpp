#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "runs/cost/averages.hpp"
#include "runs/cost/campaign.hpp"

namespace crossgrain::inline runs {

using nlohmann::json;

json CostCampaign::falls() const {
  json list = json::array();
  const std::string whole = setup_.averaging.methods.front();
  for (const auto& [engine, runs] : caseRuns_)
    for (const std::string& measure : averageMeasures())
      for (const double share : {0.25, 0.5, 1.0}) {
        const std::string view = crossgrain::nameOf({whole, 1, share});
        const auto error = weakError(runs, view, averagesReference_, view, measure);
        if (error && error->statistical)
          list.push_back({{"engine", entryOf(engine).name},
                          {"measure", measure},
                          {"rotations", share * setup_.averaging.rotations},
                          {"statistical", *error->statistical}});
      }
  return list;
}

json CostCampaign::references() const {
  json references = json::array();
  const double steps = setup_.cost.trajectoryReference;
  const auto addTrajectory = [&](const std::string& engine, const std::string& integrator,
                                 double error) {
    references.push_back(
        {{"error_kind", "trajectory"},
         {"engine", engine},
         {"setting", fmt::format("{}t_c/{:g}", integrator.empty() ? "" : integrator + ", ", steps)},
         {"error", error},
         {"note", "distance to the same at twice the step"}});
  };
  if (wants(CostKind::collision))
    references.push_back({{"error_kind", "collision"},
                          {"engine", "oracle"},
                          {"setting", "the case's law"},
                          {"error", nullptr},
                          {"note", collisions_.oracle.reason.empty()
                                       ? "planar two-body problem in continuous time, to 1e-9"
                                       : collisions_.oracle.reason}});
  if (inHouseReference_) addTrajectory(inHouse_.name, "", inHouseReference_->error);
  for (const auto& [at, reference] : ownReferences_)
    addTrajectory(entryOf(at.first).name, at.second, reference.error);
  if (!averagesReference_.empty())
    references.push_back(
        {{"error_kind", "averages"},
         {"engine", inHouse_.name},
         {"setting", fmt::format("t_c/{:g}", setup_.cost.averageReference)},
         {"error", nullptr},
         {"note", fmt::format("{} packings, paired: its statistical error is part of each point's",
                              averagesReference_.size())}});
  return references;
}

json CostCampaign::results() const {
  static const std::map<std::string, int> orders = {
      {"position_verlet", 2}, {"velocity_verlet", 2}, {"semi_implicit_euler", 1}};
  json results = campaign_.results("cost");
  results.erase("runs");
  results["points"] = json::array();
  for (const auto& [at, points] : points_)
    for (const CostPoint& point : points) results["points"].push_back(toJson(point));
  results["budget_s"] = request_.budget;
  results["budget_for_the_rest_s"] = budgetForTheRest_;
  results["startup"] = json::array();
  results["theory"] = json::object();
  for (std::size_t e = 0; e < engines_.size(); ++e) {
    const std::string& name = entryOf(e).name;
    if (!engines_[e].takesPart) continue;
    results["startup"].push_back(
        {{"engine", name}, {"start_s", engines_[e].start}, {"load_s", engines_[e].load}});
    if (const auto& realised = campaign_.realised(e))
      if (const auto found = orders.find(realised->integrator); found != orders.end())
        results["theory"][name] = found->second;
    for (const auto& [integrator, order] : orders)
      results["theory"][name + " " + integrator] = order;
  }
  results["references"] = references();
  if (wants(CostKind::trajectory)) results["trajectory"] = toJson(chaos_);
  results["averages"] = {{"falls", falls()}};
  results["engine_failures"] = engineFailures_;
  for (json& engine : results["engines"])
    for (const json& point : results["points"])
      if (point["engine"] == engine["name"] && point["status"] == "failed" &&
          std::ranges::find(engineFailures_, point["reason"].get<std::string>()) !=
              engineFailures_.end())
        engine.update({{"status", "failed"}, {"reason", point["reason"]}});
  return results;
}

}  // namespace crossgrain::inline runs

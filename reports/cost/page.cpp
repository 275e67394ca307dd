#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "reports/common/numbers.hpp"
#include "reports/common/page.hpp"
#include "reports/cost/tables.hpp"

namespace crossgrain::reports {

namespace {

/// The finest accuracy that some engine reaches, else the coarsest wanted.
std::string leadOf(const Json& results) {
  const auto wants = costWants(results);
  if (wants.empty()) return "Nothing was measured.";
  double finest = wants.front();
  for (const Json& one : list(results, "advice"))
    if (member(one, "cheapest") == Json(true))
      finest = std::min(finest, number(one, "want").value_or(finest));
  return wantInWords(results, finest);
}

std::string countsOf(const Json& results, const std::vector<CostRow>& rows) {
  std::map<std::string, std::size_t> counts;
  for (const CostRow& row : rows) ++counts[row.status];
  std::string words = fmt::format("{} points: {} ran", rows.size(), counts["ran"]);
  for (const char* status : {"failed", "refused"})
    if (counts[status] > 0) words += fmt::format(", {} {}", counts[status], status);
  if (counts["undecided"] == 0) return words + ".";
  words += fmt::format(", {} not measured, for they did not fit into the budget of {}",
                       counts["undecided"], readableDuration(number(results, "budget_s")));
  if (const auto left = number(results, "budget_for_the_rest_s"))
    words += fmt::format(": with --resume and a budget of about {} they would",
                         readableDuration(std::ceil(*left / 10.0) * 10.0));
  return words + ".";
}

std::string trajectoryInWords(const Json& results) {
  const Json& trajectory = member(results, "trajectory");
  const auto exponent = number(trajectory, "exponent_per_s");
  if (!exponent) return {};
  return fmt::format(
      "Trajectories part with the exponent {} per second; they are compared over {}{}.",
      readable(exponent, number(trajectory, "exponent_stderr")),
      readableDuration(number(trajectory, "window_s")),
      text(trajectory, "why").empty() ? "" : ": " + text(trajectory, "why"));
}

Json sentencesOf(const Json& results, const std::vector<CostRow>& rows, const std::string& lead) {
  Json sentences = Json::array();
  for (const double want : costWants(results))
    if (const std::string words = wantInWords(results, want); words != lead)
      sentences.push_back(words);
  for (const std::string& finding : unmetOrders(results)) sentences.push_back(finding);
  if (const std::string words = trajectoryInWords(results); !words.empty())
    sentences.push_back(words);
  sentences.push_back(countsOf(results, rows));
  for (const Json& engine : list(results, "engines"))
    if (text(engine, "status") == "refused")
      sentences.push_back(
          fmt::format("{} refused the scene: {}", text(engine, "name"), text(engine, "reason")));
  return sentences;
}

const char* errorOf(const std::string& kind) {
  if (kind == "collision")
    return "Two disks collide, over a whole curve of Ψ_i; the error is the root mean square "
           "distance "
           "from the oracle, in units of the range of its curve.";
  if (kind == "trajectory")
    return "One packing over a time short against its chaos; the error is the root mean square "
           "distance of the disks, in diameters, from a run at a much smaller step.";
  if (kind == "averages")
    return "Profiles and fitted numbers of a sheared cell, against a reference on the same "
           "packings: the mean paired difference, in units of the profile's largest value.";
  return "";
}

/// Figures that stand beside those of a kind of error.
constexpr std::array<std::pair<std::string_view, std::string_view>, 3> furtherFigures = {
    {{"trajectory", "cost_growth"}, {"averages", "cost_parts"}, {"averages", "cost_falls"}}};

Json kindViews(const std::vector<CostRow>& rows, const Illustrations& shown) {
  Json views = Json::array();
  for (const std::string& kind : costKinds(rows)) {
    Json figures = figureViews(shown, "cost_" + kind);
    for (const auto& [belongsTo, name] : furtherFigures)
      if (kind == belongsTo)
        for (Json& figure : figureViews(shown, name)) figures.push_back(std::move(figure));
    views.push_back(
        {{"kind", kind}, {"id", "kind-" + kind}, {"what", errorOf(kind)}, {"figures", figures}});
  }
  return views;
}

}  // namespace

std::string costPage(const Json& results, const Illustrations& shown) {
  const std::vector<CostRow> rows = costRows(results);
  const std::vector<EngineResults> engines = costEngines(results);
  Json view = commonView(results, shown);
  const std::string lead = leadOf(results);
  view["lead"] = lead;
  view["sentences"] = sentencesOf(results, rows, lead);
  view["wants"] = Json::array();
  for (const double want : costWants(results)) view["wants"].push_back(wantText(want));
  view["advice"] = adviceRows(results, engines);
  view["cheapest"] = cheapestGroups(results, engines);
  view["kinds"] = kindViews(rows, shown);
  view["contacts"] = figureViews(shown, "cost_contacts");
  view["orderFigures"] = figureViews(shown, "cost_orders_");
  view["orders"] = orderRows(results);
  view["knobs"] = knobGroups(results, engines);
  view["notRun"] = notRunRows(results);
  view["startup"] = startupRows(results);
  view["references"] = referenceRows(results);
  view["fragments"] = fragmentViews(results, engines);
  for (const char* table : {"orders", "knobs", "notRun", "startup", "references", "fragments"})
    view[fmt::format("has_{}", table)] = !view[table].empty();
  view["files"] = "Beside this page: results.json (everything) and cost.csv (every point).";
  return render("report_cost.html", view);
}

}  // namespace crossgrain::reports

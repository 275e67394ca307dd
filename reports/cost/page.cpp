#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "reports/common/labels.hpp"
#include "reports/common/numbers.hpp"
#include "reports/common/overview.hpp"
#include "reports/common/page.hpp"
#include "reports/cost/overview.hpp"
#include "reports/cost/report.hpp"
#include "reports/cost/tables.hpp"
#include "reports/cost/words.hpp"

namespace crossgrain::reports {

namespace {

std::string countsOf(const CostResults& results) {
  const auto count = [&](CostStatus status) {
    return std::ranges::count(results.points, status, &CostPoint::status);
  };
  std::string words =
      fmt::format("{} points: {} ran", results.points.size(), count(CostStatus::ran));
  for (const CostStatus status : {CostStatus::failed, CostStatus::refused})
    if (count(status) > 0) words += fmt::format(", {} {}", count(status), statusText(status));
  const auto notMeasured = count(CostStatus::notMeasured);
  if (notMeasured == 0) return words + ".";
  words += fmt::format(", {} not measured, for they did not fit into the budget of {}", notMeasured,
                       readableDuration(results.budget));
  if (const auto left = results.budgetForTheRest)
    words += fmt::format(": with --resume and a budget of about {} they would",
                         readableDuration(std::ceil(*left / 10.0) * 10.0));
  return words + ".";
}

std::string trajectoryInWords(const CostResults& results) {
  if (!results.trajectory || !results.trajectory->growth.exponent) return {};
  const auto& [separations, growth, window] = *results.trajectory;
  return fmt::format(
      "Trajectories part with the exponent {} per second; they are compared over {}{}.",
      readable(growth.exponent, growth.standardError), readableDuration(window.length),
      window.why.empty() ? "" : ": " + window.why);
}

Json sentencesOf(const CostResults& results) {
  Json sentences = Json::array();
  for (const std::string& words : accuracyInWords(results)) sentences.push_back(words);
  for (const std::string& finding : unmetOrders(results)) sentences.push_back(finding);
  if (const std::string words = trajectoryInWords(results); !words.empty())
    sentences.push_back(words);
  sentences.push_back(countsOf(results));
  for (const EngineRow& engine : results.engines)
    if (engine.status == EngineStatus::refused)
      sentences.push_back(fmt::format("{} refused the scene: {}", engine.name, engine.reason));
  return sentences;
}

const char* errorOf(CostKind kind) {
  constexpr std::array errors = {
      "Two disks collide, over a whole curve of Ψ_i; the error is the root mean square distance "
      "from the oracle, in units of the range of its curve.",
      "One packing over a time short against its chaos; the error is the root mean square "
      "distance of the disks, in diameters, from a run at a much smaller step.",
      "Profiles and fitted numbers of a sheared cell, against a reference on the same "
      "packings: the mean paired difference, in units of the profile's largest value."};
  return errors[static_cast<std::size_t>(kind)];
}

/// Figures that stand beside those of a kind of error.
constexpr std::array<std::pair<CostKind, std::string_view>, 3> furtherFigures = {
    {{CostKind::trajectory, "cost_growth"},
     {CostKind::averages, "cost_parts"},
     {CostKind::averages, "cost_falls"}}};

Json kindViews(const CostResults& results, const Illustrations& shown) {
  Json views = Json::array();
  for (const CostKind kind : kindsIn(results.points)) {
    Json figures = figureViews(shown, "cost_" + toString(kind));
    for (const auto& [belongsTo, name] : furtherFigures)
      if (kind == belongsTo)
        for (Json& figure : figureViews(shown, name)) figures.push_back(std::move(figure));
    views.push_back({{"kind", toString(kind)},
                     {"id", "kind-" + toString(kind)},
                     {"what", mathHtml(errorOf(kind))},
                     {"figures", figures}});
  }
  return views;
}

}  // namespace

std::string costPage(const CostResults& results, const Illustrations& shown) {
  const std::vector<CostEngine> engines = costEngines(results);
  Json view = commonView(results.head, results.elapsed, results.notes, shown);
  view["lead"] = decidedInWords(results);
  view["sentences"] = sentencesOf(results);
  addOverview(view, costOverview(results), results.engines);
  view["accuracies"] = accuracyTargets(results);
  view["accuracy"] = accuracyGroups(results, engines);
  view["wants"] = Json::array();
  for (const double target : costTargets(results)) view["wants"].push_back(targetText(target));
  view["together"] = Json::array();
  for (const double target : costTargets(results))
    view["together"].push_back(targetInWords(results, target));
  view["advice"] = adviceRows(results, engines);
  view["cheapest"] = cheapestGroups(results, engines);
  view["kinds"] = kindViews(results, shown);
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

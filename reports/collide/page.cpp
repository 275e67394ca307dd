#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

#include "reports/collide/scores.hpp"
#include "reports/common/labels.hpp"
#include "reports/common/numbers.hpp"
#include "reports/common/page.hpp"

namespace crossgrain::reports {

namespace {

/// HTML: "Law: normal linear, tangential spring dashpot, …" of what all variants share.
std::string lawOf(const CaseGroup& group) {
  std::vector<std::string> shared;
  for (const auto& [option, value] : member(*group.variants.front(), "law").items()) {
    const bool same =
        std::ranges::all_of(group.variants, [&, &option = option, &value = value](const Json* v) {
          return member(member(*v, "law"), option) == value;
        });
    if (!same) continue;
    if (value.is_string())
      shared.push_back(spaced(option) + " " + spaced(value.get<std::string>()));
    else if (const auto constant = number(value))
      shared.push_back(spaced(option) + " " + readableSetting(constant));
  }
  return mathHtml(fmt::format("Law of all variants: {}.", fmt::join(shared, ", ")));
}

/// Empty, or which points were not judged because the law has no limit of small time steps there.
std::string limitsOf(const CaseGroup& group) {
  std::vector<std::string> places;
  for (const Json* variant : group.variants) {
    std::vector<std::pair<std::string, std::vector<std::string>>> byReason;
    for (const Json& point : list(*variant, "no_limit")) {
      const std::string reason = text(point, "reason");
      auto found = std::ranges::find(byReason, reason, [](const auto& one) { return one.first; });
      if (found == byReason.end()) found = byReason.insert(found, {reason, {}});
      const std::string psi = readableSetting(number(point, "psi_i"));
      if (std::ranges::find(found->second, psi) == found->second.end())
        found->second.push_back(psi);
    }
    for (const auto& [reason, psi] : byReason)
      places.push_back(
          fmt::format("{}, Ψ_i = {}: {}", text(*variant, "variant"), fmt::join(psi, ", "), reason));
    if (const std::string reason = text(*variant, "oracle_reason"); !reason.empty())
      places.push_back(text(*variant, "variant") + ": " + reason);
  }
  if (places.empty()) return {};
  return mathHtml(fmt::format("Not judged: {}.", fmt::join(places, "; ")));
}

Json caseViews(const Json& results, const std::vector<CaseGroup>& groups,
               const std::vector<EngineResults>& engines, const Illustrations& shown) {
  Json views = Json::array();
  for (const CaseGroup& group : groups) {
    const std::string figure = fmt::format("collision_{}", views.size() + 1);
    Json curves = Json::array(), energies = Json::array();
    for (Json& view : figureViews(shown, "collision_")) {
      if (text(view, "file") == figure)
        curves.push_back(std::move(view));
      else if (text(view, "file") == figure + "_energy")
        energies.push_back(std::move(view));
    }
    Json mirrors = mirrorRows(group, engines);
    views.push_back({{"id", fmt::format("case_{}", views.size() + 1)},
                     {"name", group.name},
                     {"law", lawOf(group)},
                     {"limits", limitsOf(group)},
                     {"curves", std::move(curves)},
                     {"energies", std::move(energies)},
                     {"variants", variantRows(results, group, engines)},
                     {"hasMirrors", !mirrors.empty()},
                     {"mirrors", std::move(mirrors)},
                     {"heads", scoreHeads(group)},
                     {"scores", scoreRows(group)}});
  }
  return views;
}

Json engineRows(const std::vector<EngineResults>& engines) {
  Json rows = columnsView(engines);
  for (std::size_t k = 0; k < engines.size(); ++k)
    for (const char* key : {"version", "status", "mirrors", "summary", "reason"})
      rows[k][key] = text(*engines[k].entry, key);
  return rows;
}

void addSummary(Json& view, const Json& results, const std::vector<EngineResults>& engines) {
  std::map<std::string, std::map<std::string, std::size_t>> counts;
  for (const Json& variant : list(results, "variants"))
    for (const Json& curve : list(variant, "curves"))
      ++counts[text(curve, "engine")][verdictOf(curve)];
  const CollideCount all = countOf(results);
  const auto judged = static_cast<std::size_t>(all.judged());
  if (judged == 0)
    view["lead"] = fmt::format("Nothing was judged: {}.", nothingJudged(results));
  else
    view["lead"] =
        fmt::format("{} of {} held to the oracle within {} limit{}.", all.held,
                    counted(judged, "judged sweep"), judged == 1 ? "its" : "their",
                    all.notJudged == 0 ? "" : fmt::format("; {} not judged", all.notJudged));
  view["sentences"] = Json::array();
  for (const EngineResults& engine : engines) {
    if (!engine.mirrors.empty()) continue;
    std::vector<std::string> words;
    for (const auto& [verdict, count] : counts[engine.name])
      words.push_back(fmt::format("{} {}", count, verdict));
    const std::string reason = text(*engine.entry, "reason");
    view["sentences"].push_back(
        fmt::format("{}: {}{}", engine.name,
                    words.empty() ? engine.status : fmt::format("{}", fmt::join(words, ", ")),
                    reason.empty() ? "." : ": " + reason));
  }
}

}  // namespace

std::string collidePage(const Json& results, const Illustrations& shown) {
  const std::vector<EngineResults> engines = engineResults(results);
  std::vector<RealisedOf> realised;
  for (const Json& variant : list(results, "variants"))
    for (const Json& curve : list(variant, "curves"))
      if (member(curve, "realised").is_object())
        realised.push_back(
            {text(curve, "engine"), &member(curve, "realised"), &member(variant, "effects")});

  const std::vector<CaseGroup> groups = casesOf(results);
  Json view = commonView(results, shown);
  addSummary(view, results, engines);
  view["engines"] = engineRows(engines);
  view["matrix"] = matrixRows(groups, engines);
  view["cases"] = caseViews(results, groups, engines, shown);
  addDetails(view, realised);
  view["files"] = "Beside this page: results.json (everything) and collisions.csv.";
  return render("report_collide.html", view);
}

}  // namespace crossgrain::reports

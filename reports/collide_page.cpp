#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

#include "reports/collide_scores.hpp"
#include "reports/labels.hpp"
#include "reports/numbers.hpp"
#include "reports/page.hpp"

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

/// Empty, or where the law has no limit of small time steps.
std::string limitsOf(const CaseGroup& group) {
  std::vector<std::string> ranges;
  for (const Json* variant : group.variants) {
    const Json& oracle = member(*variant, "oracle");
    std::vector<double> psi;
    for (std::size_t k = 0; k < rowCount(oracle); ++k)
      if (element(list(oracle, "limitless"), k) == Json(true))
        psi.push_back(at(oracle, "psi_i", k).value_or(0.0));
    if (!psi.empty())
      ranges.push_back(
          fmt::format("{}: {}{}", text(*variant, "variant"), readable(psi.front()),
                      psi.front() == psi.back() ? std::string() : " to " + readable(psi.back())));
    if (const std::string reason = text(*variant, "oracle_reason"); !reason.empty())
      ranges.push_back(text(*variant, "variant") + ": " + reason);
  }
  if (ranges.empty()) return {};
  return fmt::format(
      "Here the outcome goes on varying with the time step, however small, and the oracle gives "
      "one "
      "of a narrow family, or none (variant: Ψ): {}.",
      fmt::join(ranges, "; "));
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
  std::size_t held = 0, fellShort = 0;
  for (const Json& variant : list(results, "variants"))
    for (const Json& curve : list(variant, "curves")) {
      const std::string verdict = verdictOf(curve);
      ++counts[text(curve, "engine")][verdict];
      held += verdict == "held";
      fellShort += verdict == "fell short";
    }
  const std::size_t judged = held + fellShort;
  view["lead"] = judged == 0
                     ? "No sweep could be judged."
                     : fmt::format("{} of {} held to the oracle within {} limit.", held,
                                   counted(judged, "judged sweep"), judged == 1 ? "its" : "their");
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
        realised.push_back({text(curve, "engine"), &member(curve, "realised")});

  const std::vector<CaseGroup> groups = casesOf(results);
  Json view = commonView(results, shown);
  addSummary(view, results, engines);
  view["engines"] = engineRows(engines);
  view["matrix"] = matrixRows(groups, engines);
  view["cases"] = caseViews(results, groups, engines, shown);
  addDetails(view, results, realised);
  view["files"] = "Beside this page: results.json (everything) and collisions.csv.";
  return render("report_collide.html", view);
}

}  // namespace crossgrain::reports

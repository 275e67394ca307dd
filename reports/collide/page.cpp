#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <deque>
#include <map>

#include "reports/collide/overview.hpp"
#include "reports/collide/report.hpp"
#include "reports/collide/scores.hpp"
#include "reports/common/labels.hpp"
#include "reports/common/numbers.hpp"
#include "reports/common/overview.hpp"
#include "reports/common/page.hpp"
#include "results/engine_fields.hpp"

namespace crossgrain::reports {

namespace {

/// HTML: "Law: normal linear, tangential spring dashpot, …" of what all variants share.
std::string lawOf(const CaseGroup& group) {
  std::vector<std::string> shared;
  for (const auto& [option, value] : group.variants.front()->law) {
    const bool same = std::ranges::all_of(
        group.variants, [&, &option = option, &value = value](const CollisionVariant* variant) {
          const auto found = variant->law.find(option);
          return found != variant->law.end() && found->second == value;
        });
    if (!same) continue;
    if (auto words = lawWords(option, value)) shared.push_back(std::move(*words));
  }
  return mathHtml(fmt::format("Law of all variants: {}.", fmt::join(shared, ", ")));
}

/// Empty, or HTML: in what the laws that engines declare are others than the scene's, over all
/// variants.
std::string declaredOf(const CollideResults& results, const CaseGroup& group) {
  std::vector<std::string> laws;
  for (const EngineRow& engine : results.engines) {
    if (runsBesideItsPeer(results, engine.name)) continue;  // its peer's law
    std::vector<std::string> words;
    for (const CollisionVariant* variant : group.variants)
      for (const CollisionCurve* curve : curvesOf(*variant, engine.name)) {
        if (!curve->declared) continue;
        for (const auto& [name, value] : curve->declared->law) {
          std::string word = lawWords(name, value).value_or(spaced(name));
          if (std::ranges::find(words, word) == words.end()) words.push_back(std::move(word));
        }
      }
    if (!words.empty()) laws.push_back(fmt::format("{}: {}", engine.name, fmt::join(words, ", ")));
  }
  if (laws.empty()) return {};
  return mathHtml(fmt::format("Declared instead: {}.", fmt::join(laws, "; ")));
}

/// Empty, or which points were not judged because the law has no limit of small time steps there.
std::string limitsOf(const CaseGroup& group) {
  std::vector<std::string> places;
  for (const CollisionVariant* variant : group.variants) {
    std::vector<std::pair<std::string, std::vector<std::string>>> byReason;
    for (const NoLimitPoint& point : variant->noLimit) {
      auto found =
          std::ranges::find(byReason, point.reason, [](const auto& one) { return one.first; });
      if (found == byReason.end()) found = byReason.insert(found, {point.reason, {}});
      const std::string psi = readableSetting(finite(point.psi));
      if (std::ranges::find(found->second, psi) == found->second.end())
        found->second.push_back(psi);
    }
    for (const auto& [reason, psi] : byReason)
      places.push_back(
          fmt::format("{}, Ψ_i = {}: {}", variant->variant, fmt::join(psi, ", "), reason));
    if (!variant->oracleReason.empty())
      places.push_back(variant->variant + ": " + variant->oracleReason);
  }
  if (places.empty()) return {};
  return mathHtml(fmt::format("Not judged: {}.", fmt::join(places, "; ")));
}

Json engineRows(const std::vector<EngineRow>& engines) {
  const std::vector<LineStyle> styles = engineStyles(engines);
  Json rows = Json::array();
  for (std::size_t k = 0; k < engines.size(); ++k)
    rows.push_back({{"name", engines[k].name},
                    {"colour", styles[k].colour},
                    {"dashed", styles[k].dashed},
                    {"version", engines[k].version},
                    {"status", nameOf(engines[k].status)},
                    {"mirrors", engines[k].mirrors},
                    {"summary", engines[k].summary},
                    {"reason", engines[k].reason}});
  return rows;
}

/// Those that have a point in the case: the legend names no others.
Json drawnEngines(const CollideResults& results, const CaseGroup& group) {
  Json drawn = Json::array();
  for (Json& row : engineRows(results.engines))
    if (std::ranges::any_of(group.variants, [&](const CollisionVariant* variant) {
          return coarsestCurve(*variant, row.at("name")) != nullptr;
        }))
      drawn.push_back(std::move(row));
  return drawn;
}

Json caseViews(const CollideResults& results, const std::vector<CaseGroup>& groups,
               const Illustrations& shown) {
  const Json figures = figureViews(shown, "collision_");
  Json views = Json::array();
  for (const CaseGroup& group : groups) {
    const std::string figure = fmt::format("collision_{}", views.size() + 1);
    Json curves = Json::array(), energies = Json::array();
    for (const Json& view : figures) {
      if (view.at("file") == figure)
        curves.push_back(view);
      else if (view.at("file") == figure + "_energy")
        energies.push_back(view);
    }
    Json mirrors = mirrorRows(group, results.engines);
    views.push_back({{"id", fmt::format("case_{}", views.size() + 1)},
                     {"name", group.name},
                     {"law", lawOf(group)},
                     {"declared", declaredOf(results, group)},
                     {"limits", limitsOf(group)},
                     {"curves", std::move(curves)},
                     {"energies", std::move(energies)},
                     {"drawn", drawnEngines(results, group)},
                     {"variants", variantRows(results, group)},
                     {"hasMirrors", !mirrors.empty()},
                     {"mirrors", std::move(mirrors)},
                     {"heads", scoreHeads(group)},
                     {"scores", scoreRows(group)}});
  }
  return views;
}

void addSummary(Json& view, const CollideResults& results) {
  using Counts = std::map<std::string_view, int>;  // by the outcomes' names
  std::map<std::string, Counts> counts;
  for (const CollisionVariant& variant : results.variants)
    for (const CollisionCurve& curve : variant.curves)
      ++counts[curve.engine][nameOf(outcomeOf(curve))];
  const CollideCount all = countOf(results);
  const auto judged = static_cast<std::size_t>(all.judged());
  if (judged == 0)
    view["lead"] = fmt::format("Nothing was judged: {}.", nothingJudged(results));
  else
    view["lead"] = fmt::format(
        "{} of {} held within {} limits{}; {} fell short{}.", all.held,
        counted(judged, "judged sweep"), judged == 1 ? "its" : "their",
        all.modelDifference == 0
            ? ""
            : fmt::format("; {} differ by their model: they hold to the law that their engine "
                          "declares, but not to the scene's",
                          all.modelDifference),
        all.fellShort, all.notJudged == 0 ? "" : fmt::format("; {} not judged", all.notJudged));
  view["sentences"] = Json::array();
  for (const EngineRow& engine : results.engines) {
    if (!engine.mirrors.empty()) continue;
    std::vector<std::string> words;
    for (const auto& [outcome, count] : counts[engine.name])
      words.push_back(fmt::format("{} {}", count, outcome));
    if (words.empty()) words.emplace_back(nameOf(engine.status));
    view["sentences"].push_back(fmt::format("{}: {}{}", engine.name, fmt::join(words, ", "),
                                            engine.reason.empty() ? "." : ": " + engine.reason));
  }
}

/// What engines made of each variant's scenes.
void addRealised(Json& view, const CollideResults& results) {
  std::vector<RealisedScene> realised;
  for (const CollisionVariant& variant : results.variants)
    for (const CollisionCurve& curve : variant.curves)
      if (curve.realised)
        realised.push_back(
            {curve.engine, &*curve.realised, variant.effects ? &*variant.effects : nullptr});
  addDetails(view, realised);
}

}  // namespace

std::string collidePage(const CollideResults& results, const Illustrations& shown) {
  const std::vector<CaseGroup> groups = casesOf(results);
  Json view = commonView(results.head, results.elapsed, {}, shown);
  addSummary(view, results);
  addOverview(view, collideOverview(results), results.engines);
  view["engines"] = engineRows(results.engines);
  view["matrix"] = matrixRows(groups, results.engines);
  view["cases"] = caseViews(results, groups, shown);
  addRealised(view, results);
  view["files"] = "Beside this page: results.json (everything) and collisions.csv.";
  return render("report_collide.html", view);
}

}  // namespace crossgrain::reports

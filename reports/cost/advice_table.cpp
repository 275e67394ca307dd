#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

#include "reports/common/page.hpp"
#include "reports/cost/cells.hpp"
#include "reports/cost/tables.hpp"
#include "reports/cost/words.hpp"

namespace crossgrain::reports {

namespace {

/// Null where there is none.
const Advice* adviceOn(const CostResults& results, const std::string& engine, double target) {
  for (const Advice& one : results.advice)
    if (one.engine == engine && one.target == target) return &one;
  return nullptr;
}

/// "averages, radial stress: 0.31 % ± 3 %"
std::string obstacleText(const CostPoint* point) {
  if (!point) return {};
  return fmt::format("{}, {}: {}", toString(point->kind), measureWords(point->measure),
                     errorText(*point));
}

Json adviceCell(const CostPoints& points, const Advice& one) {
  const std::string verdict = toString(one.verdict), setting = settingWords(one);
  if (one.setting.empty()) return verdictCell(one.verdict, verdict, {decidesText(one.decides)});
  const bool reached = one.verdict == CostVerdict::reached;
  const std::string best = one.verdict == CostVerdict::notMeasured ? "best so far: " : "best: ";
  return verdictCell(
      one.verdict, reached ? setting : verdict,
      {reached ? "" : best + setting, costText(one), one.cheapest ? "the cheapest engine" : "",
       reached ? lengthText(one.length) : "", obstacleText(pointAt(points, one.obstacle)),
       decidesText(one.decides), one.kinds.size() < 2 ? "in " + inWords(one.kinds) + " only" : ""});
}

/// Of an engine that nothing is said of.
Json emptyCell() {
  return {{"symbol", ""}, {"class", ""}, {"text", ""}, {"lines", Json::array()}};
}

}  // namespace

std::vector<double> costTargets(const CostResults& results) {
  std::vector<double> targets;
  for (const Advice& one : results.advice) targets.push_back(one.target);
  for (const Cheapest& one : results.cheapest) targets.push_back(one.target);
  std::ranges::sort(targets, std::ranges::greater());
  const auto rest = std::ranges::unique(targets);
  targets.erase(rest.begin(), rest.end());
  return targets;
}

std::string targetInWords(const CostResults& results, double target) {
  const Advice* cheapest = nullptr;
  std::array<std::size_t, namesOf(CostVerdict()).size()> count{};
  std::size_t all = 0;
  for (const Advice& one : results.advice) {
    if (one.target != target) continue;
    ++all;
    ++count[static_cast<std::size_t>(one.verdict)];
    if (one.cheapest) cheapest = &one;
  }
  const auto [reached, undecided, notReached, notMeasured] = count;
  std::vector<std::string> others;
  if (undecided > 0) others.push_back(fmt::format("of {} it is undecided", undecided));
  if (notMeasured > 0)
    others.push_back(fmt::format("of {} not measured far enough to tell", notMeasured));
  if (notReached > 0)
    others.push_back(fmt::format("{} {} not reach it with any setting measured", notReached,
                                 notReached == 1 ? "does" : "do"));
  const std::string open = others.empty() ? "" : fmt::format("; {}", fmt::join(others, ", "));
  if (all == 0) return fmt::format("{}: nothing was measured.", targetText(target));
  if (notReached == all)
    return fmt::format("{}: no engine reaches it with any setting measured.", targetText(target));
  if (!cheapest)
    return fmt::format("{}: of {}, none is shown to reach it{}.", targetText(target),
                       counted(all, "engine"), open);
  return fmt::format(
      "{}: cheapest with {} at {}, {} (measured in {}); {} of {} engines reach it{}.",
      targetText(target), cheapest->engine, settingWords(*cheapest), costText(*cheapest),
      inWords(cheapest->kinds), reached, all, open);
}

Json adviceRows(const CostResults& results, const std::vector<CostEngine>& engines) {
  Json rows = Json::array();
  for (const CostEngine& engine : engines) {
    Json row = headOf(engine);
    row["cells"] = Json::array();
    for (const double target : costTargets(results)) {
      const Advice* one = adviceOn(results, engine.name, target);
      row["cells"].push_back(one ? adviceCell(results.points, *one) : emptyCell());
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

Json fragmentViews(const CostResults& results, const std::vector<CostEngine>& engines) {
  Json views = Json::array();
  for (const CostEngine& engine : engines) {
    std::vector<std::pair<const Advice*, std::vector<std::string>>> settings;
    for (const double target : costTargets(results)) {
      const Advice* one = adviceOn(results, engine.name, target);
      if (!one || one->verdict != CostVerdict::reached) continue;
      if (settings.empty() || settings.back().first->setting != one->setting)
        settings.push_back({one, {}});
      settings.back().second.push_back(targetText(target));
    }
    for (const auto& [one, targets] : settings)
      views.push_back(
          {{"engine", engine.name},
           {"wants", fmt::format("{}", fmt::join(targets, ", "))},
           {"setting", settingWords(*one)},
           {"fragment", one->fragment.empty() ? "# the case as it is" : one->fragment}});
  }
  return views;
}

}  // namespace crossgrain::reports

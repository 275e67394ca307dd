#include "reports/cost/overview.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/common/numbers.hpp"
#include "reports/common/page.hpp"
#include "reports/common/sentences.hpp"
#include "reports/cost/points.hpp"
#include "reports/cost/tables.hpp"
#include "reports/cost/words.hpp"

namespace crossgrain::reports {

namespace {

/// A number and its unit stay in one line.
std::string unbroken(std::string text) {
  if (const std::size_t at = text.find(' '); at != std::string::npos) text.replace(at, 1, "\u00a0");
  return text;
}

const CostCell* cellAt(const CostResults& results, const std::string& engine, CostKind kind,
                       CostBasis basis, double target) {
  for (const CostCell& cell : results.cells)
    if (cell.engine == engine && cell.kind == kind && cell.basis == basis && cell.target == target)
      return &cell;
  return nullptr;
}

const CostModel* modelOf(const CostResults& results, const CostCell& cell) {
  return cell.model && *cell.model < results.models.size() ? &results.models[*cell.model] : nullptr;
}

/// "its own law: t_c/50, 0.3 s"; empty where that is not reached either.
std::string ownInWords(const CostResults& results, const CostCell& scene) {
  const CostCell* own = cellAt(results, scene.engine, scene.kind, CostBasis::own, scene.target);
  if (!own || own->verdict != CostVerdict::reached) return {};
  std::string words = "its own law: " + plainSetting(own->knob, own->setting);
  if (own->wallSeconds) words += ", " + shortDuration(own->wallSeconds);
  return words;
}

OverviewCell cellOf(const CostResults& results, const CostCell* cost) {
  OverviewCell cell{CellState::notMeasured, {}, "s", {}, {}, "accuracy"};
  if (!cost) return cell;
  const CostPoint* point = pointAt(results.points, cost->point);
  switch (cost->verdict) {
    case CostVerdict::reached:
      cell.state = CellState::good;
      cell.value = cost->wallSeconds;
      cell.shown = shortDuration(cost->wallSeconds);
      cell.words = plainSetting(cost->knob, cost->setting);
      return cell;
    case CostVerdict::undecided:
      cell.state = CellState::undecided;
      break;
    case CostVerdict::notReached:
      cell.state = CellState::bad;
      break;
    case CostVerdict::notMeasured:
      return cell;
  }
  cell.unit = "%";
  if (const CostModel* model = modelOf(results, *cost)) {
    cell.state = CellState::modelDifference;
    cell.value = 100.0 * model->error;
    cell.shown = percentText(model->error) + " off";
    cell.words = measureWords(sceneOf(model->measure));
  } else if (point && countedError(*point)) {
    cell.value = 100.0 * *countedError(*point);
    cell.shown = percentText(countedError(*point)) + " off";
    cell.words = measureWords(sceneOf(point->measure));
  }
  if (const std::string own = ownInWords(results, *cost); !own.empty())
    cell.words += (cell.words.empty() ? "" : "; ") + own;
  return cell;
}

/// In each kind of error the finest accuracy that anyone reaches, and who does for the least time.
std::string finestReached(const CostResults& results, const std::vector<double>& targets) {
  std::vector<std::string> parts;
  for (const CostKind kind : kindsIn(results.points)) {
    const CostCell* finest = nullptr;
    for (const double target : targets)
      if (const CostCell* cell = cheapestOf(results, kind, target);
          cell && (!finest || cell->target < finest->target))
        finest = cell;
    parts.push_back(finest ? fmt::format("{} {} by {} with {} ({} for {})", kindWords(kind),
                                         targetText(finest->target), finest->engine,
                                         plainSetting(finest->knob, finest->setting),
                                         shortDuration(finest->wallSeconds), timeUnit(kind))
                           : fmt::format("{} by no engine as far as measured", kindWords(kind)));
  }
  if (parts.empty()) return "Nothing was measured.";
  return fmt::format("Finest accuracy of the case's law that is reached, for the least time: {}.",
                     listed(parts));
}

/// Whose law is off the case's by more than an accuracy that is wanted, in what, by how much.
std::string whoseModel(const CostResults& results) {
  std::vector<std::string> parts, engines;
  for (const CostCell& cell : results.cells) {
    const CostModel* model = modelOf(results, cell);
    if (!model || std::ranges::find(engines, cell.engine) != engines.end()) continue;
    const CostModel* worst = model;
    for (const CostCell& other : results.cells)
      if (const CostModel* one = modelOf(results, other);
          one && other.engine == cell.engine && one->error > worst->error)
        worst = one;
    engines.push_back(cell.engine);
    parts.push_back(fmt::format("{} by {} in {}", cell.engine, percentText(worst->error),
                                measureWords(sceneOf(worst->measure))));
  }
  if (parts.empty()) return {};
  return fmt::format("No time step mends a law that is not the case's: {}.",
                     listedShortly(parts, 3));
}

std::string nextStep(const CostResults& results) {
  const auto count = [&](auto value, auto member) {
    return static_cast<std::size_t>(std::ranges::count(results.points, value, member));
  };
  const std::size_t left = count(CostStatus::notMeasured, &CostPoint::status);
  if (left > 0 && results.budgetForTheRest)
    return fmt::format(
        "Next: the same command with --budget {:.0f}s measures the {} that did not "
        "fit into the budget.",
        std::ceil(*results.budgetForTheRest / 10.0) * 10.0, counted(left, "point"));
  const auto open = std::ranges::count_if(results.cells, [](const CostCell& cell) {
    return cell.basis == CostBasis::scene && cell.verdict == CostVerdict::undecided;
  });
  if (open > 0)
    return "Next: what is undecided takes more packings or longer runs; the table below says "
           "which.";
  if (left > 0) return fmt::format("{} were not measured.", counted(left, "point"));
  return "Next: take the fragment of the setting that you need from the end of this page.";
}

}  // namespace

Overview costOverview(const CostResults& results) {
  Overview overview;
  std::vector<double> targets;
  for (const CostCell& cell : results.cells)
    if (std::ranges::find(targets, cell.target) == targets.end()) targets.push_back(cell.target);
  const std::vector<CostKind> kinds = kindsIn(results.points);
  for (const CostKind kind : kinds)
    for (const double target : targets)
      overview.columns.push_back(
          {fmt::format("{} {}", kindWords(kind), unbroken(targetText(target))),
           fmt::format("Which setting brings the error of {} below {} for the least time? Time of "
                       "{}.",
                       kindWords(kind), targetText(target), timeUnit(kind)),
           "kind-" + toString(kind)});
  for (const CostEngine& engine : costEngines(results)) {
    OverviewRow row{engine.name, true, {}};
    for (const CostKind kind : kinds)
      for (const double target : targets)
        row.cells.push_back(
            cellOf(results, cellAt(results, engine.name, kind, CostBasis::scene, target)));
    overview.rows.push_back(std::move(row));
  }
  for (std::string& sentence :
       std::vector{finestReached(results, targets), whoseModel(results), nextStep(results)})
    if (!sentence.empty()) overview.conclusion.push_back(std::move(sentence));
  return overview;
}

}  // namespace crossgrain::reports

// Of rigid bodies: what small steps and what iterations buy.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "reports/common/engines.hpp"
#include "reports/cost/report.hpp"

namespace crossgrain::reports {

namespace {

/// "iterations = 8, dt/2" is of the row "iterations = 8": all but the step.
std::string rowOf(const CostPoint& point) {
  const std::string row = withoutStep(point.knob, point.setting);
  return row.empty() ? "as the case has them" : row;
}

/// Index of the kind of change: the step alone, another setting alone, or both.
std::size_t changedIn(const CostPoint& point) {
  if (point.knob == "time_step") return 0;
  return point.setting.find(',') == std::string::npos ? 1 : 2;
}

/// The cheapest within the margins by steps, iterations and both: "dt/4: 12 ms".
Table tradeTable(const CostResults& results, const std::vector<const CostPoint*>& points) {
  Table table{{engineNames("engine"), remarks("by the step alone"), remarks("by iterations alone"),
               remarks("by both")}};
  for (const EngineRow& engine : results.engines) {
    std::array<const CostPoint*, 3> best = {}, nearest = {};
    for (const CostPoint* point : points) {
      if (point->engine != engine.name) continue;
      const auto better = [&](const CostPoint*& known, bool than) {
        if (!known || than) known = point;
      };
      const std::size_t changed = changedIn(*point);
      better(nearest[changed], nearest[changed] && *point->error < *nearest[changed]->error);
      if (point->high() <= 1.0 && point->time())
        better(best[changed], best[changed] && *point->time() < *best[changed]->time());
    }
    TableRow row{{engine.name}};
    for (std::size_t k = 0; k < best.size(); ++k)
      if (best[k])
        row.cells.push_back({settingText(best[k]->knob, best[k]->setting),
                             {readableDuration(best[k]->time())},
                             Verdict::pass,
                             true});
      else if (nearest[k])
        row.cells.push_back({readable(nearest[k]->error) + " margins off",
                             {"best: " + settingText(nearest[k]->knob, nearest[k]->setting)},
                             Verdict::fail,
                             true});
      else
        row.cells.push_back(absentText);
    if (row.cells.size() > 1 && (nearest[0] || nearest[1])) table.rows.push_back(std::move(row));
  }
  table.note =
      "The cheapest setting within the margins of all endpoints, with its processor time of a "
      "second "
      "of the scene, or the setting that is nearest to them. Iterations alone: at the case's step.";
  return table;
}

/// Error at each step and number of iterations, with its time.
Table mapTable(const std::vector<const CostPoint*>& points) {
  std::vector<double> steps;
  for (const CostPoint* point : points)
    if (point->dt && std::ranges::find(steps, *point->dt) == steps.end())
      steps.push_back(*point->dt);
  std::ranges::sort(steps, std::greater<>());
  Table table{{"iterations"}};
  for (const double dt : steps) table.columns.push_back(numbers(readableDuration(dt)));
  std::string engine;
  for (const CostPoint* point : points) {
    if (!point->dt) continue;
    const bool begins = point->engine != engine;
    if (begins || table.rows.back().cells.front().text != rowOf(*point)) {
      table.rows.push_back(
          {std::vector<Cell>(1 + steps.size(), Cell(absentText)), begins ? point->engine : ""});
      table.rows.back().cells.front() = rowOf(*point);
    }
    engine = point->engine;
    const auto column = std::ranges::find(steps, *point->dt) - steps.begin();
    table.rows.back().cells[static_cast<std::size_t>(1 + column)] = {
        readable(point->error),
        {readableDuration(point->time())},
        point->high() <= 1.0 ? Verdict::pass : Verdict::fail,
        false};
  }
  table.note =
      "The largest error of an endpoint, in margins, at each time step; below it the processor "
      "time "
      "of a second of the scene.";
  return table;
}

}  // namespace

std::vector<const CostPoint*> largestErrors(const CostResults& results) {
  const bool several =
      std::ranges::find(results.points, largestError, &CostPoint::measure) != results.points.end();
  std::vector<const CostPoint*> points;
  for (const CostPoint& point : results.points)
    if (point.measured() && (!several || point.measure == largestError)) points.push_back(&point);
  return points;
}

Blocks tradeBlocks(const CostResults& results) {
  const auto points = largestErrors(results);
  return {tradeTable(results, points), Heading{"Error at each step and number of iterations"},
          mapTable(points)};
}

}  // namespace crossgrain::reports

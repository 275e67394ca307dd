#include "runs/cost/cheapest.hpp"

#include <algorithm>

#include "runs/cost/target.hpp"

namespace crossgrain::inline runs {

Cheapest cheapest(const std::vector<CostPoint>& points, const std::string& engine, CostKind kind,
                  const std::string& measure, double target) {
  Cheapest found{.engine = engine, .kind = kind, .measure = measure, .target = target};
  PointIndices meet, may, all, notRun;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const CostPoint& point = points[k];
    if (point.engine != engine || point.kind != kind || point.measure != measure) continue;
    if (point.status == CostStatus::notMeasured) notRun.push_back(k);
    if (!point.ran() || !measuredError(point)) continue;
    all.push_back(k);
    const Standing standing = standingOf(point, target);
    if (standing == Standing::meets) meet.push_back(k);
    if (standing == Standing::may) may.push_back(k);
  }
  const auto time = [&](std::size_t k) { return timeOf(points[k]); };
  const auto high = [&](std::size_t k) { return measuredError(points[k])->high(); };
  const auto fastestThatMay = least(may, time);
  if (!meet.empty()) {
    found.verdict = CostVerdict::reached;
    found.point = least(meet, time);
    if (fastestThatMay && time(*fastestThatMay) < time(*found.point))
      found.cheaper = fastestThatMay;
  } else if (fastestThatMay) {
    found.verdict = CostVerdict::undecided;
    found.point = fastestThatMay;
  } else if (!all.empty()) {
    found.verdict = CostVerdict::notReached;
    found.point = least(all, high);
    if (const auto missing = mayYetReach(points, notRun, points[*found.point])) {
      found.verdict = CostVerdict::notMeasured;
      found.decides = notRunInWords(points[*missing], notRun.size());
    }
  } else if (!notRun.empty()) {
    found.decides = notRunInWords(points[notRun.front()], notRun.size());
  }
  if (found.point) {
    found.high = high(*found.point);
    found.length = lengthFor(points[*found.point], target);
  }
  const auto open = found.verdict == CostVerdict::undecided ? found.point : found.cheaper;
  if (open && found.decides.empty()) found.decides = whatDecides(points[*open], target);
  return found;
}

std::vector<Cheapest> cheapestTable(const std::vector<CostPoint>& points,
                                    const std::vector<double>& targets) {
  std::vector<Cheapest> table;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const CostPoint& point = points[k];
    const auto same = [&](const Cheapest& row) {
      return row.engine == point.engine && row.kind == point.kind && row.measure == point.measure;
    };
    if (std::ranges::any_of(table, same)) continue;
    for (const double target : targets)
      table.push_back(cheapest(points, point.engine, point.kind, point.measure, target));
  }
  return table;
}

}  // namespace crossgrain::inline runs

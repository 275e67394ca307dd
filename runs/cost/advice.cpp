#include "runs/cost/advice.hpp"

#include <algorithm>

#include "runs/cost/candidates.hpp"

namespace crossgrain::inline runs {

std::vector<double> usualTargets() {
  return {0.1, 0.01, 1e-3, 1e-6};
}

namespace {

using Points = std::vector<CostPoint>;

/// What advice rests on: errors against the case's law that do not end with a window.
bool decidesAdvice(const CostPoint& point) {
  return point.kind != CostKind::trajectory && !isOwn(point.measure);
}

Advice adviceFor(const Points& points, const std::string& engine, double target) {
  Advice found;
  found.engine = engine;
  found.target = target;
  const auto belongs = [&](const CostPoint& point) {
    return point.engine == engine && decidesAdvice(point);
  };
  for (const CostPoint& point : points)
    if (belongs(point) && point.ran() && measuredError(point) &&
        std::ranges::find(found.kinds, point.kind) == found.kinds.end())
      found.kinds.push_back(point.kind);
  std::ranges::sort(found.kinds);
  if (found.kinds.empty()) return found;
  const Settled settled = settle(points, belongs, target, *found.costKind());
  found.verdict = settled.verdict;
  found.decides = settled.decides;
  found.obstacle = settled.obstacle;
  if (!settled.best) return found;
  found.knob = settled.best->knob;
  found.setting = settled.best->setting;
  found.fragment = points[settled.best->points.front()].fragment;
  found.wallSeconds = settled.best->seconds();
  found.length = settled.length;
  return found;
}

/// Marks the cheapest of those that were measured in most kinds.
void markCheapest(std::vector<Advice>& all, double target) {
  Advice* best = nullptr;
  for (Advice& one : all) {
    if (one.target != target || one.verdict != CostVerdict::reached || !one.wallSeconds) continue;
    if (!best || one.kinds.size() > best->kinds.size() ||
        (one.kinds == best->kinds && *one.wallSeconds < *best->wallSeconds))
      best = &one;
  }
  if (best) best->cheapest = true;
}

}  // namespace

std::vector<Advice> advice(const std::vector<CostPoint>& points,
                           const std::vector<double>& targets) {
  const std::vector<std::string> engines = enginesIn(points);
  std::vector<Advice> all;
  for (const double target : targets) {
    for (const std::string& engine : engines) all.push_back(adviceFor(points, engine, target));
    markCheapest(all, target);
  }
  return all;
}

}  // namespace crossgrain::inline runs

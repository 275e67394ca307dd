#include "runs/cost/advice.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "runs/cost/target.hpp"

namespace crossgrain::inline runs {

std::vector<double> usualTargets() {
  return {0.1, 0.01, 1e-3, 1e-6};
}

namespace {

using Points = std::vector<CostPoint>;

/// A setting of an engine with its points in every measure that decides on advice.
struct Candidate {
  std::string knob, setting;
  PointIndices points;
  Standing standing = Standing::meets;
  std::size_t worst = 0;     ///< the point with the largest upper bound
  std::size_t obstacle = 0;  ///< the point with the largest lower bound if that is above the
                             ///< target, else the worst
  double time = std::numeric_limits<double>::infinity();
};

bool decidesAdvice(const CostPoint& point) {
  return point.kind != CostKind::trajectory;
}

using Measure = std::pair<CostKind, std::string>;

Measure measureOf(const CostPoint& point) {
  return {point.kind, point.measure};
}

/// PointIndices of an engine's points that advice rests on.
PointIndices grounds(const Points& points, const std::string& engine) {
  PointIndices found;
  for (std::size_t k = 0; k < points.size(); ++k)
    if (points[k].engine == engine && points[k].ran() && points[k].error &&
        decidesAdvice(points[k]))
      found.push_back(k);
  return found;
}

/// Those that it would have rested on too, had the budget allowed them.
PointIndices plannedOnly(const Points& points, const std::string& engine) {
  PointIndices found;
  for (std::size_t k = 0; k < points.size(); ++k)
    if (points[k].engine == engine && points[k].status == CostStatus::notMeasured &&
        decidesAdvice(points[k]))
      found.push_back(k);
  return found;
}

template <class Value>
void addOnce(std::vector<Value>& values, const Value& value) {
  if (std::ranges::find(values, value) == values.end()) values.push_back(value);
}

/// The settings that were measured in all of these measures.
std::vector<Candidate> candidates(const Points& points, const PointIndices& among,
                                  const std::vector<Measure>& measures) {
  std::vector<Candidate> settings;
  for (const std::size_t k : among) {
    const auto same = [&](const Candidate& one) {
      return one.knob == points[k].knob && one.setting == points[k].setting;
    };
    auto found = std::ranges::find_if(settings, same);
    if (found == settings.end())
      found = settings.insert(settings.end(), {points[k].knob, points[k].setting, {}});
    found->points.push_back(k);
  }
  std::erase_if(settings, [&](const Candidate& one) {
    return std::ranges::any_of(measures, [&](const Measure& measure) {
      return std::ranges::none_of(one.points,
                                  [&](std::size_t k) { return measureOf(points[k]) == measure; });
    });
  });
  return settings;
}

/// @param costKind  the kind whose time counts
void judge(Candidate& candidate, const Points& points, double target, CostKind costKind) {
  candidate.worst = candidate.obstacle = candidate.points.front();
  for (const std::size_t k : candidate.points) {
    candidate.standing = std::max(candidate.standing, standingOf(points[k], target));
    if (measuredError(points[k])->high() > measuredError(points[candidate.worst])->high())
      candidate.worst = k;
    if (measuredError(points[k])->low() > measuredError(points[candidate.obstacle])->low())
      candidate.obstacle = k;
    if (points[k].kind == costKind) candidate.time = std::min(candidate.time, timeOf(points[k]));
  }
  if (candidate.standing != Standing::cannot) candidate.obstacle = candidate.worst;
}

/// Better: a better standing, then less time where it meets the target, a smaller bound elsewhere.
const Candidate& bestOf(const std::vector<Candidate>& settings, const Points& points) {
  return *std::ranges::min_element(settings, [&](const Candidate& a, const Candidate& b) {
    if (a.standing != b.standing) return a.standing < b.standing;
    if (a.standing == Standing::meets && a.time != b.time) return a.time < b.time;
    return measuredError(points[a.worst])->high() < measuredError(points[b.worst])->high();
  });
}

Advice adviceFor(const Points& points, const std::string& engine, double target) {
  Advice found;
  found.engine = engine;
  found.target = target;
  const PointIndices among = grounds(points, engine);
  std::vector<Measure> measures;
  for (const std::size_t k : among) {
    addOnce(found.kinds, points[k].kind);
    addOnce(measures, measureOf(points[k]));
  }
  std::ranges::sort(found.kinds);
  if (measures.empty()) return found;
  std::vector<Candidate> settings = candidates(points, among, measures);
  const PointIndices notRun = plannedOnly(points, engine);
  if (settings.empty()) {
    found.decides = "a setting that was measured in every measure";
    return found;
  }
  for (Candidate& one : settings) judge(one, points, target, *found.costKind());
  const Candidate& best = bestOf(settings, points);
  found.knob = best.knob;
  found.setting = best.setting;
  found.fragment = points[best.points.front()].fragment;
  if (std::isfinite(best.time)) found.wallSeconds = best.time;
  for (const std::size_t k : best.points)
    if (const auto length = lengthFor(points[k], target))
      found.length = std::max(*length, found.length.value_or(0.0));
  found.verdict = best.standing == Standing::meets ? CostVerdict::reached
                  : best.standing == Standing::may ? CostVerdict::undecided
                                                   : CostVerdict::notReached;
  if (best.standing != Standing::meets) found.obstacle = best.obstacle;
  if (best.standing == Standing::may) found.decides = whatDecides(points[best.obstacle], target);
  if (best.standing != Standing::cannot) return found;
  // Only where all was run that may be better is it shown that nothing reaches the target.
  if (const auto missing = mayYetReach(points, notRun, points[best.worst])) {
    found.verdict = CostVerdict::notMeasured;
    found.decides = notRunInWords(points[*missing], notRun.size());
  }
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
  std::vector<std::string> engines;
  for (const CostPoint& point : points) addOnce(engines, point.engine);
  std::vector<Advice> all;
  for (const double target : targets) {
    for (const std::string& engine : engines) all.push_back(adviceFor(points, engine, target));
    markCheapest(all, target);
  }
  return all;
}

}  // namespace crossgrain::inline runs

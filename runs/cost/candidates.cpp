#include "runs/cost/candidates.hpp"

#include <algorithm>
#include <cmath>

namespace crossgrain::inline runs {

namespace {

using Points = std::vector<CostPoint>;
using Measure = std::pair<CostKind, std::string>;

Measure measureOf(const CostPoint& point) {
  return {point.kind, point.measure};
}

template <class Value>
void addOnce(std::vector<Value>& values, const Value& value) {
  if (std::ranges::find(values, value) == values.end()) values.push_back(value);
}

constexpr const char* everyMeasure = "a setting that was measured in every measure";

/// Every setting with its points.
std::vector<Candidate> candidates(const Points& points, const PointIndices& among) {
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
  return settings;
}

/// Whether the setting was measured in all of them.
bool isComplete(const Candidate& one, const Points& points, const std::vector<Measure>& measures) {
  return std::ranges::all_of(measures, [&](const Measure& measure) {
    return std::ranges::any_of(one.points,
                               [&](std::size_t k) { return measureOf(points[k]) == measure; });
  });
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

}  // namespace

Settled settle(const Points& points, const std::function<bool(const CostPoint&)>& belongs,
               double target, CostKind costKind) {
  PointIndices among, notRun;
  std::optional<std::string> refusal;  // of the case as it is, which comes first
  std::vector<Measure> measures;
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (!belongs(points[k])) continue;
    if (points[k].status == CostStatus::notMeasured) notRun.push_back(k);
    if (!refusal) refusal = points[k].status == CostStatus::refused ? points[k].reason : "";
    if (!points[k].ran() || !measuredError(points[k])) continue;
    among.push_back(k);
    addOnce(measures, measureOf(points[k]));
  }
  Settled found;
  std::vector<Candidate> settings = candidates(points, among);
  for (Candidate& one : settings) judge(one, points, target, costKind);
  const auto rest = std::ranges::stable_partition(
      settings, [&](const Candidate& one) { return isComplete(one, points, measures); });
  const bool open = std::ranges::any_of(
      rest, [](const Candidate& one) { return one.standing != Standing::cannot; });
  settings.erase(rest.begin(), rest.end());
  if (settings.empty()) {
    if (!among.empty())
      found.decides = everyMeasure;
    else if (!notRun.empty() && refusal->empty())
      found.decides = notRunInWords(points[notRun.front()], notRun.size());
    else
      found.decides = refusal.value_or("");
    return found;
  }
  found.best = bestOf(settings, points);
  const Candidate& best = *found.best;
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
  if (open) {
    found.verdict = CostVerdict::notMeasured;
    found.decides = everyMeasure;
  }
  if (const auto missing = mayYetReach(points, notRun, points[best.worst])) {
    found.verdict = CostVerdict::notMeasured;
    found.decides = notRunInWords(points[*missing], notRun.size());
  }
  return found;
}

std::vector<std::string> enginesIn(const Points& points) {
  std::vector<std::string> engines;
  for (const CostPoint& point : points) addOnce(engines, point.engine);
  return engines;
}

}  // namespace crossgrain::inline runs

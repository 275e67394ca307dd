#include "runs/cost/advice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "cases/cost_knobs.hpp"

namespace crossgrain::inline runs {

namespace {

using Points = std::vector<CostPoint>;
using Indices = std::vector<std::size_t>;

enum class Standing { meets, may, cannot };

/// @pre the point has an error
Standing standingOf(const CostPoint& point, double target) {
  const MeasuredError error = *measuredError(point);
  if (error.high() <= target) return Standing::meets;
  return error.low() <= target ? Standing::may : Standing::cannot;
}

double timeOf(const CostPoint& point) {
  return point.wallSeconds.value_or(std::numeric_limits<double>::infinity());
}

/// What would tell whether the error lies above or below the target. Repeats are taken to show the
/// same error with a smaller uncertainty.
std::string whatDecides(const CostPoint& point, double target) {
  if (measuredError(point)->saysNothing()) return "more packings: one shows no statistical error";
  const double distance = std::abs(target - *point.error);
  const double statistical = point.statistical.value_or(0.0);
  const double reference = point.referenceError.value_or(0.0);
  const double room = distance - reference;
  if (statistical > 0.0 && room > 0.0) {
    const double times = (statistical / room) * (statistical / room);
    return times < 1000.0 ? fmt::format("{:.1f} times as much simulated time", times)
                          : "more than 1000 times as much simulated time";
  }
  if (reference > 0.0 && distance > statistical)
    return fmt::format("a reference known to {:.1e}", distance - statistical);
  if (reference > 0.0 && distance > 0.0)
    return fmt::format("a reference known to better than {:.1e} and more simulated time", distance);
  return "nothing: the error is the want";
}

std::optional<double> lengthFor(const CostPoint& point, double target) {
  if (!point.statistical || *point.statistical <= 0.0) return std::nullopt;
  return (*point.statistical / target) * (*point.statistical / target);
}

/// The one of smallest value; of equal ones the first. Absent of none.
template <class Value>
std::optional<std::size_t> least(const Indices& among, Value value) {
  const auto found = std::ranges::min_element(among, {}, value);
  return found == among.end() ? std::nullopt : std::optional(*found);
}

/// Of the points that were not run the one with the largest step that may yet be better than the
/// best: not those at the same or larger time steps of an engine's own scheme.
std::optional<std::size_t> mayYetReach(const Points& points, const Indices& notRun,
                                       const CostPoint& best) {
  Indices open = notRun;
  std::erase_if(open, [&](std::size_t k) {
    return points[k].knob == "time_step" && points[k].dt >= best.dt;
  });
  return least(open, [&](std::size_t k) { return -points[k].dt.value_or(0.0); });
}

std::string notRunInWords(const CostPoint& point, std::size_t count) {
  const std::string more =
      count > 1 ? fmt::format(" and {} more, which were", count - 1) : ", which was";
  return fmt::format("{}{} not run: {}", point.setting, more, point.reason);
}

}  // namespace

std::vector<double> usualTargets() {
  return {0.1, 0.01, 1e-3, 1e-6};
}

Cheapest cheapest(const std::vector<CostPoint>& points, const std::string& engine, CostKind kind,
                  const std::string& measure, double target) {
  Cheapest found{.engine = engine, .kind = kind, .measure = measure, .target = target};
  Indices meet, may, all, notRun;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const CostPoint& point = points[k];
    if (point.engine != engine || point.kind != kind || point.measure != measure) continue;
    if (point.status == CostStatus::notMeasured) notRun.push_back(k);
    if (!point.ran() || !point.error) continue;
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

namespace {

/// A setting of an engine with its points in every measure that decides on advice.
struct Candidate {
  std::string knob, setting;
  Indices points;
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

/// Indices of an engine's points that advice rests on.
Indices grounds(const Points& points, const std::string& engine) {
  Indices found;
  for (std::size_t k = 0; k < points.size(); ++k)
    if (points[k].engine == engine && points[k].ran() && points[k].error &&
        decidesAdvice(points[k]))
      found.push_back(k);
  return found;
}

/// Those that it would have rested on too, had the budget allowed them.
Indices plannedOnly(const Points& points, const std::string& engine) {
  Indices found;
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
std::vector<Candidate> candidates(const Points& points, const Indices& among,
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
  const Indices among = grounds(points, engine);
  std::vector<Measure> measures;
  for (const std::size_t k : among) {
    addOnce(found.kinds, points[k].kind);
    addOnce(measures, measureOf(points[k]));
  }
  std::ranges::sort(found.kinds);
  if (measures.empty()) return found;
  std::vector<Candidate> settings = candidates(points, among, measures);
  const Indices notRun = plannedOnly(points, engine);
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

namespace {

std::string costInWords(const Advice& one) {
  if (!one.wallSeconds) return {};
  return fmt::format(", {:.3g} s per {}", *one.wallSeconds,
                     one.costKind() == CostKind::averages ? "rotation" : "sweep of collisions");
}

std::string settingInWords(const Advice& one) {
  return speaksForItself(one.knob) ? one.setting : one.knob + " " + one.setting;
}

std::string obstacleInWords(const CostPoint& point) {
  const MeasuredError error = *measuredError(point);
  return fmt::format("# {}, {}: {:.2g} to {:.2g} of its scale\n", toString(point.kind),
                     point.measure, error.low(), error.high());
}

std::string asToml(const Advice& one, const Points& points) {
  std::string text =
      fmt::format("# {}, wanted {:g} %: {}", one.engine, 100.0 * one.target, toString(one.verdict));
  const bool reached = one.verdict == CostVerdict::reached;
  if (!one.setting.empty())
    text +=
        fmt::format("{}{}{} (measured in {}){}",
                    reached                                   ? " by "
                    : one.verdict == CostVerdict::notMeasured ? " far enough; the best so far is "
                                                              : "; the best is ",
                    settingInWords(one), costInWords(one), inWords(one.kinds),
                    one.cheapest ? "; the cheapest engine" : "");
  text += "\n";
  if (one.obstacle) text += obstacleInWords(points[*one.obstacle]);
  if (!one.decides.empty()) text += "# what would decide: " + one.decides + "\n";
  if (!reached) return text;
  text += one.fragment.empty() ? "# the case as it is: nothing to change\n" : one.fragment;
  return text.ends_with('\n') ? text : text + "\n";
}

}  // namespace

std::string adviceAsToml(const std::vector<Advice>& advice, const std::vector<CostPoint>& points) {
  std::string text;
  for (const Advice& one : advice) text += (text.empty() ? "" : "\n") + asToml(one, points);
  return text;
}

}  // namespace crossgrain::inline runs

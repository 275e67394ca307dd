#include "studies/cost/analysis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace crossgrain::inline studies {

void addCostAnalysis(CostResults& results) {
  std::vector<double> targets = {0.1, 0.01, 1e-3, 1e-6};
  if (results.target && std::ranges::find(targets, *results.target) == targets.end())
    targets.push_back(*results.target);
  results.fronts = paretoFronts(results.points);
  results.advice = advice(results.points, targets);
  results.cells = costCells(results.points, results.models);
}

std::vector<std::size_t> paretoFront(const std::vector<CostPoint>& points) {
  struct Place {
    double time, error;
    std::size_t point;
    auto operator<=>(const Place&) const = default;
  };
  std::vector<Place> places;
  for (std::size_t k = 0; k < points.size(); ++k)
    if (const auto error = points[k].counted(); error && points[k].wallSeconds)
      places.push_back({*points[k].wallSeconds, *error, k});
  std::ranges::sort(places);
  std::vector<std::size_t> front;
  Place best{0.0, std::numeric_limits<double>::infinity(), 0};
  for (const Place& one : places) {
    const bool equal = one.error == best.error && one.time == best.time;
    if (one.error >= best.error && !equal) continue;
    best = one;
    front.push_back(one.point);
  }
  return front;
}

namespace {

template <class Value>
void addOnce(std::vector<Value>& values, const Value& value) {
  if (std::ranges::find(values, value) == values.end()) values.push_back(value);
}

std::vector<std::string> enginesIn(const std::vector<CostPoint>& points) {
  std::vector<std::string> engines;
  for (const CostPoint& point : points) addOnce(engines, point.engine);
  return engines;
}

}  // namespace

std::vector<Front> paretoFronts(const std::vector<CostPoint>& points) {
  std::vector<std::pair<CostKind, std::string>> measures;
  for (const CostPoint& point : points) addOnce(measures, std::pair(point.kind, point.measure));
  std::vector<std::string> engines = enginesIn(points);
  engines.insert(engines.begin(), "");  // all
  std::vector<Front> fronts;
  for (const auto& [kind, measure] : measures)
    for (const std::string& engine : engines) {
      Front front{kind, measure, engine, {}, {}};
      std::vector<CostPoint> own = points;  // those of others have no time: they keep their places
      for (CostPoint& point : own)
        if (point.kind != kind || point.measure != measure ||
            (!engine.empty() && point.engine != engine))
          point.wallSeconds.reset();
      front.points = paretoFront(own);
      for (const std::size_t place : front.points) front.errors.push_back(*points[place].counted());
      if (engine.empty() || !front.points.empty()) fronts.push_back(std::move(front));
    }
  return fronts;
}

namespace {

using Points = std::vector<CostPoint>;
using Places = std::vector<std::size_t>;
using Measure = std::pair<CostKind, std::string>;

/// Pass: the point's whole interval meets the target; undecided: a part of it; fail: nothing.
Verdict verdictOf(const CostPoint& point, double target) {
  if (point.high() <= target) return Verdict::pass;
  return point.low() <= target ? Verdict::undecided : Verdict::fail;
}

/// What would show whether the error lies above or below the target. Repeats are taken to show the
/// same error with a smaller uncertainty.
std::string whatDecides(const CostPoint& point, double target) {
  if (point.saysNothing()) return "more packings: one shows no statistical error";
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
  return "nothing: the error is the target";
}

/// "t_c/100 and 2 more, which were not run: …"
std::string notRunText(const CostPoint& point, std::size_t count) {
  const std::string more =
      count > 1 ? fmt::format(" and {} more, which were", count - 1) : ", which was";
  return fmt::format("{}{} not run: {}", point.setting, more, point.reason);
}

/// Of the points that were not run the one with the largest step that may yet be better than the
/// best: not those at the same or larger time steps of an engine's own scheme.
std::optional<std::size_t> mayYetReach(const Points& points, Places notRun, const CostPoint& best) {
  std::erase_if(notRun, [&](std::size_t k) {
    return points[k].knob == "time_step" && points[k].dt >= best.dt;
  });
  const auto found = std::ranges::min_element(
      notRun, {}, [&](std::size_t k) { return -points[k].dt.value_or(0.0); });
  return found == notRun.end() ? std::nullopt : std::optional(*found);
}

/// What is asked of an engine's settings.
struct Question {
  std::function<bool(const CostPoint&)> belongs;  ///< which points decide
  double target;
  CostKind costKind;  ///< the kind whose time counts
  /// A kind that can only contradict: where its interval holds the target it does not stand in the
  /// way.
  std::optional<CostKind> onlyContradicts = {};
};

/// A setting of an engine with its points in every measure that decides.
struct RatedSetting {
  std::string knob, setting;
  Places points;
  Verdict verdict = Verdict::pass;
  std::size_t worst = 0;                 ///< the point with the largest upper end
  std::size_t obstacle = 0;              ///< with the largest lower end if that is above the
                                         ///< target, else the worst
  std::optional<std::size_t> open = {};  ///< the worst of the kind that can only contradict
  double time = std::numeric_limits<double>::infinity();  ///< [s]

  std::optional<double> seconds() const {
    return std::isfinite(time) ? std::optional(time) : std::nullopt;
  }
};

/// Every setting with its points.
std::vector<RatedSetting> ratedSettings(const Points& points, const Places& among) {
  std::vector<RatedSetting> settings;
  for (const std::size_t k : among) {
    auto found = std::ranges::find_if(settings, [&](const RatedSetting& one) {
      return one.knob == points[k].knob && one.setting == points[k].setting;
    });
    if (found == settings.end())
      found = settings.insert(settings.end(), {points[k].knob, points[k].setting, {}});
    found->points.push_back(k);
  }
  return settings;
}

bool isComplete(const RatedSetting& one, const Points& points,
                const std::vector<Measure>& measures) {
  return std::ranges::all_of(measures, [&](const Measure& measure) {
    return std::ranges::any_of(one.points, [&](std::size_t k) {
      return Measure(points[k].kind, points[k].measure) == measure;
    });
  });
}

void judge(RatedSetting& rated, const Points& points, const Question& question) {
  rated.worst = rated.obstacle = rated.points.front();
  for (const std::size_t k : rated.points) {
    const CostPoint& point = points[k];
    if (point.kind == question.costKind)
      rated.time =
          std::min(rated.time, point.wallSeconds.value_or(std::numeric_limits<double>::infinity()));
    const Verdict verdict = verdictOf(point, question.target);
    if (verdict == Verdict::undecided && point.kind == question.onlyContradicts) {
      if (!rated.open || point.high() > points[*rated.open].high()) rated.open = k;
      continue;
    }
    rated.verdict = moreSevere(rated.verdict, verdict);
    if (point.high() > points[rated.worst].high()) rated.worst = k;
    if (point.low() > points[rated.obstacle].low()) rated.obstacle = k;
  }
  if (rated.verdict != Verdict::fail) rated.obstacle = rated.worst;
}

/// Whether some setting meets a target in every measure.
struct Settled {
  Verdict verdict = Verdict::notMeasured;
  /// Reached: the cheapest; else the one whose largest upper end is smallest. Absent where no
  /// setting was measured in every measure.
  std::optional<RatedSetting> best = {};
  /// As of Advice.
  std::optional<std::size_t> obstacle = {};
  std::string decides = {};
};

Settled settle(const Points& points, const Question& question) {
  static const std::string everyMeasure = "a setting that was measured in every measure";
  Places among, notRun;
  std::optional<std::string> refusal;  // of the case as it is, which comes first
  std::vector<Measure> measures;
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (!question.belongs(points[k])) continue;
    if (points[k].status == Status::notRun) notRun.push_back(k);
    if (!refusal) refusal = points[k].status == Status::refused ? points[k].reason : "";
    if (!points[k].measured()) continue;
    among.push_back(k);
    addOnce(measures, Measure(points[k].kind, points[k].measure));
  }
  Settled found;
  std::vector<RatedSetting> settings = ratedSettings(points, among);
  for (RatedSetting& one : settings) judge(one, points, question);
  const auto rest = std::ranges::stable_partition(
      settings, [&](const RatedSetting& one) { return isComplete(one, points, measures); });
  // Some settings are not measured in every kind of error; others lack a measure of a kind.
  const bool open = std::ranges::any_of(rest, [&](const RatedSetting& one) {
    return one.verdict != Verdict::fail &&
           std::ranges::all_of(measures, [&](const Measure& measure) {
             return std::ranges::any_of(
                 one.points, [&](std::size_t k) { return points[k].kind == measure.first; });
           });
  });
  settings.erase(rest.begin(), rest.end());
  if (settings.empty()) {
    if (!among.empty())
      found.decides = everyMeasure;
    else if (!notRun.empty() && refusal->empty())
      found.decides = notRunText(points[notRun.front()], notRun.size());
    else
      found.decides = refusal.value_or("");
    return found;
  }
  // Better: a better verdict, then less time where it meets the target, a smaller end elsewhere.
  found.best =
      *std::ranges::min_element(settings, [&](const RatedSetting& a, const RatedSetting& b) {
        if (a.verdict != b.verdict) return a.verdict < b.verdict;
        if (a.verdict == Verdict::pass && a.time != b.time) return a.time < b.time;
        return points[a.worst].high() < points[b.worst].high();
      });
  const RatedSetting& best = *found.best;
  found.obstacle = best.verdict == Verdict::pass ? best.open : best.obstacle;
  if (best.verdict != Verdict::fail) {
    found.verdict = best.verdict;
    if (found.obstacle) found.decides = whatDecides(points[*found.obstacle], question.target);
    return found;
  }
  // Only where all was run that may be better is it shown that nothing reaches the target.
  found.verdict = Verdict::fail;
  const auto missing = mayYetReach(points, notRun, points[best.worst]);
  if (!open && !missing) return found;
  found.verdict = Verdict::notMeasured;
  found.decides = missing ? notRunText(points[*missing], notRun.size()) : everyMeasure;
  return found;
}

Advice adviceFor(const Points& points, const std::string& engine, double target) {
  Advice found;
  found.engine = engine;
  found.target = target;
  // Errors against the case's law that do not end with a window.
  const auto belongs = [&](const CostPoint& point) {
    return point.engine == engine && point.kind != CostKind::trajectory && !isOwn(point.measure);
  };
  for (const CostPoint& point : points)
    if (belongs(point) && point.measured()) addOnce(found.kinds, point.kind);
  std::ranges::sort(found.kinds);
  if (found.kinds.empty()) return found;
  Question question{belongs, target, *found.costKind()};
  if (found.kinds.size() > 1) question.onlyContradicts = CostKind::averages;
  const Settled settled = settle(points, question);
  found.verdict = settled.verdict;
  found.decides = settled.decides;
  found.obstacle = settled.obstacle;
  if (!settled.best) return found;
  found.knob = settled.best->knob;
  found.setting = settled.best->setting;
  found.fragment = points[settled.best->points.front()].fragment;
  found.wallSeconds = settled.best->seconds();
  for (const std::size_t k : settled.best->points)
    if (const double statistical = points[k].statistical.value_or(0.0); statistical > 0.0)
      found.length = std::max(found.length.value_or(0.0), std::pow(statistical / target, 2));
  return found;
}

/// Marks the cheapest of those that were measured in most kinds.
void markCheapest(std::vector<Advice>& all, double target) {
  Advice* best = nullptr;
  for (Advice& one : all) {
    if (one.target != target || one.verdict != Verdict::pass || !one.wallSeconds) continue;
    if (!best || one.kinds.size() > best->kinds.size() ||
        (one.kinds == best->kinds && *one.wallSeconds < *best->wallSeconds))
      best = &one;
  }
  if (best) best->cheapest = true;
}

CostBasis basisOf(const CostPoint& point) {
  return isOwn(point.measure) ? CostBasis::own : CostBasis::scene;
}

/// The largest of an engine's model errors that are shown to lie above the target. Where a setting
/// comes nearer to the case's law than the limit of small steps does, coarse steps make up for some
/// of the model, and nothing follows for those that were not run.
std::optional<std::size_t> modelAbove(const std::vector<CostModel>& models, const CostCell& cell) {
  std::optional<std::size_t> largest;
  for (std::size_t k = 0; k < models.size(); ++k)
    if (models[k].engine == cell.engine && models[k].kind == cell.kind &&
        models[k].low > cell.target && (!largest || models[k].low > models[*largest].low))
      largest = k;
  return largest;
}

CostCell cellOf(CostCell cell, const Points& points, const std::vector<CostModel>& models) {
  const auto belongs = [&](const CostPoint& point) {
    return point.engine == cell.engine && point.kind == cell.kind && basisOf(point) == cell.basis;
  };
  const Settled settled = settle(points, {belongs, cell.target, cell.kind});
  cell.verdict = settled.verdict;
  cell.decides = settled.decides;
  if (settled.best) {
    cell.knob = settled.best->knob;
    cell.setting = settled.best->setting;
    cell.wallSeconds = settled.best->seconds();
    cell.point = settled.obstacle.value_or(settled.best->worst);
  }
  if (cell.verdict == Verdict::pass || cell.basis == CostBasis::own) return cell;
  cell.model = modelAbove(models, cell);
  if (cell.model && settled.best && points[settled.best->worst].high() < models[*cell.model].low)
    cell.model.reset();
  if (cell.model) {
    cell.verdict = Verdict::fail;
    cell.decides.clear();
  }
  return cell;
}

}  // namespace

std::vector<Advice> advice(const Points& points, const std::vector<double>& targets) {
  std::vector<Advice> all;
  for (const double target : targets) {
    for (const std::string& engine : enginesIn(points))
      all.push_back(adviceFor(points, engine, target));
    markCheapest(all, target);
  }
  return all;
}

std::vector<CostCell> costCells(const Points& points, const std::vector<CostModel>& models,
                                const std::vector<double>& targets) {
  std::vector<CostCell> cells;
  for (const std::string& engine : enginesIn(points))
    for (const CostKind kind : costKinds)
      for (const CostBasis basis : costBases) {
        const auto has = [&](const CostPoint& point) {
          return point.engine == engine && point.kind == kind && basisOf(point) == basis;
        };
        if (std::ranges::none_of(points, has)) continue;
        for (const double target : targets)
          cells.push_back(cellOf({.engine = engine, .kind = kind, .basis = basis, .target = target},
                                 points, models));
      }
  return cells;
}

}  // namespace crossgrain::inline studies

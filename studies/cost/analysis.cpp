#include "studies/cost/analysis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>

namespace crossgrain::inline studies {

void addCostAnalysis(CostResults& results) {
  std::vector<double> targets = {0.1, 0.01, 1e-3};
  if (results.inMargins) targets = {10.0, 1.0, 0.1};
  const std::vector<double> ofCells = targets;
  if (!results.inMargins) targets.push_back(1e-6);
  if (results.target && std::ranges::find(targets, *results.target) == targets.end())
    targets.push_back(*results.target);
  if (!results.inMargins) results.largestSteps = largestSteps(results.points);
  results.fronts = paretoFronts(results.points);
  results.advice = advice(results.points, results.models, targets);
  results.cells = costCells(results.points, results.models, ofCells);
}

namespace {

/// Whether a point is shown to be better: at most as wrong and at most as slow, and less in one.
bool beats(const CostPoint& one, const CostPoint& other) {
  const double error = *one.counted(), thanError = *other.counted();
  const TimeInterval time = one.timeInterval(), than = other.timeInterval();
  return error <= thanError && time.high <= than.low && (error < thanError || time.high < than.low);
}

std::vector<std::size_t> frontAmong(const std::vector<CostPoint>& points,
                                    std::vector<std::size_t> among) {
  std::erase_if(among, [&](std::size_t k) { return !points[k].counted() || !points[k].time(); });
  std::vector<std::size_t> front;
  std::ranges::copy_if(among, std::back_inserter(front), [&](std::size_t k) {
    return std::ranges::none_of(among, [&](std::size_t j) { return beats(points[j], points[k]); });
  });
  std::ranges::stable_sort(
      front, {}, [&](std::size_t k) { return std::pair(*points[k].time(), *points[k].counted()); });
  return front;
}

}  // namespace

std::vector<std::size_t> paretoFront(const std::vector<CostPoint>& points) {
  std::vector<std::size_t> all(points.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  return frontAmong(points, all);
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

std::vector<LargestStep> largestSteps(const std::vector<CostPoint>& points) {
  std::vector<LargestStep> all;
  for (const std::string& engine : enginesIn(points)) {
    LargestStep found{engine, CostKind::averages, {}, {}, {}};
    const auto each = [&](CostKind kind, Status status, auto&& use) {
      for (const CostPoint& point : points)
        if (point.engine == engine && point.kind == kind && point.knob == "time_step" &&
            point.status == status && point.dt)
          use(point);
    };
    for (const CostKind kind : {CostKind::averages, CostKind::trajectory, CostKind::collision})
      each(kind, Status::failed, [&](const CostPoint& point) {
        found.unstable = std::min(found.unstable.value_or(INFINITY), *point.dt);
      });
    // Nothing may touch along a path, which then bears any step: collisions do.
    std::optional<double> borne;
    each(CostKind::collision, Status::finished,
         [&](const CostPoint& point) { borne = std::max(borne.value_or(0.0), *point.dt); });
    bool allRan = true;
    for (const CostKind kind : {CostKind::averages, CostKind::trajectory}) {
      if (found.stable) break;  // whole runs show more than paths
      found.kind = kind;
      each(kind, Status::notRun, [&](const CostPoint&) { allRan = false; });
      each(kind, Status::finished, [&](const CostPoint& point) {
        if (found.unstable && *point.dt >= *found.unstable) return;  // by chance
        if (kind == CostKind::trajectory && borne && *point.dt > *borne) return;
        found.stable = std::max(found.stable.value_or(0.0), *point.dt);
        if (point.stepsPerContact) found.contactTime = *point.dt * *point.stepsPerContact;
      });
    }
    if (found.stable || (found.unstable && allRan)) all.push_back(found);
  }
  return all;
}

std::vector<Front> paretoFronts(const std::vector<CostPoint>& points) {
  std::vector<std::pair<CostKind, std::string>> measures;
  for (const CostPoint& point : points) addOnce(measures, std::pair(point.kind, point.measure));
  std::vector<std::string> engines = enginesIn(points);
  engines.insert(engines.begin(), "");  // all
  std::vector<Front> fronts;
  for (const auto& [kind, measure] : measures)
    for (const std::string& engine : engines) {
      Front front{kind, measure, engine, {}, {}};
      std::vector<std::size_t> own;
      for (std::size_t k = 0; k < points.size(); ++k)
        if (points[k].kind == kind && points[k].measure == measure &&
            (engine.empty() || points[k].engine == engine))
          own.push_back(k);
      front.points = frontAmong(points, own);
      for (const std::size_t place : front.points) front.errors.push_back(*points[place].counted());
      if (engine.empty() || !front.points.empty()) fronts.push_back(std::move(front));
    }
  return fronts;
}

namespace {

using Points = std::vector<CostPoint>;
using Places = std::vector<std::size_t>;
using Measure = std::pair<CostKind, std::string>;

CostBasis basisOf(const CostPoint& point) {
  return isOwn(point.measure) ? CostBasis::own : CostBasis::scene;
}

/// Where a point's error lies as far as it counts.
struct CountedEnds {
  double low, high;
  bool cancels = false;  ///< the step's error makes up for a part of the model's

  /// Pass: the whole interval meets the target; undecided: a part of it; fail: nothing.
  Verdict verdict(double target) const {
    if (high <= target) return Verdict::pass;
    return low <= target ? Verdict::undecided : Verdict::fail;
  }
};

/// Whether a setting is of another law, whose model error is its own.
bool changesLaw(const std::string& knob) {
  return knob != "time_step" && knob != "integrator" && knob != "precision";
}

/// The same setting's error against the engine's own limit of small steps.
const CostPoint* ownPoint(const Points& points, const CostPoint& point) {
  const auto found = std::ranges::find_if(points, [&](const CostPoint& one) {
    return one.engine == point.engine && one.kind == point.kind && one.knob == point.knob &&
           one.setting == point.setting && one.measured() && isOwn(one.measure) &&
           (one.kind == CostKind::trajectory || withoutOwn(one.measure) == point.measure);
  });
  return found == points.end() ? nullptr : &*found;
}

/// An error against the case's law is a sum e = e_step + e_model over the same collisions or disks,
/// hence ‖e‖ <= ‖e_step‖ + ‖e_model‖, and it can be smaller than either part only where the two
/// have opposite signs: by chance of that one step. So a point whose error is shown to be smaller
/// than a part counts with the larger part as its lower end and the sum as its upper one. Intervals
/// hold what samples leave open; a hundredth of a part is left to rounding.
CountedEnds endsOf(const Points& points, const std::vector<CostModel>& models,
                   const CostPoint& point) {
  CountedEnds ends{point.low(), point.high()};
  if (isOwn(point.measure) || changesLaw(point.knob)) return ends;
  double least = 0.0, most = 0.0;
  const auto add = [&](double low, double high) {
    least = std::max(least, low);
    most += high;
  };
  if (const CostPoint* own = ownPoint(points, point)) add(own->low(), own->high());
  for (const CostModel& model : models)
    if (model.engine == point.engine && model.kind == point.kind && model.measure == point.measure)
      add(model.low, model.high);
  constexpr double noticeable = 0.99;
  if (!(ends.high < noticeable * least)) return ends;
  return {std::max(ends.low, least), std::max(ends.high, most), true};
}

constexpr const char* morePackings = "more packings: one shows no statistical error";

/// Advice on how to decide whether the error lies above or below the target. Repeats are assumed to
/// show the same error with a smaller uncertainty.
std::string whatDecides(const CostPoint& point, double target) {
  if (point.saysNothing()) return morePackings;
  if (point.kind == CostKind::collision && !point.referenceError)
    return "more collisions: a larger cost.psi_count";
  if (point.kind == CostKind::trajectory && point.statistical.value_or(0.0) > 0.0)
    return "more packings: a larger cost.trajectory_packings";
  const double distance = std::abs(target - *point.error);
  const double statistical = point.statistical.value_or(0.0);
  const double reference = point.referenceError.value_or(0.0);
  const double room = distance - reference;
  if (statistical > 0.0 && room > 0.0) {
    const double half =
        std::max(statistical, point.intervalHigh.value_or(0.0) - *point.error - reference);
    const double times = (half / room) * (half / room);
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

/// Whether no contact is stable at a point's step: 2/ω is 2 t_c/π.
bool isBeyondLimit(const CostPoint& point) {
  return point.stepsPerContact && *point.stepsPerContact < std::numbers::pi / 2.0;
}

/// Of the points that were not run, all below the stability limit, the one that may yet be better
/// than the best: with the largest of the steps that are smaller than its own, else with the
/// smallest; not those at the same or larger time steps of an engine's own scheme.
std::optional<std::size_t> mayYetReach(const Points& points, Places notRun, const CostPoint& best) {
  std::erase_if(notRun, [&](std::size_t k) {
    return points[k].knob == "time_step" && points[k].dt >= best.dt;
  });
  const auto found = std::ranges::min_element(notRun, {}, [&](std::size_t k) {
    const double dt = points[k].dt.value_or(0.0);
    return dt < best.dt ? std::pair(false, -dt) : std::pair(true, dt);
  });
  return found == notRun.end() ? std::nullopt : std::optional(*found);
}

/// Target and kinds of error for which an engine's settings are rated.
struct Question {
  std::string engine;
  std::vector<CostKind> kinds;
  CostBasis basis;
  double target;
  /// A kind that can only contradict: where its interval holds the target it does not stand in the
  /// way.
  std::optional<CostKind> onlyContradicts = {};

  /// Whether a point decides.
  bool asks(const CostPoint& point) const {
    return point.engine == engine && std::ranges::find(kinds, point.kind) != kinds.end() &&
           basisOf(point) == basis;
  }
  CostKind costKind() const { return kinds.back(); }  ///< whose time counts
};

/// Points, and how far engines' own limits are from the case's law.
struct CostData {
  const Points& points;
  const std::vector<CostModel>& models;
};

/// A setting of an engine with its points in every measure that decides.
struct RatedSetting {
  std::string knob, setting;
  Places points;
  Verdict verdict = Verdict::pass;
  std::size_t worst = 0;                 ///< the point with the largest upper end
  double high = 0.0;                     ///< that end
  std::size_t obstacle = 0;              ///< with the largest lower end if that is above the
                                         ///< target, else the worst
  std::optional<std::size_t> open = {};  ///< the worst of the kind that can only contradict
  bool cancels = false;                  ///< CountedEnds::cancels of a point
  /// Of closed forms, at a smaller step with all else alike: a point that is not as near. An error
  /// that has no scatter crosses 0 somewhere between two steps.
  std::optional<std::size_t> worse = {};
  CostTime time = {};
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

void judge(RatedSetting& rated, const CostData& of, const Question& question) {
  rated.worst = rated.obstacle = rated.points.front();
  rated.high = -1.0;
  double largestLow = -1.0, openHigh = -1.0;
  for (const std::size_t k : rated.points) {
    const CostPoint& point = of.points[k];
    if (point.kind == question.costKind() &&
        point.timeInterval().value < rated.time.timeInterval().value)
      rated.time = point;
    const CountedEnds ends = endsOf(of.points, of.models, point);
    const Verdict verdict = ends.verdict(question.target);
    if (verdict == Verdict::undecided && point.kind == question.onlyContradicts) {
      if (ends.high > openHigh) rated.open = k, openHigh = ends.high;
      continue;
    }
    rated.cancels = rated.cancels || ends.cancels;
    rated.verdict = moreSevere(rated.verdict, verdict);
    if (ends.high > rated.high) rated.worst = k, rated.high = ends.high;
    if (ends.low > largestLow) rated.obstacle = k, largestLow = ends.low;
  }
  if (rated.verdict != Verdict::fail) rated.obstacle = rated.worst;
}

void findWorse(std::vector<RatedSetting>& settings, const Points& points) {
  for (RatedSetting& one : settings) {
    const CostPoint& point = points[one.points.front()];
    if (one.verdict != Verdict::pass || point.statistical != 0.0) continue;
    for (const RatedSetting& other : settings)
      if (other.verdict == Verdict::fail && points[other.obstacle].dt < point.dt &&
          withoutStep(other.knob, other.setting) == withoutStep(one.knob, one.setting))
        one.worse = other.obstacle;
  }
}

/// Whether some setting meets a target in every measure.
struct Settled {
  Verdict verdict = Verdict::notMeasured;
  /// Reached: the cheapest; else the one whose largest upper end is smallest. Absent where no
  /// setting was measured in every measure, or none reaches it and only settings were whose error
  /// cancels.
  std::optional<RatedSetting> best = {};
  std::vector<TiedSetting> ties = {};        ///< as of Advice
  std::optional<std::size_t> obstacle = {};  ///< as of Advice
  std::optional<std::size_t> figure = {};    ///< as of CostCell::point
  std::optional<std::size_t> model = {};     ///< as of CostCell
  std::string decides = {};
};

/// Better: a better verdict, then, where it meets the target, smaller steps that do, too, and less
/// time; elsewhere errors that do not cancel, then a smaller end.
bool isBetter(const RatedSetting& a, const RatedSetting& b) {
  if (a.verdict != b.verdict) return a.verdict < b.verdict;
  const double time = a.time.timeInterval().value, than = b.time.timeInterval().value;
  if (a.verdict == Verdict::pass && !a.worse != !b.worse) return !a.worse;
  if (a.verdict == Verdict::pass && time != than) return time < than;
  if (a.verdict != Verdict::pass && a.cancels != b.cancels) return b.cancels;
  return a.high < b.high;
}

/// Of the settings whose times cannot be distinguished from that of the cheapest the plainest: a
/// time step before another knob, of time steps the largest, which takes the fewest steps. So the
/// same setting is named whichever of a tie happened to be the fastest.
RatedSetting plainest(const std::vector<RatedSetting>& settings, const RatedSetting& cheapest,
                      const Points& points) {
  const auto rank = [&](const RatedSetting& one) {
    const CostPoint& point = points[one.points.front()];
    return std::pair(one.knob != "time_step", -point.dt.value_or(0.0));
  };
  const RatedSetting* found = &cheapest;
  for (const RatedSetting& one : settings)
    if (one.verdict == Verdict::pass && !one.worse == !cheapest.worse &&
        one.time.timeInterval().ties(cheapest.time.timeInterval()) && rank(one) < rank(*found))
      found = &one;
  return *found;
}

Settled settle(const CostData& of, const Question& question) {
  static const std::string everyMeasure = "a setting that was measured in every measure";
  const Points& points = of.points;
  Places among, notRun;
  std::optional<std::string> refusal;  // of the case as it is, which comes first
  std::vector<Measure> measures;
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (!question.asks(points[k])) continue;
    if (points[k].status == Status::notRun && !isBeyondLimit(points[k])) notRun.push_back(k);
    if (!refusal) refusal = points[k].status == Status::refused ? points[k].reason : "";
    if (!points[k].measured()) continue;
    among.push_back(k);
    addOnce(measures, Measure(points[k].kind, points[k].measure));
  }
  Settled found;
  std::vector<RatedSetting> settings = ratedSettings(points, among);
  for (RatedSetting& one : settings) judge(one, of, question);
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
  findWorse(settings, points);
  RatedSetting best = *std::ranges::min_element(settings, isBetter);
  const bool reached = best.verdict == Verdict::pass;
  if (reached) best = plainest(settings, best, points);
  if (reached || !best.cancels) found.best = best;
  if (reached)
    for (const RatedSetting& one : settings)
      if (one.verdict == Verdict::pass && !one.worse == !best.worse &&
          TiedSetting(one.knob, one.setting) != TiedSetting(best.knob, best.setting) &&
          one.time.timeInterval().ties(best.time.timeInterval()))
        found.ties.push_back({one.knob, one.setting});
  found.obstacle = !reached ? best.obstacle : best.open ? best.open : best.worse;
  found.figure = found.obstacle.value_or(best.worst);
  if (best.verdict != Verdict::fail) {
    found.verdict = best.verdict;
    if (found.obstacle && !best.worse)
      found.decides = whatDecides(points[*found.obstacle], question.target);
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

/// The largest of an engine's model errors that are shown to lie above the target: no time step
/// lessens it, and one whose error cancels it does not count.
std::optional<std::size_t> modelAbove(const CostData& of, const Question& question) {
  std::optional<std::size_t> largest;
  for (std::size_t k = 0; k < of.models.size(); ++k) {
    const CostModel& one = of.models[k];
    if (one.engine == question.engine && one.low > question.target &&
        std::ranges::find(question.kinds, one.kind) != question.kinds.end() &&
        (!largest || one.low > of.models[*largest].low))
      largest = k;
  }
  return largest;
}

/// The one rule by which cells and advice stand. What a single kind of error is shown not to reach
/// several do not, whatever else is left to be run.
Settled decide(const CostData& of, const Question& question) {
  Settled found = settle(of, question);
  if (found.verdict == Verdict::pass || question.basis == CostBasis::own) return found;
  if (question.kinds.size() > 1)
    for (const CostKind kind : question.kinds) {
      Settled single = decide(of, {question.engine, {kind}, question.basis, question.target});
      if (single.verdict != Verdict::fail) continue;
      if (found.verdict == Verdict::fail && !single.model) return found;
      single.decides.clear();
      return single;
    }
  const auto model = modelAbove(of, question);
  // A setting of another law may come nearer than any time step of the engine's own.
  const bool otherLaw = found.best && changesLaw(found.best->knob);
  if (!model || (otherLaw && found.best->high < of.models[*model].low)) return found;
  found.model = model;
  found.verdict = Verdict::fail;
  found.decides.clear();
  return found;
}

Advice adviceFor(const CostData& of, const std::string& engine, double target) {
  Advice found;
  found.engine = engine;
  found.target = target;
  // Errors against the case's law that do not end with a window.
  bool ofOnePacking = false;
  for (const CostPoint& point : of.points) {
    if (point.engine != engine || point.kind == CostKind::trajectory || isOwn(point.measure) ||
        !point.measured())
      continue;
    if (point.saysNothing())
      ofOnePacking = true;
    else
      addOnce(found.kinds, point.kind);
  }
  std::ranges::sort(found.kinds);
  if (ofOnePacking) found.decides = morePackings;
  if (found.kinds.empty()) return found;
  Question question{engine, found.kinds, CostBasis::scene, target};
  if (found.kinds.size() > 1) question.onlyContradicts = CostKind::averages;
  const Settled settled = decide(of, question);
  found.verdict = settled.verdict;
  if (!settled.decides.empty() || settled.verdict == Verdict::fail) found.decides = settled.decides;
  found.obstacle = settled.obstacle;
  found.model = settled.model;
  found.ties = settled.ties;
  if (!settled.best) return found;
  found.knob = settled.best->knob;
  found.setting = settled.best->setting;
  found.fragment = of.points[settled.best->points.front()].fragment;
  for (const std::size_t k : settled.best->points)
    if (const double statistical = of.points[k].statistical.value_or(0.0); statistical > 0.0)
      found.length = std::max(found.length.value_or(0.0), std::pow(statistical / target, 2));
  static_cast<CostTime&>(found) = settled.best->time;
  return found;
}

/// Marks the cheapest of those that were measured in most kinds, and those that tie with it.
void markCheapest(std::vector<Advice>& all, double target) {
  const Advice* best = nullptr;
  const auto counts = [&](const Advice& one) {
    return one.target == target && one.verdict == Verdict::pass && one.time();
  };
  for (const Advice& one : all) {
    if (!counts(one)) continue;
    if (!best || one.kinds.size() > best->kinds.size() ||
        (one.kinds == best->kinds && *one.time() < *best->time()))
      best = &one;
  }
  for (Advice& one : all)
    one.cheapest = one.cheapest || (best && counts(one) && one.kinds == best->kinds &&
                                    one.timeInterval().ties(best->timeInterval()));
}

CostCell cellOf(CostCell cell, const CostData& of) {
  const Settled settled = decide(of, {cell.engine, {cell.kind}, cell.basis, cell.target});
  cell.verdict = settled.verdict;
  cell.decides = settled.decides;
  cell.ties = settled.ties;
  cell.model = settled.model;
  cell.point = settled.figure;
  if (!settled.best) return cell;
  cell.knob = settled.best->knob;
  cell.setting = settled.best->setting;
  static_cast<CostTime&>(cell) = settled.best->time;
  return cell;
}

}  // namespace

std::vector<Advice> advice(const Points& points, const std::vector<CostModel>& models,
                           const std::vector<double>& targets) {
  std::vector<Advice> all;
  for (const double target : targets) {
    for (const std::string& engine : enginesIn(points))
      all.push_back(adviceFor({points, models}, engine, target));
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
          cells.push_back(cellOf({{}, engine, kind, basis, target}, {points, models}));
      }
  return cells;
}

}  // namespace crossgrain::inline studies

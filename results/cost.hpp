#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cases/cost.hpp"
#include "results/flow_frame.hpp"
#include "results/head.hpp"
#include "results/schema.hpp"

/// Findings of `crossgrain cost`: results of kind "cost" (docs/results.md). Targets are
/// accuracies that are wanted: 0.01 is 1 %. Places are indices into CostResults::points.
namespace crossgrain::inline results {

/// Names in files of the fate of a point or timing. Failed: its engine broke down, or the step
/// was beyond its stability limit; refused: its engine has no such setting; not run: the budget did
/// not allow it.
inline constexpr support::EnumNames<Status, 4> costStatusNames{{{Status::finished, "ran"},
                                                                {Status::failed, "failed"},
                                                                {Status::refused, "refused"},
                                                                {Status::notRun, "undecided"}}};

/// Time of a step of one engine on a scene of one size, shared by so many workers: a row of
/// scale.csv.
struct StepTime {
  std::string engine;
  std::size_t bodies = 0;  ///< that move
  int workers = 1;         ///< threads or ranks that share a step
  std::string workersAre;  ///< "threads", "ranks"; empty: the engine has one process
  Status status = Status::finished;
  std::string reason;
  std::uint64_t steps = 0;           ///< that each round timed
  std::vector<double> seconds;       ///< wall time of a step in each round [s]
  double step = 0.0;                 ///< their geometric mean [s]
  std::optional<double> low, high;   ///< ends of its 95 % interval; absent of a single round [s]
  std::optional<double> contacts;    ///< evaluated in a step
  std::optional<double> memory;      ///< most that its processes held together [bytes]
  std::string precision;             ///< that was used
  double dt = 0.0;                   ///< of the engine [s]
  std::vector<std::string> differs;  ///< deviations from the scene
  std::string measured;              ///< when it was begun: ISO 8601, UTC

  bool ran() const { return status == Status::finished && !seconds.empty(); }

  void fields(auto& io) {
    io("engine", engine, aName);
    io("disks", bodies);
    FIELDS(io, workers, workersAre, reason, steps, differs, measured);
    io("status", status, costStatusNames);
    io("step_s", seconds);
    io("mean_s", step);
    io("low_s", low);
    io("high_s", high);
    io("contacts_per_step", contacts);
    io("memory_bytes", memory);
    io("precision", precision, aName);
    io("dt_s", dt);
  }
};

/// Figures of a step's time and of the others of its engine. Absent where it did not run, or that
/// with which it is compared.
struct StepFigures {
  std::optional<double> step;     ///< [s]
  std::optional<double> spread;   ///< (slowest − fastest)/fastest round; of a single one none
  std::optional<double> perBody;  ///< step / bodies [s]
  std::optional<double> bytes;    ///< memory / bodies
  std::optional<double> ratio;    ///< step over that of the first engine, one worker, same size
  /// T(1, N)/(p T(p, N)): of one worker's time, shared by p, on the same scene. Absent for p = 1.
  std::optional<double> strong;
  /// T(1, N/p)/T(p, N): each worker has as many bodies as the one of the smaller scene had.
  std::optional<double> weak;
};

/// @param of  one of `times`
StepFigures stepFigures(const std::vector<StepTime>& times, const StepTime& of);

/// What a step of a size that did not run would take, by the two largest that did.
struct StepForecast {
  std::size_t smaller = 0, larger = 0;  ///< that it is from [bodies]
  /// Ends of a step's time [s]: time per body as of the larger, and changing further as from the
  /// smaller to the larger, by the same power of the number of bodies.
  double least = 0.0, most = 0.0;
  std::optional<double> memory;  ///< on the straight line through both [bytes]
};

/// @param of  one of `times`
/// @returns absent where fewer than two smaller sizes of the engine ran with as many workers
std::optional<StepForecast> stepForecast(const std::vector<StepTime>& times, const StepTime& of);

/// "1 thread", "2 threads"; "one process" of an engine that has no workers.
std::string describeWorkers(const StepTime& of);

/// The name of a knob, or "effect:NAME".
inline constexpr Words aKnob{
    [](std::string_view text) {
      constexpr std::string_view effect = "effect:";
      return isName(text.starts_with(effect) ? text.substr(effect.size()) : text);
    },
    "a knob"};

/// Measure of the largest of the errors of all endpoints, where these are in margins.
inline constexpr const char* largestError = "largest_error";

/// Whether a target is reached, as files and reports call it. Undecided: the error's interval holds
/// the target; not reached: and every setting of the plan that may do better was run; not measured:
/// nor was every such setting.
inline constexpr support::EnumNames<Verdict, 4> costVerdictNames{
    {{Verdict::pass, "reached"},
     {Verdict::undecided, "undecided"},
     {Verdict::fail, "not reached"},
     {Verdict::notMeasured, "not measured"}}};

/// A time, and between which it lies [s].
struct TimeInterval {
  double value, low, high;
  /// Whether it is not known which of both is shorter.
  bool ties(const TimeInterval& other) const { return low <= other.high && other.low <= high; }
};

/// Time of a setting: of the advance alone, per unit that all points of one kind and measure
/// share: a sweep of collisions, the trajectory's window, a simulated second.
struct CostTime {
  std::optional<double> wallSeconds, cpuSeconds;  ///< geometric means over the rounds [s]
  /// Ends of the 95 % interval of time(), from its rounds [s]; absent of a single one.
  std::optional<double> timeLow, timeHigh;

  /// By which settings are ranked: processor time, as wall time depends on the load of the machine;
  /// wall time of an engine that does not report it [s].
  std::optional<double> time() const {
    return cpuSeconds.value_or(0.0) > 0.0 ? cpuSeconds : wallSeconds;
  }
  /// Infinite where there is no time.
  TimeInterval timeInterval() const {
    const double value = time().value_or(std::numeric_limits<double>::infinity());
    return {value, timeLow.value_or(value), timeHigh.value_or(value)};
  }

  void timeFields(auto& io) {
    io("wall_s", wallSeconds);
    io("cpu_s", cpuSeconds);
    io("time_low_s", timeLow);
    io("time_high_s", timeHigh);
  }
};

/// Cost and error of one setting of one engine, in one kind of error and one measure:
/// a point of a work–precision plot, a row of cost.csv.
struct CostPoint : CostTime {
  std::string engine;
  std::string knob;      ///< one of costKnobs, an engine's setting, or "effect:NAME"
  std::string setting;   ///< readable, e.g. "t_c/50"
  std::string fragment;  ///< TOML that, in a case that extends this one, gives this setting
  CostKind kind = CostKind::collision;    ///< of error
  std::string measure;                    ///< quantity of the error: "psi_f", "stress_rr", …
  std::optional<double> dt;               ///< absent where an engine refused [s]
  std::optional<double> stepsPerContact;  ///< t_c of the stiffest, lightest pair divided by dt

  /// Relative to a scale that the kind names (a curve's range, d, a profile's largest value) [-].
  std::optional<double> error;
  /// Of averages: the standard error in `error`, and |bias| with that part removed; absent where
  /// they cannot be separated [-].
  std::optional<double> statistical, systematic;
  std::optional<double> referenceError;  ///< uncertainty of the reference itself [-]
  /// Ends of the error's 95 % interval: of collisions over where in a step they begin, of
  /// trajectories over packings, of averages over these, all rings and measures together [-].
  std::optional<double> intervalLow, intervalHigh;
  std::optional<double> worst;  ///< of collisions: the largest error of a single one [-]

  std::optional<std::uint64_t> steps, contactEvaluations;  ///< per the unit of the times

  Status status = Status::finished;
  std::string reason;  ///< unless it ran: one line

  bool ran() const { return status == Status::finished; }
  bool measured() const { return ran() && error; }
  /// A single packing: the scatter over packings is not known, so that it counts nowhere.
  bool saysNothing() const { return kind != CostKind::collision && !statistical; }
  /// Ends of the interval that the true error lies in, the lower at least 0. @pre measured()
  double low() const {
    return intervalLow && intervalHigh ? *intervalLow : std::max(0.0, *error - uncertainty());
  }
  double high() const {
    return intervalLow && intervalHigh ? *intervalHigh : *error + uncertainty();
  }
  /// Whether the error is below its own standard error or that of its reference.
  bool mayBeChance() const {
    return error && (*error < statistical.value_or(0.0) || *error < referenceError.value_or(0.0));
  }
  /// Value for fronts and plots: its error, the upper end where that may be
  /// chance. Absent unless it ran and its error says anything.
  std::optional<double> counted() const {
    if (!measured() || saysNothing()) return std::nullopt;
    return mayBeChance() ? high() : *error;
  }

  void fields(auto& io) {
    io("engine", engine, aName);
    io("knob", knob, aKnob);
    FIELDS(io, setting, fragment, stepsPerContact, error, statistical, systematic, referenceError,
           steps, contactEvaluations, reason);
    io("error_kind", kind);
    io("measure", measure, aName);
    io("dt_s", dt);
    io("low", intervalLow);
    io("high", intervalHigh);
    io.present("worst", worst);
    timeFields(io);
    io("status", status, costStatusNames);
  }

 private:
  double uncertainty() const {
    return saysNothing() ? std::numeric_limits<double>::infinity()
                         : statistical.value_or(0.0) + referenceError.value_or(0.0);
  }
};

/// Measures exist twice: against the case's law, and against the engine's own limit of small steps,
/// whose law may be another: "psi_f" and "psi_f_own".
bool isOwn(const std::string& measure);
std::string ownOf(const std::string& measure);
/// "psi_f_own" → "psi_f"; of positions, whose measures name their reference, as it is.
std::string withoutOwn(const std::string& measure);

/// Which series of time steps a setting belongs to: that of an engine's own integrator (empty), or
/// of another one, whose settings are "INTEGRATOR, STEP". Absent of settings of other knobs.
std::optional<std::string> schemeOf(const std::string& knob, const std::string& setting);

/// What a setting is but for its step: "iterations = 8" of "iterations = 8, dt/2"; empty of a step
/// alone.
std::string withoutStep(const std::string& knob, const std::string& setting);

/// Reference of the points of one kind of error.
struct CostReference {
  CostKind kind = CostKind::collision;
  std::string engine, setting;
  std::optional<double> error = {};  ///< of its own, in the unit of the points' errors
  std::string note;

  void fields(auto& io) {
    io("error_kind", kind);
    io("engine", engine, aName);
    FIELDS(io, setting, error, note);
  }
};

/// How far an engine's own limit of small steps lies from what the case's law gives: no time step
/// lessens it. In the unit of the points' errors.
struct CostModel {
  std::string engine;
  CostKind kind = CostKind::collision;
  std::string measure;
  double error = 0.0, low = 0.0, high = 0.0;  ///< and between which it lies

  void fields(auto& io) {
    io("engine", engine, aName);
    io("error_kind", kind);
    io("measure", measure, aName);
    FIELDS(io, error, low, high);
  }
};

/// The case's margin of an endpoint, in the unit of its points' errors.
struct CostMargin {
  std::string measure;
  double margin = 0.0;
};

void fields(auto& io, CostMargin& margin) {
  io("measure", margin.measure, aName);
  io("margin", margin.margin);
}

void fields(auto& io, PairImpacts& impacts) {
  FIELDS(io, impacts.pair, impacts.contacts);
  io("median_speed", impacts.median);
  io("fast_speed", impacts.fast);
  for (const int side : {0, 1}) {
    // No number stands for infinity in JSON: a wall's mass is absent.
    std::optional<double> mass = impacts.mass[side];
    if (!std::isfinite(*mass)) mass.reset();
    io(side == 0 ? "radius_i" : "radius_j", impacts.radius[side]);
    io(side == 0 ? "mass_i" : "mass_j", mass);
    impacts.mass[side] = mass.value_or(std::numeric_limits<double>::infinity());
  }
}

/// Contacts that begin in short runs of the scene on the in-house engine.
struct SceneImpacts {
  std::vector<PairImpacts> pairs;
  double rmsSpeed = 0.0;  ///< of the bodies that move [m/s]
  double seconds = 0.0;   ///< of the runs together [s]

  void fields(auto& io) { FIELDS(io, pairs, rmsSpeed, seconds); }
};

/// Between which an engine's largest stable step lies, by the runs of the case's time steps.
struct LargestStep {
  std::string engine;
  CostKind kind =
      CostKind::averages;             ///< that `stable` is of: whole runs, or a trajectory's window
  std::optional<double> stable;       ///< the largest that is stable as all smaller ones are [s]
  std::optional<double> unstable;     ///< the smallest that is not; absent: none was found [s]
  std::optional<double> contactTime;  ///< t_c that the steps are counted in [s]

  void fields(auto& io) {
    io("engine", engine, aName);
    io("error_kind", kind);
    io("stable_s", stable);
    io("unstable_s", unstable);
    io("contact_time_s", contactTime);
  }
};

/// An engine of which no endpoint was measured, as the budget had no room for it.
struct MissingAnswer {
  std::string engine;
  double budget = 0.0;  ///< with which the same command has room for it [s]

  void fields(auto& io) {
    io("engine", engine, aName);
    io("budget_s", budget);
  }
};

/// Time before the first step [s].
struct Startup {
  std::string engine;
  double start = 0.0, load = 0.0;

  void fields(auto& io) {
    io("engine", engine, aName);
    io("start_s", start);
    io("load_s", load);
  }
};

/// A setting whose time cannot be distinguished from that of another one.
struct TiedSetting {
  std::string knob, setting;
  bool operator==(const TiedSetting&) const = default;

  void fields(auto& io) {
    io("knob", knob, aKnob);
    io("setting", setting);
  }
};

/// The points of one kind and measure that no other is shown to beat in both error and time.
struct Front {
  CostKind kind = CostKind::collision;
  std::string measure;
  std::string engine;  ///< empty: over all engines
  std::vector<std::size_t> points;
  std::vector<double> errors;  ///< that these points count with

  void fields(auto& io) {
    io("error_kind", kind);
    io("measure", measure, aName);
    io("engine", engine, aName);
    FIELDS(io, points, errors);
  }
};

/// The setting of an engine for a target: the cheapest that collisions show to reach it and that
/// averages, whose scatter seldom decides, do not contradict. Where no collision was measured
/// averages have to show it.
struct Advice : CostTime {
  std::string engine;
  double target = 0.0;
  Verdict verdict = Verdict::notMeasured;
  /// Reached: the cheapest, of ties the most accurate; else the one whose largest upper end is
  /// smallest. Empty: none.
  std::string knob, setting, fragment;
  std::vector<CostKind> kinds;  ///< in which it was measured
  std::vector<TiedSetting>
      ties;  ///< that reach it too, in a time that cannot be distinguished from its own
  /// Simulated time that makes the statistical part as small as the target, in units of what was
  /// simulated: (statistical/target)², of the measure that takes longest.
  std::optional<double> length;
  /// The point that stands in the way, if it is not reached; if it is, an average that does not
  /// decide and has the largest upper end, `decides` is what would decide on it; or, of closed
  /// forms, a point of a smaller step that is not as near.
  std::optional<std::size_t> obstacle;
  std::optional<std::size_t> model;  ///< as of CostCell
  std::string decides;
  /// Of the engines that reach this target in the same kinds: the cheapest, or one that ties with
  /// it.
  bool cheapest = false;

  /// Whose time counts: averages if they were measured.
  std::optional<CostKind> costKind() const {
    return kinds.empty() ? std::nullopt : std::optional(kinds.back());
  }

  void fields(auto& io) {
    io("engine", engine, aName);
    io("want", target);
    io("verdict", verdict, costVerdictNames);
    io("knob", knob, aKnob);
    FIELDS(io, setting, fragment, kinds);
    timeFields(io);
    io("ties", ties);
    const auto kind = costKind();
    std::string costKind = kind ? toString(*kind) : "";  // for readers of the file: it follows
    FIELDS(io, costKind, length, obstacle, model, decides, cheapest);
  }
};

/// Reference of an engine's error.
enum class CostBasis {
  own,   ///< its own limit of small steps: what is left is discretisation
  scene  ///< the case's law: its model included
};
constexpr auto namesOf(CostBasis) {
  return std::array<std::string_view, 2>{"own", "scene"};
}
inline constexpr std::array costBases = {CostBasis::own, CostBasis::scene};

/// Which setting of an engine reaches a target in one kind of error, in all its measures, for the
/// least time. Nothing is interpolated. A setting meets the target if the upper ends of its errors
/// do; it may, if only the lower ends do. Against the case's law an error that is small because
/// the step's makes up for the model's does not count (studies/cost/analysis.hpp).
struct CostCell : CostTime {
  std::string engine;
  CostKind kind = CostKind::collision;
  CostBasis basis = CostBasis::own;
  double target = 0.0;
  Verdict verdict = Verdict::notMeasured;
  std::string knob = {}, setting = {};  ///< as of Advice
  std::vector<TiedSetting> ties = {};
  std::optional<std::size_t> point = {};  ///< its measured figure: the measure that decides
  /// Not reached, of the case's law: place in CostResults::models of a model error that alone lies
  /// above the target.
  std::optional<std::size_t> model = {};
  std::string decides = {};  ///< measurements that would decide

  bool decided() const { return verdict == Verdict::pass || verdict == Verdict::fail; }

  void fields(auto& io) {
    io("engine", engine, aName);
    io("error_kind", kind);
    FIELDS(io, basis, setting, ties, point, model, decides);
    io("want", target);
    io("verdict", verdict, costVerdictNames);
    io("knob", knob, aKnob);
    timeFields(io);
  }
};

/// Cost of accuracy: results of kind "cost" (docs/results.md).
struct CostResults : FlowFrame {
  std::optional<double> elapsed;  ///< [s]
  std::vector<EngineRow> engines;
  std::vector<PackingRow> packings;

  /// Errors and targets are in margins of the case, not fractions of a scale.
  bool inMargins = false;
  std::optional<double> target;               ///< --want: an accuracy asked for besides the usual
  std::optional<double> budget;               ///< for all that was measured [s]
  std::optional<double> budgetForTheRest;     ///< for what did not fit, all else kept [s]
  std::vector<MissingAnswer> missingAnswers;  ///< from the smallest budget
  std::vector<CostPoint> points;              ///< by kind, engine and setting
  std::vector<CostReference> references;
  std::vector<CostModel> models;
  std::optional<double> window;  ///< over which trajectories were compared, if they were [s]
  std::vector<Startup> startup;
  /// For other reasons than a step beyond the stability limit: one line each.
  std::vector<std::string> engineFailures;

  SceneImpacts impacts;  ///< whose speeds and sizes collisions have, unless cost.speed says them
  std::vector<CostMargin> margins;
  std::vector<StepTime> steps;  ///< of the scene as it grows and workers share it, by size

  // Worked out from the points (studies/cost/analysis.hpp).
  std::vector<LargestStep> largestSteps;
  std::vector<Front> fronts;
  std::vector<Advice> advice;
  std::vector<CostCell> cells;

  /// Whether the budget had no room for an endpoint of any engine.
  bool lacksEndpoints() const {
    return !missingAnswers.empty() && std::ranges::none_of(points, [](const CostPoint& point) {
      return point.kind == CostKind::averages && point.ran();
    });
  }
  /// How many points have that status.
  std::size_t count(Status status) const;

  void fields(auto& io) {
    FlowFrame::fields(io);
    io("elapsed_s", elapsed);
    FIELDS(io, engines, packings, points, references, models, startup, engineFailures, impacts,
           margins, steps, largestSteps, fronts, advice, cells);
    io.when(inMargins, "in_margins", inMargins);
    io.present("want", target);
    io("budget_s", budget);
    io("budget_for_the_rest_s", budgetForTheRest);
    io.when(!missingAnswers.empty(), "missing_answers", missingAnswers);
    io("window_s", window);
  }
};

}  // namespace crossgrain::inline results

#include <fmt/format.h>

#include <cmath>

#include "studies/cost/analysis.hpp"
#include "tests/reports/sample_common.hpp"
#include "tests/reports/sample_results.hpp"

namespace crossgrain::sample {

namespace {

constexpr double contactTime = 2e-3;

/// error = amplitude (dt/t_c)^order + floor, wall time = cost · steps.
struct Engine {
  std::string name;
  double amplitude, order, floor, cost;
};

struct Measure {
  CostKind kind;
  std::string name;
  double scale, statistical, reference;  ///< of the engine's error; 0: none
  double work;                           ///< simulated time, in t_c
};

const std::vector<Measure>& measures() {
  static const std::vector<Measure> all = {
      {CostKind::collision, "psi_f", 1.0, 0.0, 0.0, 40.0},
      {CostKind::collision, "e_n", 0.4, 0.0, 0.0, 40.0},
      {CostKind::trajectory, "position_rms_own", 0.02, 1e-8, 2e-8, 2e3},
      {CostKind::averages, "azimuthal_velocity", 0.5, 0.004, 0.001, 3e4},
      {CostKind::averages, "stress_rr", 2.0, 0.03, 0.001, 3e4},
      {CostKind::averages, "shear_band_width", 0.3, 0.02, 0.001, 3e4},
  };
  return all;
}

CostPoint pointOf(const Engine& engine, const Measure& measure, double stepsPerContact) {
  CostPoint point;
  point.engine = engine.name;
  point.knob = "time_step";
  point.setting = fmt::format("t_c/{:g}", stepsPerContact);
  point.fragment = fmt::format("[run]\nsteps_per_contact = {:g}\n", stepsPerContact);
  point.kind = measure.kind;
  point.measure = measure.name;
  point.dt = contactTime / stepsPerContact;
  point.stepsPerContact = stepsPerContact;
  const double bias =
      measure.scale * (engine.amplitude * std::pow(stepsPerContact, -engine.order) + engine.floor);
  point.error = bias;
  if (measure.kind == CostKind::collision) point.worst = 2.0 * bias;
  if (measure.statistical > 0.0) {
    // as if drawn: alternately above and below
    const double noise = measure.statistical * std::sin(stepsPerContact);
    point.error = std::abs(bias + noise);
    point.statistical = measure.statistical;
    point.systematic = std::sqrt(
        std::max(0.0, *point.error * *point.error - measure.statistical * measure.statistical));
  }
  if (measure.reference > 0.0) point.referenceError = measure.reference;
  const auto steps = static_cast<std::uint64_t>(measure.work * stepsPerContact);
  point.steps = steps;
  point.contactEvaluations = 400 * steps;
  point.wallSeconds = engine.cost * static_cast<double>(steps);
  point.cpuSeconds = 0.99 * *point.wallSeconds;
  point.timeLow = 0.95 * *point.cpuSeconds;
  point.timeHigh = 1.05 * *point.cpuSeconds;
  return point;
}

CostPoint without(CostPoint point, Status status, const std::string& reason) {
  point.error.reset();
  point.statistical.reset();
  point.systematic.reset();
  point.status = status;
  point.reason = reason;
  return point;
}

CostPoint changed(CostPoint point, const std::string& knob, const std::string& setting,
                  double error, double time) {
  point.knob = knob;
  point.setting = setting;
  point.fragment = fmt::format("[run]\n{} = \"{}\"\n", knob, setting);
  *point.error *= error;
  if (point.worst) *point.worst *= error;
  for (auto* const each : {&point.wallSeconds, &point.cpuSeconds, &point.timeLow, &point.timeHigh})
    **each *= time;
  return point;
}

std::vector<CostPoint> pointsOf(const Engine& engine) {
  std::vector<CostPoint> points;
  for (const Measure& measure : measures()) {
    for (const double steps : {400.0, 200.0, 100.0, 50.0, 25.0, 10.0, 5.0}) {
      CostPoint point = pointOf(engine, measure, steps);
      if (engine.name == "yade" && measure.kind == CostKind::averages && steps > 100.0)
        point = without(point, Status::notRun, "would take about 140 s, budget 60 s");
      points.push_back(point);
    }
    points.push_back(without(pointOf(engine, measure, 1.2), Status::failed,
                             "a disk left the cell at step 37; " + std::string(awkward)));
  }
  return points;
}

}  // namespace

CostResults costResults() {
  const std::vector<Engine> engines = {{"grain", 6.0, 2.0, 0.0, 5e-6},
                                       {"yade", 6.0, 1.0, 0.02, 8e-5},
                                       {"box2d-penalty", 9.0, 1.0, 1e-6, 4e-5}};
  CostResults results = fromJson<CostResults>(head("cost", "quick"));
  std::vector<CostPoint>& points = results.points;
  for (const Engine& engine : engines)
    for (const CostPoint& point : pointsOf(engine)) points.push_back(point);
  for (const Measure& measure : measures()) {
    const CostPoint base = pointOf(engines[0], measure, 50.0);
    points.push_back(changed(base, "precision", "float", 1.02, 0.6));
    points.push_back(changed(base, "tension", "cut", 30.0, 0.97));
    points.push_back(changed(base, "skin", "2 d", 1.0, 1.3));
    for (const double steps : {200.0, 100.0, 50.0, 25.0})
      points.push_back(changed(pointOf({"grain", 6.0, 1.0, 0.0, 5e-6}, measure, steps),
                               "integrator", fmt::format("semi_implicit_euler, t_c/{:g}", steps),
                               1.0, 0.98));
  }
  results.notes.clear();
  results.budget = 720.0;
  results.budgetForTheRest = 1396.0;
  results.engines = {{"grain", "the in-house engine", "1.0", "", Status::finished, ""},
                     {"yade", "YADE", "1.0", "", Status::finished, ""},
                     {"box2d-penalty", "Box2D", "1.0", "", Status::finished, ""},
                     {"box2d-impulse", "Box2D", "1.0", "", Status::refused, awkward}};
  results.references = {{CostKind::collision, "oracle", "10⁻¹²", 1e-11, "planar two-body problem"},
                        {CostKind::averages, "grain", "t_c/400", 0.001, awkward}};
  results.window = 0.8;
  results.margins = {{"azimuthal_velocity", 0.1}, {"stress_rr", 0.25}, {"shear_band_width", 0.1}};
  results.impacts = {{{"small-small", 120, 0.012, 0.05, {0.0037, 0.0037}, {2.7e-4, 2.7e-4}},
                      {"small-wall", 30, 0.02, 0.06, {0.0037, 0.00125}, {2.7e-4, INFINITY}}},
                     0.02,
                     0.8};
  for (const std::size_t bodies : {246u, 984u})
    for (const int workers : {1, 2}) {
      StepTime& time = results.steps.emplace_back();
      time.engine = "grain";
      time.bodies = bodies;
      time.workers = workers;
      time.workersAre = "threads";
      time.steps = 1000;
      time.step = 4e-8 * static_cast<double>(bodies) / (workers == 1 ? 1.0 : 1.6);
      time.seconds = {0.98 * time.step, 1.02 * time.step};
      time.low = 0.9 * time.step;
      time.high = 1.1 * time.step;
      time.memory = 2e7 + 300.0 * static_cast<double>(bodies);
      time.precision = "double";
      time.dt = 4e-5;
    }
  StepTime& refused = results.steps.emplace_back(StepTime{.engine = "yade", .bodies = 984});
  refused.status = Status::refused;
  refused.reason = awkward;
  results.startup = {{"grain", 0.004, 0.001}, {"yade", 1.4, 0.3}};
  addCostAnalysis(results);
  return results;
}

}  // namespace crossgrain::sample

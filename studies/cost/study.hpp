#pragma once

#include <array>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "cases/case.hpp"
#include "results/cost.hpp"
#include "studies/core/run_store.hpp"
#include "studies/cost/settings.hpp"
#include "studies/flow/campaign.hpp"

namespace crossgrain::inline studies {

/// @name Stability limits
/// @{

/// Beginning of the reason of every point past a stability limit: such a failure is a result.
inline constexpr const char* beyondLimit = "beyond its stability limit";

/// The largest stable step of a contact, 2/ω with ω² = k_n/m₁₂ [s]: what a symplectic integrator
/// bears of an undamped oscillator.
double pairLimit(const Case& setup);

/// The smallest step at which a packing may be unstable [s]: 2/ω of a disk between six others, six
/// times as stiff as a pair (Gershgorin: ω² ≤ 6 · 2 k_n/m).
double packingLimit(const Case& setup);

/// Whether a packing has blown up: the rms speed is no number, or exceeds ten times drivenSpeed().
/// @throws EngineFailure that says so, after `beyondLimit`
template <int D>
void requireSound(const SceneOf<D>& scene, const SnapshotOf<D>& snapshot);

/// The fastest that anything may be in a scene without an instability: as its bodies and walls move
/// at first, and as they fall through all of it, √(2 g L) [m/s].
template <int D>
double drivenSpeed(const SceneOf<D>& scene);

/// @}

/// Returns the stored result of that name, else that of `make`, which is then kept.
template <class Make>
auto keptOr(const RunStore& store, const std::string& name, const CaseKeys& key, Make make) {
  using Run = decltype(make());
  if (auto kept = store.findAs<Run>(name, key)) return std::move(*kept);
  Run made = make();
  store.keep(name, key, jsonOf(made));
  return made;
}

/// One round of a setting: a sweep of collisions, or one packing; kept as it is.
struct CostRun {
  double dt = 0.0;                                  ///< [s]
  double wallSeconds = 0.0, cpuSeconds = 0.0;       ///< of the kind's piece of work [s]
  std::uint64_t steps = 0, contactEvaluations = 0;  ///< of the same
  /// By measure, as each kind of error has them; absent where the run has no such number.
  std::map<std::string, std::vector<std::optional<double>>> numbers = {};
  Status status = Status::finished;
  std::string reason = {};  ///< unless it finished: one line
};

void fields(auto& io, CostRun& run) {
  io("dt_s", run.dt);
  io("wall_s", run.wallSeconds);
  io("cpu_s", run.cpuSeconds);
  FIELDS(io, run.steps, run.contactEvaluations, run.numbers);
  io("status", run.status, costStatusNames);
  io("reason", run.reason);
}

/// Between which the geometric mean of positive numbers lies (Student, 95 %); absent of a single
/// one.
struct GeometricMean {
  double mean;
  std::optional<double> low, high;
};
GeometricMean geometricMean(const std::vector<double>& numbers);

/// A point without error, with the times of its rounds: geometric means, as what disturbs a run
/// multiplies its time, and Student's interval of their logarithms.
/// @param runs  all of them finished, at least one
CostPoint timedPoint(const std::string& engine, const CostSetting& setting, CostKind kind,
                     const std::vector<CostRun>& runs);

/// Times to load a scene and to step it [s].
struct SceneTimes {
  double load = 0.0, step = 0.0;
};

/// Of all collisions of a flow, side by side as errors run them, at a step of the engine [s].
/// @throws EngineFailure, UnsupportedScene
SceneTimes timeCollisions(Engine& engine, const EngineEntry& entry, const Case& setup, double step);

/// An engine, its worker, what it takes to start and to step, and what there is to measure on it.
struct TimedEngine {
  std::array<std::vector<CostSetting>, costKinds.size()> settings;  ///< by CostKind
  double start = 0.0;                                               ///< [s]
  SceneTimes scene, collisions;  ///< of a state along the flow, and of two bodies at a time
  bool takesPart = false;
  std::unique_ptr<Engine> worker;  ///< null: to be started anew
};

/// One setting of one engine, all measures of one kind of error.
struct PlannedPoint {
  std::size_t engine = 0;
  CostKind kind = CostKind::collision;
  std::size_t setting = 0;  ///< of that engine and kind; 0 is the case as it is
  double seconds = 0.0;     ///< predicted; 0: an earlier run has it, or it is refused
  double round = 0.0;       ///< of one of its rounds
  std::size_t turn = 0;     ///< among its engine's points, from the cheapest
};

/// Data of planning and measuring: engines and packings, the settings to measure, and the names and
/// keys of the results in the store.
///
///   ask          of a dry run
///   prepare      of a real one
struct CostStudy {
  /// @throws BadInput for rigid bodies without closed forms
  CostStudy(const Case& setup, const RunCommand& command, RunStore& store);

  /// Which settings there are and which packings there would be; computes nothing.
  void ask();
  /// Engines, packings, settings, and what starts and steps take.
  void prepare();

  const EngineEntry& entryOf(std::size_t engine) const { return campaign.engines()[engine]; }
  const Capabilities& canOf(std::size_t engine) const { return *campaign.capabilities(engine); }
  /// Its worker, started when it is first needed and again after it failed.
  Engine& workerOf(std::size_t engine);
  const std::vector<CostSetting>& settingsOf(std::size_t engine, CostKind kind) const {
    return engines[engine].settings[static_cast<std::size_t>(kind)];
  }
  const CostSetting& settingOf(const PlannedPoint& point) const {
    return settingsOf(point.engine, point.kind)[point.setting];
  }
  double stepOf(std::size_t engine, const Case& setup) const;  ///< that it will take [s]
  /// Whether rounds repeat one start, for its time: else each is a packing.
  bool isRepeated(CostKind kind) const {
    return kind == CostKind::collision || (kind == CostKind::averages && hasClosedForms(setup));
  }
  /// Where paths begin, one for each packing: a cell's packings are sheared already; of others
  /// states along the flow, as nothing may touch at their start.
  const std::vector<Packing>& trajectoryStarts() const {
    return states_.empty() ? campaign.packings() : states_;
  }

  /// By what it is, not by its place in lists that may grow: "averages-grain-time_step-t_c-50".
  std::string nameOf(const PlannedPoint& point) const;
  std::string nameOf(const PlannedPoint& point, std::size_t round) const;
  CaseKeys keyOf(const PlannedPoint& point, std::size_t round) const;
  /// Of what the in-house engine does for all: it need not be among the engines named.
  CaseKeys inHouseKey(std::size_t packing, const std::string& part) const;

  Case setup;  ///< with what a run of the scene shows of its collisions, once prepared
  const int jobs;
  Campaign campaign;
  std::vector<TimedEngine> engines;
  SceneImpacts impacts;        ///< of a real run
  const EngineEntry& inHouse;  ///< whose runs are references for all
  std::unique_ptr<Engine> inHouseEngine;
  double inHouseStep = 0.0;  ///< duration of one of its steps [s]
  /// For other reasons than a step beyond the stability limit.
  std::vector<std::string> engineFailures;

 private:
  void listSettings(std::size_t engine);
  void timeStart(std::size_t engine);
  void timeInHouse();
  void findStates();
  void findImpacts();

  std::vector<Packing> states_;
};

/// A run takes many times what was predicted, as those do that blow up and do not end.
struct TakesTooLong : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// One kind of error: how its points are predicted and measured, and what against. All settings of
/// all engines are run once, then all of them again, so that a machine that is busy for a while
/// disturbs a round of many and not all rounds of one.
///
///   predicted, commonTime, ownTime ── makeReferences ── run … ── points … ── addTo
class ErrorKind {
 public:
  explicit ErrorKind(CostStudy& study) : study_(study) {}
  virtual ~ErrorKind() = default;
  ErrorKind(const ErrorKind&) = delete;
  ErrorKind& operator=(const ErrorKind&) = delete;

  virtual CostKind kind() const = 0;
  virtual std::vector<std::string> measures() const = 0;
  virtual std::size_t rounds() const = 0;
  /// Time of all rounds of a setting on an engine; what references of the first rounds take
  /// that all engines share, and an engine's own [s].
  virtual double predicted(std::size_t engine, const CostSetting& setting) const = 0;
  virtual double commonTime(std::size_t) const { return 0.0; }
  virtual double ownTime(std::size_t engine) const = 0;
  /// Whether what is kept of a point needs none of those references any more.
  virtual bool keptSuffice() const { return true; }
  /// Those references that all points of the first rounds need. Not called where they take too
  /// long.
  virtual void makeReferences(std::size_t) {}
  /// @param longest  that whole runs may take [s]
  /// @throws as Engine does, TakesTooLong
  virtual CostRun run(const PlannedPoint& point, std::size_t round, double longest) = 0;
  /// One point per measure. @param runs  of all rounds, finished
  virtual std::vector<CostPoint> points(const PlannedPoint& point,
                                        const std::vector<CostRun>& runs) const = 0;
  /// Adds its references and what else it has found out.
  virtual void addTo(CostResults& results) const = 0;

 protected:
  CostStudy& study_;
};

}  // namespace crossgrain::inline studies

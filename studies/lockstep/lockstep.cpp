#include "studies/lockstep/lockstep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <optional>

#include "adapters/registry.hpp"
#include "adapters/suitability.hpp"
#include "adapters/worker/json.hpp"
#include "cases/flow.hpp"
#include "results/lockstep_findings.hpp"
#include "studies/core/engine_access.hpp"
#include "studies/core/executor.hpp"
#include "studies/lockstep/account.hpp"
#include "studies/lockstep/closest_term.hpp"
#include "studies/lockstep/declared_causes.hpp"
#include "studies/lockstep/responses.hpp"
#include "studies/lockstep/rules.hpp"
#include "studies/lockstep/separation.hpp"
#include "studies/lockstep/starts.hpp"
#include "studies/lockstep/terms.hpp"
#include "studies/lockstep/window.hpp"

namespace crossgrain::inline studies {
namespace {

/// The scheme of a mirror.
struct MirrorScheme {
  Integrator integrator = Integrator::positionVerlet;
  bool positionsFirst = false;  ///< disks move with the velocities of the start before any kick
};

/// As the engine declares it by its integrator and by how its velocities lie to its positions:
/// velocity_lag is dt/2 where a kick precedes its drift (semi-implicit Euler), -dt/2 where the
/// drift comes first, and 0 in both Verlet schemes.
/// @param law  as the engine runs it
/// @throws UnsupportedScene where the in-house engine has no such scheme
MirrorScheme schemeOf(const Capabilities& can, const ContactLaw& law,
                      const EffectiveParameters& effective) {
  constexpr double rounding = 1e-6;
  const double lag = effective.velocityLag / effective.dt;
  const auto is = [lag](double value) { return std::abs(lag - value) < rounding; };
  if (is(-0.5)) return {Integrator::semiImplicitEuler, true};
  const bool declared = law.soft() && can.lawOptions.contains("integrator");
  const Integrator own = law.conventions.integrator;
  if (declared && (is(0.0) || (is(0.5) && own == Integrator::semiImplicitEuler)))
    return {own, false};
  if (!declared && is(0.5)) return {Integrator::semiImplicitEuler, false};
  if (!declared && is(0.0) && law.soft()) return {own, false};
  throw UnsupportedScene(
      fmt::format("no mirror has its time stepping: {}, velocities {:g} dt behind their time",
                  effective.integrator, lag));
}

/// The in-house engine, which kicks before it drifts, one step behind from where the first drift
/// leads: x₁ = x₀ + v₀ dt, then kick and drift as ever.
class PositionsFirst : public Engine {
 public:
  PositionsFirst() : own_(engineRegistry().front().make()) {}

  Capabilities capabilities() const override { return own_->capabilities(); }
  /// @throws UnsupportedScene for walls that move: theirs would be the place of a step before
  EffectiveParameters load(const Scene& scene, const Settings& settings) override {
    for (const WallBody& body : scene.bodies)
      if (body.motion.kind != Motion::Kind::fixed)
        throw UnsupportedScene("no mirror moves disks before it kicks them where walls move");
    Scene drifted = scene;
    for (std::size_t i = 0; i < scene.disks.size(); ++i)
      drifted.disks.position[i] += scene.dt * scene.disks.velocity[i];
    EffectiveParameters effective = own_->load(drifted, settings);
    dt_ = effective.dt;
    return effective;
  }
  double advance(double t) override { return own_->advance(t - dt_) + dt_; }
  Snapshot snapshot(ContactReport contacts) override {
    Snapshot now = own_->snapshot(contacts);
    for (double* time : {&now.positionTime, &now.velocityTime, &now.contactTime}) *time += dt_;
    return now;
  }
  Stats stats() const override { return own_->stats(); }

 private:
  std::unique_ptr<Engine> own_;
  double dt_ = 0.0;  ///< [s]
};

/// One engine against its mirror from one state after the other.
template <int D>
class Comparison {
 public:
  Comparison(Engine& engine, const EngineEntry& entry, const Case& setup, double dt)
      : engine_(engine), entry_(entry), setup_(setup), dt_(dt), can_(engine.capabilities()) {}

  /// @throws EngineFailure, UnsupportedScene
  void follow(std::size_t start, const FlowState& state) {
    const SceneOf<D> scene = flowScene<D>(setup_, state.packing, dt_);
    EffectiveParameters effective = loadScene(engine_, entry_, setup_, scene);
    if (effective_) requireSameStep(*effective_, effective);
    step_ = effective.dt;
    steps_ = lockstepSteps(step_);
    const SceneOf<D> mirrored = sceneOfMirror(can_, entry_, setup_, scene, effective);
    if (!mirror_) mirror_ = mirrorOf(can_, entry_, setup_, scene, effective);
    loadOn(*mirror_, mirrored, {});
    const LockstepWindowOf<D> window = windowFrom(mirrored);
    if (!account_) account_.emplace(flowDiameter(setup_), timesOf(steps_, step_), reported());
    const Responses moved = byMirror([&] { return responses(mirrored, window); });
    const std::vector<double> limits = byMirror([&] {
      return precisionLimits(effective.precision, *mirror_, mirrored, window.mirror, steps_,
                             flowDiameter(setup_));
    });
    account_->add(start, window, moved, mirrored.disks.size(), limits);
    frames_.add(window, reported());
    scenes_.push_back(mirrored);
    cases_.push_back(scene);
    cases_.back().precision = Precision::float64;
    cases_.back().dt = step_;
    if (!effective_) effective_ = std::move(effective);
  }

  LockstepRow result() {
    LockstepRow row;
    if (account_) {
      row = account_->row();
      if (hasTerm(row))
        row.term = closestTerm(
            *mirror_, TermSearchOf<D>{scenes_, frames_.instants(row.first, flowDiameter(setup_)),
                                      flowDiameter(setup_)});
      const bool names = row.verdict == Equivalence::differs && row.term;
      if (row.starts > 0)
        row.causes = causesInLockstep<D>(*mirror_, cases_, scenes_, names ? &*row.term : nullptr,
                                         flowDiameter(setup_));
      // Of rigid disks: impulses of one step, most of them of nothing but rounding.
      if (!setup_.law.soft()) row.forces.reset();
      row.effective = effective_;
    }
    row.engine = entry_.name;
    return row;
  }

 private:
  /// Frames nearest to lockstepTimes.
  std::vector<std::size_t> reported() const {
    std::vector<std::size_t> frames;
    for (const double time : lockstepTimes) frames.push_back(frameAt(steps_, step_, time));
    return frames;
  }

  /// Both from the scene that they have been loaded with.
  /// @throws EngineFailure, UnsupportedScene where the in-house engine fails from there, too
  LockstepWindowOf<D> windowFrom(const SceneOf<D>& mirrored) {
    try {
      return followBoth<D>(engine_, *mirror_, step_, steps_, can_.instantContacts, 0.0,
                           mirrored.box);
    } catch (const EngineFailure&) {
      loadOn(*mirror_, mirrored, {});
      byMirror([&] { return crossgrain::follow<D>(*mirror_, step_, steps_); });
      throw;
    }
  }

  /// Responses of the mirror to changes of the reference constant from here.
  Responses responses(const SceneOf<D>& mirrored, const LockstepWindowOf<D>& window) {
    std::vector<LockstepFrameOf<D>> unchanged;
    for (const std::size_t frame : reported()) unchanged.push_back(window.mirror[frame]);
    return referenceResponses(*mirror_, unchanged, flowDiameter(setup_), [&](double change) {
      SceneOf<D> changed = mirrored;
      changeLaws(changed, [&](ContactLaw& law) { changeReference(law, change); });
      loadOn(*mirror_, changed, {});
      return step_;
    });
  }

  Engine& engine_;
  const EngineEntry& entry_;
  const Case& setup_;
  double dt_;  ///< the case's [s]
  Capabilities can_;
  std::unique_ptr<Engine> mirror_;
  double step_ = 0.0;  ///< the engine's [s]
  std::vector<std::uint64_t> steps_;
  std::optional<SeparationAccount> account_;
  TermFramesOf<D> frames_;
  std::vector<SceneOf<D>> scenes_;  ///< the mirror's, by start
  std::vector<SceneOf<D>> cases_;   ///< likewise, of the case's own law
  std::optional<EffectiveParameters> effective_;
};

}  // namespace

template <int D>
SceneOf<D> sceneOfMirror(const Capabilities& can, const EngineEntry& entry, const Case& setup,
                         const SceneOf<D>& scene, const EffectiveParameters& effective) {
  SceneOf<D> theirs = sceneFor(can, entry, setup, scene).scene;
  theirs.precision = Precision::float64;
  theirs.dt = effective.dt;
  const Integrator integrator = schemeOf(can, theirs.law, effective).integrator;
  changeLaws(theirs, [&](ContactLaw& law) { law.conventions.integrator = integrator; });
  return theirs;
}
template Scene sceneOfMirror(const Capabilities&, const EngineEntry&, const Case&, const Scene&,
                             const EffectiveParameters&);
template SpaceScene sceneOfMirror(const Capabilities&, const EngineEntry&, const Case&,
                                  const SpaceScene&, const EffectiveParameters&);

template <int D>
std::unique_ptr<Engine> mirrorOf(const Capabilities& can, const EngineEntry& entry,
                                 const Case& setup, const SceneOf<D>& scene,
                                 const EffectiveParameters& effective) {
  const ContactLaw law = sceneFor(can, entry, setup, scene).scene.law;
  if (schemeOf(can, law, effective).positionsFirst) return std::make_unique<PositionsFirst>();
  return engineRegistry().front().make();
}
template std::unique_ptr<Engine> mirrorOf(const Capabilities&, const EngineEntry&, const Case&,
                                          const Scene&, const EffectiveParameters&);
template std::unique_ptr<Engine> mirrorOf(const Capabilities&, const EngineEntry&, const Case&,
                                          const SpaceScene&, const EffectiveParameters&);

bool hasTerm(const LockstepRow& row) {
  const bool measured = row.verdict == Equivalence::sameLaw ||
                        row.verdict == Equivalence::differs ||
                        row.verdict == Equivalence::undecided;
  return measured && std::ranges::any_of(row.readings, [](const StartReading& reading) {
           return reading.beyond || reading.equivalent.value_or(0.0) >= leastNamed;
         });
}

namespace {

template <int D>
LockstepRow holdIn(Engine& engine, const EngineEntry& entry, const Case& setup,
                   const std::vector<FlowState>& states, double dt,
                   const std::function<void(double)>& progress) {
  const auto began = std::chrono::steady_clock::now();
  Comparison<D> comparison(engine, entry, setup, dt);
  std::string failure, refusal;
  try {
    for (std::size_t s = 0; s < states.size(); ++s) {
      comparison.follow(s, states[s]);
      progress(static_cast<double>(s + 1) / static_cast<double>(states.size()));
    }
  } catch (const EngineFailure& error) {
    failure = error.what();
  } catch (const UnsupportedScene& error) {
    refusal = error.what();
  }
  LockstepRow row = comparison.result();
  row.failure = failure;
  if (row.starts == 0) row.reason = refusal.empty() ? failure : refusal;
  row.wallSeconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  return row;
}

}  // namespace

LockstepRow holdAgainstMirror(Engine& engine, const EngineEntry& entry, const Case& setup,
                              const std::vector<FlowState>& states, double dt,
                              const std::function<void(double)>& progress) {
  return setup.dimension == 3 ? holdIn<3>(engine, entry, setup, states, dt, progress)
                              : holdIn<2>(engine, entry, setup, states, dt, progress);
}

std::string noMirrorReason(const EngineEntry& entry, const Capabilities& can, const Case& setup) {
  if (entry.name == engineRegistry().front().name)
    return "mirrors are made of this engine: it is its own";
  if (!hasNormalLaw(can, setup.law))
    return "has another normal law in place of the case's: no mirror stands for it step by step";
  return {};
}

namespace {

std::string describe(Equivalence verdict) {
  std::string words(nameOf(verdict));
  std::ranges::replace(words, '_', ' ');
  return words;
}

/// The states of a flow, as their packings, their number and the case determine them: not made
/// again where all that starts from them is there.
struct KeptStarts {
  std::vector<LockstepStart> starts;

  void fields(auto& io) { io("starts", starts); }
};

CaseKeys keyOf(const Case& setup, const LockstepEngine& engine, const LockstepPlan& plan) {
  CaseKeys key = runKey(setup, engine.entry.name, engine.version);
  std::string from = std::to_string(plan.starts);
  for (const Packing& packing : plan.packings) from += " " + packing.hash;
  key["starts"] = from;
  return key;
}

/// Of a kept result: one for each number of packings that starts come from, as more packings have
/// other starts and take nothing back.
std::string nameOf(const std::string& what, const LockstepPlan& plan) {
  return fmt::format("{}-from-{}", what, plan.packings.size());
}

/// Time is over, for the reason in it.
struct OutOfTime {
  std::string reason;
};

/// @throws OutOfTime
void requireTime(const LockstepPlan& plan) {
  if (std::string reason = plan.outOfTime(); !reason.empty()) throw OutOfTime{std::move(reason)};
}

CachedTask<LockstepRow> taskOf(const LockstepEngine& engine, const Case& setup,
                               const LockstepPlan& plan, const std::vector<FlowState>& states,
                               const RunStore& store) {
  const EngineEntry& entry = engine.entry;
  CachedTask<LockstepRow> task;
  task.name = nameOf("lockstep-" + entry.name, plan);
  task.label = entry.name;
  task.key = keyOf(setup, engine, plan);
  task.weight = entry.command ? 10.0 : 1.0;
  task.work = [&entry, &setup, &states, &store,
               &plan](const std::function<void(double)>& progress) {
    LockstepRow row;
    row.engine = entry.name;
    const auto whileTime = [&](double fraction) {
      progress(fraction);
      if (fraction < 1.0) requireTime(plan);
    };
    try {
      requireTime(plan);
      const auto worker =
          startAudited(entry, store.scratch("lockstep-" + entry.name), setup.run.timeout);
      row.reason = noMirrorReason(entry, worker->capabilities(), setup);
      if (row.reason.empty())
        row = holdAgainstMirror(*worker, entry, setup, states, plan.dt, whileTime);
    } catch (const OutOfTime& late) {
      row.reason = late.reason;
      return CachedTask<LockstepRow>::Outcome{std::move(row), false, late.reason};
    } catch (const UnsupportedScene& refusal) {
      row.reason = refusal.what();
    } catch (const EngineFailure& failure) {
      row.reason = row.failure = failure.what();
    }
    const bool finished = row.failure.empty();
    const std::string line = finished ? describe(row.verdict) : row.failure;
    return CachedTask<LockstepRow>::Outcome{std::move(row), finished, line};
  };
  return task;
}

/// Where the in-house engine, which all mirrors are made of, cannot run the scene, or has no time
/// to: engines are compared with each other all the same.
LockstepFindings withoutMirrors(const std::vector<LockstepEngine>& engines, const Case& setup,
                                const std::string& why) {
  LockstepFindings findings;
  findings.rules = lockstepRules(setup.law);
  for (const LockstepEngine& engine : engines) {
    LockstepRow& row = findings.rows.emplace_back();
    row.engine = engine.entry.name;
    row.reason = why;
  }
  return findings;
}

}  // namespace

LockstepFindings holdAgainstMirrors(const std::vector<LockstepEngine>& engines, const Case& setup,
                                    const LockstepPlan& plan, const RunStore& store,
                                    Progress& progress) {
  std::vector<FlowState> states;
  std::vector<CachedTask<LockstepRow>> tasks;
  for (const LockstepEngine& engine : engines)
    tasks.push_back(taskOf(engine, setup, plan, states, store));
  const std::string name = nameOf("starts-of-lockstep", plan);
  const CaseKeys key = keyOf(setup, {engineRegistry().front(), {}}, plan);
  auto kept = store.findAs<KeptStarts>(name, key);
  if (!kept || !std::ranges::all_of(tasks, [&](const auto& task) {
        return store.find(task.name, task.key).has_value();
      })) {
    progress.begin("finding states of the flow", {1.0});
    try {
      states = statesAlongTheFlow(
          setup, plan.packings, plan.dt, plan.starts,
          [&](double fraction) {
            requireTime(plan);
            progress.update(0, "states", fraction);
          },
          plan.jobs);
    } catch (const UnsupportedScene& refusal) {
      return withoutMirrors(engines, setup,
                            fmt::format("there is no mirror: {}, which mirrors are made of, {}",
                                        engineRegistry().front().name, refusal.what()));
    } catch (const OutOfTime& late) {
      return withoutMirrors(engines, setup, late.reason);
    }
    kept.emplace();
    for (const FlowState& state : states) kept->starts.push_back(state.start);
    store.keep(name, key, jsonOf(*kept));
  }
  if (kept->starts.size() < plan.starts)
    progress.say(fmt::format("{} different starts along the flow, of the {} asked for",
                             kept->starts.size(), plan.starts));
  LockstepFindings findings;
  findings.rules = lockstepRules(setup.law);
  findings.starts = std::move(kept->starts);
  findings.rows = runOrLoad(tasks, store, progress, "lockstep", plan.jobs);
  return findings;
}

}  // namespace crossgrain::inline studies

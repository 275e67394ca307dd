#include "studies/stability/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "adapters/registry.hpp"
#include "adapters/suitability.hpp"
#include "adapters/worker/json.hpp"
#include "cases/collision_scene.hpp"
#include "cases/flow.hpp"
#include "cases/time_step.hpp"
#include "results/scene_picture.hpp"
#include "results/stability.hpp"
#include "stability/measures.hpp"
#include "stability/verdict.hpp"
#include "studies/core/engine_access.hpp"
#include "studies/core/engine_running.hpp"
#include "studies/core/in_space.hpp"
#include "studies/core/study.hpp"
#include "studies/lockstep/window.hpp"
#include "studies/stability/transforms.hpp"
#include "support/bad_input.hpp"
#include "support/interrupt.hpp"

namespace crossgrain::inline studies {

template <int D>
HardSceneOf<D> plainScene(const Case& setup, const Packing& packing) {
  const double dt = timeStep(setup);
  if (isCollision(setup))
    return {&setup, sweepScene<D>(setup, collisionStarts(setup), dt),
            dt + 2.5 * impactTimes(setup).longest + 20.0 * dt};
  const bool prepared = !packing.hash.empty();
  const auto scene = [&](const Packing& start) {
    return HardSceneOf<D>{&setup, flowScene<D>(setup, start, dt), flowDuration(setup)};
  };
  if (prepared) return scene(packing);
  return scene(flowPacking(setup, 0, dt, *engineRegistry().front().make(), [](double) {}));
}
template HardSceneOf<2> plainScene<2>(const Case&, const Packing&);
template HardSceneOf<3> plainScene<3>(const Case&, const Packing&);

namespace {

/// How the case turns and moves its assembly as a whole; only one of the plane is.
Placement placementOf(const Case& setup) {
  const auto* const assembly = std::get_if<Assembly>(&setup.source);
  return assembly ? assembly->placement : Placement();
}

/// Starts of all collisions of the scene, which has each of the case's as often as in
/// collisionsAt().
template <int D>
std::vector<CollisionStart> startsOf(const Case& setup, const SceneOf<D>& scene) {
  if (!isCollision(setup)) return {};
  const std::vector<CollisionStart> once = collisionStarts(setup);
  const std::size_t all = scene.disks.size() / (collisionIn(setup).wall ? 1 : 2);
  std::vector<CollisionStart> starts;
  for (std::size_t k = 0; k < all; ++k) starts.push_back(once[k % once.size()]);
  return starts;
}

/// Unwraps positions that an engine has wrapped into a periodic box, by the velocity of the
/// snapshot before.
template <int D>
void unwrap(SnapshotOf<D>& now, const SnapshotOf<D>& before, const SceneOf<D>& scene) {
  std::vector<VecOf<D>> expected = before.position;
  for (std::size_t i = 0; i < expected.size(); ++i)
    expected[i] += (now.positionTime - before.positionTime) * before.velocity[i];
  unwrap<D>(now.position, expected, scene.box);
}

/// Has an engine load the scene and takes the case's samples while it runs. An engine that fails
/// on the way ends the recording there, with the reason and what was seen before.
/// @param progress  called with the fraction done, 0 … 1
/// @throws UnsupportedScene, BadInput, Interrupted
template <int D>
RecordingOf<D> record(Engine& engine, const EngineEntry& entry, const HardSceneOf<D>& hard,
                      const std::function<void(double)>& progress) {
  const Case& setup = *hard.setup;
  RecordingOf<D> run{hard.scene,
                     {},
                     {},
                     {},
                     setup.stability->settle,
                     placementOf(setup),
                     startsOf(setup, hard.scene),
                     lawAsRun(engine.capabilities(), hard.scene.law),
                     setup.stability->stands};
  try {
    run.effective = loadScene(engine, entry, setup, hard.scene);
    run.snapshots.push_back(snapshotOf<D>(engine, ContactReport::none));
    const int samples = setup.stability->samples;
    const int more = stabilityMeasure(setup.stability->measure).steps;
    double now = 0.0;
    for (int k = 1; k <= samples; ++k) {
      const double next = hard.duration * k / samples;
      for (int step = 0; step <= more; ++step) {
        const double then = next + step * run.effective.dt;
        if (then > hard.duration * (k + 1) / samples) break;
        advanceInPieces(engine, run.effective, now, then);
        now = then;
        SnapshotOf<D> seen = snapshotOf<D>(engine, ContactReport::instant);
        unwrap(seen, run.snapshots.back(), hard.scene);
        run.snapshots.push_back(std::move(seen));
      }
      progress(static_cast<double>(k) / samples);
    }
  } catch (const EngineFailure& failure) {
    run.failure = failure.what();
  }
  return run;
}

/// The scene of a case as the task has it, with what its measure takes.
template <int D>
HardSceneOf<D> sceneOf(const StabilityTask& task, const Case& setup) {
  HardSceneOf<D> hard = plainScene<D>(setup, *task.packing);
  // No engine has one in space, nor in a periodic box.
  hard.scene.energyLedger =
      setup.run.energyLedger ||
      (D == 2 && !hard.scene.box && stabilityMeasure(setup.stability->measure).takesLedger);
  if constexpr (D == 2)
    if (task.inSpace) hard.scene = ofSpheres(std::move(hard.scene));
  return hard;
}

/// A worker of the task's engine. @param engine  one that has begun
std::unique_ptr<Engine> asTaskHasIt(const StabilityTask& task, std::unique_ptr<Engine> engine) {
  return task.inSpace ? runInSpace(std::move(engine)) : std::move(engine);
}

StabilityRun rowOf(const StabilityTask& task) {
  const Stability& hard = *task.setup->stability;
  StabilityRun row;
  row.engine = task.entry.name;
  row.name = task.setup->name;
  row.variant = task.setup->variant;
  row.measure = hard.measure;
  row.limit = hard.limit;
  row.degradedLimit = hard.degraded;
  row.unit = stabilityMeasure(hard.measure).unit;
  return row;
}

void refuse(StabilityRun& row, const std::string& reason) {
  row.status = Status::refused;
  row.verdict = Verdict::notApplicable;
  row.reason = reason;
}

void fail(StabilityRun& row, const std::string& reason) {
  row.status = Status::failed;
  row.verdict = Verdict::fail;
  row.reason = "failed: " + reason;
}

/// A figure that is one number.
void judgeNumber(StabilityRun& row, const Stability& hard, double value) {
  const StabilityJudgement judged = judgeStability(hard, {value});
  row.verdict = judged.verdict;
  row.value = judged.value;
}

template <int D>
void placeInTime(StabilityRun& row, const RecordingOf<D>& run, std::size_t sample) {
  row.time = run.snapshots[sample].positionTime;
  row.step = std::llround(*row.time / run.effective.dt);
}

/// Every few samples are enough for a plot.
template <int D>
void keepCurve(StabilityRun& row, const RecordingOf<D>& run, const std::vector<double>& curve) {
  constexpr std::size_t most = 200;
  const std::size_t stride = std::max<std::size_t>(1, (curve.size() + most - 1) / most);
  for (std::size_t k = 0; k < curve.size(); ++k) {
    if (k % stride != 0 && k + 1 != curve.size()) continue;
    row.curve.time.push_back(run.snapshots[k].positionTime);
    row.curve.value.push_back(curve[k]);
  }
}

/// The engine did not get to the end.
template <int D>
void judgeFailure(StabilityRun& row, const RecordingOf<D>& run) {
  fail(row, run.failure);
  if (run.snapshots.empty()) return;
  placeInTime(row, run, run.snapshots.size() - 1);
  row.picture = scenePicture(run.scene, run.snapshots.back(), 0.0);
}

template <int D>
void judgeCurve(StabilityRun& row, const Stability& hard, const RecordingOf<D>& run,
                const std::vector<double>& curve) {
  if (curve.empty()) return refuse(row, std::string(stabilityMeasure(hard.measure).absent));
  const StabilityJudgement judged = judgeStability(hard, curve);
  row.verdict = judged.verdict;
  row.value = judged.value;
  keepCurve(row, run, curve);
  if (!judged.passed) return;
  placeInTime(row, run, *judged.passed);
  row.worstTime = run.snapshots[judged.worst].positionTime;
  row.picture = scenePicture(run.scene, run.snapshots[judged.worst], 0.0);
}

/// Sets the entries of a row that every measure has: parameters and cost.
template <int D>
void describe(StabilityRun& row, const RecordingOf<D>& run, const Engine& engine) {
  if (!run.effective.engine.empty()) row.effective = run.effective;
  if (run.failure.empty()) row.stats = engine.stats();
}

// The outcome of a collision depends on where within a step the bodies first touch: a dashpot's
// force begins up to a step late, and the contact may end a step earlier or later. Where a contact
// lasts a whole number of steps, only phases close to a step's edge show the latter; with other
// steps, other phases.

/// Fractions of a step: `evenly` of them, and one close to either edge.
std::vector<double> touchPhases(int evenly) {
  constexpr double edge = 1e-3;
  std::vector<double> phases = {edge, 1.0 - edge};
  for (int k = 0; k < evenly; ++k) phases.push_back((k + 0.5) / evenly);
  return phases;
}

/// Steps are the case's and finer ones down to this part of it, over which a contact's number of
/// steps passes through all fractions several times.
constexpr double finestStep = 1.0 / 1.1;

/// All of a case's collisions at that step, each with every phase, side by side.
HardScene collisionsAt(const StabilityTask& task, double dt) {
  Case setup = *task.setup;
  collisionIn(setup).startPhase = 0.0;
  const std::vector<double> phases = touchPhases(32);
  const std::vector<CollisionStart> once = collisionStarts(setup);
  std::vector<CollisionStart> starts;
  for (std::size_t k = 0; k < phases.size(); ++k)
    starts.insert(starts.end(), once.begin(), once.end());
  HardScene hard = sceneOf<2>(task, *task.setup);
  hard.scene.dt = dt;
  hard.duration += dt;  // that they touch later
  hard.scene.disks = collisionScene(setup, starts, dt).disks;
  Disks& disks = hard.scene.disks;
  const std::size_t each = once.size() * (collisionIn(setup).wall ? 1 : 2);  // disks of one phase
  for (std::size_t i = 0; i < disks.size(); ++i)
    disks.position[i] -=
        phases[i / each] * dt * (disks.velocity[i] - collisionIn(setup).wallVelocity);
  if (task.inSpace) hard.scene = ofSpheres(std::move(hard.scene));
  return hard;
}

/// When two disks, or one and a plane at rest, first touch in a scene that has nothing else, where
/// nothing acts before [s].
template <int D>
std::optional<double> firstTouch(const SceneOf<D>& scene) {
  const DisksOf<D>& disks = scene.disks;
  const std::vector<PlaneOf<D>> planes = planesAt(scene, 0.0);
  if (!scene.gravity.isZero(0.0) || disks.size() + planes.size() != 2 ||
      effectsOf(scene).contains(Effect::movingWalls) || scene.bottom || scene.box ||
      scene.wallDiskCount() + scene.cylinderCount() > 0)
    return std::nullopt;
  if (planes.size() == 1) {
    const double gap =
        (disks.position[0] - planes[0].point).dot(planes[0].normal) - disks.radius[0];
    const double speed = -disks.velocity[0].dot(planes[0].normal);
    return gap > 0.0 && speed > 0.0 ? std::optional(gap / speed) : std::nullopt;
  }
  const VecOf<D> apart = disks.position[0] - disks.position[1],
                 velocity = disks.velocity[0] - disks.velocity[1];
  const double reach = disks.radius[0] + disks.radius[1], along = apart.dot(velocity);
  const double outside = apart.squaredNorm() - reach * reach;
  const double root = along * along - velocity.squaredNorm() * outside;
  if (outside <= 0.0 || along >= 0.0 || root < 0.0) return std::nullopt;
  return outside / (-along + std::sqrt(root));  // without a difference of large numbers
}

/// The scene so much earlier that it first touches at that fraction of a step.
template <int D>
HardSceneOf<D> touchingAt(HardSceneOf<D> hard, double touch, double phase, double dt) {
  const double steps = touch / dt;
  const double earlier = phase - (steps - std::floor(steps));
  const double shift = (earlier < 0.0 ? earlier + 1.0 : earlier) * dt;
  DisksOf<D>& disks = hard.scene.disks;
  for (std::size_t i = 0; i < disks.size(); ++i) disks.position[i] -= shift * disks.velocity[i];
  hard.scene.dt = dt;
  hard.duration += shift;
  return hard;
}

/// Scenes that a run is judged by: the scene itself, or one collision or several side by side at
/// several phases and steps.
template <int D>
std::vector<HardSceneOf<D>> beginningsOf(const StabilityTask& task, const HardSceneOf<D>& hard,
                                         Engine& engine) {
  const bool collisions = D == 2 && isCollision(*task.setup);
  const std::optional<double> touch = firstTouch(hard.scene);
  if (!collisions && !touch) return {hard};
  const double own = loadScene(engine, task.entry, *task.setup, hard.scene).dt;
  const bool itsOwn = own != hard.scene.dt;  // that of a setting, whatever the scene says
  const auto stepAt = [&](double part) {
    return itsOwn ? own : own * (1.0 - part * (1.0 - finestStep));
  };
  std::vector<HardSceneOf<D>> all;
  if constexpr (D == 2)
    if (collisions) {
      const int steps = itsOwn ? 1 : 11;
      for (int k = 0; k < steps; ++k)
        all.push_back(collisionsAt(task, stepAt(steps == 1 ? 0.0 : k / (steps - 1.0))));
      return all;
    }
  all.push_back(hard);
  const std::vector<double> phases = touchPhases(8);
  for (std::size_t k = 0; k < phases.size(); ++k)
    all.push_back(touchingAt(hard, *touch, phases[k],
                             stepAt(static_cast<double>(k) / static_cast<double>(phases.size()))));
  return all;
}

double rms(const std::vector<double>& values) {
  double squares = 0.0;
  for (const double value : values) squares += value * value;
  return std::sqrt(squares / static_cast<double>(values.size()));
}

/// The worst of several beginnings, and the rms of all.
template <int D>
void judgeBeginnings(StabilityRun& row, const StabilityTask& task, const HardSceneOf<D>& hard,
                     Engine& engine, const std::function<void(double)>& progress) {
  const Stability& limits = *task.setup->stability;
  const std::vector<HardSceneOf<D>> all = beginningsOf(task, hard, engine);
  const auto share = [&](std::size_t k) {
    return static_cast<double>(k) / static_cast<double>(all.size());
  };
  struct Judged {
    RecordingOf<D> run;
    std::vector<double> curve;
    double value;
  };
  std::optional<Judged> worst;
  std::vector<double> values;
  for (std::size_t k = 0; k < all.size(); ++k) {
    RecordingOf<D> run = record(engine, task.entry, all[k],
                                [&](double done) { progress(share(k) + done * share(1)); });
    if (k == 0 || !run.failure.empty()) describe(row, run, engine);
    if (!run.failure.empty()) return judgeFailure(row, run);
    std::vector<double> curve = stabilityMeasure(limits.measure).of(run);
    if (curve.empty()) return judgeCurve(row, limits, run, curve);
    const double value = judgeStability(limits, curve).value;
    if (run.collisions.empty()) values.push_back(value);
    if constexpr (D == 2)
      if (!run.collisions.empty())
        std::ranges::copy(restitutionErrors(run), std::back_inserter(values));
    if (!worst || value > worst->value) worst = Judged{std::move(run), std::move(curve), value};
  }
  judgeCurve(row, limits, worst->run, worst->curve);
  if (values.size() > 1)
    row.reason = fmt::format(
        "largest of {} collisions that begin at different fractions of a step; rms {:.2g}",
        values.size(), rms(values));
}

/// A run of the original, and one of the case.
template <int D>
void judgeCopy(StabilityRun& row, const StabilityTask& task, const HardSceneOf<D>& hard,
               Engine& engine, const std::function<void(double)>& progress) {
  const HardSceneOf<D> originalScene = sceneOf<D>(task, *task.original);
  const RecordingOf<D> original =
      record(engine, task.entry, originalScene, [&](double f) { progress(0.5 * f); });
  if (!original.failure.empty()) return judgeFailure(row, original);
  const RecordingOf<D> run =
      record(engine, task.entry, hard, [&](double f) { progress(0.5 + 0.5 * f); });
  describe(row, run, engine);
  if (!run.failure.empty()) return judgeFailure(row, run);
  judgeCurve(row, *task.setup->stability, run, copiesDiffer(original, run));
}

/// Twice the same run, the second time in a new worker from a checkpoint at the middle.
template <int D>
void judgeRestart(StabilityRun& row, const StabilityTask& task, const HardSceneOf<D>& hard,
                  Engine& engine) {
  if (!engine.capabilities().checkpoints) return refuse(row, "has no checkpoints");
  const std::filesystem::path file = std::filesystem::absolute(task.scratch) / "middle";
  const EffectiveParameters effective = loadScene(engine, task.entry, *task.setup, hard.scene);
  row.effective = effective;
  const double middle = 0.5 * hard.duration;
  advanceInPieces(engine, effective, 0.0, middle);
  engine.checkpoint(file);
  advanceInPieces(engine, effective, middle, hard.duration);
  const SnapshotOf<D> whole = snapshotOf<D>(engine, ContactReport::none);

  const auto second = asTaskHasIt(
      task, audited(task.entry.name,
                    startNew(task.entry, task.scratch / "second", task.setup->run.timeout)));
  const EffectiveParameters again = loadScene(*second, task.entry, *task.setup, hard.scene);
  second->restore(file);
  advanceInPieces(*second, again, middle, hard.duration);
  const SnapshotOf<D> resumed = snapshotOf<D>(*second, ContactReport::none);
  judgeNumber(row, *task.setup->stability, largestDistance(hard.scene, whole, resumed));
}

template <int D>
bool staysCalm(Engine& engine, const EngineEntry& entry, const HardSceneOf<D>& hard, double dt) {
  constexpr double growth = 100.0;
  HardSceneOf<D> run = hard;
  run.duration *= dt / hard.scene.dt;
  run.scene.dt = dt;
  const RecordingOf<D> seen = record(engine, entry, run, [](double) {});
  if (!seen.snapshots.empty() && seen.effective.dt != dt)
    throw UnsupportedScene(fmt::format("takes time steps of its own, {:g} s", seen.effective.dt));
  if (!seen.failure.empty()) return false;  // a step far too long ends in no numbers at all
  const double start = energyOf(seen, seen.snapshots.front()).kinetic;
  for (const SnapshotOf<D>& now : seen.snapshots)
    if (!(energyOf(seen, now).kinetic <= growth * start)) return false;
  return true;
}

/// Halves the interval between a step that is stable and one that is not, from 0.1 to 1.6 of
/// theory's, until it is known to 0.5 % of that. Stable: over the scene's number of steps no sample
/// finds more than 100 times the kinetic energy of the start.
/// @returns the largest stable one, by theory's; 0 if none is
/// @throws UnsupportedScene for an engine that takes steps of its own, EngineFailure
template <int D>
double measuredStepLimit(Engine& engine, const EngineEntry& entry, const HardSceneOf<D>& hard,
                         double theory, const std::function<void(double)>& progress) {
  double stable = 0.1, unstable = 1.6;
  constexpr double precision = 0.005;
  if (!staysCalm(engine, entry, hard, stable * theory)) return 0.0;
  while (unstable - stable > precision) {
    const double middle = 0.5 * (stable + unstable);
    (staysCalm(engine, entry, hard, middle * theory) ? stable : unstable) = middle;
    progress(1.0 - (unstable - stable) / 1.5);
  }
  return stable;
}

template <int D>
void judgeStepLimit(StabilityRun& row, const StabilityTask& task, const HardSceneOf<D>& hard,
                    Engine& engine, const std::function<void(double)>& progress) {
  const double theory = theoreticalStepLimit(hard.scene);
  const double measured = theory * measuredStepLimit(engine, task.entry, hard, theory, progress);
  judgeNumber(row, *task.setup->stability, std::max(0.0, 1.0 - measured / theory));
  row.reason = fmt::format(
      "steps up to {:.4g} s were stable, {:.3f} of the 2/ω = {:.4g} s of all contacts together; "
      "the estimate from the coordination number is {:.4g} s",
      measured, measured / theory, theory, coordinationStepLimit(hard.scene));
}

/// From the case's own step upward: doubled as long as the run is sound, then halved between the
/// last that was and the first that was not, to a twentieth.
template <int D>
void judgeLargestStep(StabilityRun& row, const StabilityTask& task, HardSceneOf<D> hard,
                      Engine& engine, const std::function<void(double)>& progress) {
  constexpr double mostSteps = 1e4;  // of the case's own, of what may be a long run
  constexpr double precision = 1.05, most = 64.0;
  const double own = hard.scene.dt;
  hard.duration = std::min(hard.duration, mostSteps * own);
  const RecordingOf<D> calm = record(engine, task.entry, hard, [](double) {});
  describe(row, calm, engine);
  if (!calm.failure.empty()) return judgeFailure(row, calm);
  if (calm.effective.dt != own)
    throw UnsupportedScene(fmt::format("takes time steps of its own, {:g} s", calm.effective.dt));
  const auto sound = [&](double times) {
    HardSceneOf<D> run = hard;
    run.scene.dt = times * own;
    progress(0.5);
    return isSound(record(engine, task.entry, run, [](double) {}), calm);
  };
  double good = isSound(calm, calm) ? 1.0 : 0.0, bad = good > 0.0 ? 2.0 : 1.0;
  while (good > 0.0 && bad <= most && sound(bad)) {
    good = bad;
    bad *= 2.0;
  }
  while (good > 0.0 && bad <= most && bad > precision * good) {
    const double middle = std::sqrt(good * bad);
    (sound(middle) ? good : bad) = middle;
  }
  judgeNumber(row, *task.setup->stability, good > 0.0 ? 1.0 / good : 2.0);
  const auto pair = pairStepLimit(*task.setup);
  row.reason =
      good > 0.0
          ? fmt::format("sound in steps of up to {:.3g} s, {:.3g} times the case's own{}",
                        good * own, good,
                        pair ? fmt::format("; one contact alone bears {:.3g} s by theory", pair->dt)
                             : std::string())
          : fmt::format("not sound in the case's own steps of {:.3g} s", own);
}

/// The start is one that must be refused, by the harness or by the engine.
template <int D>
void judgeAcceptance(StabilityRun& row, const StabilityTask& task, Engine& engine,
                     const std::function<void(double)>& progress) {
  try {
    const HardSceneOf<D> hard = sceneOf<D>(task, *task.setup);
    const RecordingOf<D> run = record(engine, task.entry, hard, progress);
    if (!run.failure.empty()) return judgeFailure(row, run);
    judgeNumber(row, *task.setup->stability, 1.0);
    row.reason = "was not refused";
  } catch (const UnsupportedScene& refusal) {
    judgeNumber(row, *task.setup->stability, 0.0);
    row.reason = fmt::format("refused: {}", refusal.what());
  } catch (const BadInput& refusal) {
    judgeNumber(row, *task.setup->stability, 0.0);
    row.reason = fmt::format("refused: {}", refusal.what());
  }
}

template <int D>
void judge(StabilityRun& row, const StabilityTask& task, Engine& engine,
           const std::function<void(double)>& progress) {
  const StabilityProtocol protocol = stabilityMeasure(task.setup->stability->measure).protocol;
  if (protocol == StabilityProtocol::invariances) return judgeInvariances(row, task, progress);
  if (protocol == StabilityProtocol::acceptance)
    return judgeAcceptance<D>(row, task, engine, progress);
  const HardSceneOf<D> hard = sceneOf<D>(task, *task.setup);
  switch (protocol) {
    case StabilityProtocol::restart:
      return judgeRestart(row, task, hard, engine);
    case StabilityProtocol::stepLimit:
      return judgeStepLimit(row, task, hard, engine, progress);
    case StabilityProtocol::largestStep:
      return judgeLargestStep(row, task, hard, engine, progress);
    case StabilityProtocol::againstOriginal:
      return judgeCopy(row, task, hard, engine, progress);
    default:
      return judgeBeginnings(row, task, hard, engine, progress);
  }
}

}  // namespace

void judged(StabilityRun& row, const std::function<void()>& work) {
  try {
    work();
  } catch (const Interrupted&) {
    throw;
  } catch (const OutOfTime& late) {
    row.status = Status::notRun;
    row.verdict = Verdict::notMeasured;
    row.reason = late.what();
  } catch (const UnsupportedScene& refusal) {
    refuse(row, refusal.what());
  } catch (const BadInput& refusal) {
    refuse(row, refusal.what());
  } catch (const std::exception& failure) {
    fail(row, failure.what());
  }
}

StabilityRun runStability(const StabilityTask& task, const std::function<void(double)>& progress) {
  StabilityRun row = rowOf(task);
  judged(row, [&] {
    if (!task.unprepared.empty())
      throw BadInput(task.unprepared);  // no engine's failure: it never ran
    const auto engine =
        asTaskHasIt(task, startAudited(task.entry, task.scratch, task.setup->run.timeout));
    inDimensionOf(*task.setup, [&]<int D>() { judge<D>(row, task, *engine, progress); });
  });
  return row;
}

}  // namespace crossgrain::inline studies

#include "studies/cost/study.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cctype>
#include <chrono>
#include <cmath>

#include "averaging/agreement.hpp"
#include "averaging/statistics.hpp"
#include "cases/flow.hpp"
#include "cases/materials.hpp"
#include "cases/time_step.hpp"
#include "studies/core/engine_access.hpp"
#include "studies/core/engine_running.hpp"
#include "studies/cost/collision_pairs.hpp"
#include "studies/cost/impacts.hpp"
#include "studies/cost/trajectory.hpp"
#include "studies/lockstep/starts.hpp"
#include "support/bad_input.hpp"
#include "support/interrupt.hpp"

namespace crossgrain::inline studies {

namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

}  // namespace

double pairLimit(const Case& setup) {
  if (!setup.law.soft()) return INFINITY;
  const double kn = std::ranges::max(lawsOf(setup), {}, &ContactLaw::kn).kn;
  return 2.0 * std::sqrt(lightestReducedMass(setup) / kn);
}

double packingLimit(const Case& setup) {
  return pairLimit(setup) / std::sqrt(6.0);
}

namespace {

template <int D>
double spinRate(const SpinOf<D>& spin) {
  if constexpr (D == 2)
    return std::abs(spin);
  else
    return spin.norm();
}

}  // namespace

template <int D>
double drivenSpeed(const SceneOf<D>& scene) {
  double fastest = 0.0;
  Eigen::AlignedBox<double, D> extent;
  for (const VecOf<D>& place : scene.disks.position) extent.extend(place);
  for (const VecOf<D>& velocity : scene.disks.velocity)
    fastest = std::max(fastest, velocity.norm());
  for (const WallBodyOf<D>& body : scene.bodies) {
    double reach = 0.0;
    for (const VecOf<D>& place : body.diskPosition) {
      extent.extend(place);
      reach = std::max(reach, (place - body.centre).norm());
    }
    const MotionOf<D>& motion = body.motion;
    fastest = std::max({fastest, motion.velocity.norm(),
                        motion.amplitude.norm() * std::abs(motion.frequency),
                        spinRate<D>(motion.angularVelocity) * reach});
  }
  return std::hypot(fastest, std::sqrt(2.0 * scene.gravity.norm() * extent.diagonal().norm()));
}

template <int D>
void requireSound(const SceneOf<D>& scene, const SnapshotOf<D>& snapshot) {
  // A packing whose springs are dropped, or that loses its friction, lets go at several times what
  // drives it; an instability grows without bound.
  constexpr double mostSpeed = 10.0;
  double squares = 0.0;
  for (const VecOf<D>& velocity : snapshot.velocity) squares += velocity.squaredNorm();
  const double speed = std::sqrt(squares / static_cast<double>(snapshot.velocity.size()));
  const double driven = drivenSpeed(scene);
  if (!(speed < mostSpeed * driven))
    throw EngineFailure(
        fmt::format("{}: at t = {:.3g} s the bodies' rms speed is {:.3g} times what drives them",
                    beyondLimit, snapshot.positionTime, speed / driven));
}
template double drivenSpeed(const Scene&);
template double drivenSpeed(const SpaceScene&);
template void requireSound(const Scene&, const Snapshot&);
template void requireSound(const SpaceScene&, const SpaceSnapshot&);

SceneTimes timeCollisions(Engine& engine, const EngineEntry& entry, const Case& setup,
                          double step) {
  const std::vector<Case> collisions = collisionsOf(setup);
  CollisionReference starts;
  for (const Case& pair : collisions) starts.pairs.push_back({pair, collisionStarts(pair), {}});
  const Clock::time_point begin = Clock::now();
  const PairOutcomes done = runPairs(engine, entry, collisions, starts, step, 0);
  return {secondsSince(begin) - done.seconds,
          done.seconds / static_cast<double>(std::max<std::uint64_t>(done.steps, 1))};
}

GeometricMean geometricMean(const std::vector<double>& numbers) {
  std::vector<std::optional<double>> logs;
  for (const double number : numbers) logs.emplace_back(std::log(number));
  const auto mean = ensembleMean(logs);
  GeometricMean found{std::exp(mean->mean), {}, {}};
  if (!mean->standardError) return found;
  constexpr double confidence = 0.95;
  const double half = *mean->standardError * studentQuantile(confidence, mean->packings - 1);
  found.low = std::exp(mean->mean - half);
  found.high = std::exp(mean->mean + half);
  return found;
}

CostPoint timedPoint(const std::string& engine, const CostSetting& setting, CostKind kind,
                     const std::vector<CostRun>& runs) {
  CostPoint point = pointOf(engine, setting, kind, runs.front().dt);
  std::vector<double> wall, cpu;
  std::uint64_t steps = 0, contactEvaluations = 0;
  for (const CostRun& run : runs) {
    wall.push_back(std::max(run.wallSeconds, 1e-9));
    if (run.cpuSeconds > 0.0) cpu.push_back(run.cpuSeconds);
    steps += run.steps;
    contactEvaluations += run.contactEvaluations;
  }
  const bool reportsCpu = cpu.size() == runs.size();
  const GeometricMean wallMean = geometricMean(wall);
  const GeometricMean ranked = reportsCpu ? geometricMean(cpu) : wallMean;
  point.wallSeconds = wallMean.mean;
  if (reportsCpu) point.cpuSeconds = ranked.mean;
  point.timeLow = ranked.low;
  point.timeHigh = ranked.high;
  countWork(point, steps / runs.size(), contactEvaluations / runs.size());
  return point;
}

namespace {

/// Endpoints with a closed form: nothing else says what is right of bodies whose contacts take no
/// time, and which the in-house engine has not. @throws BadInput where that leaves nothing
void keepWhatRigidBodiesHave(Case& setup) {
  const auto fail = [&](const char* why) {
    throw BadInput(fmt::format("{}: {}", setup.file.string(), why));
  };
  std::vector<CostKind>& kinds = setup.cost.kinds;
  if (kinds.empty()) return;  // steps alone are timed
  std::erase_if(kinds, [](CostKind kind) { return kind != CostKind::averages; });
  if (kinds.empty())
    fail(
        "cost.kinds: of rigid bodies there are averages alone: their contacts take no time that "
        "steps could be counted in, and no path is known to be right; collide scores collisions");
  if (!hasClosedForms(setup))
    fail(
        "cost of rigid bodies needs [[endpoints]] with expected values, as nothing else says what "
        "is right; compare --reference none has how far engines are from each other");
}

}  // namespace

CostStudy::CostStudy(const Case& of, const RunCommand& command, RunStore& store)
    : setup(of),
      jobs(command.jobs),
      campaign(of, command, selectEngines(command.engines), store),
      engines(campaign.engines().size()),
      inHouse(engineRegistry().front()),
      inHouseEngine(inHouse.make()) {
  if (!setup.law.soft()) keepWhatRigidBodiesHave(setup);
}

void CostStudy::ask() {
  campaign.askEngines();
  campaign.lookForPackings();
  for (std::size_t e = 0; e < engines.size(); ++e)
    if (campaign.capabilities(e)) listSettings(e);
}

void CostStudy::prepare() {
  campaign.askEngines();
  campaign.preparePackings();
  campaign.timeEngines();
  if (setup.law.soft()) {
    findStates();
    findImpacts();
  }
  campaign.progress().begin("timing starts and steps", std::vector<double>(engines.size(), 1.0));
  for (std::size_t e = 0; e < engines.size(); ++e) {
    throwIfInterrupted();
    if (!campaign.refusal(e).empty()) continue;
    try {
      timeStart(e);
    } catch (const EngineFailure& failure) {
      engineFailures.push_back(failure.what());
      continue;
    }
    if (!campaign.capabilities(e)) continue;
    listSettings(e);
    engines[e].takesPart = true;
    campaign.progress().finish(
        e, fmt::format("{}: {:.3g} µs a step", entryOf(e).name, 1e6 * engines[e].scene.step));
  }
  if (setup.law.soft()) timeInHouse();
}

void CostStudy::findStates() {
  if (cellOf(setup)) return;
  const std::size_t wanted =
      std::min(campaign.packings().size(), static_cast<std::size_t>(setup.cost.trajectoryPackings));
  for (FlowState& state : statesAlongTheFlow(
           setup, campaign.packings(), campaign.dt(), wanted, [](double) {}, jobs))
    states_.push_back(std::move(state.packing));
  if (states_.size() < wanted) states_.clear();
}

void CostStudy::findImpacts() {
  impacts = keptOr(campaign.store(), "impacts", inHouseKey(0, "cost: impacts"),
                   [&] { return impactsIn(setup, trajectoryStarts(), campaign.dt()); });
  setup.cost.impacts = impacts.pairs;
  if (impacts.rmsSpeed > 0.0) setup.cost.quietSpeed = impacts.rmsSpeed;
}

Engine& CostStudy::workerOf(std::size_t engine) {
  auto& worker = engines[engine].worker;
  const EngineEntry& entry = entryOf(engine);
  if (!worker) worker = startNew(entry, campaign.store().scratch(entry.name), setup.run.timeout);
  return *worker;
}

void CostStudy::listSettings(std::size_t engine) {
  for (const CostKind kind : setup.cost.kinds)
    engines[engine].settings[static_cast<std::size_t>(kind)] =
        costSettings(setup, kind, entryOf(engine).name, canOf(engine));
}

void CostStudy::timeStart(std::size_t engine) {
  TimedEngine& timed = engines[engine];
  const EngineEntry& entry = entryOf(engine);
  const Clock::time_point start = Clock::now();
  Engine& worker = workerOf(engine);
  const Capabilities can = worker.capabilities();
  timed.start = secondsSince(start);
  const Clock::time_point load = Clock::now();
  const double dt = inDimensionOf(setup, [&]<int D>() {
    return loadScene(worker, entry, setup,
                     flowScene<D>(setup, trajectoryStarts().front(), campaign.dt()))
        .dt;
  });
  timed.scene.load = secondsSince(load);
  timed.scene.step = briefSteps(worker, dt, 0.5, 128).wall;
  timed.collisions = timed.scene;
  if (std::ranges::find(setup.cost.kinds, CostKind::collision) == setup.cost.kinds.end()) return;
  try {
    timed.collisions = timeCollisions(worker, entry, setup, engineStep(setup, entry.name, can));
  } catch (const UnsupportedScene&) {  // is said where they are measured, as is what fails
  } catch (const EngineFailure&) {
    timed.worker.reset();
  }
}

void CostStudy::timeInHouse() {
  constexpr int steps = 2000;
  const Track track = followPacking(*inHouseEngine, inHouse, setup, trajectoryStarts().front(),
                                    steps * campaign.dt());
  inHouseStep = track.cost.wallSeconds / static_cast<double>(track.cost.steps);
}

double CostStudy::stepOf(std::size_t engine, const Case& of) const {
  return engineStep(of, entryOf(engine).name, canOf(engine));
}

std::string CostStudy::nameOf(const PlannedPoint& point) const {
  const CostSetting& setting = settingOf(point);
  std::string what = fmt::format("{}-{}", setting.knob, setting.setting);
  std::ranges::replace_if(
      what, [](unsigned char c) { return !std::isalnum(c) && c != '.' && c != '_'; }, '-');
  return fmt::format("{}-{}-{}", toString(point.kind), entryOf(point.engine).name, what);
}

std::string CostStudy::nameOf(const PlannedPoint& point, std::size_t round) const {
  return fmt::format("{}-{}{}", nameOf(point), isRepeated(point.kind) ? "r" : "p", round);
}

CaseKeys CostStudy::keyOf(const PlannedPoint& point, std::size_t round) const {
  return campaign.keyOf(
      point.engine, isRepeated(point.kind) ? 0 : static_cast<int>(round),
      fmt::format("cost: {} {}", toString(point.kind), settingOf(point).fragment));
}

CaseKeys CostStudy::inHouseKey(std::size_t packing, const std::string& part) const {
  CaseKeys key = runKey(setup, inHouse.name, inHouseEngine->capabilities().version);
  key["packing"] = campaign.packings()[packing].hash;
  key["part"] = part;
  return key;
}

}  // namespace crossgrain::inline studies

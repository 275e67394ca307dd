#include "studies/regression/observe.hpp"

#include <algorithm>
#include <cmath>

#include "adapters/registry.hpp"
#include "cases/collision_scene.hpp"
#include "cases/flow.hpp"
#include "cases/loader.hpp"
#include "cases/time_step.hpp"
#include "studies/collide/sweep.hpp"
#include "studies/core/engine_access.hpp"
#include "studies/core/executor.hpp"
#include "studies/core/run_store.hpp"
#include "studies/cost/collision_pairs.hpp"
#include "studies/flow/endpoint_values.hpp"
#include "studies/flow/run.hpp"
#include "studies/lockstep/responses.hpp"
#include "studies/lockstep/rules.hpp"
#include "studies/lockstep/terms.hpp"
#include "support/interrupt.hpp"
#include "support/scratch_folder.hpp"

namespace crossgrain::inline studies {
namespace {

template <int D>
BaselineWindowOf<D> windowOf(const Observed& of, const FlowState& state,
                             std::optional<EffectiveParameters>& effective) {
  EffectiveParameters now = loadStart<D>(of, state);
  const double step = now.dt;
  if (effective) requireSameStep(*effective, now);
  if (!effective) effective = std::move(now);
  const std::vector<std::uint64_t> steps = lockstepSteps(step);
  BaselineWindowOf<D> window;
  const bool instant = of.engine.capabilities().instantContacts;
  window.frames =
      follow<D>(of.engine, step, steps, instant ? ContactReport::instant : ContactReport::none);
  std::vector<LockstepFrameOf<D>> reported;
  for (const double time : lockstepTimes)
    reported.push_back(window.frames[frameAt(steps, step, time)]);
  window.responses = referenceResponses<D>(
      of.engine, reported, flowDiameter(of.setup),
      [&](double change) { return loadStart<D>(of, state, change).dt; },
      flowScene<D>(of.setup, state.packing, of.dt).box);
  return window;
}

KeptCollisions collisionsOf(Engine& engine, const EngineEntry& entry, const Case& setup,
                            double dt) {
  KeptCollisions kept;
  kept.name = setup.name;
  kept.variant = setup.variant;
  kept.dt = dt;
  const std::vector<CollisionStart> starts = collisionStarts(setup);
  for (const CollisionStart& start : starts) {
    kept.psi.push_back(start.psi);
    kept.vn.push_back(start.vn);
  }
  Outcomes outcomes;
  try {
    outcomes = sweepOutcomes(engine, entry, setup, dt, starts);
  } catch (const UnsupportedScene& refusal) {
    kept.refusal = refusal.what();
    return kept;
  }
  const CollidingPair pair = collidingPair(setup);
  for (const CollisionQuantity& quantity : scoredQuantities()) {
    std::vector<double> values;
    for (std::size_t k = 0; k < outcomes.size(); ++k) {
      const auto value =
          outcomes[k] ? quantity.scoredValue(*outcomes[k], pair, starts[k].vn) : std::nullopt;
      values.push_back(value && std::isfinite(*value) ? *value : NAN);
    }
    if (!std::ranges::all_of(values, [](double value) { return std::isnan(value); }))
      kept.values[std::string(quantity.name)] = std::move(values);
  }
  return kept;
}

std::vector<FlowState> startsOf(const Case& setup, double dt, std::size_t count,
                                Progress& progress) {
  const auto packings = std::min(count, static_cast<std::size_t>(flowPackings(setup)));
  progress.begin("preparing packings", std::vector<double>(packings + 1, 1.0));
  const auto engine = engineRegistry().front().make();
  std::vector<Packing> prepared;
  for (std::size_t p = 0; p < packings; ++p)
    prepared.push_back(flowPacking(setup, static_cast<int>(p), dt, *engine, [&](double fraction) {
      throwIfInterrupted();
      progress.update(p, "packings", fraction);
    }));
  return statesAlongTheFlow(setup, prepared, dt, count, [&](double fraction) {
    progress.update(packings, "states", fraction);
  });
}

}  // namespace

template <int D>
EffectiveParameters loadStart(const Observed& of, const FlowState& state, double change) {
  SceneOf<D> scene = flowScene<D>(of.setup, state.packing, of.dt);
  if (change != 0.0) changeLaws(scene, [&](ContactLaw& law) { changeReference(law, change); });
  return loadScene(of.engine, of.entry, of.setup, scene);
}
template EffectiveParameters loadStart<2>(const Observed&, const FlowState&, double);
template EffectiveParameters loadStart<3>(const Observed&, const FlowState&, double);

std::vector<KeptCollisions> collisionsOf(Engine& engine, const EngineEntry& entry,
                                         const std::vector<Case>& cases) {
  std::vector<KeptCollisions> kept;
  for (const Case& setup : cases) {
    const bool flows = hasFlow(setup);
    for (const double dt : flows ? std::vector{timeStep(setup)} : collisionTimeSteps(setup)) {
      throwIfInterrupted();
      kept.push_back(collisionsOf(engine, entry, flows ? collisionOf(setup) : setup, dt));
    }
  }
  return kept;
}

KeptEndpoints endpointsFrom(const EngineEntry& entry, const Case& setup,
                            const std::vector<FlowState>& starts, double dt,
                            const std::function<void(double)>& progress) {
  KeptEndpoints kept;
  for (std::size_t s = 0; s < starts.size(); ++s) {
    const FlowRun run = runWithoutFiles(
        entry, setup, static_cast<int>(s), starts[s].packing, dt, [&](double fraction) {
          progress((static_cast<double>(s) + fraction) / static_cast<double>(starts.size()));
        });
    for (const auto& [name, margin] : setup.averaging.endpoints)
      kept[name].push_back(endpointOf(endpointNamed(setup, name), setup, run));
  }
  return kept;
}

BaselineEngine keepEngine(Engine& engine, const EngineEntry& entry, const std::vector<Case>& cases,
                          const std::vector<FlowState>& starts, double dt,
                          const std::function<void(double)>& progress) {
  BaselineEngine kept;
  kept.name = entry.name;
  kept.can = engine.capabilities();
  kept.version = kept.can.version;
  const Observed of{engine, entry, cases.front(), dt};
  inDimensionOf(of.setup, [&]<int D>() {
    auto& windows = windowsIn<D>(kept);
    for (const FlowState& state : starts) {
      throwIfInterrupted();
      progress(static_cast<double>(windows.size()) / static_cast<double>(starts.size() + 1));
      windows.push_back(windowOf<D>(of, state, kept.effective));
    }
  });
  kept.collisions = collisionsOf(engine, entry, cases);
  return kept;
}

Baseline keepBaseline(const std::vector<Case>& cases, const RunCommand& command, std::size_t starts,
                      bool endpoints, std::vector<std::string>& refusals) {
  const Case& setup = cases.front();
  for (const Case& each : cases) checkEngineSections(each);
  const std::vector<EngineEntry> engines = selectEngines(command.engines);
  Progress progress(command.quiet);
  Baseline baseline;
  std::vector<std::string> reasons;
  baseline.version = programVersion;
  baseline.setup = {setup.name, setup.variant, setup.file.string(), resolvedFile(cases)};
  baseline.dimension = setup.dimension;
  const double dt = hasFlow(setup) ? timeStep(setup) : 0.0;
  if (hasFlow(setup)) baseline.starts = startsOf(setup, dt, starts, progress);
  progress.begin("running engines", std::vector<double>(engines.size(), 1.0));
  for (std::size_t e = 0; e < engines.size(); ++e) {
    const ScratchFolder scratch;
    const auto engine = startEngine(engines[e], scratch.path, setup.run.timeout);
    const auto report = [&](double fraction) { progress.update(e, engines[e].name, fraction); };
    try {
      BaselineEngine kept = keepEngine(*engine, engines[e], cases, baseline.starts, dt, report);
      if (endpoints) kept.endpoints = endpointsFrom(engines[e], setup, baseline.starts, dt, report);
      baseline.engines.push_back(std::move(kept));
      progress.finish(e, engines[e].name + ": kept");
    } catch (const UnsupportedScene& refusal) {
      reasons.emplace_back(refusal.what());
      if (isNamed(command.engines, engines[e])) refusals.push_back(reasons.back());
      progress.finish(e, refusal.what());
    }
  }
  if (baseline.engines.empty()) throw AllRefused(std::move(reasons));
  return baseline;
}

}  // namespace crossgrain::inline studies

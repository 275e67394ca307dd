#include "runs/baseline/keep.hpp"

#include <algorithm>

#include "adapters/registry.hpp"
#include "cases/loader.hpp"
#include "cases/preparation.hpp"
#include "cases/time_step.hpp"
#include "runs/baseline/observe.hpp"
#include "runs/common/engine_access.hpp"
#include "runs/common/executor.hpp"
#include "runs/common/run_store.hpp"
#include "runs/lockstep/responses.hpp"
#include "runs/lockstep/rules.hpp"
#include "support/interrupt.hpp"
#include "support/scratch_folder.hpp"

namespace crossgrain::inline runs {
namespace {

BaselineWindow windowOf(const Observed& of, const FlowState& state,
                        std::optional<Realised>& realised) {
  Realised now = loadStart(of, state);
  const double step = now.dt;
  if (realised) requireSameStep(*realised, now);
  if (!realised) realised = std::move(now);
  const std::vector<std::uint64_t> steps = lockstepSteps(step);
  BaselineWindow window;
  const bool instant = of.engine.capabilities().instantContacts;
  window.frames =
      follow(of.engine, step, steps, instant ? ContactReport::instant : ContactReport::none);
  std::vector<LockstepFrame> told;
  for (const double time : lockstepTimes) told.push_back(window.frames[frameAt(steps, step, time)]);
  window.responses =
      yardstickResponses(of.engine, told, 2.0 * of.setup.particles.smallRadius,
                         [&](double change) { return loadStart(of, state, change).dt; });
  return window;
}

std::vector<FlowState> startsOf(const Case& setup, double dt, std::size_t count,
                                Progress& progress) {
  const auto packings = std::min<std::size_t>(
      count, setup.particles.file ? 1 : static_cast<std::size_t>(setup.preparation.packings));
  progress.begin("preparing packings", std::vector<double>(packings + 1, 1.0));
  const auto engine = engineRegistry().front().make();
  std::vector<Packing> prepared;
  for (std::size_t p = 0; p < packings; ++p)
    prepared.push_back(packingOf(setup, static_cast<int>(p), dt, *engine, [&](double fraction) {
      throwIfInterrupted();
      progress.update(p, "packings", fraction);
    }));
  return statesAlongTheFlow(setup, prepared, dt, count, [&](double fraction) {
    progress.update(packings, "states", fraction);
  });
}

}  // namespace

BaselineEngine keepEngine(Engine& engine, const EngineEntry& entry, const std::vector<Case>& cases,
                          const std::vector<FlowState>& starts, double dt,
                          const std::function<void(double)>& progress) {
  BaselineEngine kept;
  kept.name = entry.name;
  kept.can = engine.capabilities();
  kept.version = kept.can.version;
  const std::vector<SweepOfCase> sweeps = sweepsOf(cases);
  const double all = static_cast<double>(starts.size() + sweeps.size());
  const auto oneIsDone = [&] {
    throwIfInterrupted();
    progress(static_cast<double>(kept.windows.size() + kept.collisions.size()) / all);
  };
  for (const FlowState& state : starts) {
    kept.windows.push_back(windowOf({engine, entry, cases.front(), dt}, state, kept.realised));
    oneIsDone();
  }
  for (const SweepOfCase& sweep : sweeps) {
    kept.collisions.push_back(collisionsOf(engine, entry, sweep));
    oneIsDone();
  }
  return kept;
}

Baseline keepBaseline(const std::vector<Case>& cases, const RunCommand& command, std::size_t starts,
                      bool endpoints) {
  const Case& setup = cases.front();
  for (const Case& each : cases) checkEngineSections(each);
  const std::vector<EngineEntry> engines = selectEngines(command.engines);
  Progress progress(command.quiet);
  Baseline baseline;
  baseline.version = programVersion;
  baseline.setup = {setup.name, setup.variant, setup.file.string(), resolvedFile(cases)};
  const double dt = setup.kind == CaseKind::couette ? timeStep(setup) : 0.0;
  if (setup.kind == CaseKind::couette) baseline.starts = startsOf(setup, dt, starts, progress);
  progress.begin("keeping what engines do", std::vector<double>(engines.size(), 1.0));
  for (std::size_t e = 0; e < engines.size(); ++e) {
    const ScratchFolder scratch;
    const auto engine = startEngine(engines[e], scratch.path, setup.run.timeout);
    baseline.engines.push_back(
        keepEngine(*engine, engines[e], cases, baseline.starts, dt,
                   [&](double fraction) { progress.update(e, engines[e].name, fraction); }));
    if (endpoints)
      baseline.engines.back().endpoints = endpointsFrom(
          engines[e], setup, baseline.starts, dt,
          [&](double fraction) { progress.update(e, engines[e].name + " averages", fraction); });
    progress.finish(e, engines[e].name + ": kept");
  }
  return baseline;
}

}  // namespace crossgrain::inline runs

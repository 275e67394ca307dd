#include "studies/flow/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "adapters/audit.hpp"
#include "cases/flow.hpp"
#include "studies/core/engine_running.hpp"
#include "studies/core/study.hpp"
#include "studies/flow/averages.hpp"
#include "studies/flow/snapshot_file.hpp"
#include "studies/flow/unfinished_run.hpp"
#include "support/interrupt.hpp"
#include "support/scratch_folder.hpp"

namespace crossgrain::inline studies {

Rings ringsOf(const Case& setup) {
  const Region& region = setup.region.value();
  return Rings(region.innerRadius, region.outerRadius, region.count, region.height,
               flowDiameter(setup));
}

std::vector<Weight> weightsOf(const Case& setup, std::span<const std::string> names) {
  const double width = flowDiameter(setup) * setup.averaging.lineWidth;
  std::vector<Weight> weights;
  for (const std::string& name : names) weights.emplace_back(weightMethod(name), width);
  return weights;
}

namespace {

/// Five of the snapshots 1 … samples, the first and the last among them.
bool isOfStrip(int taken, int samples) {
  constexpr int frames = 5;
  for (int k = 0; k < frames; ++k)
    if (taken == 1 + k * (samples - 1) / (frames - 1)) return true;
  return false;
}

/// Keeps of a scene's picture the bodies as they move, and the walls.
template <int D>
ScenePicture stripPicture(const SceneOf<D>& scene, const SnapshotOf<D>& now) {
  ScenePicture picture = scenePicture(scene, now, NAN);
  picture.startR = picture.startPhi = {};
  picture.contactI = picture.contactJ = {};
  picture.contactForce = {};
  return picture;
}

}  // namespace

template <int D>
FlowRun runFlow(const FlowTask& task, const std::function<void(double)>& progress) {
  const Case& setup = *task.setup;
  const SceneOf<D> scene = flowScene<D>(setup, *task.packing, task.dt);
  LoadedEngine loaded = loadEngine(task.entry, setup, scene, task.scratch);
  Engine& engine = *loaded.engine;
  // Forces of one instant belong to the positions beside them; those summed over an interval do not
  // where the wheel's disks moved on meanwhile.
  const ContactReport report =
      loaded.can.instantContacts ? ContactReport::instant : ContactReport::accumulated;

  const FlowTimes times = flowTimes(setup);
  const auto [settled, interval, samples] = times;
  const double end = times.end();
  const bool resumable = D == 2 && loaded.can.checkpoints && report == ContactReport::instant;
  UnfinishedRunOf<D> unfinished(task.unfinished, task.key, scene, resumable);
  const auto before = unfinished.resume(engine);
  double now = before ? before->time : 0.0;
  std::optional<double> reached;
  const auto advanceTo = [&](double t) {
    if (now < t)
      reached = advanceInPieces(engine, loaded.effective, now, t, [&](double at) {
        if (interrupted())
          unfinished.keep(engine, at);
        else
          unfinished.keepIfDue(engine, at);
      });
    now = std::max(now, t);
    progress(t / end);
  };

  // Slices only tell the progress: advanceTo() goes in pieces of its own.
  constexpr double mostSlices = 1e6;
  const int settleSlices = static_cast<int>(std::min(std::ceil(settled / interval), mostSlices));
  for (int k = 1; k <= settleSlices; ++k) advanceTo(settled * k / settleSlices);
  if (report == ContactReport::accumulated)
    snapshotOf<D>(engine, report);  // starts the first interval

  FlowAverages<D> averages(setup, scene);
  SnapshotFileOf<D> kept(
      task.snapshots, task.entry.name, scene, samples,
      task.packingIndex < setup.run.keepSnapshotsOf ? setup.run.keepSnapshots : 0);
  FlowRun run;
  const double pictureTime = std::min(0.5 * flowUnit(setup), end);
  int taken = 0;
  const auto take = [&](const SnapshotOf<D>& snapshot) {
    averages.add(snapshot);
    kept.offer(snapshot, ++taken);
    if (task.packingIndex == 0 && !run.picture && snapshot.positionTime >= pictureTime - interval)
      run.picture = scenePicture(scene, snapshot, snapshot.positionTime / flowUnit(setup));
    if (task.keepsStrip && task.packingIndex == 0 && isOfStrip(taken, samples))
      run.strip.push_back(stripPicture(scene, snapshot));
  };
  for (std::size_t k = 0; before && k < before->snapshots; ++k) take(unfinished.snapshot(k));
  while (taken < samples) {
    advanceTo(settled + (taken + 1) * interval);
    const SnapshotOf<D> snapshot = snapshotOf<D>(engine, report);
    take(snapshot);
    unfinished.took(snapshot);
  }
  kept.close();

  Stats stats = engine.stats();
  if (!before && reached)
    if (const std::string why = statsFault(stats, loaded.effective.dt, *reached); !why.empty()) {
      discardWorker(engine);
      throw EngineFailure(fmt::format("{}, {} at t = {:g} s: its stats cannot be: {}",
                                      task.entry.name, setup.name, *reached, why));
    }
  if (before) {
    stats.wallSeconds += before->wallSeconds;
    stats.cpuSeconds += before->cpuSeconds;
  }
  run.engine = task.entry.name;
  run.packing = task.packingIndex;
  run.effective = loaded.effective;
  run.stats = stats;
  averages.describe(loaded.effective, run);
  return run;
}
template FlowRun runFlow<2>(const FlowTask&, const std::function<void(double)>&);
template FlowRun runFlow<3>(const FlowTask&, const std::function<void(double)>&);

FlowRun runWithoutFiles(const EngineEntry& entry, const Case& setup, int packingIndex,
                        const Packing& packing, double dt,
                        const std::function<void(double)>& progress) {
  Case quiet = setup;
  quiet.run.keepSnapshots = 0;
  const ScratchFolder scratch;
  const FlowTask task{&quiet,
                      entry,
                      packingIndex,
                      &packing,
                      dt,
                      scratch.path / "worker",
                      scratch.path / "snapshots.h5",
                      scratch.path / "unfinished",
                      packing.hash};
  return inDimensionOf(setup, [&]<int D>() { return runFlow<D>(task, progress); });
}

}  // namespace crossgrain::inline studies

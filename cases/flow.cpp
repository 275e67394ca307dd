#include "cases/flow.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "adapters/registry.hpp"
#include "cases/assembly_scene.hpp"
#include "cases/couette.hpp"
#include "cases/preparation.hpp"
#include "support/fingerprint.hpp"
#include "support/interrupt.hpp"

namespace crossgrain::inline cases {

namespace {

/// Of the disks of a start file that stand still, and of what its rows are made of: its moving
/// disks alone do not make a scene.
template <int D>
std::string fixedHash(const StartFilesOf<D>& starts) {
  if (starts.fixedRadius.empty() && starts.rowMaterials.empty()) return {};
  std::string text;
  for (const MaterialName& material : starts.rowMaterials) text += material.name + ";";
  if (!starts.rowMaterials.empty())
    text += fmt::format("{};", fmt::join(starts.rowMaterialOf, " "));
  for (std::size_t k = 0; k < starts.fixedRadius.size(); ++k)
    text += fmt::format("{} {};", fmt::join(starts.fixedPosition[k], " "), starts.fixedRadius[k]);
  return fmt::format("{:016x}", fnv1a(text));
}

Packing assemblyPacking(const Case& setup, int index) {
  Packing packing;
  inDimensionOf(setup, [&]<int D>() {
    disksIn<D>(packing) = assemblyDisks<D>(setup, index);
    packing.fixed = fixedHash(assemblyIn<D>(setup).starts);
  });
  packing.hash = contentHash(packing);
  return packing;
}

/// Of walls that swing, which all do so alike (the loader sees to it); 0: none does [s].
template <int D>
double swingPeriod(const AssemblyOf<D>& assembly) {
  for (const WallGroupOf<D>& wall : assembly.walls)
    if (wall.motion.kind == MotionKind::oscillating)
      return 2.0 * std::numbers::pi / wall.motion.frequency;
  return 0.0;
}

}  // namespace

bool hasFlow(const Case& setup) {
  return setup.region.has_value();
}

FlowTimes flowTimes(const Case& setup) {
  FlowTimes times;
  if (isAssembly(setup)) {
    const Region& region = *setup.region;
    times.settled = region.from;
    times.samples = region.snapshots;
    times.interval = (assemblyDuration(setup) - region.from) / region.snapshots;
    return times;
  }
  const CellTimes& cell = couetteIn(setup).times;
  const double rotation = rotationTime(setup);
  times.settled = cell.settleRotations * rotation;
  times.samples =
      std::max(1, static_cast<int>(std::lround(cell.snapshotsPerRotation * cell.rotations)));
  times.interval = cell.rotations * rotation / times.samples;
  return times;
}

double flowDuration(const Case& setup) {
  if (isAssembly(setup)) return assemblyDuration(setup);
  const CellTimes& cell = couetteIn(setup).times;
  return (cell.settleRotations + cell.rotations) * rotationTime(setup);
}

double flowUnit(const Case& setup) {
  return isAssembly(setup) ? 1.0 : rotationTime(setup);
}

double flowDiameter(const Case& setup) {
  if (const Couette* const cell = cellOf(setup)) return 2.0 * cell->particles.smallRadius;
  if (isCollision(setup)) {
    const Collision& two = collisionIn(setup);
    return 2.0 * (two.wall ? two.radius[0] : std::min(two.radius[0], two.radius[1]));
  }
  double smallest = INFINITY;
  withAssembly(setup, [&](const auto& assembly) {
    for (const auto& group : assembly.disks)
      smallest = std::min(smallest, group.radius * (1.0 - group.radiusSpread));
    for (const auto& disks : assembly.starts.disks)
      smallest = std::min(smallest, std::ranges::min(disks.radius));
  });
  return 2.0 * smallest;
}

double inertiaFactorOf(const Case& setup) {
  return std::visit(
      [](const auto& source) {
        if constexpr (requires { source.particles; })
          return source.particles.inertiaFactor;
        else
          return source.inertiaFactor;
      },
      setup.source);
}

bool packingsAreFiles(const Case& setup) {
  if (!isAssembly(setup)) return packingFile(setup) != nullptr;
  return withAssembly(setup, [](const auto& assembly) {
    return !assembly.starts.files.empty() && assembly.starts.velocityRms == 0.0;
  });
}

bool hasClosedForms(const Case& setup) {
  return !setup.endpoints.empty() && setup.endpoints.front().expected;
}

int flowPackings(const Case& setup) {
  if (hasClosedForms(setup)) return closedFormRuns;
  if (!packingsAreFiles(setup)) return setup.preparation.packings;
  if (!isAssembly(setup)) return 1;
  return withAssembly(
      setup, [](const auto& assembly) { return static_cast<int>(assembly.starts.files.size()); });
}

template <int D>
SceneOf<D> flowScene(const Case& setup, const Packing& packing, double dt) {
  if constexpr (D == 2)
    if (!isAssembly(setup)) return couetteScene(setup, packing, dt);
  return assemblyScene<D>(setup, disksIn<D>(packing), packing.wallTime, dt);
}
template Scene flowScene<2>(const Case&, const Packing&, double);
template SpaceScene flowScene<3>(const Case&, const Packing&, double);

template <int D>
SceneOf<D> unplacedScene(const Case& setup, double dt) {
  Packing unplaced;
  if (isAssembly(setup))
    disksIn<D>(unplaced) = assemblyDisks<D>(setup, 0);
  else
    unplaced.disks = diskKinds(couetteIn(setup).particles);
  return flowScene<D>(setup, unplaced, dt);
}
template Scene unplacedScene<2>(const Case&, double);
template SpaceScene unplacedScene<3>(const Case&, double);

Packing flowPacking(const Case& setup, int index, double dt, Engine& engine,
                    const std::function<void(double)>& progress) {
  if (!isAssembly(setup)) return packingOf(setup, index, dt, engine, progress);
  Packing packing = assemblyPacking(setup, index);
  inDimensionOf(setup,
                [&]<int D>() { checkAssemblyStart<D>(setup, flowScene<D>(setup, packing, dt)); });
  return packing;
}

ExpectedPacking expectedPacking(const Case& setup, int index, double dt) {
  if (isAssembly(setup)) return {assemblyPacking(setup, index).hash, true};
  if (packingsAreFiles(setup)) return {contentHash(readPacking(*packingFile(setup), setup)), true};
  ExpectedPacking packing{packingHash(setup, index, dt), false};
  packing.there = std::filesystem::exists(packingCacheFile(packing.hash));
  return packing;
}

void checkPackings(const Case& setup, int count, double dt) {
  if (!isAssembly(setup) && !packingsAreFiles(setup)) {
    preparationStart(setup, 0, dt);  // others differ in what is drawn at random
    return;
  }
  const auto none = engineRegistry().front().make();  // nothing is prepared
  for (int index = 0; index < count; ++index) {
    throwIfInterrupted();
    flowPacking(setup, index, dt, *none, [](double) {});
  }
}

double flowRestart(const Case& setup, double t) {
  const double period =
      isAssembly(setup)
          ? withAssembly(setup, [](const auto& assembly) { return swingPeriod(assembly); })
          : 0.0;
  return period > 0.0 ? period * std::floor(t / period) : t;
}

template <int D>
Packing packingAt(const Packing& from, const SceneOf<D>& scene, const SnapshotOf<D>& now) {
  Packing there = from;
  DisksOf<D>& disks = disksIn<D>(there);
  disks.position = now.position;
  disks.velocity = now.velocity;
  if (now.spin) disks.spin = *now.spin;
  there.wallTime += now.positionTime;
  if constexpr (D == 2) {  // a cell's wheel turns, and its other walls stand still
    const auto wheel = std::ranges::find(scene.bodies, wheelName, &WallBody::name);
    if (wheel != scene.bodies.end()) {
      there.wallTime = from.wallTime;
      there.wheelAngle += now.bodies[static_cast<std::size_t>(wheel - scene.bodies.begin())].angle;
    }
  }
  there.hash = contentHash(there);
  return there;
}
template Packing packingAt<2>(const Packing&, const Scene&, const Snapshot&);
template Packing packingAt<3>(const Packing&, const SpaceScene&, const SpaceSnapshot&);

}  // namespace crossgrain::inline cases

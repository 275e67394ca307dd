#include "cases/flow.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "cases/assembly_scene.hpp"
#include "cases/couette.hpp"
#include "cases/preparation.hpp"
#include "support/fingerprint.hpp"

namespace crossgrain::inline cases {

namespace {

bool isAssembly(const Case& setup) {
  return setup.kind == CaseKind::assembly;
}

/// Of the disks of a start file that stand still: its moving disks alone do not tell a scene.
std::string fixedHash(const StartFiles& starts) {
  if (starts.fixedRadius.empty()) return {};
  std::string text;
  for (std::size_t k = 0; k < starts.fixedRadius.size(); ++k)
    text += fmt::format("{} {} {};", starts.fixedPosition[k].x(), starts.fixedPosition[k].y(),
                        starts.fixedRadius[k]);
  return fmt::format("{:016x}", fnv1a(text));
}

Packing assemblyPacking(const Case& setup, int index) {
  Packing packing;
  packing.disks = assemblyDisks(setup, index);
  packing.fixed = fixedHash(setup.assembly.starts);
  packing.hash = contentHash(packing);
  return packing;
}

/// Of walls that swing, which all do so alike (the loader sees to it); 0: none does [s].
double swingPeriod(const Assembly& assembly) {
  for (const WallGroup& wall : assembly.walls)
    if (wall.motion.kind == Motion::Kind::oscillating)
      return 2.0 * std::numbers::pi / wall.motion.frequency;
  return 0.0;
}

}  // namespace

bool hasFlow(const Case& setup) {
  return setup.kind == CaseKind::couette || setup.average;
}

FlowTimes flowTimes(const Case& setup) {
  FlowTimes times;
  if (isAssembly(setup)) {
    const Region& region = setup.average->region;
    times.settled = region.from;
    times.samples = region.snapshots;
    times.interval = (assemblyDuration(setup) - region.from) / region.snapshots;
    return times;
  }
  const Averaging& averaging = setup.averaging;
  const double rotation = rotationTime(setup);
  times.settled = averaging.settleRotations * rotation;
  times.samples = std::max(
      1, static_cast<int>(std::lround(averaging.snapshotsPerRotation * averaging.rotations)));
  times.interval = averaging.rotations * rotation / times.samples;
  return times;
}

double flowDuration(const Case& setup) {
  if (isAssembly(setup)) return assemblyDuration(setup);
  return (setup.averaging.settleRotations + setup.averaging.rotations) * rotationTime(setup);
}

double flowUnit(const Case& setup) {
  return isAssembly(setup) ? 1.0 : rotationTime(setup);
}

double flowDiameter(const Case& setup) {
  if (!isAssembly(setup)) return 2.0 * setup.particles.smallRadius;
  double smallest = INFINITY;
  for (const DiskGroup& group : setup.assembly.disks)
    smallest = std::min(smallest, group.radius * (1.0 - group.radiusSpread));
  for (const Disks& disks : setup.assembly.starts.disks)
    smallest = std::min(smallest, std::ranges::min(disks.radius));
  return 2.0 * smallest;
}

bool packingsAreFiles(const Case& setup) {
  const StartFiles& starts = setup.assembly.starts;
  return setup.particles.file || (!starts.files.empty() && starts.velocityRms == 0.0);
}

bool hasClosedForms(const Case& setup) {
  return setup.average && setup.average->hasClosedForms();
}

int flowPackings(const Case& setup) {
  if (hasClosedForms(setup)) return closedFormRuns;
  if (!packingsAreFiles(setup)) return setup.preparation.packings;
  return isAssembly(setup) ? static_cast<int>(setup.assembly.starts.files.size()) : 1;
}

template <>
Scene flowScene<2>(const Case& setup, const Packing& packing, double dt) {
  if (isAssembly(setup)) return assemblyScene(setup, packing.disks, packing.wallTime, dt);
  return couetteScene(setup, packing, dt);
}
template <>
SpaceScene flowScene<3>(const Case&, const Packing&, double) {
  return {};
}

Scene unplacedScene(const Case& setup, double dt) {
  if (isAssembly(setup)) return assemblyScene(setup, assemblyDisks(setup, 0), 0.0, dt);
  Packing unplaced;
  unplaced.disks = diskKinds(setup.particles);
  return couetteScene(setup, unplaced, dt);
}

Packing flowPacking(const Case& setup, int index, double dt, Engine& engine,
                    const std::function<void(double)>& progress) {
  if (!isAssembly(setup)) return packingOf(setup, index, dt, engine, progress);
  Packing packing = assemblyPacking(setup, index);
  checkAssemblyStart(setup, flowScene(setup, packing, dt));
  return packing;
}

ExpectedPacking expectedPacking(const Case& setup, int index, double dt) {
  if (isAssembly(setup)) return {assemblyPacking(setup, index).hash, true};
  if (packingsAreFiles(setup))
    return {contentHash(readPacking(*setup.particles.file, setup)), true};
  ExpectedPacking packing{packingHash(setup, index, dt), false};
  packing.there = std::filesystem::exists(packingCacheFile(packing.hash));
  return packing;
}

double flowRestart(const Case& setup, double t) {
  const double period = isAssembly(setup) ? swingPeriod(setup.assembly) : 0.0;
  return period > 0.0 ? period * std::floor(t / period) : t;
}

template <>
Packing packingAt(const Packing&, const SpaceScene&, const SpaceSnapshot&) {
  return {};
}
template <>
Packing packingAt(const Packing& from, const Scene& scene, const Snapshot& now) {
  Packing there = from;
  there.disks.position = now.position;
  there.disks.velocity = now.velocity;
  if (now.spin) there.disks.spin = *now.spin;
  const auto wheel = std::ranges::find(scene.bodies, wheelName, &WallBody::name);
  if (wheel != scene.bodies.end())  // a cell's, whose other walls stand still
    there.wheelAngle += now.bodies[static_cast<std::size_t>(wheel - scene.bodies.begin())].angle;
  else
    there.wallTime += now.positionTime;
  there.hash = contentHash(there);
  return there;
}

}  // namespace crossgrain::inline cases

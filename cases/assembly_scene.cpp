#include "cases/assembly_scene.hpp"

#include <fmt/format.h>
#include <gsl/gsl_randist.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <utility>

#include "cases/couette.hpp"
#include "cases/materials.hpp"
#include "cases/time_step.hpp"
#include "support/random.hpp"

namespace crossgrain::inline cases {

namespace {

/// Nothing is drawn where nothing is to vary, so that other groups stay as they are.
double within(gsl_rng* random, double half) {
  return half > 0.0 ? gsl_ran_flat(random, -half, half) : 0.0;
}

double normal(gsl_rng* random, double rms) {
  return rms > 0.0 ? gsl_ran_gaussian(random, rms) : 0.0;
}

void addDisks(Disks& disks, const DiskGroup& group, const Assembly& assembly, gsl_rng* random) {
  const double diameter = 2.0 * group.radius;
  for (const Vec2& place : group.places) {
    const double scale = 1.0 + within(random, group.radiusSpread);
    const double jitterX = within(random, group.jitter), jitterY = within(random, group.jitter);
    const double extraX = normal(random, group.velocityRms);
    const double extraY = normal(random, group.velocityRms);
    const double radius = group.radius * scale, mass = group.mass * scale * scale;
    const Vec2 position = group.position + diameter * (place + Vec2(jitterX, jitterY));
    disks.radius.push_back(radius);
    disks.mass.push_back(mass);
    disks.inertia.push_back(assembly.inertiaFactor * mass * radius * radius);
    disks.position.push_back(assembly.placement.offset + assembly.placement.turned(position));
    disks.velocity.push_back(assembly.placement.boost +
                             assembly.placement.turned(group.velocity + Vec2(extraX, extraY)));
    disks.spin.push_back(!assembly.rotation          ? 0.0
                         : assembly.placement.mirror ? -group.spin
                                                     : group.spin);
  }
}

/// Walls that move in any other way cannot be boosted: the loader says so.
Motion movedAlong(Motion motion, const Assembly& assembly) {
  motion.velocity = assembly.placement.turned(motion.velocity);
  motion.amplitude = assembly.placement.turned(motion.amplitude);
  if (assembly.placement.mirror) motion.angularVelocity = -motion.angularVelocity;
  if (assembly.placement.boost.isZero(0.0)) return motion;
  motion.kind = Motion::Kind::translating;
  motion.velocity += assembly.placement.boost;
  return motion;
}

WallBody bodyOf(const WallGroup& group, const Assembly& assembly, std::size_t index) {
  const auto place = [&](const Vec2& point) -> Vec2 {
    return assembly.placement.offset + assembly.placement.turned(point);
  };
  WallBody body;
  body.name = fmt::format("wall-{}", index);
  body.centre = place(group.centre);
  for (const Plane& plane : group.planes)
    body.planes.push_back({place(plane.point), assembly.placement.turned(plane.normal)});
  for (const Vec2& position : group.position) body.diskPosition.push_back(place(position));
  body.diskRadius = group.radii;
  if (group.radii.empty()) body.diskRadius.assign(group.position.size(), group.radius);
  body.motion = movedAlong(group.motion, assembly);
  return body;
}

/// The body as a start that is so far along [s].
void moveOn(WallBody& body, double time) {
  if (time == 0.0) return;
  const BodyState now = stateAt(body.motion, body.centre, time);
  const auto place = [&](const Vec2& point) { return memberPosition(now, body.centre, point); };
  const Eigen::Rotation2Dd turn(now.angle);
  for (Vec2& position : body.diskPosition) position = place(position);
  for (Plane& plane : body.planes) plane = {place(plane.point), turn * plane.normal};
  body.centre = now.centre;
}

/// A file's disks, placed as the assembly is, with this packing's velocities.
Disks placed(Disks disks, const Assembly& assembly, gsl_rng* random) {
  const Placement& placement = assembly.placement;
  for (std::size_t i = 0; i < disks.size(); ++i) {
    const double extraX = normal(random, assembly.starts.velocityRms);
    const double extraY = normal(random, assembly.starts.velocityRms);
    disks.position[i] = placement.offset + placement.turned(disks.position[i]);
    disks.velocity[i] =
        placement.boost + placement.turned(disks.velocity[i] + Vec2(extraX, extraY));
    if (!assembly.rotation)
      disks.spin[i] = 0.0;
    else if (placement.mirror)
      disks.spin[i] = -disks.spin[i];
  }
  return disks;
}

}  // namespace

Disks assemblyDisks(const Case& setup, int packing) {
  const Assembly& assembly = setup.assembly;
  const Random random = randomStream(assembly.seed, static_cast<std::uint64_t>(packing));
  const auto& starts = assembly.starts.disks;
  if (!starts.empty())
    return placed(starts[static_cast<std::size_t>(packing) % starts.size()], assembly,
                  random.get());
  Disks disks;
  for (const DiskGroup& group : assembly.disks) addDisks(disks, group, assembly, random.get());
  return disks;
}

Scene assemblyScene(const Case& setup, Disks disks, double wallTime, double dt) {
  const Assembly& assembly = setup.assembly;
  Scene scene;
  scene.name = setup.variant.empty() ? setup.name : setup.name + " " + setup.variant;
  scene.law = setup.law;
  scene.bottom = setup.bottom;
  scene.gravity = assembly.placement.turned(assembly.gravity);
  scene.rotation = assembly.rotation;
  scene.precision = setup.run.precision;
  scene.dt = dt;
  scene.energyLedger = setup.run.energyLedger;
  scene.disks = std::move(disks);
  for (const WallGroup& group : assembly.walls) {
    scene.bodies.push_back(bodyOf(group, assembly, scene.bodies.size()));
    moveOn(scene.bodies.back(), wallTime);
  }
  addMaterials(scene, setup);
  return scene;
}

namespace {

Particles limitsOf(const Case& setup, const Scene& scene) {
  Particles limits;
  limits.smallRadius = std::ranges::min(scene.disks.radius);
  limits.maxOverlap = setup.assembly.maxOverlap;
  limits.maxOverlapKey = "assembly.max_overlap";
  return limits;
}

}  // namespace

void checkAssemblyStart(const Case& setup, const Scene& scene) {
  checkStart(scene, limitsOf(setup, scene), setup.file.string());
}

void checkStartFiles(const Case& setup) {
  const StartFiles& starts = setup.assembly.starts;
  for (std::size_t k = 0; k < starts.files.size(); ++k) {
    const Scene scene = assemblyScene(setup, assemblyDisks(setup, static_cast<int>(k)), 0.0, 1.0);
    std::vector<int> lines = starts.lines[k];
    if (!lines.empty())  // fixed disks are the last body of the walls
      lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(scene.disks.size()),
                   scene.wallDiskCount() - starts.fixedRadius.size(), 0);
    checkStart(scene, limitsOf(setup, scene), starts.files[k].string(), nullptr, lines);
  }
}

Scene assemblyScene(const Case& setup) {
  Scene scene = assemblyScene(setup, assemblyDisks(setup, 0), 0.0, timeStep(setup));
  checkAssemblyStart(setup, scene);
  return scene;
}

double assemblyDuration(const Case& setup) {
  const Assembly& assembly = setup.assembly;
  if (assembly.duration) return *assembly.duration;
  if (assembly.steps) return *assembly.steps * timeStep(setup);
  return *assembly.contactTimes * shortestContact(setup);
}

std::vector<Vec2> gridPlaces(int columns, int rows, const Vec2& spacing, bool triangular) {
  std::vector<Vec2> places;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const double shift = triangular && row % 2 == 1 ? 0.5 : 0.0;
      places.emplace_back((column + shift) * spacing.x(), row * spacing.y());
    }
  return places;
}

std::vector<Vec2> heapPlaces(int base, double spacing) {
  std::vector<Vec2> places;
  for (int row = 0; row < base; ++row)
    for (int column = 0; column < base - row; ++column)
      places.emplace_back((column + 0.5 * row) * spacing, row * spacing * std::sqrt(0.75));
  return places;
}

}  // namespace crossgrain::inline cases

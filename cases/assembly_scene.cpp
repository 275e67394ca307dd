#include "cases/assembly_scene.hpp"

#include <fmt/format.h>
#include <gsl/gsl_randist.h>

#include <algorithm>

#include "cases/couette.hpp"
#include "cases/time_step.hpp"
#include "oracle/impact.hpp"
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
  body.diskRadius.assign(group.position.size(), group.radius);
  body.motion = movedAlong(group.motion, assembly);
  return body;
}

}  // namespace

Scene assemblyScene(const Case& setup) {
  const Assembly& assembly = setup.assembly;
  Scene scene;
  scene.name = setup.variant.empty() ? setup.name : setup.name + " " + setup.variant;
  scene.law = setup.law;
  scene.bottom = setup.bottom;
  scene.gravity = assembly.placement.turned(assembly.gravity);
  scene.rotation = assembly.rotation;
  scene.precision = setup.run.precision;
  scene.dt = timeStep(setup);
  scene.energyLedger = setup.run.energyLedger;
  const Random random = seededRandom(assembly.seed);
  for (const DiskGroup& group : assembly.disks)
    addDisks(scene.disks, group, assembly, random.get());
  for (const WallGroup& group : assembly.walls)
    scene.bodies.push_back(bodyOf(group, assembly, scene.bodies.size()));

  Particles limits;
  limits.smallRadius = std::ranges::min(scene.disks.radius);
  limits.maxOverlap = assembly.maxOverlap;
  limits.maxOverlapKey = "assembly.max_overlap";
  checkStart(scene, limits, setup.file.string());
  return scene;
}

double assemblyDuration(const Case& setup) {
  const Assembly& assembly = setup.assembly;
  if (assembly.duration) return *assembly.duration;
  if (assembly.steps) return *assembly.steps * timeStep(setup);
  return *assembly.contactTimes * contactTime(setup.law, lightestReducedMass(setup));
}

}  // namespace crossgrain::inline cases

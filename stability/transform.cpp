#include "stability/transform.hpp"

#include <gsl/gsl_randist.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "support/random.hpp"

namespace crossgrain::inline stability {

double Units::of(int l, int m, int t) const {
  return std::pow(length, l) * std::pow(mass, m) * std::pow(time, t);
}

namespace {

/// γ in the units of what its damper multiplies it with.
double damperUnit(Damper damper, const Units& units) {
  switch (damper) {
    case Damper::constant:
      return units.of(0, 1, -1);
    case Damper::viscoelastic:
      return units.of(0, 0, 1);
    case Damper::critical:
      break;
  }
  return 1.0;
}

Motion inUnits(Motion motion, const Units& units) {
  motion.angularVelocity *= units.of(0, 0, -1);
  motion.velocity *= units.of(1, 0, -1);
  motion.amplitude *= units.length;
  motion.frequency *= units.of(0, 0, -1);
  motion.radialVelocity *= units.of(1, 0, -1);
  motion.radialEnd *= units.time;
  return motion;
}

}  // namespace

ContactLaw inUnits(ContactLaw law, const Units& units) {
  const double stiffness = units.of(0, 1, -2), modulus = units.of(-1, 1, -2);
  law.kn *= law.stiffens() ? modulus : stiffness;
  law.kn3 *= units.of(-2, 1, -2);
  law.kt *= law.normal == NormalLaw::hertz ? modulus : stiffness;
  law.gn *= damperUnit(law.damper, units);
  law.gt *= damperUnit(law.damper, units);
  const LawConventions& how = law.conventions;
  const bool perAngle = how.rollingStiffness == RollingStiffness::constant;  // [N m]
  law.kr *= perAngle ? units.of(2, 1, -2) : stiffness;
  const bool ratio =
      law.rolling == RollingLaw::spring && how.rollingDamper == RollingDamper::critical;
  law.gr *= ratio ? 1.0 : units.of(0, 1, -1);
  if (law.rolling == RollingLaw::viscousByLoad) law.muR *= units.of(-1, 0, 1);
  law.kc *= law.cohesion == CohesionLaw::area ? modulus : stiffness;
  law.w *= stiffness;  // J/m² is N/m
  law.kUnload *= stiffness;
  return law;
}

Scene inUnits(Scene scene, const Units& units) {
  const double speed = units.of(1, 0, -1), rate = units.of(0, 0, -1);
  Disks& disks = scene.disks;
  for (double& radius : disks.radius) radius *= units.length;
  for (double& mass : disks.mass) mass *= units.mass;
  for (double& inertia : disks.inertia) inertia *= units.of(2, 1, 0);
  for (Vec2& position : disks.position) position *= units.length;
  for (Vec2& velocity : disks.velocity) velocity *= speed;
  for (double& spin : disks.spin) spin *= rate;
  for (WallBody& body : scene.bodies) {
    body.centre *= units.length;
    for (Vec2& position : body.diskPosition) position *= units.length;
    for (double& radius : body.diskRadius) radius *= units.length;
    for (Plane& plane : body.planes) plane.point *= units.length;
    body.motion = inUnits(body.motion, units);
  }
  changeLaws(scene, [&](ContactLaw& law) { law = inUnits(law, units); });
  if (scene.bottom) {
    scene.bottom->kb *= units.of(0, 1, -2);
    scene.bottom->gb *= units.of(0, 1, -1);
    scene.bottom->gravity *= units.of(1, 0, -2);
  }
  scene.gravity *= units.of(1, 0, -2);
  scene.dt *= units.time;
  return scene;
}

Scene placed(Scene scene, const Placement& placement) {
  const auto turn = [&](Vec2& vector) { vector = placement.turned(vector); };
  const double handed = placement.mirror ? -1.0 : 1.0;
  std::ranges::for_each(scene.disks.position, turn);
  std::ranges::for_each(scene.disks.velocity, turn);
  for (double& spin : scene.disks.spin) spin *= handed;
  for (WallBody& body : scene.bodies) {
    turn(body.centre);
    std::ranges::for_each(body.diskPosition, turn);
    for (Plane& plane : body.planes) {
      turn(plane.point);
      turn(plane.normal);
    }
    turn(body.motion.velocity);
    turn(body.motion.amplitude);
    body.motion.angularVelocity *= handed;
  }
  turn(scene.gravity);
  return scene;
}

Scene renumbered(Scene scene, const std::vector<std::size_t>& order) {
  const Disks& from = scene.disks;
  Disks disks = from;
  for (std::size_t k = 0; k < order.size(); ++k) {
    disks.radius[k] = from.radius[order[k]];
    disks.mass[k] = from.mass[order[k]];
    disks.inertia[k] = from.inertia[order[k]];
    disks.position[k] = from.position[order[k]];
    disks.velocity[k] = from.velocity[order[k]];
    disks.spin[k] = from.spin[order[k]];
  }
  scene.disks = std::move(disks);
  if (scene.materials) {
    const std::vector<std::int32_t> ofDisk = scene.materials->ofDisk;
    for (std::size_t k = 0; k < order.size(); ++k) scene.materials->ofDisk[k] = ofDisk[order[k]];
  }
  return scene;
}

Scene transformed(const Scene& scene, const Transform& by) {
  return renumbered(inUnits(placed(scene, by.placement), by.units), by.order);
}

namespace {

std::size_t placeOf(const Transform& by, std::size_t k) {
  return by.order.empty() ? k : by.order[k];
}

}  // namespace

std::vector<Vec2> placesBack(const Transform& by, const std::vector<Vec2>& position) {
  std::vector<Vec2> places(position.size());
  for (std::size_t k = 0; k < position.size(); ++k)
    places[placeOf(by, k)] = by.placement.turnedBack(position[k] / by.units.length);
  return places;
}

std::vector<double> spinsBack(const Transform& by, const std::vector<double>& spin) {
  std::vector<double> spins(spin.size());
  const double unit = (by.placement.mirror ? -1.0 : 1.0) * by.units.time;
  for (std::size_t k = 0; k < spin.size(); ++k) spins[placeOf(by, k)] = unit * spin[k];
  return spins;
}

std::vector<std::size_t> shuffledOrder(std::size_t disks, std::uint64_t seed) {
  std::vector<std::size_t> order(disks);
  std::iota(order.begin(), order.end(), std::size_t{0});
  if (disks < 2) return order;
  const Random random = seededRandom(seed);
  while (std::ranges::is_sorted(order))  // of few disks a shuffle may be none
    gsl_ran_shuffle(random.get(), order.data(), order.size(), sizeof(std::size_t));
  return order;
}

Disks nudged(Disks disks, double epsilon, std::uint64_t seed) {
  const Random random = seededRandom(seed);
  const auto either = [&] { return gsl_rng_uniform_int(random.get(), 2) == 0 ? 1.0 : -1.0; };
  const auto nudge = [&](Vec2& vector, double by) {
    vector.x() += either() * by;
    vector.y() += either() * by;
  };
  for (std::size_t i = 0; i < disks.size(); ++i) {
    nudge(disks.position[i], epsilon * (disks.position[i].norm() + disks.radius[i]));
    nudge(disks.velocity[i], epsilon * disks.velocity[i].norm());
    disks.spin[i] += either() * epsilon * std::abs(disks.spin[i]);
  }
  return disks;
}

double extentOf(const Scene& scene) {
  double extent = 0.0;
  for (std::size_t i = 0; i < scene.disks.size(); ++i)
    extent = std::max(extent, scene.disks.position[i].norm() + scene.disks.radius[i]);
  for (const WallBody& body : scene.bodies) {
    for (const Vec2& position : body.diskPosition) extent = std::max(extent, position.norm());
    for (const Plane& plane : body.planes) extent = std::max(extent, plane.point.norm());
  }
  return extent;
}

}  // namespace crossgrain::inline stability

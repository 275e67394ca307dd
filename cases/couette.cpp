#include "cases/couette.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "cases/bad_input.hpp"

namespace crossgrain {

WallBody wallRing(const char* name, const Cell& cell, double radius, double angle) {
  WallBody body;
  body.name = name;
  const double circumference = 2.0 * std::numbers::pi * radius;
  const auto count = static_cast<int>(circumference / cell.wallSpacing);
  for (int k = 0; k < count; ++k) {
    const double phi = angle + 2.0 * std::numbers::pi * k / count;
    body.diskPosition.emplace_back(radius * std::cos(phi), radius * std::sin(phi));
    body.diskRadius.push_back(cell.wallRadius);
  }
  return body;
}

Disks diskKinds(const Particles& particles) {
  Disks disks;
  const auto add = [&](int count, double radius, double mass) {
    for (int k = 0; k < count; ++k) {
      disks.radius.push_back(radius);
      disks.mass.push_back(mass);
      disks.inertia.push_back(particles.inertiaFactor * mass * radius * radius);
    }
  };
  add(particles.small, particles.smallRadius, particles.smallMass);
  add(particles.large, particles.largeRadius, particles.largeMass);
  disks.position.assign(disks.size(), Vec2::Zero());
  disks.velocity.assign(disks.size(), Vec2::Zero());
  disks.spin.assign(disks.size(), 0.0);
  return disks;
}

Scene couetteScene(const Case& setup, const Packing& packing, double dt) {
  Scene scene;
  scene.name = setup.name;
  scene.disks = packing.disks;
  scene.law = setup.law;
  scene.bottom = setup.bottom;
  scene.rotation = setup.particles.rotation;
  if (!scene.rotation) std::ranges::fill(scene.disks.spin, 0.0);
  scene.precision = setup.run.precision;
  scene.dt = dt;
  WallBody wheel = wallRing(wheelName, setup.cell, setup.cell.innerRadius, packing.wheelAngle);
  wheel.motion.kind = Motion::Kind::rotating;
  wheel.motion.angularVelocity = setup.cell.omega;
  scene.bodies.push_back(std::move(wheel));
  scene.bodies.push_back(wallRing(ringName, setup.cell, setup.cell.outerRadius, 0.0));
  return scene;
}

namespace {

/// "disk 3", "wall disk 12": as the user knows it.
std::string nameOf(std::size_t id, std::size_t disks) {
  return id < disks ? fmt::format("disk {}", id) : fmt::format("wall disk {}", id - disks);
}

void checkInCell(const Disks& disks, const Cell& cell, const std::string& where) {
  for (std::size_t i = 0; i < disks.size(); ++i) {
    const double r = disks.position[i].norm();
    if (r <= cell.innerRadius || r >= cell.outerRadius)
      throw BadInput(
          fmt::format("{}: disk {} at r = {:.4g} m is not between the walls at {:g} m and "
                      "{:g} m",
                      where, i, r, cell.innerRadius, cell.outerRadius));
  }
}

}  // namespace

void checkStart(const Scene& scene, const Particles& particles, const std::string& where,
                const Cell* cell) {
  std::vector<Vec2> position = scene.disks.position;
  std::vector<double> radius = scene.disks.radius;
  for (const WallBody& body : scene.bodies) {
    position.insert(position.end(), body.diskPosition.begin(), body.diskPosition.end());
    radius.insert(radius.end(), body.diskRadius.begin(), body.diskRadius.end());
  }
  for (std::size_t i = 0; i < position.size(); ++i)
    if (!position[i].allFinite())
      throw BadInput(fmt::format("{}: the position of disk {} is not finite", where, i));
  if (cell) checkInCell(scene.disks, *cell, where);

  // Sweep over x: only disks whose extents in x overlap are held against each other.
  std::vector<std::size_t> order(position.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::sort(order, {}, [&](std::size_t i) { return position[i].x() - radius[i]; });
  const double limit = particles.maxOverlap * particles.smallRadius;
  const std::size_t disks = scene.disks.size();
  for (std::size_t a = 0; a < order.size(); ++a) {
    for (std::size_t b = a + 1; b < order.size(); ++b) {
      const std::size_t i = std::min(order[a], order[b]);
      const std::size_t j = std::max(order[a], order[b]);
      const double right = position[order[a]].x() + radius[order[a]];
      if (position[order[b]].x() - radius[order[b]] > right) break;
      if (i >= disks) continue;  // disks of a wall may overlap each other
      const double distance = (position[i] - position[j]).norm();
      const double overlap = radius[i] + radius[j] - distance;
      if (distance == 0.0)
        throw BadInput(fmt::format("{}: {} and {} have the same centre", where, nameOf(i, disks),
                                   nameOf(j, disks)));
      if (overlap > limit)
        throw BadInput(fmt::format(
            "{}: {} and {} overlap by {:.3g} m at the start, more than particles.max_overlap = "
            "{:g} "
            "of the small radius allows ({:.3g} m)",
            where, nameOf(i, disks), nameOf(j, disks), overlap, particles.maxOverlap, limit));
    }
  }
}

}  // namespace crossgrain

#include "cases/collision_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "cases/materials.hpp"

namespace crossgrain::inline cases {

CollidingPair collidingPair(const Case& setup) {
  const Collision& c = setup.collision;
  const auto inertia = [&](int side) {
    return c.inertiaFactor * c.mass[side] * c.radius[side] * c.radius[side];
  };
  if (c.wall) return diskOnWall(c.radius[0], c.mass[0], inertia(0));
  return {{c.radius[0], c.radius[1]}, {c.mass[0], c.mass[1]}, {inertia(0), inertia(1)}};
}

std::vector<CollisionStart> collisionStarts(const Case& setup) {
  const Collision& c = setup.collision;
  std::vector<CollisionStart> starts;
  const auto add = [&](const std::vector<double>& speeds, bool whole) {
    for (const double speed : speeds)
      for (const double spin : c.counterSpin)
        for (const double psi : c.psi)
          starts.push_back({psi, whole ? speed / std::hypot(1.0, psi) : speed, c.approach, spin});
  };
  c.vn.empty() ? add({c.speed}, true) : add(c.vn, false);
  return starts;
}

namespace {

void addDisk(Disks& disks, const CollidingPair& pair, int side, const Vec2& position,
             const Vec2& velocity, double spin) {
  disks.radius.push_back(pair.radius[side]);
  disks.mass.push_back(pair.mass[side]);
  disks.inertia.push_back(pair.inertia[side]);
  disks.position.push_back(position);
  disks.velocity.push_back(velocity);
  disks.spin.push_back(spin);
}

WallBody movingWall(const Vec2& velocity) {
  WallBody wall;
  wall.name = "wall";
  wall.planes.push_back({Vec2::Zero(), Vec2::UnitX()});
  if (!velocity.isZero(0.0)) {
    wall.motion.kind = Motion::Kind::translating;
    wall.motion.velocity = velocity;
  }
  return wall;
}

}  // namespace

Scene collisionScene(const Case& setup, const std::vector<CollisionStart>& starts, double dt) {
  const Collision& collision = setup.collision;
  const CollidingPair pair = collidingPair(setup);
  const double reach = pair.radius[0] + pair.radius[1];
  const double spacing = 3.0 * std::max(2.0 * std::max(pair.radius[0], pair.radius[1]), reach);
  const std::size_t columns =
      pair.plane
          ? 1
          : static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(starts.size()))));

  Scene scene;
  scene.name = setup.name;
  scene.law = setup.law;
  scene.bottom = setup.bottom;
  scene.precision = setup.run.precision;
  scene.energyLedger = setup.run.energyLedger;
  scene.dt = dt;
  if (pair.plane) scene.bodies.push_back(movingWall(collision.wallVelocity));
  const double middle = 0.5 * static_cast<double>(columns - 1);
  for (std::size_t k = 0; k < starts.size(); ++k) {
    const Vec2 centre((static_cast<double>(k % columns) - middle) * spacing,
                      (static_cast<double>(k / columns) - middle) * spacing);
    const PairMotion motion = motionBefore(pair, starts[k]);
    const Vec2 velocity(motion.normal, motion.tangential);
    const Vec2 apart = Vec2(reach, 0.0) - collision.startPhase * dt * velocity;
    if (pair.plane) {
      addDisk(scene.disks, pair, 0, centre + apart, velocity + collision.wallVelocity,
              motion.spin[0]);
      continue;
    }
    const double massSum = pair.mass[0] + pair.mass[1];
    for (const int side : {0, 1}) {
      const double fraction = (side == 0 ? 1.0 : -1.0) * pair.mass[1 - side] / massSum;
      addDisk(scene.disks, pair, side, centre + fraction * apart, fraction * velocity,
              motion.spin[side]);
    }
  }
  return scene;
}

std::vector<NamedPair> pairsOf(const Case& setup) {
  if (setup.kind == CaseKind::collision) return {{"i-j", collidingPair(setup), setup.law}};
  const Particles& p = setup.particles;
  struct Kind {
    const char* name;
    double radius, mass;
    const MaterialName& material;
    double inertia(double factor) const { return factor * mass * radius * radius; }
  };
  std::vector<Kind> kinds;
  if (p.small > 0 || p.file)
    kinds.push_back({"small", p.smallRadius, p.smallMass, p.smallMaterial});
  if (p.large > 0 || p.file)
    kinds.push_back({"large", p.largeRadius, p.largeMass, p.largeMaterial});
  const std::size_t disks = kinds.size();
  constexpr double infinite = std::numeric_limits<double>::infinity();
  const Cell& cell = setup.cell;
  const bool alike = cell.wheelMaterial.name == cell.ringMaterial.name;
  kinds.push_back({alike ? "wall" : "wheel", cell.wallRadius, infinite, cell.wheelMaterial});
  if (!alike) kinds.push_back({"ring", cell.wallRadius, infinite, cell.ringMaterial});
  std::vector<NamedPair> pairs;
  for (std::size_t i = 0; i < disks; ++i)
    for (std::size_t j = i; j < kinds.size(); ++j) {
      const Kind &one = kinds[i], &two = kinds[j];
      pairs.push_back({fmt::format("{}-{}", one.name, two.name),
                       {{one.radius, two.radius},
                        {one.mass, two.mass},
                        {one.inertia(p.inertiaFactor), two.inertia(p.inertiaFactor)}},
                       lawOf(setup, one.material, two.material)});
    }
  return pairs;
}

}  // namespace crossgrain::inline cases

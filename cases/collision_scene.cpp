#include "cases/collision_scene.hpp"

#include <algorithm>
#include <cmath>

namespace crossgrain {

CollidingPair collidingPair(const Case& setup) {
  const Collision& c = setup.collision;
  CollidingPair pair{};
  for (const int side : {0, 1}) {
    pair.radius[side] = c.radius[side];
    pair.mass[side] = c.mass[side];
    pair.inertia[side] = c.inertiaFactor * c.mass[side] * c.radius[side] * c.radius[side];
  }
  return pair;
}

Scene collisionScene(const Case& setup, const std::vector<CollisionStart>& starts, double dt) {
  const Collision& pair = setup.collision;
  const double reach = pair.radius[0] + pair.radius[1];
  const double spacing = 3.0 * std::max(2.0 * std::max(pair.radius[0], pair.radius[1]), reach);
  const auto columns =
      static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(starts.size()))));

  Scene scene;
  scene.name = setup.name;
  scene.law = setup.law;
  scene.bottom = setup.bottom;
  scene.precision = setup.run.precision;
  scene.dt = dt;
  const double massSum = pair.mass[0] + pair.mass[1];
  for (std::size_t k = 0; k < starts.size(); ++k) {
    const double middle = 0.5 * static_cast<double>(columns - 1);
    const Vec2 centre((static_cast<double>(k % columns) - middle) * spacing,
                      (static_cast<double>(k / columns) - middle) * spacing);
    const PairMotion motion = motionBefore(collidingPair(setup), starts[k]);
    const Vec2 velocity(motion.normal, motion.tangential);
    const Vec2 apart = Vec2(reach, 0.0) - pair.startPhase * dt * velocity;
    for (const int side : {0, 1}) {
      const double sign = side == 0 ? 1.0 : -1.0;
      const double share = pair.mass[1 - side] / massSum;
      scene.disks.radius.push_back(pair.radius[side]);
      scene.disks.mass.push_back(pair.mass[side]);
      scene.disks.inertia.push_back(pair.inertiaFactor * pair.mass[side] * pair.radius[side] *
                                    pair.radius[side]);
      scene.disks.position.push_back(centre + sign * share * apart);
      scene.disks.velocity.push_back(sign * share * velocity);
      scene.disks.spin.push_back(motion.spin[side]);
    }
  }
  return scene;
}

namespace {

CollidingPair pairOf(const Disks& disks, std::size_t i, std::size_t j) {
  return {{disks.radius[i], disks.radius[j]},
          {disks.mass[i], disks.mass[j]},
          {disks.inertia[i], disks.inertia[j]}};
}

/// When a free flight from `apart` reached `reach` for the last time, ≤ 0 [s]. An engine that lets
/// disks part a hair outside contact never had them at `reach`: then the closest approach of the
/// flight line is the best instant there is.
double timeOfParting(const Vec2& apart, const Vec2& velocity, double reach) {
  const double a = velocity.squaredNorm();
  const double b = apart.dot(velocity);
  const double c = apart.squaredNorm() - reach * reach;
  return (std::sqrt(std::max(b * b - a * c, 0.0)) - b) / a;
}

}  // namespace

std::optional<CollisionEnd> collisionEnd(const Scene& scene, const Snapshot& after,
                                         std::size_t pair, const CollisionStart& start) {
  const std::size_t i = 2 * pair;
  const std::size_t j = i + 1;
  const Disks& disks = scene.disks;
  const double reach = disks.radius[i] + disks.radius[j];
  const Vec2 apart = after.position[i] - after.position[j];
  const Vec2 velocity = after.velocity[i] - after.velocity[j];
  if (apart.dot(velocity) <= 0.0 || apart.norm() < reach) return std::nullopt;
  const double parting = timeOfParting(apart, velocity, reach);
  const Vec2 normal = (apart + parting * velocity).normalized();
  const std::vector<double>& spin = after.spin ? *after.spin : disks.spin;
  CollisionEnd end =
      endOf(pairOf(disks, i, j), start,
            {velocity.dot(normal), velocity.dot(perpendicular(normal)), {spin[i], spin[j]}});
  // The flight that brought them together, run backwards, parted them when they met.
  const double touch = -timeOfParting(disks.position[i] - disks.position[j],
                                      disks.velocity[j] - disks.velocity[i], reach);
  if (scene.law.normal != NormalLaw::rigid) end.duration = after.positionTime + parting - touch;
  return end;
}

}  // namespace crossgrain

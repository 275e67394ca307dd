#include "oracle/collision_flight.hpp"

#include <algorithm>
#include <cmath>

#include "law/cohesion.hpp"

namespace crossgrain::inline oracle {

template <int D>
CollidingPair pairOf(const SceneOf<D>& scene, std::size_t pair) {
  const DisksOf<D>& disks = scene.disks;
  if (!scene.bodies.empty())
    return diskOnWall(disks.radius[pair], disks.mass[pair], disks.inertia[pair]);
  const std::size_t i = 2 * pair, j = i + 1;
  return {{disks.radius[i], disks.radius[j]},
          {disks.mass[i], disks.mass[j]},
          {disks.inertia[i], disks.inertia[j]}};
}
template CollidingPair pairOf<2>(const Scene&, std::size_t);
template CollidingPair pairOf<3>(const SpaceScene&, std::size_t);

namespace {

/// When a free flight from `apart` reached `reach` for the last time, ≤ 0 [s]. An engine that lets
/// disks part a hair outside contact never had them at `reach`: then the closest approach of the
/// flight line is the best instant there is.
double timeOfParting(const auto& apart, const auto& velocity, double reach) {
  const double a = velocity.squaredNorm();
  const double b = apart.dot(velocity);
  const double c = apart.squaredNorm() - reach * reach;
  return (std::sqrt(std::max(b * b - a * c, 0.0)) - b) / a;
}

const std::vector<double>& spinsOf(const Disks& disks, const Snapshot& after) {
  return after.spin ? *after.spin : disks.spin;
}

/// The plane moves as prescribed, so only the disk's flight is looked at; the normal stays.
std::optional<CollisionEnd> wallCollisionEnd(const Scene& scene, const Snapshot& after,
                                             std::size_t disk, const CollisionStart& start) {
  const Disks& disks = scene.disks;
  const Vec2 wall = scene.bodies.front().motion.velocity;
  const double reach = disks.radius[disk];
  const double height = after.position[disk].x() - wall.x() * after.positionTime;
  const Vec2 velocity = after.velocity[disk] - wall;
  const double end = reach + bondRange(scene.law, reach);
  if (velocity.x() <= 0.0 || height < end) return std::nullopt;
  CollisionEnd parted = endOf(pairOf(scene, disk), start,
                              {velocity.x(), velocity.y(), {spinsOf(disks, after)[disk], 0.0}});
  const double parting = (end - height) / velocity.x();
  const double touch = (disks.position[disk].x() - reach) / (wall.x() - disks.velocity[disk].x());
  if (scene.law.soft()) parted.duration = after.positionTime + parting - touch;
  return parted;
}

}  // namespace

std::optional<CollisionEnd> collisionEnd(const Scene& scene, const Snapshot& after,
                                         std::size_t pair, const CollisionStart& start) {
  if (!scene.bodies.empty()) return wallCollisionEnd(scene, after, pair, start);
  const std::size_t i = 2 * pair;
  const std::size_t j = i + 1;
  const Disks& disks = scene.disks;
  const double reach = disks.radius[i] + disks.radius[j];
  const Vec2 apart = after.position[i] - after.position[j];
  const Vec2 velocity = after.velocity[i] - after.velocity[j];
  const double end = reach + bondRange(scene.law, pairOf(scene, pair).reducedRadius());
  if (apart.dot(velocity) <= 0.0 || apart.norm() < end) return std::nullopt;
  const double parting = timeOfParting(apart, velocity, end);
  const Vec2 normal = (apart + parting * velocity).normalized();
  const std::vector<double>& spin = spinsOf(disks, after);
  CollisionEnd parted =
      endOf(pairOf(scene, pair), start,
            {velocity.dot(normal), velocity.dot(perpendicular(normal)), {spin[i], spin[j]}});
  // The flight that brought them together, run backwards, parted them when they met.
  const double touch = -timeOfParting(disks.position[i] - disks.position[j],
                                      disks.velocity[j] - disks.velocity[i], reach);
  if (scene.law.soft()) parted.duration = after.positionTime + parting - touch;
  return parted;
}

std::optional<CollisionEnd> collisionEnd(const SpaceScene& scene, const SpaceSnapshot& after,
                                         std::size_t pair, const CollisionStart& start,
                                         const Eigen::Matrix3d& turn) {
  const DisksOf<3>& spheres = scene.disks;
  const CollidingPair bodies = pairOf(scene, pair);
  const double reach = bodies.radius[0] + bodies.radius[1];
  const std::size_t i = bodies.plane ? pair : 2 * pair, j = i + 1;
  const Vec3 wall = bodies.plane ? scene.bodies.front().motion.velocity : Vec3::Zero();
  /// Of i against j, or against the plane.
  const auto between = [&](const std::vector<Vec3>& of, const Vec3& ofWall) -> Vec3 {
    return turn.transpose() * (of[i] - (bodies.plane ? ofWall : of[j]));
  };
  const Vec3 apart = between(after.position, after.positionTime * wall);
  const Vec3 before = between(spheres.position, Vec3::Zero());
  const Vec3 velocity = between(after.velocity, wall), approach = between(spheres.velocity, wall);
  SpaceMotion motion;
  motion.velocity = velocity;
  const std::vector<Vec3>& spin = after.spin ? *after.spin : spheres.spin;
  motion.spin[0] = turn.transpose() * spin[i];
  if (!bodies.plane) motion.spin[1] = turn.transpose() * spin[j];
  double parting, touch;
  if (bodies.plane) {
    if (velocity.x() <= 0.0 || apart.x() < reach) return std::nullopt;
    parting = (reach - apart.x()) / velocity.x();
    touch = (reach - before.x()) / approach.x();
  } else {
    if (apart.dot(velocity) <= 0.0 || apart.norm() < reach) return std::nullopt;
    parting = timeOfParting(apart, velocity, reach);
    motion.normal = (apart + parting * velocity).normalized();
    touch = -timeOfParting(before, Vec3(-approach), reach);
  }
  CollisionEnd end = spaceEndOf(bodies, start, motion);
  if (scene.law.soft()) end.duration = after.positionTime + parting - touch;
  return end;
}

}  // namespace crossgrain::inline oracle

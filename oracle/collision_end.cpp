#include "oracle/collision_end.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "law/cohesion.hpp"

namespace crossgrain::inline oracle {

PairMotion motionBefore(const CollidingPair& pair, const CollisionStart& start) {
  const double slip = start.psi * start.vn;
  PairMotion motion{-start.vn, 0.0, {0.0, 0.0}};
  const bool both = start.approach == Approach::spin && !pair.plane;
  if (start.approach == Approach::oblique) {
    motion.tangential = slip;
  } else {
    motion.spin[0] = -slip / (both ? pair.radius[0] + pair.radius[1] : pair.radius[0]);
    if (both) motion.spin[1] = motion.spin[0];
  }
  if (start.counterSpin != 0.0) {
    motion.spin[0] += start.counterSpin;
    motion.spin[1] -= start.counterSpin * pair.radius[0] / pair.radius[1];
  }
  return motion;
}

double energyOf(const CollidingPair& pair, const PairMotion& motion) {
  double twice =
      pair.reducedMass() * (motion.normal * motion.normal + motion.tangential * motion.tangential);
  for (const int side : {0, 1})
    if (motion.spin[side] != 0.0)  // a wall has none, and an infinite moment of inertia
      twice += pair.inertia[side] * motion.spin[side] * motion.spin[side];
  return 0.5 * twice;
}

SpaceMotion spaceMotionBefore(const CollidingPair& pair, const CollisionStart& start) {
  const PairMotion plane = motionBefore(pair, start);
  SpaceMotion motion;
  motion.velocity = {plane.normal, plane.tangential, 0.0};
  for (const int side : {0, 1}) {
    const Vec2& besides = start.spinOutOfPlane[side];
    motion.spin[side] = {besides.x(), besides.y(), plane.spin[side]};
  }
  return motion;
}

namespace {

/// As that of the plane.
double energyOf(const CollidingPair& pair, const SpaceMotion& motion) {
  double twice = pair.reducedMass() * motion.velocity.squaredNorm();
  for (const int side : {0, 1})
    if (!motion.spin[side].isZero(0.0))  // a wall has none, and an infinite moment of inertia
      twice += pair.inertia[side] * motion.spin[side].squaredNorm();
  return 0.5 * twice;
}

}  // namespace

CollisionEnd spaceEndOf(const CollidingPair& pair, const CollisionStart& start,
                        const SpaceMotion& after) {
  const Vec3 along = turnedAlong(Vec3::UnitX(), after.normal, Vec3::UnitY()),
             out = turnedAlong(Vec3::UnitX(), after.normal, Vec3::UnitZ());
  CollisionEnd end = endOf(pair, start,
                           {after.velocity.dot(after.normal),
                            after.velocity.dot(along),
                            {after.spin[0].dot(out), after.spin[1].dot(out)}});
  // Of the slip v − (a_i ω_i + a_j ω_j) × n′ the part along b′ = n′ × s′, as ω × n′·b′ = −ω·s′.
  const Vec3 turning = pair.radius[0] * after.spin[0] + pair.radius[1] * after.spin[1];
  EndOutOfPlane& besides = end.outOfPlane.emplace();
  besides.psi = (after.velocity.dot(out) + turning.dot(along)) / start.vn;
  for (const int side : {0, 1}) {
    besides.spinNormal[side] = after.spin[side].x();
    besides.spinTangent[side] = after.spin[side].y();
    end.spin[side] = after.spin[side].z();
  }
  end.energyBefore = energyOf(pair, spaceMotionBefore(pair, start));
  end.energyAfter = energyOf(pair, after);
  return end;
}

CollisionEnd endOf(const CollidingPair& pair, const CollisionStart& start,
                   const PairMotion& after) {
  const PairMotion before = motionBefore(pair, start);
  const double slip =
      after.tangential - pair.radius[0] * after.spin[0] - pair.radius[1] * after.spin[1];
  CollisionEnd end;
  end.en = after.normal / start.vn;
  end.psi = slip / start.vn;
  if (start.psi != 0.0) end.beta = -end.psi / start.psi;
  end.centrePsi = after.tangential / start.vn;
  if (before.tangential != 0.0) end.et = after.tangential / before.tangential;
  end.reboundAngle = std::atan2(after.tangential, after.normal);
  for (const int side : {0, 1}) end.spin[side] = after.spin[side];
  end.energyBefore = energyOf(pair, before);
  end.energyAfter = energyOf(pair, after);
  return end;
}

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

/// @param turn  takes n, s and b of the start to where they are in the scene: its columns. In the
///              plane they are where they are
template <int D>
std::optional<CollisionEnd> endOfFlight(const SceneOf<D>& scene, const SnapshotOf<D>& after,
                                        std::size_t pair, const CollisionStart& start,
                                        const Eigen::Matrix<double, D, D>& turn) {
  const DisksOf<D>& disks = scene.disks;
  const CollidingPair bodies = pairOf(scene, pair);
  const std::size_t i = bodies.plane ? pair : 2 * pair, j = i + 1;
  // A plane moves as prescribed, so only the body's flight is looked at; the normal stays.
  const VecOf<D> wall =
      bodies.plane ? scene.bodies.front().motion.velocity : VecOf<D>(VecOf<D>::Zero());
  const auto seen = [&](const VecOf<D>& v) -> VecOf<D> {
    if constexpr (D == 2)
      return v;
    else
      return turn.transpose() * v;
  };
  /// Of i against j, or against the plane.
  const auto between = [&](const std::vector<VecOf<D>>& of, const VecOf<D>& ofWall) {
    return seen(of[i] - (bodies.plane ? ofWall : of[j]));
  };
  const VecOf<D> apart = between(after.position, after.positionTime * wall),
                 before = between(disks.position, VecOf<D>::Zero()),
                 velocity = between(after.velocity, wall), approach = between(disks.velocity, wall);
  const double reach = bodies.radius[0] + bodies.radius[1];
  const double end = D == 2 ? reach + bondRange(scene.law, bodies.reducedRadius()) : reach;
  VecOf<D> normal = VecOf<D>::UnitX();
  double parting, touch;
  if (bodies.plane) {
    if (velocity.x() <= 0.0 || apart.x() < end) return std::nullopt;
    parting = (end - apart.x()) / velocity.x();
    touch = (reach - before.x()) / approach.x();
  } else {
    if (apart.dot(velocity) <= 0.0 || apart.norm() < end) return std::nullopt;
    parting = timeOfParting(apart, velocity, end);
    normal = (apart + parting * velocity).normalized();
    // The flight that brought them together, run backwards, parted them when they met.
    touch = -timeOfParting(before, VecOf<D>(-approach), reach);
  }
  const auto& spin = after.spin ? *after.spin : disks.spin;
  CollisionEnd parted;
  if constexpr (D == 2) {
    parted = endOf(bodies, start,
                   {velocity.dot(normal),
                    velocity.dot(perpendicular(normal)),
                    {spin[i], bodies.plane ? 0.0 : spin[j]}});
  } else {
    SpaceMotion motion{normal, velocity, {seen(spin[i]), Vec3::Zero()}};
    if (!bodies.plane) motion.spin[1] = seen(spin[j]);
    parted = spaceEndOf(bodies, start, motion);
  }
  if (scene.law.soft()) parted.duration = after.positionTime + parting - touch;
  return parted;
}

}  // namespace

std::optional<CollisionEnd> collisionEnd(const Scene& scene, const Snapshot& after,
                                         std::size_t pair, const CollisionStart& start) {
  return endOfFlight<2>(scene, after, pair, start, Eigen::Matrix2d::Identity());
}

std::optional<CollisionEnd> collisionEnd(const SpaceScene& scene, const SpaceSnapshot& after,
                                         std::size_t pair, const CollisionStart& start,
                                         const Eigen::Matrix3d& turn) {
  return endOfFlight<3>(scene, after, pair, start, turn);
}

}  // namespace crossgrain::inline oracle

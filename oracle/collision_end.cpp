#include "oracle/collision_end.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

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

}  // namespace crossgrain::inline oracle

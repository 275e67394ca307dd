#include "oracle/convex_contact.hpp"

#include <algorithm>
#include <cmath>

namespace crossgrain::inline oracle {

template <int D>
CornerOf<D> cornerTowards(const ShapeOf<D>& shape, const TurnOf<D>& turn,
                          const VecOf<D>& direction) {
  const Eigen::Matrix<double, D, D> axes = matrixOf<D>(turn);
  const VecOf<D> own = axes.transpose() * direction;
  std::vector<double> behind;
  for (const VecOf<D>& corner : shape.vertices) behind.push_back(-corner.dot(own));
  std::ranges::sort(behind);
  double next = behind[1] - behind[0];
  // The other side of a cylinder's rim.
  if (shape.kind == ShapeKind::cylinder)
    next = std::min(next, 2.0 * shape.rounding * own.template head<D - 1>().norm());
  return {axes * farthest<D>(shape, own), next};
}

template <int D>
ConvexImpactBody<D> impactBody(const DisksOf<D>& bodies, std::size_t i, const VecOf<D>& arm) {
  ConvexImpactBody<D> body{bodies.mass[i], {}, arm, bodies.velocity[i], bodies.spin[i]};
  if constexpr (D == 2) {
    body.inverseInertia = 1.0 / bodies.inertia[i];
  } else {
    const Eigen::Matrix3d axes = matrixOf<3>(bodies.turn[i]);
    body.inverseInertia = axes * bodies.moments[i].cwiseInverse().asDiagonal() * axes.transpose();
  }
  return body;
}

template <int D>
CollisionEnd convexEnd(const ConvexImpactStart<D>& start, const std::array<VecOf<D>, 2>& velocity,
                       const std::array<SpinOf<D>, 2>& spin) {
  const auto between = [](const ConvexImpactStart<D>& at) -> VecOf<D> {
    return velocityAtContact(at.body[0]) - velocityAtContact(at.body[1]);
  };
  const auto ofCentres = [](const ConvexImpactStart<D>& at) -> VecOf<D> {
    return at.body[0].velocity - at.body[1].velocity;
  };
  ConvexImpactStart<D> after = start;
  CollisionEnd end;
  for (const int side : {0, 1}) {
    after.body[side].velocity = velocity[side];
    after.body[side].spin = spin[side];
    end.energyBefore += kineticEnergy(start.body[side]);
    end.energyAfter += kineticEnergy(after.body[side]);
  }
  const VecOf<D> before = between(start), parting = between(after), centres = ofCentres(after);
  const double speed = -before[0], along = ofCentres(start)[1];
  const auto isZero = [&](double part) { return std::abs(part) < 1e-12 * speed; };
  end.en = parting[0] / speed;
  end.psi = parting[1] / speed;
  if (!isZero(before[1])) end.beta = -parting[1] / before[1];
  end.centrePsi = centres[1] / speed;
  if (!isZero(along)) end.et = centres[1] / along;
  end.reboundAngle = std::atan2(centres[1], centres[0]);
  if constexpr (D == 3) {
    EndOutOfPlane& besides = end.outOfPlane.emplace();
    besides.psi = parting[2] / speed;
    for (const int side : {0, 1}) {
      besides.spinNormal[side] = spin[side].x();
      besides.spinTangent[side] = spin[side].y();
      end.spin[side] = spin[side].z();
    }
  } else {
    for (const int side : {0, 1}) end.spin[side] = spin[side];
  }
  end.convex = {centres[0] / speed, std::max(0.0, end.energyAfter - end.energyBefore)};
  return end;
}

template CornerOf<2> cornerTowards(const ShapeOf<2>&, const TurnOf<2>&, const Vec2&);
template CornerOf<3> cornerTowards(const ShapeOf<3>&, const TurnOf<3>&, const Vec3&);
template ConvexImpactBody<2> impactBody(const DisksOf<2>&, std::size_t, const Vec2&);
template ConvexImpactBody<3> impactBody(const DisksOf<3>&, std::size_t, const Vec3&);
template CollisionEnd convexEnd(const ConvexImpactStart<2>&, const std::array<Vec2, 2>&,
                                const std::array<double, 2>&);
template CollisionEnd convexEnd(const ConvexImpactStart<3>&, const std::array<Vec3, 2>&,
                                const std::array<Vec3, 2>&);

}  // namespace crossgrain::inline oracle

#pragma once

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <functional>

#include "oracle/convex_impact.hpp"

namespace crossgrain::test {

/// How stiff a body is and how small its steps.
struct PenaltySteps {
  double stiffness;  ///< k of loading [N/m]
  int perRadian;     ///< steps in √(m/k), m the mass that the contact feels along the normal
};

/// A body that meets a wall at rest with its one corner, in time: it moves and turns, arm and
/// inertia with it. Its corner is a spring of stiffness k while the overlap grows, k/e² while it
/// falls (Walton and Braun, J. Rheol. 30, 1986), which gives back e² of the work that it took, and
/// Coulomb's friction without any tangential compliance. Störmer–Verlet in half drifts, with the
/// friction of a kick implicit: it ends the slip or opposes the slip that is left.
/// Distance from a rigid impact falls as √(1/k) and as the step, with its square where the slip
/// does not turn.
inline ConvexImpactBody<3> penaltyImpact(const ConvexImpactStart<3>& start,
                                         const PenaltySteps& how) {
  ConvexImpactBody<3> body = start.body[0];
  const Vec3 n = start.normal;
  const auto skew = [](const Vec3& r) {
    return (Eigen::Matrix3d() << 0.0, -r.z(), r.y(), r.z(), 0.0, -r.x(), -r.y(), r.x(), 0.0)
        .finished();
  };
  const Eigen::Matrix3d inverseInertia = body.inverseInertia;
  const Vec3 arm = body.arm;
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  Vec3 moment = inverseInertia.inverse() * body.spin;  // L
  Vec3 moved = Vec3::Zero();

  const auto compliance = [&]() -> Eigen::Matrix3d {
    return Eigen::Matrix3d::Identity() / body.mass -
           skew(body.arm) * body.inverseInertia * skew(body.arm);
  };
  const double step = 1.0 / std::sqrt(how.stiffness * n.dot(compliance() * n)) / how.perRadian;
  const double speed = velocityAtContact(body).norm();
  const auto drift = [&] {
    moved += 0.5 * step * body.velocity;
    // ω of the middle of the drift: L stays.
    const auto turned = [&](double time) -> Eigen::Matrix3d {
      const double angle = time * body.spin.norm();
      if (angle == 0.0) return turn;
      return Eigen::AngleAxisd(angle, body.spin.normalized()).toRotationMatrix() * turn;
    };
    const auto spinAt = [&](const Eigen::Matrix3d& pose) -> Vec3 {
      return pose * inverseInertia * pose.transpose() * moment;
    };
    body.spin = spinAt(turned(0.25 * step));
    turn = turned(0.5 * step);
    body.inverseInertia = turn * inverseInertia * turn.transpose();
    body.spin = body.inverseInertia * moment;
    body.arm = turn * arm;
  };

  // A kick within which the slip stops or reverses is halved.
  const std::function<void(double, int)> kick = [&](double normal, int halvings) {
    const ConvexImpactBody<3> before = body;
    const Vec3 momentBefore = moment;
    const Vec3 s = n.unitOrthogonal(), b = n.cross(s);
    const Eigen::Matrix<double, 3, 2> tangents = (Eigen::Matrix<double, 3, 2>() << s, b).finished();
    const auto slip = [&]() -> Vec2 { return tangents.transpose() * velocityAtContact(body); };
    const Eigen::Matrix3d matrix = compliance();
    const Eigen::Matrix2d a = tangents.transpose() * matrix * tangents;
    const Vec2 had = slip(), free = had + tangents.transpose() * matrix * n * normal;
    Vec2 friction = -a.inverse() * free;
    const double bound = start.mu * normal;
    if (friction.norm() > bound) {
      double low = 0.0, high = free.norm();  // of the slip that is left
      const auto pushFor = [&](double left) -> Vec2 {
        return -bound * ((left * Eigen::Matrix2d::Identity() + bound * a).inverse() * free);
      };
      for (double middle; middle = 0.5 * (low + high), low < middle && middle < high;)
        (pushFor(middle).norm() > bound ? low : high) = middle;
      friction = pushFor(high);
    }
    const Vec3 impulse = normal * n + tangents * friction;
    body.velocity += impulse / body.mass;
    moment += body.arm.cross(impulse);
    body.spin = body.inverseInertia * moment;
    if (halvings == 0 || had.norm() < 1e-12 * speed || slip().dot(had) > 0.5 * had.squaredNorm())
      return;
    body = before;
    moment = momentBefore;
    for (int half = 0; half < 2; ++half) kick(0.5 * normal, halvings - 1);
  };

  const double e2 = start.restitution * start.restitution;
  double deepest = 0.0;
  while (true) {
    drift();
    const double overlap = -n.dot(moved + body.arm - arm);
    deepest = std::max(deepest, overlap);
    const double rest = (1.0 - e2) * deepest;  // overlap at which an unloading spring is slack
    const double force =
        overlap >= deepest ? how.stiffness * overlap : how.stiffness / e2 * (overlap - rest);
    if (!(force > 0.0)) return body;
    kick(force * step, 16);
    drift();
  }
}

}  // namespace crossgrain::test

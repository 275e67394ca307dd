#include "adapters/motion.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace crossgrain {

std::string toString(Motion::Kind kind) {
  return std::string(motionNames[static_cast<std::size_t>(kind)]);
}

template <int D>
BodyStateOf<D> stateAt(const MotionOf<D>& motion, const std::type_identity_t<VecOf<D>>& centre,
                       double t) {
  BodyStateOf<D> now;
  now.centre = centre;
  switch (motion.kind) {
    case Motion::Kind::fixed:
      break;
    case Motion::Kind::rotating:
      now.angle = motion.angularVelocity * t;
      now.angularVelocity = motion.angularVelocity;
      break;
    case Motion::Kind::translating:
      now.centre = centre + motion.velocity * t;
      now.velocity = motion.velocity;
      break;
    case Motion::Kind::oscillating:
      now.centre = centre + motion.amplitude * std::sin(motion.frequency * t);
      now.velocity = motion.amplitude * (motion.frequency * std::cos(motion.frequency * t));
      break;
    case Motion::Kind::radial:
      now.radialShift = motion.radialVelocity * std::min(t, motion.radialEnd);
      now.radialVelocity = t < motion.radialEnd ? motion.radialVelocity : 0.0;
      break;
  }
  return now;
}
template BodyState stateAt<2>(const Motion&, const Vec2&, double);
template BodyStateOf<3> stateAt<3>(const MotionOf<3>&, const Vec3&, double);

template <int D>
VecOf<D> turnedBy(const SpinOf<D>& angle, const VecOf<D>& v) {
  if constexpr (D == 2) {
    const double c = std::cos(angle), s = std::sin(angle);
    return {c * v.x() - s * v.y(), s * v.x() + c * v.y()};
  } else {
    return angle.isZero(0.0) ? v : Eigen::AngleAxisd(angle.norm(), angle.normalized()) * v;
  }
}
template Vec2 turnedBy<2>(const double&, const Vec2&);
template Vec3 turnedBy<3>(const Vec3&, const Vec3&);

template <int D>
VecOf<D> memberPosition(const BodyStateOf<D>& now,
                        const std::type_identity_t<VecOf<D>>& referenceCentre,
                        const std::type_identity_t<VecOf<D>>& reference) {
  const VecOf<D> offset = reference - referenceCentre;
  const double distance = offset.norm();
  const double scale = distance > 0.0 ? 1.0 + now.radialShift / distance : 1.0;
  if constexpr (D == 2) {
    const double c = std::cos(now.angle) * scale;
    const double s = std::sin(now.angle) * scale;
    return now.centre + Vec2(c * offset.x() - s * offset.y(), s * offset.x() + c * offset.y());
  } else {
    return now.centre + scale * turnedBy<3>(now.angle, offset);
  }
}
template Vec2 memberPosition<2>(const BodyState&, const Vec2&, const Vec2&);
template Vec3 memberPosition<3>(const BodyStateOf<3>&, const Vec3&, const Vec3&);

template <int D>
VecOf<D> memberVelocity(const BodyStateOf<D>& now, const std::type_identity_t<VecOf<D>>& position) {
  const VecOf<D> offset = position - now.centre;
  const double distance = offset.norm();
  VecOf<D> velocity = now.velocity;
  if constexpr (D == 2)
    velocity += now.angularVelocity * perpendicular(offset);
  else
    velocity += now.angularVelocity.cross(offset);
  if (distance > 0.0) velocity += offset * (now.radialVelocity / distance);
  return velocity;
}
template Vec2 memberVelocity<2>(const BodyState&, const Vec2&);
template Vec3 memberVelocity<3>(const BodyStateOf<3>&, const Vec3&);

}  // namespace crossgrain

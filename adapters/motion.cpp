#include "adapters/motion.hpp"

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

Vec2 memberPosition(const BodyState& now, const Vec2& referenceCentre, const Vec2& reference) {
  const Vec2 offset = reference - referenceCentre;
  const double distance = offset.norm();
  const double scale = distance > 0.0 ? 1.0 + now.radialShift / distance : 1.0;
  const double c = std::cos(now.angle) * scale;
  const double s = std::sin(now.angle) * scale;
  return now.centre + Vec2(c * offset.x() - s * offset.y(), s * offset.x() + c * offset.y());
}

Vec2 memberVelocity(const BodyState& now, const Vec2& position) {
  const Vec2 offset = position - now.centre;
  const double distance = offset.norm();
  Vec2 velocity = now.velocity + now.angularVelocity * perpendicular(offset);
  if (distance > 0.0) velocity += offset * (now.radialVelocity / distance);
  return velocity;
}

}  // namespace crossgrain

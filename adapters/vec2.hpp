#pragma once

#include <Eigen/Core>

namespace crossgrain {

/// A vector in the plane of motion, laboratory frame, components (x, y).
using Vec2 = Eigen::Vector2d;

/// z × v: v turned by +90° (counter-clockwise).
inline Vec2 perpendicular(const Vec2& v) {
  return {-v.y(), v.x()};
}

/// z component of a × b.
inline double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

}  // namespace crossgrain

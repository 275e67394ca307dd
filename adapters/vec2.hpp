#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <type_traits>

namespace crossgrain {

/// A vector of a model of D dimensions, laboratory frame.
template <int D>
using VecOf = Eigen::Matrix<double, D, 1>;

/// A vector in the plane of motion, laboratory frame, components (x, y).
using Vec2 = VecOf<2>;

/// A vector in space, components (x, y, z).
using Vec3 = VecOf<3>;

/// Angular velocity, angle or torque. In the plane it is about z, one number, counter-clockwise
/// positive; in space a vector along its axis.
template <int D>
using SpinOf = std::conditional_t<D == 2, double, Vec3>;

/// The zero of either.
template <int D>
SpinOf<D> noSpin() {
  if constexpr (D == 2)
    return 0.0;
  else
    return Vec3::Zero();
}

/// z × v: v turned by +90° (counter-clockwise).
inline Vec2 perpendicular(const Vec2& v) {
  return {-v.y(), v.x()};
}

/// z component of a × b.
inline double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// v turned by the smallest rotation that takes one unit vector to another, by Rodrigues' formula.
/// Eigen's Quaternion::FromTwoVectors compiles a whole singular value decomposition for it.
/// @pre from and to are not opposite
inline Vec3 turnedAlong(const Vec3& from, const Vec3& to, const Vec3& v) {
  const Vec3 w = from.cross(to), wv = w.cross(v);
  return v + wv + w.cross(wv) / (1.0 + from.dot(to));
}

}  // namespace crossgrain

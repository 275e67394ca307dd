#pragma once

// Vectors in the plane of motion, or in space (SI units, laboratory frame), in plain C++17. A
// quantity about z, one number in the plane, is a vector along its axis in space.

#include <array>
#include <cmath>
#include <type_traits>
#include <vector>

namespace crossgrain_worker {

template <int D>
struct VectorOf {
  static_assert(D == 2);
  double x = 0.0, y = 0.0;
};
template <>
struct VectorOf<3> {
  double x = 0.0, y = 0.0, z = 0.0;
};
using Vector = VectorOf<2>;
using Vector3 = VectorOf<3>;

/// Angular velocity, angle about a fixed axis, torque.
template <int D>
using SpinOf = std::conditional_t<D == 2, double, Vector3>;

/// Orientation of a convex body: its angle about z, or a unit quaternion w, x, y, z.
template <int D>
using OrientationOf = std::conditional_t<D == 2, double, std::array<double, 4>>;
template <int D>
OrientationOf<D> noTurn() {
  if constexpr (D == 2)
    return 0.0;
  else
    return {1.0, 0.0, 0.0, 0.0};
}

inline Vector operator+(Vector a, Vector b) {
  return {a.x + b.x, a.y + b.y};
}
inline Vector3 operator+(Vector3 a, Vector3 b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Vector operator-(Vector a, Vector b) {
  return {a.x - b.x, a.y - b.y};
}
inline Vector3 operator-(Vector3 a, Vector3 b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Vector operator*(double s, Vector a) {
  return {s * a.x, s * a.y};
}
inline Vector3 operator*(double s, Vector3 a) {
  return {s * a.x, s * a.y, s * a.z};
}
inline double dot(Vector a, Vector b) {
  return a.x * b.x + a.y * b.y;
}
inline double dot(Vector3 a, Vector3 b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline double norm(Vector a) {
  return std::hypot(a.x, a.y);
}
inline double norm(Vector3 a) {
  return std::hypot(a.x, a.y, a.z);
}
inline bool isZero(double a) {
  return a == 0.0;
}
inline bool isZero(Vector a) {
  return a.x == 0.0 && a.y == 0.0;
}
inline bool isZero(Vector3 a) {
  return a.x == 0.0 && a.y == 0.0 && a.z == 0.0;
}
/// z component of a × b.
inline double cross(Vector a, Vector b) {
  return a.x * b.y - a.y * b.x;
}
inline Vector3 cross(Vector3 a, Vector3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline Vector absolute(Vector a) {
  return {std::abs(a.x), std::abs(a.y)};
}
inline Vector3 absolute(Vector3 a) {
  return {std::abs(a.x), std::abs(a.y), std::abs(a.z)};
}
/// z × a: a turned by +90°.
inline Vector turned(Vector a) {
  return {-a.y, a.x};
}
/// ω z × a.
inline Vector cross(double spin, Vector a) {
  return spin * turned(a);
}

/// A turn by an angle [rad].
template <int D>
class TurnOf {
 public:
  explicit TurnOf(double angle) : c_(std::cos(angle)), s_(std::sin(angle)) {}
  Vector operator()(Vector v) const { return {c_ * v.x - s_ * v.y, s_ * v.x + c_ * v.y}; }

 private:
  double c_, s_;
};
/// Rodrigues' formula; the angle is a vector along the axis.
template <>
class TurnOf<3> {
 public:
  explicit TurnOf(Vector3 angle) {
    const double size = norm(angle);
    if (size == 0.0) return;
    axis_ = (1.0 / size) * angle;
    c_ = std::cos(size);
    s_ = std::sin(size);
  }
  Vector3 operator()(Vector3 v) const {
    return c_ * v + s_ * cross(axis_, v) + (1.0 - c_) * dot(axis_, v) * axis_;
  }

 private:
  Vector3 axis_;
  double c_ = 1.0, s_ = 0.0;
};
inline Vector turned(double angle, Vector v) {
  return TurnOf<2>(angle)(v);
}

// Tangential quantities: a number along z × n in the plane, a vector normal to n in space.

template <int D>
using TangentOf = SpinOf<D>;

inline Vector alongTangent(double along, Vector normal) {
  return along * turned(normal);
}
inline Vector3 alongTangent(Vector3 along, Vector3) {
  return along;
}
/// Inverse of alongTangent(), of a vector that is normal to n.
inline double tangentOf(Vector across, Vector normal) {
  return dot(across, turned(normal));
}
inline Vector3 tangentOf(Vector3 across, Vector3) {
  return across;
}
/// A tangential quantity after its normal has turned from n to m by the smallest turn.
inline double carriedAlong(double along, Vector, Vector) {
  return along;
}
inline Vector3 carriedAlong(Vector3 along, Vector3 n, Vector3 m) {
  const Vector3 w = cross(n, m), across = cross(w, along);
  const double share = 1.0 + dot(n, m);  // 0: any turn by 180° is as small
  return share > 0.0 ? along + across + (1.0 / share) * cross(w, across) : along;
}
inline Vector3& operator+=(Vector3& a, Vector3 b) {
  return a = a + b;
}

/// Behind numbers of an array.
inline void append(std::vector<double>& numbers, double x) {
  numbers.push_back(x);
}
inline void append(std::vector<double>& numbers, Vector v) {
  numbers.insert(numbers.end(), {v.x, v.y});
}
inline void append(std::vector<double>& numbers, Vector3 v) {
  numbers.insert(numbers.end(), {v.x, v.y, v.z});
}
inline void append(std::vector<double>& numbers, const std::array<double, 4>& turn) {
  numbers.insert(numbers.end(), turn.begin(), turn.end());
}

}  // namespace crossgrain_worker

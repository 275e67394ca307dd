#pragma once

// Vectors in the plane of motion (SI units, laboratory frame), in plain C++17.

#include <cmath>
#include <vector>

namespace crossgrain_worker {

struct Vector {
  double x = 0.0, y = 0.0;
};
inline Vector operator+(Vector a, Vector b) {
  return {a.x + b.x, a.y + b.y};
}
inline Vector operator-(Vector a, Vector b) {
  return {a.x - b.x, a.y - b.y};
}
inline Vector operator*(double s, Vector a) {
  return {s * a.x, s * a.y};
}
inline double dot(Vector a, Vector b) {
  return a.x * b.x + a.y * b.y;
}
/// z component of a × b.
inline double cross(Vector a, Vector b) {
  return a.x * b.y - a.y * b.x;
}
/// z × a: a turned by +90°.
inline Vector turned(Vector a) {
  return {-a.y, a.x};
}
/// v turned by an angle [rad].
inline Vector turned(double angle, Vector v) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * v.x - s * v.y, s * v.x + c * v.y};
}

/// Behind numbers of an array.
inline void append(std::vector<double>& numbers, Vector v) {
  numbers.insert(numbers.end(), {v.x, v.y});
}

}  // namespace crossgrain_worker

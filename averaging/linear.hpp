#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace crossgrain::inline averaging {

/// A number made from moments that knows how it answers to small changes of them (forward-mode
/// differentiation): a formula written with it is its own linearised error.
struct Linear {
  double value = 0.0;
  /// ∂value/∂moment by index; an index may occur more than once, its entries add up
  std::vector<std::pair<std::size_t, double>> slopes;

  Linear(double number = 0.0) : value(number) {}
};

/// value with the slopes of x times dx.
Linear chained(double value, const Linear& x, double dx);

/// value with the slopes of x times dx and those of y times dy.
Linear chained(double value, const Linear& x, double dx, const Linear& y, double dy);

inline Linear operator+(const Linear& x, const Linear& y) {
  return chained(x.value + y.value, x, 1.0, y, 1.0);
}
inline Linear operator-(const Linear& x, const Linear& y) {
  return chained(x.value - y.value, x, 1.0, y, -1.0);
}
inline Linear operator*(const Linear& x, const Linear& y) {
  return chained(x.value * y.value, x, y.value, y, x.value);
}
inline Linear operator/(const Linear& x, const Linear& y) {
  const double ratio = x.value / y.value;
  return chained(ratio, x, 1.0 / y.value, y, -ratio / y.value);
}
inline Linear operator-(const Linear& x) {
  return chained(-x.value, x, -1.0);
}

/// √(x² + y²). Where it is 0 it has a kink and the slopes are left out.
Linear length(const Linear& x, const Linear& y);

/// Angle of the vector (x, y), in (−π, π]; NaN for the null vector, which has none.
Linear direction(const Linear& x, const Linear& y);

Linear cos(const Linear& x);
Linear sin(const Linear& x);

/// A symmetric or unsymmetric 2 × 2 tensor; the first index is r or φ, then the second.
struct LinearTensor {
  Linear rr, rp, pr, pp;
};

Linear trace(const LinearTensor& t);

/// Of the symmetric part: T_max − T_min, and the angle of the major axis from the first direction,
/// counter-clockwise, in (−π/2, π/2].
Linear deviator(const LinearTensor& t);
Linear axis(const LinearTensor& t);

/// NaN where |det t| ≤ 10⁻¹² (tr t)²: there the tensor has one direction only, up to rounding.
LinearTensor inverse(const LinearTensor& t);
LinearTensor operator*(const LinearTensor& s, const LinearTensor& t);

}  // namespace crossgrain::inline averaging

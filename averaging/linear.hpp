#pragma once

#include <array>
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

/// A tensor of D × D, symmetric or not; indices are the bin's directions.
struct LinearTensor {
  int dimension = 2;
  std::array<Linear, 9> entries;

  Linear& operator()(int row, int column) { return entries[place(row, column)]; }
  const Linear& operator()(int row, int column) const { return entries[place(row, column)]; }

 private:
  static std::size_t place(int row, int column) {
    return static_cast<std::size_t>(3 * row + column);
  }
};

/// The tensor whose entries are value(row, column).
template <typename Value>
LinearTensor tensorOf(int dimension, Value&& value) {
  LinearTensor tensor{dimension, {}};
  for (int row = 0; row < dimension; ++row)
    for (int column = 0; column < dimension; ++column) tensor(row, column) = value(row, column);
  return tensor;
}

Linear trace(const LinearTensor& t);

/// T_max − T_min of the symmetric part.
Linear deviator(const LinearTensor& t);

/// In the plane the angle of the symmetric part's major axis from the first direction,
/// counter-clockwise, in (−π/2, π/2].
Linear axis(const LinearTensor& t);

/// NaN where |det t| ≤ 10⁻¹² |tr t|^D: there the tensor lacks a direction, up to rounding.
LinearTensor inverse(const LinearTensor& t);
LinearTensor operator*(const LinearTensor& s, const LinearTensor& t);
LinearTensor operator+(const LinearTensor& s, const LinearTensor& t);

}  // namespace crossgrain::inline averaging

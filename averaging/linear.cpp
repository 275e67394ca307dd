#include "averaging/linear.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>

#include "adapters/vec2.hpp"

namespace crossgrain::inline averaging {

namespace {

void append(const Linear& x, double factor, Linear& sum) {
  for (const auto& [index, slope] : x.slopes) sum.slopes.emplace_back(index, factor * slope);
}

}  // namespace

Linear chained(double value, const Linear& x, double dx) {
  Linear result(value);
  append(x, dx, result);
  return result;
}

Linear chained(double value, const Linear& x, double dx, const Linear& y, double dy) {
  Linear result(value);
  result.slopes.reserve(x.slopes.size() + y.slopes.size());
  append(x, dx, result);
  append(y, dy, result);
  return result;
}

Linear length(const Linear& x, const Linear& y) {
  const double l = std::hypot(x.value, y.value);
  if (l == 0.0) return 0.0;
  return chained(l, x, x.value / l, y, y.value / l);
}

Linear direction(const Linear& x, const Linear& y) {
  const double square = x.value * x.value + y.value * y.value;
  if (square == 0.0) return std::numeric_limits<double>::quiet_NaN();
  return chained(std::atan2(y.value, x.value), x, -y.value / square, y, x.value / square);
}

Linear cos(const Linear& x) {
  return chained(std::cos(x.value), x, -std::sin(x.value));
}

Linear sin(const Linear& x) {
  return chained(std::sin(x.value), x, std::cos(x.value));
}

Linear trace(const LinearTensor& t) {
  Linear sum = t(0, 0) + t(1, 1);
  return t.dimension == 2 ? sum : sum + t(2, 2);
}

Linear deviator(const LinearTensor& t) {
  if (t.dimension == 2) return length(t(0, 0) - t(1, 1), t(0, 1) + t(1, 0));
  Eigen::Matrix3d symmetric;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      symmetric(row, column) = 0.5 * (t(row, column).value + t(column, row).value);
  if (!symmetric.allFinite()) return std::numeric_limits<double>::quiet_NaN();
  // ∂λ/∂T = e⊗e with the eigenvector e of λ.
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solved(symmetric);
  const Vec3 least = solved.eigenvectors().col(0), most = solved.eigenvectors().col(2);
  Linear result;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      append(t(row, column), most[row] * most[column] - least[row] * least[column], result);
  result.value = solved.eigenvalues()[2] - solved.eigenvalues()[0];
  return result;
}

Linear axis(const LinearTensor& t) {
  return 0.5 * direction(t(0, 0) - t(1, 1), t(0, 1) + t(1, 0));
}

LinearTensor inverse(const LinearTensor& t) {
  const bool plane = t.dimension == 2;
  // Of the matrix without a row and a column; in the plane one entry.
  const auto cofactor = [&](int row, int column) {
    if (plane) return row == column ? t(1 - row, 1 - column) : -t(1 - row, 1 - column);
    const int r1 = (row + 1) % 3, r2 = (row + 2) % 3, c1 = (column + 1) % 3, c2 = (column + 2) % 3;
    return t(r1, c1) * t(r2, c2) - t(r1, c2) * t(r2, c1);
  };
  Linear determinant =
      plane ? t(0, 0) * t(1, 1) - t(0, 1) * t(1, 0)
            : t(0, 0) * cofactor(0, 0) + t(0, 1) * cofactor(0, 1) + t(0, 2) * cofactor(0, 2);
  const double scale = std::pow(std::abs(trace(t).value), t.dimension);
  if (!(std::abs(determinant.value) > 1e-12 * scale))
    determinant = std::numeric_limits<double>::quiet_NaN();
  return tensorOf(t.dimension,
                  [&](int row, int column) { return cofactor(column, row) / determinant; });
}

LinearTensor operator*(const LinearTensor& s, const LinearTensor& t) {
  return tensorOf(s.dimension, [&](int row, int column) {
    Linear sum = s(row, 0) * t(0, column) + s(row, 1) * t(1, column);
    return s.dimension == 2 ? sum : sum + s(row, 2) * t(2, column);
  });
}

LinearTensor operator+(const LinearTensor& s, const LinearTensor& t) {
  return tensorOf(s.dimension,
                  [&](int row, int column) { return s(row, column) + t(row, column); });
}

}  // namespace crossgrain::inline averaging

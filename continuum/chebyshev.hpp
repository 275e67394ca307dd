#pragma once

#include <span>
#include <vector>

namespace crossgrain::inline continuum {

/// Polynomials of one degree on 0 ≤ ξ ≤ 1 by their values at the Chebyshev points
/// ξ_k = (1 − cos(πk/N))/2, k = 0 … N (Trefethen 2000, Spectral Methods in MATLAB, chapter 6).
class ChebyshevGrid {
 public:
  /// @param degree N ≥ 2
  explicit ChebyshevGrid(int degree);

  std::span<const double> points() const { return points_; }  ///< ascending, from 0 to 1
  std::size_t count() const { return points_.size(); }

  /// The polynomial at ξ (barycentric form).
  double at(double xi, std::span<const double> values) const;

 private:
  std::vector<double> points_, weights_;
};

}  // namespace crossgrain::inline continuum

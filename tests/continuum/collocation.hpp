#pragma once

#include <optional>
#include <span>
#include <vector>

#include "continuum/cosserat.hpp"

namespace crossgrain::test {

/// Derivatives of the polynomials on a Chebyshev grid, at its points (Trefethen 2000, chapter 6).
class ChebyshevSlopes {
 public:
  explicit ChebyshevSlopes(const ChebyshevGrid& grid);
  /// What gives the derivative at ξ_k from the values at all points.
  std::span<const double> row(std::size_t k) const {
    return std::span(matrix_).subspan(k * count_, count_);
  }
  std::vector<double> of(std::span<const double> values) const;

 private:
  std::size_t count_;
  std::vector<double> matrix_;
};

/// solveCosserat() by another route: collocation of s, m, u/ω and ln ω at Chebyshev points, from
/// the stresses of a classical continuum (s = q ∝ r⁻²) with Newton's method. Absent where that does
/// not converge.
std::optional<CosseratSolution> solveByCollocation(const CosseratParameters& parameters,
                                                   int degree = 192);

}  // namespace crossgrain::test

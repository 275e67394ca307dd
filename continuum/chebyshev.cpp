#include "continuum/chebyshev.hpp"

#include <cmath>
#include <numbers>
#include <numeric>

namespace crossgrain::inline continuum {

ChebyshevGrid::ChebyshevGrid(int degree) {
  const auto last = static_cast<std::size_t>(degree);
  // sin² keeps the digits of small ξ and of small differences beside 0.
  const auto angle = [&](std::size_t k) {
    return 0.5 * std::numbers::pi * static_cast<double>(k) / degree;
  };
  for (std::size_t k = 0; k <= last; ++k) {
    points_.push_back(std::pow(std::sin(angle(k)), 2));
    weights_.push_back((k % 2 == 0 ? 1.0 : -1.0) * (k == 0 || k == last ? 0.5 : 1.0));
  }
  points_.back() = 1.0;
  matrix_.assign(count() * count(), 0.0);
  for (std::size_t i = 0; i < count(); ++i) {
    double sum = 0.0;
    for (std::size_t j = 0; j < count(); ++j) {
      if (i == j) continue;
      // ξ_i − ξ_j without cancellation.
      const double apart = std::sin(angle(i) + angle(j)) * std::sin(angle(i) - angle(j));
      matrix_[i * count() + j] = weights_[j] / weights_[i] / apart;
      sum += matrix_[i * count() + j];
    }
    matrix_[i * count() + i] = -sum;  // the derivative of a constant is 0, to rounding
  }
}

std::span<const double> ChebyshevGrid::derivativeRow(std::size_t k) const {
  return std::span(matrix_).subspan(k * count(), count());
}

std::vector<double> ChebyshevGrid::derivative(std::span<const double> values) const {
  std::vector<double> result;
  for (std::size_t k = 0; k < count(); ++k) {
    const auto row = derivativeRow(k);
    // Differences: what the values have in common would only bring its rounding.
    double sum = 0.0;
    for (std::size_t j = 0; j < count(); ++j) sum += row[j] * (values[j] - values[k]);
    result.push_back(sum);
  }
  return result;
}

double ChebyshevGrid::at(double xi, std::span<const double> values) const {
  double above = 0.0, below = 0.0;
  for (std::size_t k = 0; k < count(); ++k) {
    if (xi == points_[k]) return values[k];
    const double share = weights_[k] / (xi - points_[k]);
    above += share * values[k];
    below += share;
  }
  return above / below;
}

}  // namespace crossgrain::inline continuum

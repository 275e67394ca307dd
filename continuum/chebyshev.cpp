#include "continuum/chebyshev.hpp"

#include <cmath>
#include <numbers>

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

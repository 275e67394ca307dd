#include "continuum/cosserat.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace crossgrain::inline continuum {
namespace {

void require(bool holds, const char* what, double value) {
  if (!holds) throw std::invalid_argument(fmt::format("Cosserat model: {}, not {}", what, value));
}

}  // namespace

CosseratEquations::CosseratEquations(const CosseratParameters& p) : parameters_(p) {
  constexpr double quarterTurn = std::numbers::pi / 2.0;
  const auto isPositive = [](double x) { return std::isfinite(x) && x > 0.0; };
  require(isPositive(p.innerRadius), "R_i/H must be > 0", p.innerRadius);
  require(isPositive(p.grainSize), "d_p/H must be > 0", p.grainSize);
  require(isPositive(p.lengthScale), "L must be > 0", p.lengthScale);
  require(isPositive(p.wheelVelocity), "u(0) must be > 0", p.wheelVelocity);
  require(p.asymmetry > -1.0 && p.asymmetry < 1.0, "A must lie between -1 and 1", p.asymmetry);
  require(p.internalFriction > 0.0 && p.internalFriction <= quarterTurn,
          "psi must be > 0 and at most a quarter turn", p.internalFriction);
  require(p.wallFriction > 0.0 && p.wallFriction < quarterTurn,
          "delta must be > 0 and less than a quarter turn", p.wallFriction);
  const double root = std::sqrt(2.0 * (p.asymmetry + 1.0));
  sinePsi_ = std::sin(p.internalFriction);
  epsilonAlpha_ = p.grainSize * p.lengthScale / root;
  c_ = p.momentFactor == MomentFactor::printed ? p.grainSize : p.grainSize * p.lengthScale * root;
}

double CosseratEquations::largestShear() const {
  return sinePsi_ * std::sqrt(2.0 / (1.0 - parameters_.asymmetry));
}

double CosseratEquations::rootSquared(ShearState at) const {
  const double A = parameters_.asymmetry;
  const double couple = 2.0 * (A + 1.0) * at.m;
  return (A * A - 1.0) * at.s * at.s - couple * couple + 2.0 * (A + 1.0) * sinePsi_ * sinePsi_;
}

double CosseratEquations::outerCouple(double s) const {
  return std::sqrt((sinePsi_ * sinePsi_ - s * s) / (2.0 * (parameters_.asymmetry + 1.0)));
}

ShearState CosseratEquations::rates(double xi, ShearState at, double root) const {
  const double r = radius(xi);
  const double other = q(at, root);
  return {-(at.s + other) / r, (at.s - other) / c_ - at.m / r};
}

CosseratEquations::FlowRule CosseratEquations::flowRule(ShearState at, double root) const {
  const double onePlusA = parameters_.asymmetry + 1.0;
  return {onePlusA * (at.s + q(at, root)) / root, 2.0 * onePlusA * at.m / (root * epsilonAlpha_)};
}

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

CosseratSolution::CosseratSolution(CosseratEquations equations, ChebyshevGrid grid, Values values)
    : equations_(std::move(equations)), grid_(std::move(grid)), values_(std::move(values)) {}

CosseratPoint CosseratSolution::at(double xi) const {
  const ShearState state{grid_.at(xi, values_.s), grid_.at(xi, values_.m)};
  const double root = std::sqrt(std::max(0.0, equations_.rootSquared(state)));
  const double omega = std::exp(grid_.at(xi, values_.logOmega));
  return {xi,   state.s, equations_.q(state, root), state.m, omega * grid_.at(xi, values_.ratio),
          omega};
}

double CosseratSolution::spinRatio() const {
  return 1.0 / values_.ratio.front();
}

}  // namespace crossgrain::inline continuum

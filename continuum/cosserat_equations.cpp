#include "continuum/cosserat_equations.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace crossgrain::inline continuum {
namespace {

void require(bool holds, const char* what, double value) {
  if (!holds) throw std::invalid_argument(fmt::format("Cosserat model: {}, not {}", what, value));
}

}  // namespace

CosseratEquations::CosseratEquations(const CosseratParameters& p, CosseratSource source)
    : parameters_(p), source_(std::move(source)) {
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
  const auto source = sourceAt(xi);
  return {-(at.s + other) / r + source[0], (at.s - other) / c_ - at.m / r + source[1]};
}

CosseratEquations::FlowRule CosseratEquations::flowRule(double xi, ShearState at,
                                                        double root) const {
  const double onePlusA = parameters_.asymmetry + 1.0;
  const auto source = sourceAt(xi);
  return {onePlusA * (at.s + q(at, root)) / root, 2.0 * onePlusA * at.m / (root * epsilonAlpha_),
          source[2], source[3]};
}

double CosseratEquations::FlowRule::logarithmicRate(double v, double radius) const {
  return -turn * (1.0 + v / radius) + pushOmega;
}

double CosseratEquations::FlowRule::ratioRate(double v, double radius) const {
  return v / radius - shear * (1.0 + v / radius) + pushU - v * logarithmicRate(v, radius);
}

std::array<double, 4> CosseratEquations::sourceAt(double xi) const {
  return source_ ? source_(xi) : std::array<double, 4>{};
}

}  // namespace crossgrain::inline continuum

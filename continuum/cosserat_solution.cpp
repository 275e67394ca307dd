#include "continuum/cosserat_solution.hpp"

#include <algorithm>
#include <cmath>

namespace crossgrain::inline continuum {
namespace {

/// |sum of terms| over the sum of their sizes.
double imbalance(std::initializer_list<double> terms) {
  double sum = 0.0, size = 0.0;
  for (const double term : terms) {
    sum += term;
    size += std::abs(term);
  }
  return size > 0.0 ? std::abs(sum) / size : 0.0;
}

}  // namespace

double CosseratResiduals::largest() const {
  return std::max({yield, flow, rotation, momentum, moment, wheel, outer});
}

CosseratSolution::CosseratSolution(CosseratEquations equations, ChebyshevGrid grid, Values values)
    : equations_(std::move(equations)), grid_(std::move(grid)), values_(std::move(values)) {}

CosseratPoint CosseratSolution::at(double xi) const {
  const ShearState state{grid_.at(xi, values_.s), grid_.at(xi, values_.m)};
  CosseratPoint point;
  point.xi = xi;
  point.s = state.s;
  point.m = state.m;
  point.root = std::sqrt(std::max(0.0, equations_.rootSquared(state)));
  point.q = equations_.q(state, point.root);
  point.omega = std::exp(grid_.at(xi, values_.logOmega));
  point.u = point.omega * grid_.at(xi, values_.ratio);
  point.multiplier = 2.0 * (parameters().asymmetry + 1.0) * equations_.sineOfFriction() *
                     (point.omega + point.u / equations_.radius(xi)) / point.root;
  return point;
}

double CosseratSolution::spinRatio() const {
  return 1.0 / values_.ratio.front();
}

double CosseratSolution::smallestRoot() const {
  double smallest = at(0.0).root;
  for (const double xi : grid_.points()) smallest = std::min(smallest, at(xi).root);
  return smallest;
}

double CosseratSolution::leastMultiplier() const {
  double least = at(0.0).multiplier;
  for (const double xi : grid_.points()) least = std::min(least, at(xi).multiplier);
  return least;
}

double CosseratSolution::torque(double xi) const {
  const CosseratPoint point = at(xi);
  const double r = equations_.radius(xi);
  return r * (r * point.s - equations_.momentFactor() * point.m);
}

CosseratResiduals CosseratSolution::residuals() const {
  const auto ds = grid_.derivative(values_.s), dm = grid_.derivative(values_.m);
  const auto dRatio = grid_.derivative(values_.ratio), dLog = grid_.derivative(values_.logOmega);
  const double A = parameters().asymmetry, c = equations_.momentFactor();
  const double sine = equations_.sineOfFriction();

  CosseratResiduals most;
  const auto raise = [](double& largest, double value) { largest = std::max(largest, value); };
  // Twice as fine: every second point is one of the grid.
  const ChebyshevGrid finer(2 * static_cast<int>(grid_.count() - 1));
  for (const double xi : finer.points()) {
    const CosseratPoint p = at(xi);
    const double r = equations_.radius(xi);
    const ShearState state{p.s, p.m};
    // Sources, too, are what the equations say they are.
    const auto bare = CosseratEquations(parameters()).rates(xi, state, p.root);
    const auto with = equations_.rates(xi, state, p.root);
    const auto rule = equations_.flowRule(xi, state, p.root);
    const double v = p.u / p.omega;
    const double omegaRate = grid_.at(xi, dLog);
    const double uRate = grid_.at(xi, dRatio) + v * omegaRate;  // in units of ω

    const double couple = 2.0 * (A + 1.0) * p.m;
    raise(most.yield, imbalance({p.s * p.s, p.q * p.q, 2.0 * A * p.s * p.q, couple * couple,
                                 -2.0 * (A + 1.0) * sine * sine}));
    raise(most.momentum, imbalance({grid_.at(xi, ds), p.s / r, p.q / r, bare.s - with.s}));
    raise(most.moment,
          imbalance({c * grid_.at(xi, dm), c * p.m / r, -p.s, p.q, c * (bare.m - with.m)}));
    raise(most.flow, imbalance({uRate, -v / r, rule.shear, rule.shear * v / r, -rule.pushU}));
    raise(most.rotation, imbalance({omegaRate, rule.turn, rule.turn * v / r, -rule.pushOmega}));
  }
  const CosseratPoint wheel = at(0.0), outer = at(1.0);
  most.wheel = std::max(imbalance({wheel.s, -std::tan(parameters().wallFriction)}),
                        imbalance({wheel.u, -parameters().wheelVelocity}));
  most.outer = std::max(imbalance({outer.s, -outer.q}), std::abs(outer.u / outer.omega));
  return most;
}

}  // namespace crossgrain::inline continuum

// A solution that is prescribed, with the sources that make it one. They are worked out from
// the equations as Lätzel 2003 prints them, not from the code that is tested.

#include <gtest/gtest.h>

#include "tests/continuum/differences.hpp"

namespace crossgrain {
namespace {

/// Smooth, and within the yield surface: s and ω fall outward, m rises, u(1) = 0.
struct Prescribed {
  CosseratParameters p;

  struct Value {
    double value, slope;
  };
  Value s(double xi) const {
    const double value = std::tan(p.wallFriction) * std::exp(-1.5 * xi);
    return {value, -1.5 * value};
  }
  Value m(double xi) const {
    const double outer = s(1.0).value, sine = std::sin(p.internalFriction);
    const double atRing = std::sqrt((sine * sine - outer * outer) / (2.0 * (p.asymmetry + 1.0)));
    return {atRing * (1.0 - 0.1 * (1.0 - xi) * (1.0 - xi)), 0.2 * atRing * (1.0 - xi)};
  }
  Value omega(double xi) const {
    const double value = 5.0 * p.wheelVelocity * std::exp(-6.0 * xi);
    return {value, -6.0 * value};
  }
  Value u(double xi) const {
    const double share = 0.2 * (1.0 - xi) * (1.0 + 0.5 * xi);
    const double slope = 0.2 * (-0.5 - xi);
    const Value w = omega(xi);
    return {share * w.value, slope * w.value + share * w.slope};
  }

  std::array<double, 4> source(double xi) const {
    const double A = p.asymmetry, r = p.innerRadius + xi;
    const double root = std::sqrt((A * A - 1.0) * s(xi).value * s(xi).value -
                                  4.0 * (A + 1.0) * (A + 1.0) * m(xi).value * m(xi).value +
                                  2.0 * (A + 1.0) * std::pow(std::sin(p.internalFriction), 2));
    const double q = -A * s(xi).value + root;
    const double alpha = p.lengthScale / std::sqrt(2.0 * (A + 1.0));
    const double excess = omega(xi).value + u(xi).value / r;
    return {
        s(xi).slope + (s(xi).value + q) / r,
        m(xi).slope + m(xi).value / r - (s(xi).value - q) / p.grainSize,
        (u(xi).slope - u(xi).value / r + excess * (A + 1.0) * (s(xi).value + q) / root) /
            omega(xi).value,
        (omega(xi).slope + excess * 2.0 * (A + 1.0) * m(xi).value / root / (p.grainSize * alpha)) /
            omega(xi).value};
  }
};

using Solver = CosseratOutcome (*)(const CosseratParameters&, const CosseratNumerics&,
                                   const CosseratSource&);

class Manufactured : public testing::TestWithParam<Solver> {};

TEST_P(Manufactured, SolutionComesBack) {
  Prescribed prescribed;
  prescribed.p.wheelVelocity = 0.7;
  CosseratNumerics numerics;
  numerics.degree = 48;  // its exponentials are smooth: no layer
  const CosseratOutcome outcome =
      GetParam()(prescribed.p, numerics, [&](double xi) { return prescribed.source(xi); });
  ASSERT_TRUE(outcome.solution) << outcome.reason;
  for (int k = 0; k <= 20; ++k) {
    const double xi = 0.05 * k;
    const CosseratPoint point = outcome.solution->at(xi);
    // Far above rounding and the integrator's 1e-12 a step, far below any term of the equations.
    EXPECT_NEAR(prescribed.s(xi).value, point.s, 1e-10) << "xi " << xi;
    EXPECT_NEAR(prescribed.m(xi).value, point.m, 1e-10) << "xi " << xi;
    const double omega = prescribed.omega(xi).value;
    EXPECT_NEAR(omega, point.omega, 1e-9 * omega) << "xi " << xi;
    EXPECT_NEAR(prescribed.u(xi).value, point.u, 1e-9 * omega) << "xi " << xi;
  }
  EXPECT_LT(outcome.solution->residuals().largest(), 1e-8);
}

INSTANTIATE_TEST_SUITE_P(Routes, Manufactured,
                         testing::Values(&solveByShooting, &solveByCollocation),
                         [](const auto& route) {
                           return route.param == &solveByShooting ? "shooting" : "collocation";
                         });

}  // namespace
}  // namespace crossgrain

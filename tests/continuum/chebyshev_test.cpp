#include "continuum/chebyshev.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace crossgrain {
namespace {

std::vector<double> valuesOf(const ChebyshevGrid& grid, double (*f)(double)) {
  std::vector<double> values;
  for (const double xi : grid.points()) values.push_back(f(xi));
  return values;
}

TEST(Chebyshev, PointsOfDegreeFour) {
  const ChebyshevGrid grid(4);
  const double inner = 0.5 * (1.0 - std::sqrt(0.5));  // (1 − cos(π/4))/2
  const std::vector<double> expected = {0.0, inner, 0.5, 1.0 - inner, 1.0};
  ASSERT_EQ(expected.size(), grid.count());
  for (std::size_t k = 0; k < expected.size(); ++k)
    EXPECT_NEAR(expected[k], grid.points()[k], 1e-15);
}

TEST(Chebyshev, CubicsAreExact) {
  const ChebyshevGrid grid(3);
  const auto cubic = valuesOf(grid, [](double x) { return 2.0 + x * (3.0 - x * (1.0 + 4.0 * x)); });
  const auto slope = grid.derivative(cubic);
  for (const double xi : {0.0, 0.1, 0.25, 0.7, 1.0}) {
    EXPECT_NEAR(2.0 + xi * (3.0 - xi * (1.0 + 4.0 * xi)), grid.at(xi, cubic), 1e-14);
    EXPECT_NEAR(3.0 - 2.0 * xi - 12.0 * xi * xi, grid.at(xi, slope), 1e-13);
  }
}

TEST(Chebyshev, SmoothFunctionsConvergeFasterThanAnyPower) {
  const auto error = [](int degree) {
    const ChebyshevGrid grid(degree);
    const auto slope = grid.derivative(valuesOf(grid, [](double x) { return std::exp(5.0 * x); }));
    return std::abs(grid.at(0.3, slope) / (5.0 * std::exp(1.5)) - 1.0);
  };
  // Doubling the degree gains 2^p with a method of order p; here ever more, down to rounding.
  EXPECT_LT(error(8), 1e-2);
  EXPECT_LT(error(16), 1e-4 * error(8));
  EXPECT_LT(error(32), 1e-11);  // degree² times rounding
}

}  // namespace
}  // namespace crossgrain

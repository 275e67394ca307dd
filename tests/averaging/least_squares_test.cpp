// A straight line through three points, whose errors are those of every textbook.
#include "averaging/least_squares.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace crossgrain;

/// y = 1 + 2 x but for ± 1 that a line cannot follow: χ² is what the line through the means leaves.
const WeightedPoints points{{0.0, 1.0, 2.0}, {2.0, 1.0, 6.0}, {1.0, 1.0, 1.0}, false};
// x̄ = 1, ȳ = 3, Σ (x − x̄)² = 2, Σ (x − x̄)(y − ȳ) = 4: the line is 1 + 2 x, what is left 1, −2, 1.

/// GSL takes derivatives as differences over √ε = 1.5e-8.
constexpr double close = 1e-7;

TEST(LeastSquares, OfALineHasItsTwoParametersAndTheirErrors) {
  const NonlinearSolution line =
      solveNonlinear(points, [](const auto& p, double x) { return p[0] + p[1] * x; }, {0.5, 1.0});
  EXPECT_EQ(line.reason, "");
  ASSERT_EQ(line.parameters.size(), 2u);
  EXPECT_NEAR(line.parameters[0], 1.0, close);
  EXPECT_NEAR(line.parameters[1], 2.0, close);
  ASSERT_EQ(line.standardErrors.size(), 2u);
  EXPECT_NEAR(line.standardErrors[0], std::sqrt(1.0 / 3.0 + 1.0 / 2.0), close);
  EXPECT_NEAR(line.standardErrors[1], std::sqrt(1.0 / 2.0), close);
  ASSERT_EQ(line.correlationWithLast.size(), 2u);
  EXPECT_NEAR(line.correlationWithLast[0], -0.5 / std::sqrt(5.0 / 6.0 * 0.5), close);
  EXPECT_NEAR(line.correlationWithLast[1], 1.0, 1e-12);
  EXPECT_NEAR(line.chi2, 6.0, close);
}

TEST(LeastSquares, LinearOnesAreTheSame) {
  const auto line = solveLinear(
      points,
      [](double x) {
        return std::vector{1.0, x};
      },
      2);
  ASSERT_TRUE(line);
  ASSERT_EQ(line->coefficients.size(), 2u);
  EXPECT_NEAR(line->coefficients[0], 1.0, 1e-14);
  EXPECT_NEAR(line->coefficients[1], 2.0, 1e-14);
  EXPECT_NEAR(line->chi2, 6.0, 1e-13);
  EXPECT_FALSE(solveLinear(
      points,
      [](double) {
        return std::vector{1.0, 1.0};
      },
      2));
}

}  // namespace

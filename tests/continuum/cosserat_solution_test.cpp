// Mohan's model with the thesis' parameters: by two routes, held against reference values, against
// its equations and against what they keep constant.

#include "continuum/cosserat_solution.hpp"

#include <gtest/gtest.h>

#include "tests/continuum/differences.hpp"

namespace crossgrain {
namespace {

const CosseratSolution& byShooting() {
  static const CosseratOutcome outcome = solveByShooting({});
  return outcome.solution.value();
}

const CosseratSolution& byCollocation() {
  static const CosseratOutcome outcome = solveByCollocation({});
  return outcome.solution.value();
}

CosseratOutcome collocated(int degree) {
  CosseratNumerics numerics;
  numerics.degree = degree;
  return solveByCollocation({}, numerics);
}

/// Computed by a third program before this one was written: half a unit of their last digit.
TEST(Cosserat, ReferenceValues) {
  for (const CosseratSolution* solution : {&byShooting(), &byCollocation()}) {
    const CosseratPoint wheel = solution->at(0.0), outer = solution->at(1.0);
    EXPECT_NEAR(0.03353, outer.s, 0.5e-5);
    EXPECT_NEAR(0.14957, wheel.q, 0.5e-5);
    EXPECT_NEAR(0.21358, wheel.m, 0.5e-5);
    EXPECT_NEAR(0.23443, outer.m, 0.5e-5);
    EXPECT_NEAR(5.453, solution->spinRatio(), 0.5e-3);
    EXPECT_NEAR(0.2443, solution->at(0.1).u, 0.5e-4);
    EXPECT_NEAR(0.04563, solution->at(0.2).u, 0.5e-5);
    EXPECT_NEAR(6.293e-3, solution->at(0.3).u, 0.5e-6);
    EXPECT_NEAR(4.19e-5, solution->at(0.5).u, 0.5e-7);
  }
}

/// Measured 4e-12 and 2e-10: what polynomials of degree 192 leave of the layer beside ξ = 1.
TEST(Cosserat, BothRoutesMeet) {
  const auto apart = test::differences(byShooting(), byCollocation());
  EXPECT_LT(apart.stress, 1e-10);
  EXPECT_LT(apart.flow, 1e-8);
}

TEST(Cosserat, CollocationConvergesFasterThanAnyPower) {
  // Against the other route, which does not know the degree. With order p a doubling gains 2^p;
  // measured 140 and 300 for the stresses.
  const auto error = [](int degree) {
    return test::differences(collocated(degree).solution.value(), byShooting()).stress;
  };
  const double coarse = error(32), middle = error(64), fine = error(128);
  EXPECT_LT(coarse, 1e-2);
  EXPECT_LT(middle, coarse / 50.0);
  EXPECT_LT(fine, middle / 100.0);
}

TEST(Cosserat, ShootingFollowsItsTolerance) {
  // Of the values at the wheel, which are the end of the integration; the tolerance is one step's.
  double before = 1.0;
  for (const double tolerance : {1e-5, 1e-7, 1e-9}) {
    CosseratNumerics numerics;
    numerics.tolerance = tolerance;
    const CosseratOutcome outcome = solveByShooting({}, numerics);
    const double error = std::abs(outcome.solution->spinRatio() / byShooting().spinRatio() - 1.0);
    EXPECT_LT(error, 1e2 * tolerance);  // some hundred steps
    EXPECT_LT(error, before);
    before = error;
  }
}

TEST(Cosserat, EquationsHold) {
  for (const CosseratSolution* solution : {&byShooting(), &byCollocation()}) {
    const CosseratResiduals residuals = solution->residuals();
    EXPECT_LT(residuals.yield, 1e-14);  // rounding: q is made from it
    // Measured 4e-9 and 3e-7 in the layer beside ξ = 1, where one point is left to the polynomials.
    EXPECT_LT(residuals.largest(), 1e-6);
    EXPECT_LT(residuals.wheel, 1e-12);
    EXPECT_LT(residuals.outer, 1e-12);
  }
}

/// One wrong number shows in the residuals of the equations that it occurs in.
TEST(Cosserat, ResidualsSeeWhatIsWrong) {
  const ChebyshevGrid& grid = byShooting().grid();
  const auto residualsWith = [&](double addToM, double addToLogOmega) {
    CosseratSolution::Values values;
    for (const double xi : grid.points()) {
      const CosseratPoint p = byShooting().at(xi);
      values.s.push_back(p.s);
      values.m.push_back(p.m + addToM * xi);
      values.ratio.push_back(p.u / p.omega);
      values.logOmega.push_back(std::log(p.omega) + addToLogOmega * xi);
    }
    return CosseratSolution(CosseratEquations{CosseratParameters{}}, grid, values).residuals();
  };
  EXPECT_LT(residualsWith(0.0, 0.0).largest(), 1e-6);
  EXPECT_GT(residualsWith(-1e-4, 0.0).moment, 1e-3);
  EXPECT_GT(residualsWith(0.0, 0.1).rotation, 1e-3);
  EXPECT_LT(residualsWith(0.0, 0.1).moment, 1e-6);
}

TEST(Cosserat, EveryCylinderCarriesOneTorque) {
  const double atWheel = byShooting().torque(0.0);
  for (int k = 0; k <= 20; ++k)
    EXPECT_NEAR(atWheel, byShooting().torque(0.05 * k), 1e-12) << "xi " << 0.05 * k;
}

TEST(Cosserat, FrictionTakesWorkEverywhere) {
  EXPECT_GT(byShooting().smallestRoot(), 0.0);
  EXPECT_GT(byShooting().leastMultiplier(), 0.0);
  for (int k = 0; k < 20; ++k) {
    const CosseratPoint here = byShooting().at(0.05 * k), further = byShooting().at(0.05 * (k + 1));
    EXPECT_GT(here.u, further.u);
    EXPECT_GT(here.omega, further.omega);
    // The thesis' Fig. 9.4a. Beside the ring, where s = q is asked for, m falls by 1e-4 again.
    if (further.xi < 0.97) {
      EXPECT_LT(here.m, further.m);
    }
  }
}

TEST(Cosserat, VelocityAtTheWheelIsAScale) {
  CosseratParameters p;
  p.wheelVelocity = 0.4;
  const CosseratSolution slower = solveByShooting(p).solution.value();
  EXPECT_NEAR(0.4, slower.at(0.0).u, 1e-12);
  EXPECT_NEAR(0.4 * byShooting().at(0.3).omega, slower.at(0.3).omega,
              1e-10 * byShooting().at(0.3).omega);
}

}  // namespace
}  // namespace crossgrain

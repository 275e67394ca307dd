#include "continuum/cosserat_equations.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace crossgrain {
namespace {

TEST(CosseratEquations, RootMeetsTheYieldCondition) {
  const CosseratEquations equations{CosseratParameters{}};
  const ShearState at{0.12, 0.2};
  const double root = std::sqrt(equations.rootSquared(at));
  const double q = equations.q(at, root);
  // 9.19 with A = 1/3: s² + q² + 2/3 s q + 4·(4/3)² m² = 2·(4/3) sin²ψ.
  EXPECT_NEAR(8.0 / 3.0 * std::pow(std::sin(radians(22.6)), 2),
              0.0144 + q * q + 2.0 / 3.0 * 0.12 * q + 64.0 / 9.0 * 0.04, 1e-15);
}

TEST(CosseratEquations, ByHandAtOnePoint) {
  CosseratParameters p;
  p.innerRadius = 0.5;
  p.grainSize = 0.1;
  p.asymmetry = 0.5;  // √(2(A+1)) = √3
  const CosseratEquations printed(p);
  // s = 0.2, R = 0.4: q = 0.4 − 0.5·0.2 = 0.3; r̄ = 1 at ξ = 0.5.
  const ShearState rates = printed.rates(0.5, {0.2, 0.1}, 0.4);
  EXPECT_NEAR(-0.5, rates.s, 1e-15);              // −(0.2 + 0.3)/1
  EXPECT_NEAR(-0.1 / 0.1 - 0.1, rates.m, 1e-15);  // (0.2 − 0.3)/ε − m/r̄
  const auto rule = printed.flowRule(0.5, {0.2, 0.1}, 0.4);
  EXPECT_NEAR(1.5 * 0.5 / 0.4, rule.shear, 1e-15);  // (A+1)(s+q)/R
  // 2(A+1)m/(R ε α), ε α = 0.1·10/√3
  EXPECT_NEAR(3.0 * 0.1 / 0.4 * std::sqrt(3.0), rule.turn, 1e-14);

  p.momentFactor = MomentFactor::consistent;
  EXPECT_NEAR(0.1 * 10.0 * std::sqrt(3.0), CosseratEquations(p).momentFactor(), 1e-15);
}

TEST(CosseratEquations, OuterStressIsSymmetric) {
  const CosseratEquations equations{CosseratParameters{}};
  const ShearState outer{0.05, equations.outerCouple(0.05)};
  EXPECT_NEAR(0.05, equations.q(outer, std::sqrt(equations.rootSquared(outer))), 1e-15);
}

TEST(CosseratEquations, RigidRotationStays) {
  // u = −ω r̄ with ω the same everywhere: u′/ω = −1 and ω′ = 0, at any stress.
  const CosseratEquations equations{CosseratParameters{}};
  const auto rule = equations.flowRule(0.3, {0.1, 0.2}, 0.15);
  const double r = equations.radius(0.3);
  EXPECT_NEAR(-1.0, rule.ratioRate(-r, r), 1e-15);
  EXPECT_NEAR(0.0, rule.logarithmicRate(-r, r), 1e-15);
}

TEST(CosseratEquations, DoNotKnowTheSignOfAllStresses) {
  const CosseratEquations equations{CosseratParameters{}};
  const ShearState at{0.11, 0.21}, reversed{-0.11, -0.21};
  const double root = std::sqrt(equations.rootSquared(at));
  EXPECT_DOUBLE_EQ(equations.rootSquared(at), equations.rootSquared(reversed));
  EXPECT_DOUBLE_EQ(equations.q(at, root), -equations.q(reversed, -root));
  const ShearState rates = equations.rates(0.2, at, root);
  const ShearState reversedRates = equations.rates(0.2, reversed, -root);
  EXPECT_DOUBLE_EQ(rates.s, -reversedRates.s);
  EXPECT_DOUBLE_EQ(rates.m, -reversedRates.m);
  const auto rule = equations.flowRule(0.2, at, root);
  const auto reversedRule = equations.flowRule(0.2, reversed, -root);
  EXPECT_DOUBLE_EQ(rule.shear, reversedRule.shear);
  EXPECT_DOUBLE_EQ(rule.turn, reversedRule.turn);
}

TEST(CosseratEquations, RefuseParametersOutOfRange) {
  const auto with = [](double CosseratParameters::*parameter, double value) {
    CosseratParameters p;
    p.*parameter = value;
    return p;
  };
  for (const CosseratParameters& bad :
       {with(&CosseratParameters::innerRadius, 0.0), with(&CosseratParameters::grainSize, -0.1),
        with(&CosseratParameters::lengthScale, std::nan("")),
        with(&CosseratParameters::asymmetry, 1.0), with(&CosseratParameters::internalFriction, 0.0),
        with(&CosseratParameters::internalFriction, radians(91.0)),
        with(&CosseratParameters::wallFriction, radians(90.0)),
        with(&CosseratParameters::wheelVelocity, 0.0)})
    EXPECT_THROW(CosseratEquations{bad}, std::invalid_argument);
}

}  // namespace
}  // namespace crossgrain

#include "continuum/cell_scale.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace crossgrain {
namespace {

constexpr double sigmaC = 40.0;

CellScale thesisCell() {
  CellScale cell;
  cell.omega = 0.1;
  return cell;
}

/// A δ at which both moment factors have a solution.
CosseratSolution solved(MomentFactor factor) {
  CosseratParameters p = parametersOf(thesisCell());
  p.momentFactor = factor;
  p.wallFriction = radians(20.0);
  p.wheelVelocity = 0.4;
  return solveByShooting(p).solution.value();
}

RingStress ringAt(double radius, const CosseratSolution& solution) {
  const ModelFields fields = fieldsIn(thesisCell(), solution, sigmaC, std::vector{radius});
  // Normal stresses of which σ_c is the mean.
  return {radius,
          sigmaC - 1.0,
          sigmaC + 1.0,
          fields.stressRp.front(),
          fields.stressPr.front(),
          fields.coupleZr.front()};
}

TEST(CellScale, ThesisCellHasTheModelsLengths) {
  const CosseratParameters p = parametersOf(thesisCell());
  EXPECT_NEAR(CosseratParameters{}.innerRadius, p.innerRadius, 1e-4);  // printed with four digits
  EXPECT_NEAR(CosseratParameters{}.grainSize, p.grainSize, 1e-4);
}

TEST(CellScale, FieldsByHand) {
  const CosseratSolution solution = solved(MomentFactor::printed);
  const CosseratPoint wheel = solution.at(0.0);
  const ModelFields fields =
      fieldsIn(thesisCell(), solution, sigmaC, std::vector{0.1032, 0.1032 + 0.1492});
  EXPECT_NEAR(0.4, fields.velocity[0], 1e-12);
  EXPECT_NEAR(0.0, fields.velocity[1], 1e-12);
  // ΩR_i = 0.01032 m/s over H; the grains roll backwards on the wheel.
  EXPECT_NEAR(-wheel.omega * 0.01032 / 0.1492, fields.spin[0], 1e-12);
  EXPECT_NEAR(std::tan(radians(20.0)) * sigmaC, fields.stressPr[0], 1e-9);
  EXPECT_NEAR(wheel.q * sigmaC, fields.stressRp[0], 1e-9);
  // d_p L √(8/3) = 0.1306 m
  EXPECT_NEAR(-wheel.m * 0.08 * std::sqrt(8.0 / 3.0) * sigmaC, fields.coupleZr[0], 1e-9);
  EXPECT_NEAR(fields.stressPr[1], fields.stressRp[1], 1e-9);
  EXPECT_THROW(fieldsIn(thesisCell(), solution, sigmaC, std::vector{0.1}), std::invalid_argument);
}

/// r(r σ_φr + M_zr), which averages keep without bottom friction, holds for the model's fields,
/// too, if its moment factor is the one that belongs to its m.
TEST(CellScale, ConsistentFactorKeepsTheTorqueOfAverages) {
  const auto torque = [](const CosseratSolution& solution, double r) {
    const RingStress ring = ringAt(r, solution);
    return r * (r * ring.pr + ring.coupleZr);
  };
  const CosseratSolution consistent = solved(MomentFactor::consistent);
  EXPECT_NEAR(torque(consistent, 0.1032), torque(consistent, 0.2), 1e-9);
  const CosseratSolution printed = solved(MomentFactor::printed);
  EXPECT_GT(std::abs(torque(printed, 0.1032) - torque(printed, 0.2)), 0.1);
}

TEST(CellScale, FrictionsComeBackFromTheModelsStresses) {
  for (const double radius : {0.1032, 0.107, 0.12}) {
    const auto fitted = frictionOf(ringAt(radius, solved(MomentFactor::consistent)), thesisCell());
    ASSERT_TRUE(fitted);
    EXPECT_NEAR(sigmaC, fitted->sigmaC, 1e-12);
    EXPECT_NEAR(radians(22.6), fitted->internalFriction, 1e-10);
    if (radius == 0.1032) {
      EXPECT_NEAR(radians(20.0), fitted->wallFriction, 1e-10);
    }
  }
}

TEST(CellScale, FrictionOfARingWithoutCouplesByHand) {
  // s = 0.3 at 1.1 R_i: 0.3·1.21 at the wheel. q = s: sin ψ = s.
  RingStress ring{1.1 * 0.1032, 10.0, 10.0, 3.0, 3.0, 0.0};
  const auto fitted = frictionOf(ring, thesisCell());
  ASSERT_TRUE(fitted);
  EXPECT_NEAR(std::asin(0.3), fitted->internalFriction, 1e-14);
  EXPECT_NEAR(std::atan(0.363), fitted->wallFriction, 1e-14);
  // Friction opposes a wheel that turns with Ω > 0 by σ_φr > 0; without pressure there is none.
  ring.pr = -3.0;
  EXPECT_FALSE(frictionOf(ring, thesisCell()));
  ring = {0.11, 0.0, 0.0, 3.0, 3.0, 0.0};
  EXPECT_FALSE(frictionOf(ring, thesisCell()));
}

}  // namespace
}  // namespace crossgrain

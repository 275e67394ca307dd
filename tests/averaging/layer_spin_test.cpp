#include "averaging/layer_spin.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/averaging/scenes.hpp"

namespace crossgrain {
namespace {

using std::numbers::pi;

TEST(LayerSpin, ThreeRingsToADiameterAndByHand) {
  test::Instant instant;
  // Rings 1 … 4 with d = 1.5: six rings of 0.5. One disk inside ring 0, one inside ring 2.
  instant.addDisk({1.25, 0.0}, 0.1, 1.0, Vec2::Zero(), -3.0);
  instant.addDisk({0.0, 2.25}, 0.1, 1.0, Vec2::Zero(), 2.0);
  LayerSpin spin(Rings(1.0, 4.0, 2, 1.0, 1.5), instant.scene);
  EXPECT_TRUE(spin.points(1.0).empty());
  spin.add(instant.snapshot);
  const auto points = spin.points(10.0);
  ASSERT_EQ(points.size(), 2u);
  EXPECT_NEAR(points[0].x, 0.25 / 1.5, 1e-12);
  EXPECT_NEAR(points[0].y, -30.0, 1e-12);
  EXPECT_NEAR(points[1].x, 1.25 / 1.5, 1e-12);
  EXPECT_NEAR(points[1].y, 20.0, 1e-12);
}

TEST(LayerSpin, FindsTheThesisOscillation) {
  // Point-like disks whose spin is that of Lätzel 2003, section 6.3.2: A 0.24, B 1.46, φ 1.79.
  // Rings of d/3 average a cosine of period 2d over a sixth of it: 4.5 % at most, and bend the
  // decay by as little.
  test::Instant instant;
  const Rings cell(10.0, 20.0, 10, 1.0, 1.0);
  for (int k = 0; k < 3000; ++k) {
    const double x = 10.0 * (k + 0.5) / 3000.0;
    instant.addDisk({10.0 + x, 0.0}, 1e-3, 1.0, Vec2::Zero(),
                    0.24 * std::exp(-1.46 * x) * std::cos(pi * x + 1.79));
  }
  LayerSpin spin(cell, instant.scene);
  spin.add(instant.snapshot);
  const Fit fit = fitSpinOscillation(spin.points(1.0));
  ASSERT_TRUE(fit.converged) << fit.reason;
  EXPECT_NEAR(fit.parameters[0].value, 0.24, 0.012);
  EXPECT_NEAR(fit.parameters[1].value, 1.46, 0.07);
  EXPECT_NEAR(fit.parameters[2].value, 1.79, 0.05);
}

}  // namespace
}  // namespace crossgrain

// A ring as it is put to the test: on logarithms where the margin is relative.
#include "studies/flow/paired_runs.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace crossgrain;

TEST(PairedRings, ARelativeMarginIsOneOnLogarithms) {
  const PairedTest ring = testedRing({0.1, true, "", ""}, {-2.0, -4.0}, {-2.2, -4.4});
  ASSERT_TRUE(ring.logarithmic);
  EXPECT_EQ(ring.sign, -1.0);
  EXPECT_EQ(ring.reference, -3.0);
  EXPECT_NEAR(ring.sample.margin, std::log(1.1), 1e-15);
  for (std::size_t k = 0; k < 2; ++k)
    EXPECT_NEAR(*ring.sample.other[k] - *ring.sample.reference[k], -std::log(1.1), 1e-15);
  EXPECT_NEAR(inUnit(ring, -std::log(1.1)), -0.3, 1e-15);  // a tenth more of −3
}

/// ± 0.4 of 2 is a fifth, ± 0.4 of 4 a tenth.
TEST(PairedRings, ErrorsOfRunsAreRelativeOnLogarithms) {
  PairedTest ring = testedRing({0.1, true, "", ""}, {2.0, 4.0}, {4.0, 8.0});
  addWithinVariance(ring, {0.4, 0.4}, {0.4, std::nullopt});
  EXPECT_NEAR(ring.sample.withinVariance[0].value(), 0.2 * 0.2 + 0.1 * 0.1, 1e-15);
  EXPECT_FALSE(ring.sample.withinVariance[1]);
}

TEST(PairedRings, AnAbsoluteMarginAndItsErrorsAreInTheFieldsUnit) {
  PairedTest ring = testedRing({0.1, false, "", ""}, {2.0, 4.0}, {2.5, 4.5});
  EXPECT_FALSE(ring.logarithmic);
  EXPECT_EQ(ring.sample.margin, 0.1);
  addWithinVariance(ring, {0.3, 0.3}, {0.4, 0.4});
  EXPECT_NEAR(ring.sample.withinVariance[0].value(), 0.25, 1e-15);
  EXPECT_EQ(inUnit(ring, 0.5), 0.5);
}

}  // namespace

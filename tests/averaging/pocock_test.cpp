#include "averaging/pocock.hpp"

#include <gsl/gsl_cdf.h>
#include <gtest/gtest.h>

namespace crossgrain {
namespace {

/// Jennison and Turnbull (2000), Table 2.1: the constant C_P(looks, α) of two-sided tests. Far from
/// 0 only one side counts, so that one side at α/2 has the same.
TEST(Pocock, HasThePublishedConstants) {
  const auto constant = [](int looks, double alpha) {
    return gsl_cdf_ugaussian_Qinv(pocockLevel(looks, alpha / 2.0));
  };
  EXPECT_NEAR(constant(2, 0.10), 1.875, 1.5e-3);
  EXPECT_NEAR(constant(3, 0.10), 1.992, 1.5e-3);
  EXPECT_NEAR(constant(4, 0.10), 2.067, 1.5e-3);
  EXPECT_NEAR(constant(5, 0.10), 2.122, 1.5e-3);
  EXPECT_NEAR(constant(2, 0.05), 2.178, 1e-3);
  EXPECT_NEAR(constant(4, 0.05), 2.361, 1e-3);
  EXPECT_NEAR(constant(5, 0.05), 2.413, 1e-3);
  EXPECT_NEAR(constant(4, 0.01), 2.939, 1e-3);
}

TEST(Pocock, OneLookIsTheTestItself) {
  EXPECT_EQ(pocockLevel(1, 0.05), 0.05);
  EXPECT_GT(pocockLevel(2, 0.05), 0.025);
  EXPECT_LT(pocockLevel(8, 0.05), pocockLevel(4, 0.05));
}

}  // namespace
}  // namespace crossgrain

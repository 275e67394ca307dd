#include "averaging/transition_density.hpp"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace crossgrain {
namespace {

std::vector<LoadState> packings(const std::vector<std::pair<double, bool>>& list) {
  std::vector<LoadState> all;
  for (const auto& [nu, carries] : list) all.push_back({nu, carries});
  return all;
}

TEST(TransitionDensity, HalfOfThePackingsCarryInTheMiddleOfASymmetricLadder) {
  const auto half = transitionDensity(packings({{0.790, false},
                                                {0.791, false},
                                                {0.792, true},
                                                {0.793, false},
                                                {0.794, true},
                                                {0.795, true}}),
                                      0.02);
  ASSERT_TRUE(half);
  EXPECT_NEAR(half->nu, 0.7925, 1e-9);
  EXPECT_GT(half->standardError, 0.0);
}

// Firth's estimate is finite where the kinds do not overlap, and its error then is about their gap.
TEST(TransitionDensity, PackingsThatSeparateStillHaveAnError) {
  const auto half = transitionDensity(
      packings({{0.789, false}, {0.791, false}, {0.797, true}, {0.799, true}}), 0.02);
  ASSERT_TRUE(half);
  EXPECT_NEAR(half->nu, 0.794, 1e-9);
  EXPECT_GT(half->standardError, 0.001);
  EXPECT_LT(half->standardError, 0.010);
  const auto many = transitionDensity(
      [] {
        std::vector<LoadState> all;
        for (int k = 0; k < 40; ++k) all.push_back({0.789 + 0.0005 * (k / 2), k >= 20});
        return all;
      }(),
      0.02);
  EXPECT_LT(many->standardError, half->standardError);
}

TEST(TransitionDensity, NoCriticalDensityWhereAllCarryOrFewerDoAtHigherOnes) {
  EXPECT_FALSE(transitionDensity(packings({{0.79, true}, {0.80, true}}), 0.02));
  EXPECT_FALSE(transitionDensity(packings({{0.79, false}, {0.80, false}}), 0.02));
  EXPECT_FALSE(transitionDensity(packings({{0.79, true}, {0.80, false}}), 0.02));
  EXPECT_FALSE(transitionDensity({}, 0.02));
}

}  // namespace
}  // namespace crossgrain

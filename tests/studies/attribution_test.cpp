// Parts of differences against values worked out by hand.
#include "studies/causes/attribution.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>

namespace {

using namespace crossgrain;

/// So many differences.
Causes causesOf(std::size_t differences) {
  Causes causes;
  for (std::size_t i = 0; i < differences; ++i)
    causes.differences.push_back({std::to_string(i), "", ""});
  return causes;
}

/// Parts, of a game of one number.
Attribution attributed(Causes& causes, const AttributionPlan& plan,
                       const std::function<double(Mixture)>& value) {
  return *attribute(causes, plan, [&](Mixture mixture) { return Numbers{value(mixture)}; });
}

double sumOf(const Attribution& found, std::size_t number) {
  double sum = *found.interaction[number];
  for (const Numbers& part : found.parts) sum += *part[number];
  return sum;
}

TEST(Attribution, AdditiveGame_GivesEachItsOwn) {
  const double own[] = {3.0, -1.0, 0.25};
  Causes causes = causesOf(3);
  const Attribution found = attributed(causes, {}, [&](Mixture mixture) {
    double sum = 7.0;
    for (std::size_t i = 0; i < 3; ++i) sum += mixture >> i & 1 ? own[i] : 0.0;
    return sum;
  });
  EXPECT_EQ(causes.mixtures, Mixtures::all);
  EXPECT_EQ(causes.runs, 8);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(*found.parts[i][0], own[i], 1e-14);
  EXPECT_EQ(*found.interaction[0], 0.0);
  EXPECT_TRUE(causes.interactions.empty());
}

/// One left glove and two right ones: a pair is worth 1. φ = 2/3, 1/6, 1/6; I = 1/2, 1/2, −1/2.
TEST(Attribution, GloveGame_HasItsShapleyValuesAndInteractions) {
  Causes causes = causesOf(3);
  const Attribution found = attributed(
      causes, {}, [](Mixture mixture) { return (mixture & 1) && (mixture & 6) ? 1.0 : 0.0; });
  EXPECT_NEAR(*found.parts[0][0], 2.0 / 3.0, 1e-14);
  EXPECT_NEAR(*found.parts[1][0], 1.0 / 6.0, 1e-14);
  EXPECT_NEAR(*found.parts[2][0], 1.0 / 6.0, 1e-14);
  ASSERT_EQ(causes.interactions.size(), 3u);
  for (const Interaction& pair : causes.interactions) EXPECT_NEAR(pair.share, 0.5, 1e-14);
}

/// All three are needed: alone each does nothing, taken back each undoes all.
TEST(Attribution, BothEnds_LeaveAnInteraction) {
  Causes causes = causesOf(3);
  const Attribution found = attributed(causes, {.mostMixed = 2},
                                       [](Mixture mixture) { return mixture == 7 ? 1.0 : 0.0; });
  EXPECT_EQ(causes.mixtures, Mixtures::bothEnds);
  for (const Numbers& part : found.parts) EXPECT_NEAR(*part[0], 0.5, 1e-14);
  EXPECT_NEAR(*found.interaction[0], -0.5, 1e-14);
  ASSERT_EQ(causes.path.size(), 3u);
  EXPECT_EQ(causes.path[1].left, 1.0);
  EXPECT_EQ(causes.path[2].left, 0.0);
}

/// 1 and 2 and 3 of both; the one between does nothing and is not mixed.
TEST(Attribution, InertDifference_IsLeftOut) {
  Causes causes = causesOf(3);
  const Attribution found = attributed(causes, {.mostMixed = 2}, [](Mixture mixture) {
    const bool one = mixture & 1, other = mixture & 4;
    return one && other ? 6.0 : one ? 1.0 : other ? 2.0 : 0.0;
  });
  EXPECT_EQ(causes.mixtures, Mixtures::all);
  EXPECT_NEAR(*found.parts[0][0], 2.5, 1e-14);
  EXPECT_EQ(*found.parts[1][0], 0.0);
  EXPECT_NEAR(*found.parts[2][0], 3.5, 1e-14);
  EXPECT_NEAR(causes.interactions.at(0).share, 0.5, 1e-14);
}

TEST(Attribution, Parts_AddUpToTheDifference) {
  const RunMixture run = [](Mixture mixture) {
    const double x = static_cast<double>(mixture);
    Numbers numbers = {std::sin(x * x), std::exp(-x), std::nullopt};
    if (mixture != 5) numbers[2] = x;  // absent of one run, so of all parts of that number
    return numbers;
  };
  for (const std::size_t mostMixed : {4, 1}) {
    Causes causes = causesOf(4);
    const auto found = attribute(causes, {.mostMixed = mostMixed}, run);
    ASSERT_TRUE(found);
    EXPECT_NEAR(sumOf(*found, 0), std::sin(225.0), 1e-13);
    EXPECT_NEAR(sumOf(*found, 1), std::exp(-15.0) - 1.0, 1e-13);
  }
  Causes causes = causesOf(4);
  EXPECT_FALSE(attribute(causes, {}, run)->parts[0][2]);
}

TEST(Attribution, MixtureThatCannotRun_GivesNone) {
  Causes causes = causesOf(2);
  EXPECT_FALSE(attribute(causes, {}, [](Mixture mixture) {
    return std::popcount(mixture) == 1 ? std::nullopt : std::optional(Numbers{1.0});
  }));
}

}  // namespace

// What many runs say together, against numbers worked out by hand or known from elsewhere.
#include "studies/thesis/claim_statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "studies/thesis/claim_evidence.hpp"

namespace crossgrain::test {
namespace {

TEST(ClaimStatistics, MeanOverRuns_HasTheErrorOfTheirScatter) {
  const auto mean = meanOver(std::vector<Measured>{1.0, 2.0, 3.0});
  ASSERT_TRUE(mean);
  EXPECT_DOUBLE_EQ(mean->value, 2.0);
  EXPECT_NEAR(mean->standardError.value(), 1.0 / std::sqrt(3.0), 1e-15);
  EXPECT_EQ(mean->dof, 2.0);
  EXPECT_NEAR(mean->half(0.95).value(), 4.302652 / std::sqrt(3.0), 1e-5);  // Student's table
}

TEST(ClaimStatistics, MeanOfOneRun_HasTheErrorWithinItOrNone) {
  const auto known = meanOver(std::vector<Measured>{{1.0, 0.1}});
  EXPECT_EQ(known->basis, Estimate::Basis::within);
  EXPECT_EQ(known->standardError, 0.1);
  const auto unknown = meanOver(std::vector<Measured>{1.0});
  EXPECT_FALSE(unknown->half(0.95));
  EXPECT_FALSE(meanOver({}));
}

// Without ties Var S = n(n − 1)(2n + 5)/18, and τ's is that over (n(n − 1)/2)².
TEST(ClaimStatistics, KendallsTau_WithoutTies_ByHand) {
  const std::vector<TrendPoint> rising{{1, 1}, {2, 3}, {3, 2}, {4, 4}, {5, 5}};
  const auto tau = rankTrend(rising, 5);
  ASSERT_TRUE(tau);
  EXPECT_DOUBLE_EQ(tau->value, 0.8);  // nine pairs agree, one does not
  EXPECT_NEAR(tau->standardError.value(), std::sqrt(5.0 * 4.0 * 15.0 / 18.0) / 10.0, 1e-15);
  EXPECT_FALSE(rankTrend(rising, 6));
  // All of one x, all of one y: no trend.
  EXPECT_FALSE(rankTrend(std::vector<TrendPoint>{{1, 1}, {1, 2}, {1, 3}, {1, 4}, {1, 5}}, 5));
  EXPECT_FALSE(rankTrend(std::vector<TrendPoint>{{1, 2}, {2, 2}, {3, 2}, {4, 2}, {5, 2}}, 5));
}

// Over all orders of y that there are, S has mean 0 and that variance: so it is counted here.
TEST(ClaimStatistics, KendallsTau_WithTies_HasTheErrorOfAllOrders) {
  std::vector<int> order{0, 1, 2, 3, 4, 5};
  const double x[] = {1, 1, 2, 3, 3, 3}, y[] = {1, 2, 2, 2, 3, 4};
  double squares = 0.0, count = 0.0, error = 0.0;
  do {
    std::vector<TrendPoint> points;
    for (std::size_t k = 0; k < 6; ++k) points.push_back({x[k], y[order[k]]});
    const auto tau = rankTrend(points, 5);
    squares += tau->value * tau->value;
    error = tau->standardError.value();
    count += 1.0;
  } while (std::ranges::next_permutation(order).found);
  EXPECT_NEAR(error, std::sqrt(squares / count), 1e-12);
}

TEST(ClaimStatistics, CommonSlope_OfGroupsAtOtherLevels_ByHand) {
  const std::vector<GroupedPoint> points{{0, 0.0, 0},  {1, 2.1, 0},  {2, 3.9, 0},
                                         {0, 50.1, 1}, {1, 52.0, 1}, {2, 53.9, 1}};
  const auto slope = commonSlope(points);
  ASSERT_TRUE(slope);
  EXPECT_NEAR(slope->value, 1.925, 1e-12);  // mean of 1.95 and 1.90
  EXPECT_EQ(slope->dof, 3.0);
  // Residuals about either line: −0.075+…: S = Σ (y − ȳ)² − b² Σ (x − x̄)².
  const double squares = (2.0 * 2.0 + 0.1 * 0.1 + 1.9 * 1.9) + (1.9 * 1.9 + 0.0 + 1.9 * 1.9);
  EXPECT_NEAR(slope->standardError.value(), std::sqrt((squares - 1.925 * 1.925 * 4.0) / 3.0 / 4.0),
              1e-10);
  EXPECT_FALSE(commonSlope(std::vector<GroupedPoint>{{0, 1, 0}, {1, 2, 1}, {2, 2, 2}}));
  EXPECT_FALSE(commonSlope(std::vector<GroupedPoint>{{0, 1, 0}, {1, 2, 0}}));  // no error
}

TEST(ClaimStatistics, SlopeOverRuns_OnALine_IsExact) {
  const std::vector<std::vector<TrendPoint>> line{{{0, 1}, {1, 3}}, {{2, 5}}, {{3, 7}, {4, 9}}};
  const auto exact = slopeOverRuns(line);
  ASSERT_TRUE(exact);
  EXPECT_NEAR(exact->value, 2.0, 1e-12);
  EXPECT_NEAR(exact->standardError.value(), 0.0, 1e-12);
  const std::vector<std::vector<TrendPoint>> bent{{{0, 1}, {1, 3}}, {{2, 6}}, {{3, 7}, {4, 9}}};
  EXPECT_GT(slopeOverRuns(bent)->standardError.value(), 0.01);
  EXPECT_FALSE(slopeOverRuns(std::vector(2, std::vector<TrendPoint>{{0, 1}, {1, 2}})));
}

Estimate over10(double value, double error) {
  return {value, error, 9.0, 10, Estimate::Basis::runs};
}

const ClaimBand band{"width", "C⁻¹", "d", 4.0, 7.0, "w"};

TEST(ClaimVerdicts, Band_HoldsTheIntervalLeavesItOutOrNeither) {
  using enum Verdict;
  // t of 9 degrees of freedom is 2.262 at 95 %, 2.685 at 97.5 %.
  EXPECT_EQ(placeIn(band, over10(5.0, 0.44), 0.95, 1), pass);
  EXPECT_EQ(placeIn(band, over10(5.0, 0.45), 0.95, 1), undecided);
  EXPECT_EQ(placeIn(band, over10(3.0, 0.44), 0.95, 1), fail);
  EXPECT_EQ(placeIn(band, over10(3.0, 0.45), 0.95, 1), undecided);
  EXPECT_EQ(placeIn(band, over10(8.0, 0.44), 0.95, 1), fail);
  // Of two figures each has half of the risk.
  EXPECT_EQ(placeIn(band, over10(3.0, 0.44), 0.95, 2), undecided);
  EXPECT_EQ(placeIn(band, over10(3.0, 0.37), 0.95, 2), fail);
  EXPECT_EQ(placeIn(band, exactly(5.0), 0.95, 7), pass);
  EXPECT_EQ(placeIn(band, exactly(7.1), 0.95, 7), fail);
  EXPECT_EQ(placeIn(band, Estimate{5.0, {}, 1.0, 1, Estimate::Basis::within}, 0.95, 1), undecided);
}

TEST(ClaimVerdicts, BandOfOneEdge_IsOpenOnTheOtherSide) {
  const ClaimBand above{"slip", "A", "", 0.0, {}, "w"};
  EXPECT_EQ(placeIn(above, over10(1e9, 1.0), 0.95, 1), Verdict::pass);
  EXPECT_EQ(placeIn(above, over10(-3.0, 1.0), 0.95, 1), Verdict::fail);
}

TEST(ClaimVerdicts, RunsToDecide_BringTheIntervalWithinTheEdge) {
  const auto n = runsToDecide(band, over10(5.0, 0.45), 0.95);
  ASSERT_TRUE(n);
  EXPECT_EQ(*n, 11);  // 2.228 × 0.45 √(10/11) = 0.956 < 1
  EXPECT_FALSE(runsToDecide(band, over10(4.0, 0.45), 0.95));  // on the edge itself
  EXPECT_FALSE(runsToDecide(band, exactly(4.5), 0.95));
}

}  // namespace
}  // namespace crossgrain::test

#include "runs/cost/analysis.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "runs/cost/cheapest.hpp"
#include "runs/cost/front.hpp"
#include "runs/cost/order.hpp"

namespace {

using namespace crossgrain;

using Points = std::vector<CostPoint>;
using Indices = std::vector<std::size_t>;

/// A made-up engine: error = amplitude dt^order + floor, time = cost/dt.
struct Synthetic {
  std::string name = "synthetic";
  double amplitude = 1.0, order = 2.0, floor = 0.0, cost = 1.0;
};

CostPoint pointOf(const Synthetic& engine, double dt) {
  CostPoint point;
  point.engine = engine.name;
  point.knob = "time_step";
  point.setting = "dt " + std::to_string(dt);
  point.fragment = "[run]\ndt = " + std::to_string(dt) + "\n";
  point.kind = CostKind::collision;
  point.measure = "psi_f";
  point.dt = dt;
  point.error = engine.amplitude * std::pow(dt, engine.order) + engine.floor;
  point.wallSeconds = engine.cost / dt;
  return point;
}

/// dt = 1/2, 1/4, …: count of them, largest first.
Points halvings(const Synthetic& engine, int count) {
  Points points;
  for (int k = 1; k <= count; ++k) points.push_back(pointOf(engine, std::pow(0.5, k)));
  return points;
}

CostPoint failed(CostPoint point, const std::string& reason) {
  point.status = CostStatus::failed;
  point.reason = reason;
  point.error.reset();
  return point;
}

/// Of one kind and measure, with that error and time.
CostPoint at(double error, std::optional<double> time) {
  CostPoint point = pointOf({}, 1.0);
  point.error = error;
  point.wallSeconds = time;
  return point;
}

TEST(CostOrder, OfAPurePowerIsThatPower) {
  const OrderFit fit = fitOrder(halvings({.amplitude = 3.0, .order = 2.0}, 5), 2.0);
  EXPECT_NEAR(*fit.order, 2.0, 1e-12);
  EXPECT_NEAR(*fit.standardError, 0.0, 1e-7);  // residuals are rounding
  EXPECT_NEAR(*fit.amplitude, 3.0, 1e-11);
  EXPECT_EQ(fit.used, (Indices{4, 3, 2, 1, 0}));
  EXPECT_EQ(fit.verdict, OrderVerdict::met);
}

TEST(CostOrder, ClaimedAndNotMetIsAFinding) {
  const Points first = halvings({.order = 1.0}, 5);
  EXPECT_EQ(fitOrder(first, 2.0).verdict, OrderVerdict::notMet);
  EXPECT_EQ(fitOrder(first, 0.5).verdict, OrderVerdict::exceeded);
  EXPECT_EQ(fitOrder(first, {}).verdict, OrderVerdict::noClaim);
}

TEST(CostOrder, LeavesOutWhereTheErrorStopsFalling) {
  // dt² + 10⁻⁴: 0.25, 0.0626, 0.0157, 0.0040, 0.0011, 3.4e-4, 1.6e-4, 1.15e-4, 1.04e-4, 1.01e-4
  const OrderFit fit = fitOrder(halvings({.floor = 1e-4}, 10), 2.0);
  // The plateau is where local slopes are below ½: down from 1.6e-4 (log2(1.61/1.15) = 0.48).
  EXPECT_EQ(fit.used, (Indices{4, 3, 2, 1, 0}));
  EXPECT_NEAR(*fit.order, 2.0, *fit.halfWidth);
  EXPECT_EQ(fit.verdict, OrderVerdict::met);
  ASSERT_EQ(fit.leftOut.size(), 5u);
  EXPECT_EQ(fit.leftOut.front().why, "where the error stops falling with the step");
}

TEST(CostOrder, LeavesOutWhatTheReferenceCannotTell) {
  Points points = halvings({}, 6);  // errors 4⁻¹ … 4⁻⁶
  for (CostPoint& point : points) point.referenceError = 1e-3;
  const OrderFit fit = fitOrder(points, 2.0);
  EXPECT_EQ(fit.used, (Indices{3, 2, 1, 0}));  // 4⁻⁴ = 0.0039 is above 0.003, 4⁻⁵ is not
  for (CostPoint& point : points) {
    point.referenceError.reset();
    point.statistical = 0.02;
  }
  EXPECT_EQ(fitOrder(points, 2.0).used.size(), 0u);  // 4⁻¹ and 4⁻² only: too few
}

TEST(CostOrder, LeavesOutFailuresAndWhatHasLeftTheAsymptoticRange) {
  Points points = halvings({}, 6);
  points[0] = failed(points[0], "beyond the stability limit");
  points[1].error = 10.0 * *points[1].error;
  const OrderFit fit = fitOrder(points, 2.0);
  EXPECT_EQ(fit.used, (Indices{5, 4, 3, 2}));
  EXPECT_NEAR(*fit.order, 2.0, 1e-12);
  ASSERT_EQ(fit.leftOut.size(), 2u);
  EXPECT_EQ(fit.leftOut[0].why, "failed: beyond the stability limit");
  EXPECT_EQ(fit.leftOut[1].point, 1u);
  EXPECT_EQ(fit.leftOut[1].why, "the local slope departs");
}

TEST(CostOrder, OfFewerThanThreePointsIsNoFit) {
  const OrderFit two = fitOrder(halvings({}, 2), 2.0);
  EXPECT_FALSE(two.order);
  EXPECT_EQ(two.verdict, OrderVerdict::noFit);
  EXPECT_EQ(two.reason, "fewer than three points in the asymptotic range");
  EXPECT_FALSE(fitOrder({}, 2.0).order);
  Points constant = halvings({.amplitude = 0.0, .floor = 0.05}, 6);
  EXPECT_FALSE(fitOrder(constant, 2.0).order);
  EXPECT_EQ(fitOrder(constant, 2.0).reason, "the error stops falling with the step at 0.05");
  EXPECT_FALSE(fitOrder(halvings({.amplitude = 0.0}, 6), 2.0).order);  // nothing but zeros
}

TEST(CostOrder, StatedIntervalCoversTheTruthAsOftenAsItSays) {
  // 5 % of scatter, six steps: the interval of 95 % holds 2 in 95 % of many repeats. The binomial
  // error of 4000 is 0.34 %; four of them, and the few repeats that lose a point to a local slope.
  std::mt19937 generator(7);
  std::normal_distribution<double> scatter(0.0, 0.05);
  const int repeats = 4000;
  int covered = 0;
  double sum = 0.0;
  for (int k = 0; k < repeats; ++k) {
    Points points = halvings({}, 6);
    for (CostPoint& point : points) *point.error *= std::exp(scatter(generator));
    const OrderFit fit = fitOrder(points, 2.0);
    ASSERT_TRUE(fit.order);
    covered += std::abs(*fit.order - 2.0) <= *fit.halfWidth;
    sum += *fit.order;
  }
  EXPECT_NEAR(covered / static_cast<double>(repeats), 0.95, 0.014);
  // The slope's own standard error is 0.05/ln 2/√17.5 = 0.0172; over 4000 repeats 0.0003.
  EXPECT_NEAR(sum / repeats, 2.0, 0.0012);
}

TEST(CostOrder, IsFittedForEachSchemeOfEachEngineAndMeasure) {
  Points points = halvings({.name = "a", .order = 2.0}, 4);
  for (const CostPoint& point : halvings({.name = "a", .order = 1.0}, 4)) {
    points.push_back(point);
    points.back().knob = "integrator";
    points.back().setting = "euler, dt " + std::to_string(*point.dt);
  }
  points.push_back(pointOf({.name = "b"}, 0.5));  // one step: no order
  CostPoint single = pointOf({.name = "a"}, 0.25);
  single.knob = "precision";
  points.push_back(single);
  const auto fits = fitOrders(points, {{"a", 2}, {"a euler", 1}, {"b", 9}});
  ASSERT_EQ(fits.size(), 2u);
  EXPECT_EQ(fits[0].integrator, "");
  EXPECT_EQ(fits[0].verdict, OrderVerdict::met);
  EXPECT_EQ(fits[1].integrator, "euler");
  EXPECT_EQ(*fits[1].theory, 1.0);
  EXPECT_EQ(fits[1].verdict, OrderVerdict::met);
  EXPECT_EQ(fits[1].used, (Indices{7, 6, 5, 4}));  // places among all points
}

TEST(CostFront, HoldsWhatNothingBeats) {
  const Points points = {at(0.1, 1.0),  at(0.2, 2.0), at(0.05, 2.0), at(0.05, 3.0),
                         at(0.01, 4.0), at(0.5, 0.5), at(1e-6, {}),  failed(at(0.0, 0.1), "NaN")};
  EXPECT_EQ(paretoFront(points), (Indices{5, 0, 2, 4}));
}

TEST(CostFront, KeepsTies) {
  EXPECT_EQ(paretoFront({at(0.1, 1.0), at(0.1, 1.0)}), (Indices{0, 1}));  // equal in both
  EXPECT_EQ(paretoFront({at(0.1, 2.0), at(0.1, 1.0)}), (Indices{1}));     // as wrong, slower
  EXPECT_EQ(paretoFront({at(0.3, 1.0), at(0.1, 1.0), at(0.2, 1.0)}), (Indices{1}));  // one cost
  EXPECT_TRUE(paretoFront({}).empty());
}

TEST(CostFront, CountsAnErrorThatMayBeChanceWithItsUpperBound) {
  CostPoint chance = at(0.01, 1.0);
  chance.statistical = 0.2;
  EXPECT_NEAR(*countedError(chance), 0.21, 1e-15);
  EXPECT_EQ(paretoFront({chance, at(0.1, 1.0)}), (Indices{1}));
  CostPoint clear = at(0.1, 1.0);
  clear.statistical = 0.02;
  clear.referenceError = 0.01;
  EXPECT_EQ(*countedError(clear), 0.1);
  EXPECT_NEAR(measuredError(clear)->low(), 0.07, 1e-15);
  EXPECT_NEAR(measuredError(clear)->high(), 0.13, 1e-15);
}

TEST(CostFront, IsOverAllEnginesAndOverEach) {
  Points points = halvings({.name = "slow", .cost = 2.0}, 3);
  for (const CostPoint& point : halvings({.name = "fast", .cost = 1.0}, 3)) points.push_back(point);
  CostPoint other = pointOf({.name = "slow"}, 0.5);
  other.measure = "e_n";
  points.push_back(other);
  const auto fronts = paretoFronts(points);
  ASSERT_EQ(fronts.size(), 5u);
  EXPECT_EQ(fronts[0].engine, "");
  EXPECT_EQ(fronts[0].points, (Indices{3, 4, 5}));  // half the time at equal errors
  EXPECT_EQ(fronts[1].engine, "slow");
  EXPECT_EQ(fronts[1].points, (Indices{0, 1, 2}));
  EXPECT_EQ(fronts[2].engine, "fast");
  EXPECT_EQ(fronts[3].measure, "e_n");
  EXPECT_EQ(fronts[3].points, (Indices{6}));
}

Cheapest ofSynthetic(const Points& points, double target) {
  return cheapest(points, "synthetic", CostKind::collision, "psi_f", target);
}

TEST(CostCheapest, IsTheLargestMeasuredStepThatMeetsTheTarget) {
  const Points points = halvings({.floor = 5e-4}, 6);  // 4⁻ᵏ + 0.0005
  EXPECT_EQ(ofSynthetic(points, 0.1).point, 1u);       // 0.063; 0.2505 does not
  EXPECT_EQ(ofSynthetic(points, 0.01).point, 3u);      // 0.0044
  EXPECT_EQ(ofSynthetic(points, 1e-3).point, 5u);      // 0.00074; nothing is interpolated
  const Cheapest none = ofSynthetic(points, 1e-6);
  EXPECT_EQ(none.verdict, CostVerdict::notReached);
  EXPECT_EQ(none.point, 5u);
  EXPECT_NEAR(*none.high, std::pow(0.25, 6) + 5e-4, 1e-15);
}

TEST(CostCheapest, MustMeetTheTargetWithItsUpperBound) {
  Points points = {at(0.008, 1.0), at(0.004, 2.0)};
  for (CostPoint& point : points) point.statistical = 0.004;
  const Cheapest row = ofSynthetic(points, 0.01);
  EXPECT_EQ(row.verdict, CostVerdict::reached);
  EXPECT_EQ(row.point, 1u);
  EXPECT_EQ(row.cheaper, 0u);  // 0.004 to 0.012: may
  // its statistical part must fall from 0.004 to 0.002: 4 times as long
  EXPECT_EQ(row.decides, "4.0 times as much simulated time");
  EXPECT_NEAR(*row.length, 0.16, 1e-12);  // (0.004/0.01)²
}

TEST(CostCheapest, SaysWhatWouldDecide) {
  CostPoint point = at(0.008, 1.0);
  point.referenceError = 0.005;
  Cheapest row = ofSynthetic({point}, 0.01);
  EXPECT_EQ(row.verdict, CostVerdict::undecided);
  EXPECT_EQ(row.decides, "a reference known to 2.0e-03");
  point.statistical = 0.005;
  row = ofSynthetic({point}, 0.01);
  EXPECT_EQ(row.decides, "a reference known to better than 2.0e-03 and more simulated time");
  point.referenceError.reset();
  point.error = 0.01;
  EXPECT_EQ(ofSynthetic({point}, 0.01).decides, "nothing: the error is the target");
}

TEST(CostCheapest, OfASinglePackingIsUndecided) {
  CostPoint point = at(0.001, 1.0);
  point.kind = CostKind::averages;
  const Cheapest row = cheapest({point}, "synthetic", CostKind::averages, "psi_f", 0.01);
  EXPECT_EQ(row.verdict, CostVerdict::undecided);
  EXPECT_EQ(row.decides, "more packings: one shows no statistical error");
  EXPECT_TRUE(paretoFront({point}).empty());
}

TEST(CostCheapest, WhatWasNotRunMayStillReachIt) {
  Points points = halvings({}, 3);
  points[2] = failed(points[2], "would take about 90 s, budget 60 s");
  points[2].status = CostStatus::notMeasured;
  const Cheapest row = ofSynthetic(points, 0.02);
  EXPECT_EQ(row.verdict,
            CostVerdict::notMeasured);  // which is neither "undecided" nor "not reached"
  EXPECT_EQ(row.point, 1u);
  EXPECT_EQ(row.decides,
            points[2].setting + ", which was not run: would take about 90 s, budget 60 s");
  points[2].dt = 1.0;  // a larger step would not help
  EXPECT_EQ(ofSynthetic(points, 0.02).verdict, CostVerdict::notReached);
  points[2].knob = "precision";  // another knob may
  EXPECT_EQ(ofSynthetic(points, 0.02).verdict, CostVerdict::notMeasured);
}

TEST(CostCheapest, OfPointsThatWereAllLeftOutSaysWhatIsMissing) {
  Points points = halvings({}, 2);
  for (CostPoint& point : points) {
    point = failed(point, "would take about 90 s");
    point.status = CostStatus::notMeasured;
  }
  const Cheapest row = ofSynthetic(points, 0.1);
  EXPECT_EQ(row.verdict, CostVerdict::notMeasured);
  EXPECT_EQ(row.decides,
            points[0].setting + " and 1 more, which were not run: would take about 90 s");
}

TEST(CostCheapest, OfNothingOrOfFailuresIsNotMeasured) {
  EXPECT_EQ(ofSynthetic({}, 0.1).verdict, CostVerdict::notMeasured);
  const Cheapest row = ofSynthetic({failed(at(0.0, 1.0), "NaN at step 3")}, 0.1);
  EXPECT_EQ(row.verdict, CostVerdict::notMeasured);
  EXPECT_FALSE(row.point);
}

TEST(CostCheapest, PrefersATimeThatIsKnown) {
  EXPECT_EQ(ofSynthetic({at(0.01, {}), at(0.01, 5.0)}, 0.1).point, 1u);
  EXPECT_EQ(ofSynthetic({at(0.01, {})}, 0.1).verdict, CostVerdict::reached);
}

/// Collisions and averages of the same settings; averages take 100 times as long and are off by
/// `bias` more.
Points bothKinds(const Synthetic& engine, double bias, double statistical) {
  Points points = halvings(engine, 4);
  for (int k = 0; k < 4; ++k) {
    CostPoint average = points[static_cast<std::size_t>(k)];
    average.kind = CostKind::averages;
    average.measure = "azimuthal_velocity";
    *average.error += bias;
    average.statistical = statistical;
    *average.wallSeconds *= 100.0;
    points.push_back(average);
  }
  return points;
}

TEST(CostAdvice, IsTheSettingThatMeetsTheTargetInCollisionsAndAverages) {
  // Collisions 4⁻ᵏ; averages 4⁻ᵏ + 0.05 ± 0.002.
  const Points points = bothKinds({}, 0.05, 0.002);
  const auto all = advice(points, {0.1, 0.01});
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].verdict, CostVerdict::reached);
  EXPECT_EQ(all[0].setting, points[2].setting);  // 1/64 + 0.052; 1/16 + 0.052 is above 0.1
  EXPECT_EQ(all[0].fragment, points[2].fragment);
  EXPECT_EQ(all[0].kinds, (std::vector{CostKind::collision, CostKind::averages}));
  EXPECT_EQ(all[0].costKind(), CostKind::averages);
  EXPECT_NEAR(*all[0].wallSeconds, 800.0, 1e-9);  // 100/dt with dt = 1/8
  EXPECT_NEAR(*all[0].length, 4e-4, 1e-12);       // (0.002/0.1)²
  EXPECT_TRUE(all[0].cheapest);
  EXPECT_EQ(all[1].verdict, CostVerdict::notReached);
  EXPECT_EQ(all[1].setting, points[3].setting);
  EXPECT_EQ(all[1].obstacle, 7u);  // averages at that step: 0.052 to 0.056
  EXPECT_EQ(all[1].decides, "");
  EXPECT_FALSE(all[1].cheapest);
}

/// One rule for all: averages over a single packing say nothing, wherever they would count.
TEST(CostFront, AveragesWithoutAStatisticalErrorCountNowhere) {
  CostPoint point = at(0.001, 1.0);
  point.kind = CostKind::averages;
  EXPECT_FALSE(countedError(point));
  EXPECT_TRUE(paretoFront({point}).empty());
  EXPECT_EQ(measuredError(point)->low(), 0.0);
  EXPECT_TRUE(std::isinf(measuredError(point)->high()));
  point.statistical = 1e-4;
  EXPECT_EQ(countedError(point), 0.001);
  EXPECT_EQ(countedError(at(0.001, 1.0)), 0.001);  // a collision's error does not scatter
}

TEST(CostAdvice, SaysNotReachedOnlyWhereAllThatMayBeBetterWasRun) {
  Points points = bothKinds({}, 0.05, 0.002);
  EXPECT_EQ(advice(points, {0.01})[0].verdict, CostVerdict::notReached);
  CostPoint left = points.back();
  *left.dt *= 0.5;
  left.setting = "half of it";
  left = failed(left, "would take about 90 s");
  left.status = CostStatus::notMeasured;
  points.push_back(left);
  const Advice one = advice(points, {0.01})[0];
  EXPECT_EQ(one.verdict, CostVerdict::notMeasured);
  EXPECT_EQ(one.decides, "half of it, which was not run: would take about 90 s");
  EXPECT_NE(adviceAsToml({one}, points).find("not measured far enough; the best so far is"),
            std::string::npos);
  EXPECT_EQ(advice(points, {0.1})[0].verdict, CostVerdict::reached);
}

TEST(CostAdvice, IsUndecidedWhereNoiseHidesTheError) {
  const auto all = advice(bothKinds({}, 0.0, 0.02), {0.01});
  EXPECT_EQ(all[0].verdict, CostVerdict::undecided);
  // 4⁻⁴ = 0.0039 ± 0.02: the noise must fall to 0.0061, (0.02/0.0061)² = 10.8
  EXPECT_EQ(all[0].obstacle, 7u);
  EXPECT_EQ(all[0].decides, "10.8 times as much simulated time");
}

TEST(CostAdvice, NamesTheCheapestOfTheEnginesThatWereMeasuredInMost) {
  Points points = bothKinds({.name = "slow", .cost = 2.0}, 0.0, 0.001);
  for (const CostPoint& p : bothKinds({.name = "fast"}, 0.0, 0.001)) points.push_back(p);
  for (const CostPoint& p : halvings({.name = "collisions only", .cost = 1e-3}, 4))
    points.push_back(p);
  const auto all = advice(points, {0.1});
  ASSERT_EQ(all.size(), 3u);
  EXPECT_FALSE(all[0].cheapest);
  EXPECT_TRUE(all[1].cheapest);
  EXPECT_EQ(all[1].engine, "fast");
  EXPECT_FALSE(all[2].cheapest);  // its time is that of something else
  EXPECT_EQ(all[2].kinds, (std::vector{CostKind::collision}));
}

TEST(CostAdvice, IsASettingThatWasMeasuredEverywhere) {
  Points points = bothKinds({}, 0.0, 0.0);
  points.erase(points.begin() + 4, points.end() - 1);  // averages at the smallest step only
  EXPECT_EQ(advice(points, {0.5})[0].setting, points[3].setting);
  points.back().setting = "another";
  EXPECT_EQ(advice(points, {0.5})[0].verdict, CostVerdict::notMeasured);
  EXPECT_EQ(advice(points, {0.5})[0].decides, "a setting that was measured in every measure");
  EXPECT_TRUE(advice({}, {0.5}).empty());
}

TEST(CostAdvice, IsPrintedAsTomlThatCanBePasted) {
  const Points points = bothKinds({}, 0.05, 0.002);
  const auto all = advice(points, {0.1, 0.01});
  EXPECT_EQ(adviceAsToml({all[0]}, points),
            "# synthetic, wanted 10 %: reached by dt 0.125000, 800 s per rotation (measured in "
            "collision and averages); the cheapest engine\n[run]\ndt = 0.125000\n");
  EXPECT_EQ(adviceAsToml({all[1]}, points),
            "# synthetic, wanted 1 %: not reached; the best is dt 0.062500, 1.6e+03 s per rotation "
            "(measured in collision and averages)\n"
            "# averages, azimuthal_velocity: 0.052 to 0.056 of its scale\n");
}

TEST(CostAnalysis, StandsBesideThePoints) {
  CostResults results;
  results.theory = {{"synthetic", 2}};
  results.points = halvings({}, 4);
  results.points.push_back(failed(pointOf({}, 1.0), "beyond the stability limit"));
  addCostAnalysis(results, {0.1});
  EXPECT_EQ(results.orders[0].used, (Indices{3, 2, 1, 0}));
  EXPECT_EQ(results.orders[0].theory, 2.0);
  EXPECT_EQ(results.orders[0].dtLow, 0.0625);
  EXPECT_EQ(results.orders[0].dtHigh, 0.5);
  EXPECT_EQ(results.orders[0].leftOut[0].point, 4u);
  EXPECT_EQ(results.fronts[0].points, (Indices{0, 1, 2, 3}));
  EXPECT_EQ(results.cheapest[0].point, 1u);
  EXPECT_EQ(results.advice[0].setting, results.points[1].setting);
  EXPECT_EQ(results.points[4].reason, "beyond the stability limit");
  CostResults empty;
  addCostAnalysis(empty);
  EXPECT_TRUE(empty.orders.empty());
  EXPECT_TRUE(empty.fronts.empty());
  EXPECT_TRUE(empty.cheapest.empty());
  EXPECT_TRUE(empty.advice.empty());
}

}  // namespace

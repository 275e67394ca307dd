// Figures of timings of growing scenes, by hand.
#include "results/cost.hpp"

#include <gtest/gtest.h>

namespace crossgrain::inline results {
namespace {

/// @param step  the mean of its rounds [s]
StepTime timed(const char* engine, std::size_t bodies, int workers, double step,
               std::vector<double> seconds) {
  StepTime time{.engine = engine, .bodies = bodies, .workers = workers, .step = step};
  time.seconds = std::move(seconds);
  return time;
}

std::vector<StepTime> timings() {
  std::vector<StepTime> all = {timed("grain", 1000, 1, 12e-6, {12e-6, 10e-6, 15e-6}),
                               timed("grain", 1000, 2, 8e-6, {8e-6}),
                               timed("other", 1000, 1, 48e-6, {48e-6}),
                               timed("grain", 2000, 1, 24e-6, {24e-6}),
                               timed("grain", 2000, 2, 16e-6, {16e-6}),
                               timed("grain", 2000, 4, 10e-6, {10e-6})};
  all[0].memory = 5e5;
  return all;
}

TEST(StepFigures, OneWorker_HasStepSpreadMemoryAndRatio) {
  const auto all = timings();
  const StepFigures one = stepFigures(all, all[0]);
  EXPECT_EQ(one.step, 12e-6);
  EXPECT_NEAR(*one.spread, 0.5, 1e-12);   // 15/10 − 1
  EXPECT_DOUBLE_EQ(*one.perBody, 12e-9);  // 12 µs for 1000 bodies
  EXPECT_DOUBLE_EQ(*one.bytes, 500.0);    // 5·10⁵ for 1000
  EXPECT_DOUBLE_EQ(*one.ratio, 1.0);
  EXPECT_DOUBLE_EQ(*stepFigures(all, all[2]).ratio, 4.0);  // of the other engine
  EXPECT_FALSE(one.strong || one.weak);
}

TEST(StepFigures, SeveralWorkers_HaveStrongAndWeakEfficiency) {
  const auto all = timings();
  const StepFigures two = stepFigures(all, all[4]);
  EXPECT_DOUBLE_EQ(*two.strong, 24.0 / (2 * 16.0));
  EXPECT_DOUBLE_EQ(*two.weak, 12.0 / 16.0);  // 1000 bodies on one against 2000 on two
  EXPECT_FALSE(two.spread);                  // of one round
  const StepFigures four = stepFigures(all, all[5]);
  EXPECT_DOUBLE_EQ(*four.strong, 24.0 / (4 * 10.0));
  EXPECT_FALSE(four.weak);  // no timing of 500 bodies
}

TEST(StepFigures, FailedTiming_HasNoneAndLendsNone) {
  auto all = timings();
  all[0].status = Status::failed;
  const StepFigures failed = stepFigures(all, all[0]);
  EXPECT_FALSE(failed.step || failed.spread || failed.perBody || failed.bytes || failed.ratio);
  EXPECT_TRUE(stepFigures(all, all[4]).strong);
  EXPECT_FALSE(stepFigures(all, all[4]).weak);
  EXPECT_FALSE(stepFigures(all, all[2]).ratio);
}

TEST(StepForecast, SizeThatDidNotRun_IsForeseenByTheTwoLargestBelow) {
  // From 1000 to 4000 bodies a body takes twice as long, T ∝ N^(3/2): at 16 000 the same per body,
  // 4 · 96 µs, or twice that. Memory: 1 MB and 500 bytes a body.
  std::vector<StepTime> all = {
      timed("grain", 500, 1, 1e-6, {1e-6}),    timed("grain", 4000, 1, 96e-6, {96e-6}),
      timed("grain", 1000, 1, 12e-6, {12e-6}), timed("grain", 16000, 1, 0.0, {}),
      timed("grain", 64000, 1, 1.0, {1.0}),    timed("other", 8000, 1, 1.0, {1.0})};
  all[1].memory = 3e6;
  all[2].memory = 1.5e6;
  all[3].status = Status::notRun;
  const auto forecast = stepForecast(all, all[3]);
  ASSERT_TRUE(forecast);
  EXPECT_EQ(forecast->smaller, 1000u);
  EXPECT_EQ(forecast->larger, 4000u);
  EXPECT_DOUBLE_EQ(forecast->least, 384e-6);
  EXPECT_DOUBLE_EQ(forecast->most, 768e-6);
  EXPECT_DOUBLE_EQ(*forecast->memory, 9e6);
  EXPECT_FALSE(stepForecast(all, all[1]).value().memory);  // none of 500 bodies
  EXPECT_FALSE(stepForecast(all, all[2]));
}

TEST(StepFigures, Workers_AreNamedByTheirKind) {
  StepTime time;
  EXPECT_EQ(describeWorkers(time), "one process");
  time.workersAre = "threads";
  EXPECT_EQ(describeWorkers(time), "1 thread");
  time.workersAre = "ranks";
  time.workers = 4;
  EXPECT_EQ(describeWorkers(time), "4 ranks");
}

}  // namespace
}  // namespace crossgrain::inline results

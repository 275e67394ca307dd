#include "runs/effects/step_times.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace crossgrain;

/// An engine whose clock is made up: every step costs the same but for the first `dear` ones of a
/// load, and has so many contacts. `noise` is added to the steps of one load after the other.
class MadeUpClock final : public Engine {
 public:
  MadeUpClock(double step, std::uint64_t contacts, std::vector<double> noise = {0.0})
      : step_(step), contacts_(contacts), noise_(std::move(noise)) {}

  Capabilities capabilities() const override { return {}; }
  Realised load(const Scene&, const Settings&) override {
    stats_ = {};
    ++loads;
    return {};
  }
  double advance(double t) override {
    if (loads > failsAfter) throw EngineFailure("made up, at t = 3 s: broke down");
    constexpr std::uint64_t dear = 5;
    const double noise = noise_[static_cast<std::size_t>(loads) % noise_.size()];
    for (const auto wanted = static_cast<std::uint64_t>(std::llround(t)); stats_.steps < wanted;) {
      stats_.wallSeconds += stats_.steps < dear ? 20.0 * step_ : step_ + noise;
      stats_.contactEvaluations += contacts_;
      ++stats_.steps;
    }
    return t;
  }
  Snapshot snapshot(ContactReport) override { return {}; }
  Stats stats() const override {
    Stats stats = stats_;
    stats.cpuSeconds = shareOfCore * stats.wallSeconds;
    return stats;
  }

  int loads = 0, failsAfter = 1000;
  double shareOfCore = 1.0;  ///< CPU time over wall time

 private:
  double step_;
  std::uint64_t contacts_;
  std::vector<double> noise_;
  Stats stats_;
};

TimedVariant variantOf(std::unique_ptr<MadeUpClock> clock) {
  TimedVariant variant;
  variant.load = [engine = clock.get()] {
    engine->load({}, {});
    return 1.0;  // dt
  };
  variant.engine = std::move(clock);
  return variant;
}

std::vector<TimedVariant> wholeAndWithout(double step, double without) {
  std::vector<TimedVariant> variants;
  variants.push_back(variantOf(std::make_unique<MadeUpClock>(step, 40)));
  variants.push_back(variantOf(std::make_unique<MadeUpClock>(without, 0)));
  return variants;
}

const std::function<void(double)> ignored = [](double) {};

TEST(StepTimes, TellTheCostOfAStepAfterTheWarmUp) {
  auto variants = wholeAndWithout(4e-4, 3e-4);
  const auto times = timeSteps(variants, {0.2, 5}, ignored);
  ASSERT_EQ(times[0].seconds.size(), 5u);
  for (const double seconds : times[0].seconds) EXPECT_NEAR(seconds, 4e-4, 1e-12);
  const auto ratio = timeRatio(times[1], times[0]);
  EXPECT_NEAR(ratio->value, 0.75, 1e-9);
  EXPECT_NEAR(*ratio->standardError, 0.0, 1e-9);
  EXPECT_DOUBLE_EQ(timeRatio(times[0], times[0])->value, 1.0);
}

TEST(StepTimes, LeaveOutWhatOtherProgramsHadOfTheCore) {
  auto variants = wholeAndWithout(4e-4, 3e-4);
  static_cast<MadeUpClock&>(*variants[0].engine).shareOfCore =
      0.5;  // half as much CPU time as wall
  static_cast<MadeUpClock&>(*variants[1].engine).shareOfCore = 1.9;  // two threads
  const auto times = timeSteps(variants, {0.2, 2}, ignored);
  EXPECT_NEAR(*shortestStep(times[0]), 2e-4, 1e-12);
  EXPECT_NEAR(*shortestStep(times[1]), 3e-4, 1e-12);
}

TEST(StepTimes, CountContactsWhereTheEngineDoes) {
  auto variants = wholeAndWithout(4e-4, 3e-4);
  const auto times = timeSteps(variants, {0.2, 2}, ignored);
  EXPECT_DOUBLE_EQ(*times[0].contacts, 40.0);
  EXPECT_FALSE(times[1].contacts);
}

TEST(StepTimes, StepAsOftenInAllLegsAndLongEnoughInTheFastest) {
  auto variants = wholeAndWithout(4e-4, 1e-4);
  timeSteps(variants, {0.2, 1}, ignored);
  const Stats slow = variants[0].engine->stats(), fast = variants[1].engine->stats();
  EXPECT_EQ(slow.steps, fast.steps);
  EXPECT_GE(fast.wallSeconds, 0.2);
}

TEST(StepTimes, TakeTheShortestRoundAndTheSpreadOfAll) {
  std::vector<TimedVariant> variants;
  variants.push_back(variantOf(std::make_unique<MadeUpClock>(1e-4, 1)));
  // Load 0 is there for the estimate; each round is one more load.
  variants.push_back(
      variantOf(std::make_unique<MadeUpClock>(1e-4, 1, std::vector{3e-5, 0.0, 2e-5, 1e-5})));
  const auto times = timeSteps(variants, {0.2, 4}, ignored);
  const auto ratio = timeRatio(times[1], times[0]);
  EXPECT_NEAR(ratio->value, 1.0, 1e-9);
  // Ratios 1.0, 1.1, 1.2, 1.3 in some order: sd = √(0.05/3), over √4.
  EXPECT_NEAR(*ratio->standardError, std::sqrt(0.05 / 3.0) / 2.0, 1e-9);
}

TEST(StepTimes, AVariantThatBreaksDownLeavesTheOthers) {
  auto variants = wholeAndWithout(4e-4, 3e-4);
  static_cast<MadeUpClock&>(*variants[1].engine).failsAfter = 2;
  const auto times = timeSteps(variants, {0.2, 3}, ignored);
  EXPECT_EQ(times[0].seconds.size(), 3u);
  EXPECT_EQ(times[1].failure, "made up, at t = 3 s: broke down");
  EXPECT_TRUE(times[1].seconds.empty());
  EXPECT_FALSE(timeRatio(times[1], times[0]));
}

TEST(StepTimes, AreKeptAsJson) {
  const StepTimes times = {{1e-5, 1.0 / 3.0}, 7.5, "why"};
  const StepTimes back = readAs<StepTimes>(jsonOf(times));
  EXPECT_EQ(back.seconds, times.seconds);
  EXPECT_EQ(back.contacts, times.contacts);
  EXPECT_EQ(back.failure, times.failure);
  EXPECT_FALSE(readAs<StepTimes>(jsonOf(StepTimes{})).contacts);
}

}  // namespace

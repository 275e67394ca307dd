#include "studies/effects/step_times.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "tests/studies/planted_engine.hpp"

namespace {

using namespace crossgrain;

/// An engine whose clock is made up: every step costs the same but for the first `dear` ones of a
/// load, and has so many contacts. `noise` is added to the steps of one load after the other.
class MadeUpClock final : public Engine {
 public:
  MadeUpClock(double step, std::uint64_t contacts) : step_(step), contacts_(contacts) {}

  Capabilities capabilities() const override { return {}; }
  EffectiveParameters load(const Scene&, const Settings&) override {
    stats_ = {};
    ++loads;
    return {};
  }
  double advance(double t) override {
    if (loads > failsAfter) throw EngineFailure("made up, at t = 3 s: broke down");
    constexpr std::uint64_t dear = 5;
    const double late = noise[static_cast<std::size_t>(loads) % noise.size()];
    for (const auto wanted = static_cast<std::uint64_t>(std::llround(t)); stats_.steps < wanted;) {
      stats_.wallSeconds += stats_.steps < dear ? 20.0 * step_ : step_ + late;
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
  double shareOfCore = 1.0;           ///< CPU time over wall time
  std::vector<double> noise = {0.0};  ///< of its steps, one load after the other [s]

 private:
  double step_;
  std::uint64_t contacts_;
  Stats stats_;
};

/// @param clock  outlives it
TimedVariant variantOf(MadeUpClock& clock) {
  // Engine that a variant gets for a turn; the clock itself goes on.
  const std::shared_ptr<Engine> itself(&clock, [](Engine*) {});
  const auto nothing = [](auto&) {};
  return {[=] { return std::make_unique<test::PlantedEngine>(nothing, nothing, itself); },
          [](Engine& engine, int) {
            engine.load({}, {});
            return 1.0;  // dt
          }};
}

struct WholeAndWithout {
  WholeAndWithout(double step, double without) : clocks{{{step, 40}, {without, 0}}} {}

  std::vector<StepTimes> times(const TimingPlan& plan) {
    return timeSteps({variantOf(clocks[0]), variantOf(clocks[1])}, plan, [](double) {});
  }

  std::array<MadeUpClock, 2> clocks;
};

TEST(StepTimes, WarmUp_IsLeftOut) {
  WholeAndWithout variants(4e-4, 3e-4);
  const auto times = variants.times({0.2, 5});
  ASSERT_EQ(times[0].seconds.size(), 5u);
  for (const double seconds : times[0].seconds) EXPECT_NEAR(seconds, 4e-4, 1e-12);
  const auto ratio = timeRatio(times[1], times[0]);
  EXPECT_NEAR(ratio->value, 0.75, 1e-9);
  EXPECT_NEAR(*ratio->standardError, 0.0, 1e-9);
  EXPECT_DOUBLE_EQ(timeRatio(times[0], times[0])->value, 1.0);
  EXPECT_DOUBLE_EQ(*times[0].contacts, 40.0);
  EXPECT_FALSE(times[1].contacts);
}

TEST(StepTimes, ProcessorTime_CountsWhateverTheWallTimeIs) {
  WholeAndWithout variants(4e-4, 3e-4);
  variants.clocks[0].shareOfCore = 0.5;  // half as much CPU time as wall
  variants.clocks[1].shareOfCore = 1.9;  // two threads
  const auto times = variants.times({0.2, 2});
  EXPECT_NEAR(*meanStep(times[0]), 2e-4, 1e-12);
  EXPECT_NEAR(*meanStep(times[1]), 5.7e-4, 1e-12);
  variants.clocks[0].shareOfCore = 0.0;  // it does not report it
  EXPECT_NEAR(*meanStep(variants.times({0.2, 2})[0]), 4e-4, 1e-12);
}

TEST(StepTimes, EveryVariant_TakesAsManySteps) {
  WholeAndWithout variants(4e-4, 1e-4);
  variants.times({0.2, 1});
  const Stats slow = variants.clocks[0].stats(), fast = variants.clocks[1].stats();
  EXPECT_EQ(slow.steps, fast.steps);
  EXPECT_GE(fast.wallSeconds, 0.2);
}

TEST(StepTimes, NoisyRounds_TakeTheMeanAndItsError) {
  WholeAndWithout variants(1e-4, 1e-4);
  // Load 0 is there for the estimate; each round is one more load.
  variants.clocks[1].noise = {3e-5, 0.0, 2e-5, 1e-5};
  const auto times = variants.times({0.2, 4});
  const auto ratio = timeRatio(times[1], times[0]);
  EXPECT_NEAR(ratio->value, 1.15, 1e-9);
  // Ratios 1.0, 1.1, 1.2, 1.3 in some order: sd = √(0.05/3), over √4.
  EXPECT_NEAR(*ratio->standardError, std::sqrt(0.05 / 3.0) / 2.0, 1e-9);
}

TEST(StepTimes, Rounds_AreEachLoadedFromTheirOwnPacking) {
  WholeAndWithout variants(1e-4, 1e-4);
  std::vector<int> rounds;
  std::vector<TimedVariant> timed = {variantOf(variants.clocks[0]), variantOf(variants.clocks[1])};
  for (TimedVariant& one : timed)
    one.load = [&, load = one.load](Engine& engine, int round) {
      rounds.push_back(round);
      return load(engine, round);
    };
  timeSteps(timed, {0.01, 3}, [](double) {});
  EXPECT_EQ(rounds, (std::vector<int>{0, 0, 0, 0, 1, 1, 2, 2}));  // the first two: estimates
}

TEST(StepTimes, VariantThatBreaksDown_LeavesTheOthers) {
  WholeAndWithout variants(4e-4, 3e-4);
  variants.clocks[1].failsAfter = 2;
  const auto times = variants.times({0.2, 3});
  EXPECT_EQ(times[0].seconds.size(), 3u);
  EXPECT_EQ(times[1].failure, "made up, at t = 3 s: broke down");
  EXPECT_TRUE(times[1].seconds.empty());
  EXPECT_FALSE(timeRatio(times[1], times[0]));
}

}  // namespace

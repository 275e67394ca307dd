#include "runs/cost/averages.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "adapters/grain.hpp"
#include "tests/runs/cost_cases.hpp"

namespace {

using namespace crossgrain;

AveragedPacking run(const std::vector<std::optional<double>>& stress, double slip) {
  AveragedPacking run;
  run.samplings["slicing"] = {{"stress_rr", stress}, {"wall_slip", {slip}}};
  return run;
}

TEST(CostAverages, TheErrorIsSplitIntoWhatPackingsScatterAndWhatIsLeft) {
  // Differences in ring 1: 1, 3 (mean 2, error 1); in ring 2: 0, 0. Scale: the largest mean, 20.
  const std::vector<AveragedPacking> reference = {run({10.0, 20.0}, 0.1), run({10.0, 20.0}, 0.1)};
  const std::vector<AveragedPacking> runs = {run({11.0, 20.0}, 0.2), run({13.0, 20.0}, 0.2)};
  const auto found = weakError(runs, "slicing", reference, "slicing", "stress_rr", 0.05);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->error, std::sqrt(4.0 / 2.0) / 20.0, 1e-12);
  EXPECT_NEAR(*found->statistical, std::sqrt(1.0 / 2.0) / 20.0, 1e-12);
  EXPECT_NEAR(*found->systematic, std::sqrt(3.0 / 2.0) / 20.0, 1e-12);
}

TEST(CostAverages, TheIntervalHoldsForAllRingsAtOnce) {
  // Ring 1: 2 ± 1 from two packings, ring 2: 0 ± 0; Student's t of one degree of freedom for half
  // of 5 % each is tan(π/2 · 0.975) = 25.45. The mean may be 0, and 2 + 25.45.
  const std::vector<AveragedPacking> reference = {run({10.0, 20.0}, 0.1), run({10.0, 20.0}, 0.1)};
  const auto wide = weakError({run({11.0, 20.0}, 0.2), run({13.0, 20.0}, 0.2)}, "slicing",
                              reference, "slicing", "stress_rr", 0.05);
  EXPECT_EQ(wide->interval->low, 0.0);
  EXPECT_NEAR(wide->interval->high, 27.452 / std::sqrt(2.0) / 20.0, 1e-4);
  // 2 ± 0.01: from 2 − 0.2545 on
  const auto narrow = weakError({run({11.99, 20.0}, 0.2), run({12.01, 20.0}, 0.2)}, "slicing",
                                reference, "slicing", "stress_rr", 0.05);
  EXPECT_NEAR(narrow->interval->low, 1.7455 / std::sqrt(2.0) / 20.0, 1e-5);
}

TEST(CostAverages, SlipIsAShareOfTheRimAlready) {
  const auto found = weakError({run({1.0}, 0.2), run({1.0}, 0.2)}, "slicing",
                               {run({1.0}, 0.1), run({1.0}, 0.1)}, "slicing", "wall_slip", 0.05);
  EXPECT_NEAR(found->error, 0.1, 1e-12);
  EXPECT_NEAR(*found->systematic, 0.1, 1e-12);
}

TEST(CostAverages, OnePackingHasNoStatisticalPartAndNothingHasNoError) {
  const auto one =
      weakError({run({2.0}, 0.2)}, "slicing", {run({1.0}, 0.1)}, "slicing", "stress_rr", 0.05);
  EXPECT_NEAR(one->error, 1.0, 1e-12);
  EXPECT_FALSE(one->statistical);
  EXPECT_FALSE(one->systematic);
  EXPECT_FALSE(
      weakError({AveragedPacking{}}, "slicing", {run({1.0}, 0.1)}, "slicing", "stress_rr", 0.05));
  EXPECT_FALSE(
      weakError({run({1.0}, 0.1)}, "centre", {run({1.0}, 0.1)}, "slicing", "stress_rr", 0.05));
}

TEST(CostAverages, ScatterThatExplainsTheDifferenceLeavesNothing) {
  const auto found = weakError({run({2.0}, 0.0), run({0.0}, 0.0)}, "slicing",
                               {run({1.0}, 0.0), run({1.0}, 0.0)}, "slicing", "stress_rr", 0.05);
  EXPECT_NEAR(found->error, 0.0, 1e-12);
  EXPECT_NEAR(*found->statistical, 1.0, 1e-12);
  EXPECT_EQ(*found->systematic, 0.0);
}

TEST(CostAverages, EverySettingThatIsAnotherSamplingIsTaken) {
  Case setup = test::costCase();
  setup.cost.numbers["snapshots"] = {3, 4, 64, 100'000};  // some of which do not divide 640
  std::vector<std::string> names;
  for (const Sampling& sampling : allSamplings(setup)) names.push_back(nameOf(sampling));
  int samplings = 0;
  for (const CostSetting& setting :
       costSettings(setup, CostKind::averages, "grain", makeGrain()->capabilities())) {
    if (!setting.isSampling()) continue;
    EXPECT_NE(std::ranges::find(names, nameOf(samplingOf(setup, setting))), names.end())
        << setting.setting;
    ++samplings;
  }
  EXPECT_EQ(samplings, 5);
}

}  // namespace

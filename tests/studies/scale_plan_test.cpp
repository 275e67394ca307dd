// Which timings `scale` takes, by hand, and what its lists of numbers may be.
#include "studies/scale/timing.hpp"

#include <gtest/gtest.h>

#include "cases/couette.hpp"
#include "cases/scaled_cell.hpp"
#include "studies/scale/scale.hpp"
#include "support/bad_input.hpp"

namespace crossgrain::inline studies {
namespace {

ScalePlan planOf(std::vector<std::size_t> disks, std::vector<int> workers) {
  ScalePlan plan;
  plan.disks = std::move(disks);
  plan.workers = std::move(workers);
  return plan;
}

using Points = std::vector<PlannedTiming>;

TEST(ScalePlan, SizesAndWorkers_GiveStrongAndWeakPointsOnce) {
  EXPECT_EQ(plannedPoints(planOf({1000, 3000}, {2}), {true, false}),
            (Points{{1000, 0, 1},
                    {1000, 0, 2},
                    {1000, 1, 1},  // the second engine has no workers
                    {2000, 0, 2},  // 2 · 1000 on two: weak
                    {3000, 0, 1},
                    {3000, 0, 2},
                    {3000, 1, 1}}));  // 6000 are more than asked for
  EXPECT_EQ(plannedPoints(planOf({1000, 2000}, {1, 2}), {true}),
            (Points{{1000, 0, 1}, {1000, 0, 2}, {2000, 0, 1}, {2000, 0, 2}}));
}

TEST(ScalePlan, NumberOfDisks_GivesStepsAndMemory) {
  EXPECT_EQ(stepsFor(1000), 20000u);
  EXPECT_EQ(stepsFor(400'000), 50u);
  EXPECT_EQ(stepsFor(10'000'000), 50u);
  EXPECT_EQ(warmUpSteps(20000), 2000u);
  EXPECT_EQ(warmUpSteps(20), 5u);
  EXPECT_DOUBLE_EQ(expectedMemory(10'000'000, 1'000'000, 7e8), 7e9);
}

TEST(ScalePlan, NumberOfCores_GivesWorkersInPowersOfTwo) {
  EXPECT_EQ(usualWorkers(0), (std::vector<int>{1}));
  EXPECT_EQ(usualWorkers(2), (std::vector<int>{1, 2}));
  EXPECT_EQ(usualWorkers(6), (std::vector<int>{1, 2, 4, 6}));
}

TEST(ScalePlan, MalformedList_Throws) {
  EXPECT_EQ(wholeNumbers("--disks", "1000,20", 1, 1000), (std::vector<std::size_t>{1000, 20}));
  for (const char* wrong :
       {"", "1,", ",1", "1.5", "-1", "1e3", "0", "1001", "2,2", " 1", "99999999999999999999"})
    EXPECT_THROW(wholeNumbers("--disks", wrong, 1, 1000), BadInput) << wrong;
}

TEST(ScaleCase, OtherCellOrLaw_Throws) {
  const auto caseWith = [](const char* change) {
    CommandLine line;
    line.overrides = {change};
    ScaleOptions none;
    return scaleStudy.cases(line, none).front();
  };
  EXPECT_THROW(caseWith("cell.omega=2"), BadInput);
  EXPECT_THROW(caseWith("law.mu=0.1"), BadInput);
  EXPECT_THROW(caseWith("engines.grain.threads=2"), BadInput);
  EXPECT_EQ(caseWith("run.timeout=7").run.timeout, 7.0);
}

/// The room between the walls' surfaces less half a small disk is filled alike: the maker's own
/// rule, as it is said in tests/bench/README.md.
TEST(ScaledCell, EverySize_HasTheSameVolumeFractionOfTheRoom) {
  const auto fractionOfTheRoom = [](const Case& setup) {
    const Cell& cell = couetteIn(setup).cell;
    const double lost = cell.wallRadius + 0.5 * couetteIn(setup).particles.smallRadius;
    const double inner = cell.innerRadius + lost, outer = cell.outerRadius - lost;
    const double ring = cell.outerRadius * cell.outerRadius - cell.innerRadius * cell.innerRadius;
    return volumeFraction(setup) * ring / (outer * outer - inner * inner);
  };
  const double first = fractionOfTheRoom(scaledCase(1000));
  for (const std::size_t disks : {10'000u, 100'000u, 1'000'000u, 10'000'000u}) {
    const Case scaled = scaledCase(disks);
    EXPECT_EQ(couetteIn(scaled).particles.small + couetteIn(scaled).particles.large,
              static_cast<int>(disks));
    // Numbers of disks are whole: one of 1000 is 10⁻³.
    EXPECT_NEAR(fractionOfTheRoom(scaled), first, 1e-3 * first) << disks;
    EXPECT_NEAR(couetteIn(scaled).cell.omega * couetteIn(scaled).cell.innerRadius, 0.1032,
                1e-12);  // the rim's speed
  }
}

}  // namespace
}  // namespace crossgrain::inline studies

#include "runs/cost/plan.hpp"

#include <gtest/gtest.h>

namespace {

using namespace crossgrain;

TEST(CostPlan, WhatOneDoesNotWantGoesToTheOthers) {
  // 10 of 100 wanted by the first; the others share the 90 left in equal parts.
  EXPECT_EQ(fairShares({10.0, 200.0, 60.0}, 100.0), (std::vector<double>{10.0, 45.0, 45.0}));
  EXPECT_EQ(fairShares({10.0, 20.0}, 100.0), (std::vector<double>{10.0, 20.0}));
  EXPECT_EQ(fairShares({10.0, 20.0}, -5.0), (std::vector<double>{0.0, 0.0}));
}

std::vector<PlannedPoint> threePoints() {
  return {{0, CostKind::averages, 0, 30.0, "", false},
          {0, CostKind::averages, 1, 5.0, "", false},
          {0, CostKind::collision, 0, 10.0, "", false}};
}

TEST(CostPlan, TakesCollisionsFirstThenTheCaseAsItIsThenTheCheapest) {
  auto points = threePoints();
  fitIntoBudget(points, {{}}, 1000.0);
  EXPECT_EQ(points[0].kind, CostKind::collision);
  EXPECT_EQ(points[1].setting, 0u);
  for (const PlannedPoint& point : points) EXPECT_EQ(point.notMeasured, "");
}

TEST(CostPlan, WhatDoesNotFitIsNotMeasuredAndSaysWhatItWouldTake) {
  auto points = threePoints();
  const auto shares = fitIntoBudget(points, {{{CostKind::collision, 2.0}}}, 20.0);
  EXPECT_EQ(shares, (std::vector<double>{20.0}));
  EXPECT_EQ(points[0].notMeasured, "");  // 2 + 10 of 20
  EXPECT_EQ(points[1].notMeasured,
            "would take about 30 s, 8 s are left of the engine's share of 20 s");
  EXPECT_EQ(points[2].notMeasured, "");  // 5 of the 8 left
}

TEST(CostPlan, ReferencesThatDoNotFitTakeTheirKindsPointsOnly) {
  auto points = threePoints();
  fitIntoBudget(points, {{{CostKind::collision, 2.0}, {CostKind::averages, 8.0}}}, 20.0);
  EXPECT_EQ(points[0].notMeasured, "");  // 2 + 10 of 20; averages begin with 8 more
  EXPECT_EQ(points[1].notMeasured,
            "would take about 38 s, 8 s are left of the engine's share of 20 s");
  EXPECT_EQ(points[2].notMeasured,
            "would take about 13 s, 8 s are left of the engine's share of 20 s");
  // 30 + 5 of averages were left out, and their references.
  EXPECT_EQ(budgetOfLeftOut(points, {{{CostKind::collision, 2.0}, {CostKind::averages, 8.0}}}),
            43.0);
}

TEST(CostPlan, WhatIsBoundedComesBeforeWholeRuns) {
  auto points = threePoints();
  points[1].windowsOnly = true;
  fitIntoBudget(points, {{}}, 20.0);
  EXPECT_EQ(points[1].setting, 1u);
  EXPECT_EQ(points[1].notMeasured, "");
  EXPECT_NE(points[2].notMeasured, "");
}

TEST(CostPlan, AFinishedPointCostsNothing) {
  auto points = threePoints();
  for (PlannedPoint& point : points) point.seconds = 0.0;
  fitIntoBudget(points, {{}}, 0.0);
  for (const PlannedPoint& point : points) EXPECT_EQ(point.notMeasured, "");
}

}  // namespace

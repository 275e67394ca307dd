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
  return {{0, CostKind::averages, 0, 30.0, ""},
          {0, CostKind::averages, 1, 5.0, ""},
          {0, CostKind::collision, 0, 10.0, ""}};
}

TEST(CostPlan, TakesCollisionsFirstThenTheCaseAsItIsThenTheCheapest) {
  auto points = threePoints();
  fitIntoBudget(points, {0.0}, 1000.0);
  EXPECT_EQ(points[0].kind, CostKind::collision);
  EXPECT_EQ(points[1].setting, 0u);
  for (const PlannedPoint& point : points) EXPECT_EQ(point.notMeasured, "");
}

TEST(CostPlan, WhatDoesNotFitIsNotMeasuredAndSaysWhatItWouldTake) {
  auto points = threePoints();
  const auto shares = fitIntoBudget(points, {2.0}, 20.0);
  EXPECT_EQ(shares, (std::vector<double>{20.0}));
  EXPECT_EQ(points[0].notMeasured, "");  // 2 + 10 of 20
  EXPECT_EQ(points[1].notMeasured,
            "would take about 30 s, 8 s are left of the engine's share of 20 s");
  EXPECT_EQ(points[2].notMeasured, "");  // 5 of the 8 left
}

TEST(CostPlan, AFinishedPointCostsNothing) {
  auto points = threePoints();
  for (PlannedPoint& point : points) point.seconds = 0.0;
  fitIntoBudget(points, {0.0}, 0.0);
  for (const PlannedPoint& point : points) EXPECT_EQ(point.notMeasured, "");
}

}  // namespace

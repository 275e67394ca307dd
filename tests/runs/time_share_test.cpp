#include "runs/stability/time_share.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace {

using namespace crossgrain;

/// Hours, so that the test's own time is none.
constexpr double hours = 3600.0;

TEST(TimeBudget, IsSharedEquallyAmongWhatIsStillToBeDone) {
  TimeBudget budget(40.0 * hours, 4, 1);
  const TimeShare first = budget.next();
  EXPECT_NO_THROW(first.require(9.9 * hours));
  EXPECT_THROW(first.require(10.1 * hours), OutOfTime);
  // The first took nothing of its part: three have it.
  const TimeShare second = budget.next();
  EXPECT_NO_THROW(second.require(13.2 * hours));
  EXPECT_THROW(second.require(13.4 * hours), OutOfTime);
  budget.next();
  EXPECT_NO_THROW(budget.next().require(39.9 * hours));
}

TEST(TimeBudget, WhatRunsSideBySideHasTheTimeOfAllJobs) {
  TimeBudget budget(40.0 * hours, 4, 2);
  const TimeShare first = budget.next();
  EXPECT_NO_THROW(first.require(19.9 * hours));
  EXPECT_THROW(first.require(20.1 * hours), OutOfTime);
  TimeBudget few(40.0 * hours, 1, 8);
  EXPECT_THROW(few.next().require(40.1 * hours), OutOfTime);
}

TEST(TimeBudget, WithoutOneAllIsRun) {
  TimeBudget budget(std::numeric_limits<double>::infinity(), 1, 1);
  EXPECT_NO_THROW(budget.next().require(1e300));
}

TEST(TimeBudget, OfNothingNothingIsRun) {
  TimeBudget budget(0.0, 1, 1);
  EXPECT_THROW(budget.next().require(0.0), OutOfTime);
}

}  // namespace

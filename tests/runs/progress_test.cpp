#include "runs/common/executor.hpp"

#include <gtest/gtest.h>

namespace crossgrain {
namespace {

TEST(TimeLeft, FollowsTheSpeedSoFar) {
  EXPECT_EQ("6 s left", timeLeft(0.25, 2.0));
  EXPECT_EQ("0 s left", timeLeft(1.0, 2.0));
  EXPECT_EQ("59 s left", timeLeft(0.5, 59.0));
}

TEST(TimeLeft, IsToldInMinutesAndHours) {
  EXPECT_EQ("1 min 00 s left", timeLeft(0.5, 60.0));
  EXPECT_EQ("59 min 59 s left", timeLeft(0.5, 3599.0));
  EXPECT_EQ("1 h 01 min left", timeLeft(0.5, 3660.0));
}

TEST(TimeLeft, IsNotForetoldFromTooLittle) {
  EXPECT_EQ("estimating the time left", timeLeft(0.5, 0.9));
  EXPECT_EQ("estimating the time left", timeLeft(0.01, 100.0));
}

}  // namespace
}  // namespace crossgrain

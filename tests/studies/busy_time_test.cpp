#include "support/busy_time.hpp"

#include <gtest/gtest.h>

#include <thread>

namespace {

using crossgrain::BusyTime;
using std::chrono::milliseconds;

void sleepFor(milliseconds time) {
  std::this_thread::sleep_for(time);
}

TEST(BusyTime, CountsPiecesAndNotTheTimeBetween) {
  BusyTime time;
  EXPECT_EQ(0.0, time.seconds());
  {
    const BusyTime::Piece piece(time);
    sleepFor(milliseconds(20));
    EXPECT_GE(time.seconds(), 0.02) << "what is under way counts";
  }
  const double after = time.seconds();
  sleepFor(milliseconds(20));
  EXPECT_EQ(after, time.seconds());
}

/// Two pieces, one inside the other: the time of the outer one, where a sum would be a third more.
TEST(BusyTime, OfTwoAtOnceIsThatOfOne) {
  BusyTime time;
  const auto begin = std::chrono::steady_clock::now();
  {
    const BusyTime::Piece outer(time);
    sleepFor(milliseconds(20));
    const BusyTime::Piece inner(time);
    sleepFor(milliseconds(20));
  }
  const std::chrono::duration<double> all = std::chrono::steady_clock::now() - begin;
  EXPECT_GE(time.seconds(), 0.04);
  EXPECT_LE(time.seconds(), all.count());
}

}  // namespace

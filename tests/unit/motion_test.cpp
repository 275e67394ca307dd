// Prescribed motions, each at an instant whose state can be worked out by hand.
#include "adapters/motion.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace {

using namespace crossgrain;

constexpr double rightAngle = 0.5 * std::numbers::pi;

void expectNear(const Vec2& got, const Vec2& wanted) {
  EXPECT_NEAR((got - wanted).norm(), 0.0, 1e-15)
      << got.transpose() << " for " << wanted.transpose();
}

TEST(Motion, OfEachKind) {
  const Vec2 start(1.0, 2.0);
  const BodyState turned =
      stateAt(Motion{.kind = Motion::Kind::rotating, .angularVelocity = 3.0}, start, 2.0);
  EXPECT_EQ(turned.angle, 6.0);
  EXPECT_EQ(turned.angularVelocity, 3.0);
  expectNear(turned.centre, start);
  const BodyState moved =
      stateAt(Motion{.kind = Motion::Kind::translating, .velocity = Vec2(0.5, -1.0)}, start, 2.0);
  expectNear(moved.centre, Vec2(2.0, 0.0));
  expectNear(moved.velocity, Vec2(0.5, -1.0));
  // A quarter of a period in, and at its end.
  const Motion swings{
      .kind = Motion::Kind::oscillating, .amplitude = Vec2(0.0, 3.0), .frequency = 2.0};
  const BodyState farthest = stateAt(swings, start, rightAngle / 2.0);
  expectNear(farthest.centre, Vec2(1.0, 5.0));
  expectNear(farthest.velocity, Vec2::Zero());
  expectNear(stateAt(swings, start, 0.0).velocity, Vec2(0.0, 6.0));
}

TEST(Motion, ARingShrinksUntilItsEnd) {
  const Motion shrinks{.kind = Motion::Kind::radial, .radialVelocity = -0.1, .radialEnd = 3.0};
  const BodyState during = stateAt(shrinks, Vec2::Zero(), 2.0);
  EXPECT_DOUBLE_EQ(during.radialShift, -0.2);
  EXPECT_EQ(during.radialVelocity, -0.1);
  for (const double t : {3.0, 5.0}) {
    const BodyState after = stateAt(shrinks, Vec2::Zero(), t);
    EXPECT_DOUBLE_EQ(after.radialShift, -0.3);
    EXPECT_EQ(after.radialVelocity, 0.0);
  }
}

TEST(Motion, MembersTurnAndSpreadAboutTheCentre) {
  BodyState now;
  now.centre = Vec2(10.0, 20.0);
  now.angle = rightAngle;
  now.radialShift = 1.0;  // of the member at distance 2: to 3
  expectNear(memberPosition(now, Vec2(1.0, 1.0), Vec2(3.0, 1.0)), Vec2(10.0, 23.0));
  expectNear(memberPosition(now, Vec2(1.0, 1.0), Vec2(1.0, 3.0)), Vec2(7.0, 20.0));
  expectNear(memberPosition(now, Vec2(1.0, 1.0), Vec2(1.0, 1.0)), now.centre);
  now.angle = 0.0;
  expectNear(memberPosition(now, Vec2(1.0, 1.0), Vec2(3.0, 1.0)), Vec2(13.0, 20.0));
  expectNear(memberPosition(now, Vec2(1.0, 1.0), Vec2(1.5, 1.0)), Vec2(11.5, 20.0));
}

/// v + ω × l, and away from the centre as fast wherever it is.
TEST(Motion, AMemberHasTheVelocityOfItsPlace) {
  BodyState now;
  now.centre = Vec2(1.0, 2.0);
  now.velocity = Vec2(0.0, 3.0);
  now.angularVelocity = 2.0;
  expectNear(memberVelocity(now, Vec2(1.0, 2.5)), Vec2(-1.0, 3.0));
  expectNear(memberVelocity(now, Vec2(1.5, 2.0)), Vec2(0.0, 4.0));
  now.radialVelocity = 0.4;
  expectNear(memberVelocity(now, Vec2(1.0, 2.5)), Vec2(-1.0, 3.4));
  expectNear(memberVelocity(now, Vec2(1.0, 4.0)), Vec2(-4.0, 3.4));
  expectNear(memberVelocity(now, now.centre), now.velocity);
}

}  // namespace

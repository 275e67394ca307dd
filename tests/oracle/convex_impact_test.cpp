// The impact of bodies of any shape at one point: by hand, against disks and spheres, by what holds
// of every impact, and against a stiff body that is integrated in time.
#include "oracle/convex_impact.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <stdexcept>

#include "oracle/collision_oracle.hpp"
#include "penalty_body.hpp"
#include "tests/support/draw.hpp"

namespace {

using namespace crossgrain;
using test::Draw;
using Kind = ImpactKind;

/// m = 1, on a floor, n = y.
ConvexImpactStart<2> onFloor(double inertia, const Vec2& arm, const Vec2& velocity, double e,
                             double mu) {
  ConvexImpactStart<2> start;
  start.body[0] = {1.0, 1.0 / inertia, arm, velocity, 0.0};
  start.normal = Vec2::UnitY();
  start.restitution = e;
  start.mu = mu;
  return start;
}

struct SquareRow {
  double e, mu, vx;
  Kind kind;
  double v[2], spin;
};

TEST(ConvexImpact, SquareOnItsCorner_NewtonsRestitution_TableOfSixDigits) {
  const double root = std::sqrt(0.75);  // cos 30°, by which it is turned
  for (const SquareRow& row : {SquareRow{0.0, 0.0, 0.0, Kind::slip, {0.0, -0.167334}, -9.143306},
                               {0.5, 0.0, 0.0, Kind::slip, {0.0, 0.248999}, -13.714959},
                               {0.5, 0.2, 1.0, Kind::stick, {0.981010, 0.237139}, -14.362976},
                               {0.5, 1.0, 0.3, Kind::stick, {0.491178, 0.368389}, -7.191343},
                               {0.8, 0.1, -2.0, Kind::slip, {-1.840137, 0.598633}, -11.002890}}) {
    const auto end = convexImpact(
        onFloor(0.01 / 6.0, 0.05 * Vec2(0.5 - root, -0.5 - root), {row.vx, -1.0}, row.e, row.mu));
    ASSERT_TRUE(end.newton);
    EXPECT_EQ(end.newton->kind, row.kind);
    EXPECT_NEAR(end.newton->velocity[0].x(), row.v[0], 1e-6);
    EXPECT_NEAR(end.newton->velocity[0].y(), row.v[1], 1e-6);
    EXPECT_NEAR(end.newton->spin[0], row.spin, 1e-6);
    EXPECT_EQ(end.judged, row.kind == Kind::slip);
  }
}

/// J = 1/12, cos² 45° = 1/2: B = 1 + 12 · (1/4)(1/2) = 5/2, P = 2/B = 0.8, v′ = −0.2,
/// ω′ = 12 · 0.8 · x.
TEST(ConvexImpact, RodAt45Degrees_NoFrictionNoLoss_ByHand) {
  const double x = -0.5 * std::numbers::sqrt2 / 2.0;
  const auto end = convexImpact(onFloor(1.0 / 12.0, {x, x}, {0.7, -1.0}, 1.0, 0.0));
  EXPECT_TRUE(end.judged);
  for (const auto& by : {*end.newton, end.poisson, end.stronge}) {
    EXPECT_NEAR(by.velocity[0].x(), 0.7, 1e-15);
    EXPECT_NEAR(by.velocity[0].y(), -0.2, 1e-15);
    EXPECT_NEAR(by.spin[0], 9.6 * x, 1e-14);
    EXPECT_NEAR(by.energyAfter, end.energyBefore, 1e-15);
  }
}

/// A = 2, B = 5, C = 2 and µ = 1/2, so that C > µ A: from u = (−3, −18) slip and approach change by
/// 3 and 6 a unit of p; at p = 1, u = (0, −12), by 1 and 4; compression ends at p = 4 with
/// W = −15 − 18.
ConvexImpactStart<2> reversal(double e) {
  return onFloor(1.0, {2.0, -1.0}, {-3.0, -18.0}, e, 0.5);
}

TEST(ConvexImpact, SlipReverses_PoissonAndStronge_ByHand) {
  const auto end = convexImpact(reversal(0.5));
  EXPECT_FALSE(end.judged);
  EXPECT_EQ(end.poisson.kind, Kind::slipThenReversed);
  EXPECT_EQ(end.stronge.kind, Kind::slipThenReversed);
  // p = 6, of which one unit in the first direction.
  EXPECT_NEAR(end.poisson.impulse.y(), 6.0, 1e-13);
  EXPECT_NEAR(end.poisson.impulse.x(), 0.5 * 1.0 - 0.5 * 5.0, 1e-13);
  // ½ · 4 · Δp² = 33/4.
  const double p = 4.0 + std::sqrt(33.0 / 8.0);
  EXPECT_NEAR(end.stronge.impulse.y(), p, 1e-13);
  EXPECT_NEAR(end.stronge.impulse.x(), 0.5 - 0.5 * (p - 1.0), 1e-13);
}

/// Without slip P = (−6.5, 8), outside the cone; so P_t = P_n/2, P_n = 27/(5 + 1) or, at e = 1, 6,
/// where u′ = (15, 18) and the gain is ½ (12 · 3 + 0 · 6).
TEST(ConvexImpact, SlipReverses_NewtonsGainsEnergy_ByHand) {
  const auto half = convexImpact(reversal(0.5));
  EXPECT_EQ(half.newton->kind, Kind::slip);
  EXPECT_NEAR(half.newton->impulse.y(), 4.5, 1e-13);
  EXPECT_NEAR(half.newton->impulse.x(), 2.25, 1e-13);
  const auto whole = convexImpact(reversal(1.0));
  EXPECT_NEAR(whole.newton->gain, 18.0, 1e-12);
  EXPECT_NEAR(whole.newton->energyAfter - whole.energyBefore, 18.0, 1e-11);
  EXPECT_LT(whole.poisson.gain, 0.0);
  EXPECT_LT(whole.stronge.gain, 0.0);
}

/// A = B = 2, C = 1, µ = 1: from u = (2, −3) slip and approach change by −1 and 1; at p = 2,
/// u = (0, −1), it sticks (C/A < µ) and u_n rises by 3/2: p_c = 8/3, W = −4 − 1/3.
TEST(ConvexImpact, SlipStops_ByHand) {
  const auto end = convexImpact(onFloor(1.0, {1.0, -1.0}, {2.0, -3.0}, 0.5, 1.0));
  EXPECT_EQ(end.poisson.kind, Kind::slipThenStick);
  EXPECT_NEAR(end.poisson.impulse.y(), 4.0, 1e-14);
  EXPECT_NEAR(end.poisson.impulse.x(), -2.0 - 0.5 * 2.0, 1e-14);
  EXPECT_NEAR(end.stronge.impulse.y(), 8.0 / 3.0 + std::sqrt(13.0 / 9.0), 1e-14);
  // u_n′ = 3/2, u_t′ = 0.
  EXPECT_EQ(end.newton->kind, Kind::stick);
  EXPECT_NEAR(end.newton->impulse.y(), (2.0 * 4.5 + 2.0) / 3.0, 1e-14);
}

/// B = 1 + 9, A = 2, C = 3, µ = 4: B < µ C, so that the approach grows by 2 a unit of p while the
/// slip falls by 5; it stops at p = 1 with u_n = −3, sticks, and u_n rises by 11/2.
TEST(ConvexImpact, SlipThatJams_ByHand) {
  const auto end = convexImpact(onFloor(1.0, {3.0, -1.0}, {5.0, -1.0}, 0.5, 4.0));
  EXPECT_EQ(end.stronge.kind, Kind::slipThenStick);
  const double rest = 6.0 / 11.0, work = -2.0 - 0.5 * 3.0 * rest;
  EXPECT_NEAR(end.poisson.impulse.y(), 1.5 * (1.0 + rest), 1e-13);
  EXPECT_NEAR(end.stronge.impulse.y(), 1.0 + rest + std::sqrt(-0.25 * work * 2.0 / 5.5), 1e-13);
  EXPECT_LT(end.stronge.gain, 0.0);
}

TEST(ConvexImpact, NoSlipAtFirst_SticksInsideTheConeOrSlipsAlongTheCoupling) {
  for (const double mu : {0.4, 0.6}) {  // C/A = 1/2
    const auto end = convexImpact(onFloor(1.0, {1.0, -1.0}, {0.0, -3.0}, 0.5, mu));
    EXPECT_EQ(end.stronge.kind, mu < 0.5 ? Kind::slip : Kind::stick);
    EXPECT_NEAR(end.stronge.impulse.x(), -std::min(mu, 0.5) * end.stronge.impulse.y(), 1e-14);
    EXPECT_TRUE(end.judged);
  }
}

TEST(ConvexImpact, PartingBodies_NoImpulse) {
  const auto end = convexImpact(onFloor(1.0, {1.0, -1.0}, {2.0, 0.1}, 0.5, 1.0));
  EXPECT_EQ(end.stronge.kind, Kind::separating);
  EXPECT_TRUE(end.judged);
  EXPECT_EQ(end.stronge.velocity[0], Vec2(2.0, 0.1));
  EXPECT_EQ(end.stronge.impulse, Vec2(0.0, 0.0));
}

/// A wall at 1 m/s under a rod: as the wall at rest, seen from it.
TEST(ConvexImpact, MovingWall_GainIsThatOfTheWallsFrame) {
  const auto rest = convexImpact(onFloor(0.1, {0.4, -0.3}, {0.5, -1.0}, 0.5, 0.3)).stronge;
  ConvexImpactStart<2> start = onFloor(0.1, {0.4, -0.3}, {0.5, 0.0}, 0.5, 0.3);
  start.body[1].velocity = {0.0, 1.0};
  const auto end = convexImpact(start);
  EXPECT_NEAR(end.stronge.gain, rest.gain, 1e-15);
  EXPECT_NEAR((end.stronge.velocity[0] - rest.velocity[0] - Vec2(0.0, 1.0)).norm(), 0.0, 1e-15);
  EXPECT_GT(end.stronge.energyAfter, end.energyBefore);  // the wall's work
  EXPECT_EQ(end.stronge.velocity[1], Vec2(0.0, 1.0));
}

TEST(ConvexImpact, BadInput_Throws) {
  const auto refused = [](const auto& change) {
    ConvexImpactStart<2> start = onFloor(1.0, {1.0, -1.0}, {2.0, -3.0}, 0.5, 1.0);
    change(start);
    EXPECT_THROW(convexImpact(start), std::invalid_argument);
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  refused([](auto& start) { start.normal *= 1.001; });
  refused([](auto& start) { start.restitution = 1.1; });
  refused([=](auto& start) { start.restitution = nan; });
  refused([](auto& start) { start.mu = -0.1; });
  refused([](auto& start) { start.body[1].mass = 0.0; });
  refused([](auto& start) { start.body[0].mass = std::numeric_limits<double>::infinity(); });
}

/// Arms along n: C = 0, and Walton's closed form with a tangential restitution of 0.
TEST(ConvexImpact, DisksAndSpheres_AsTheRigidLaw) {
  ContactLaw law{.normal = NormalLaw::rigid, .en = 0.7, .et0 = 0.0};
  CollidingPair pair{{0.5, 0.8}, {1.0, 3.0}, {}};
  for (const int side : {0, 1})
    pair.inertia[side] = 0.4 * pair.mass[side] * pair.radius[side] * pair.radius[side];
  for (const double mu : {0.05, 0.8}) {
    law.mu = mu;
    CollisionStart start{1.3, 2.0, Approach::oblique};
    const PairMotion before = motionBefore(pair, start);
    ConvexImpactStart<2> plane{.normal = Vec2::UnitX(), .restitution = law.en, .mu = mu};
    for (const int side : {0, 1})
      plane.body[side] = {pair.mass[side], 1.0 / pair.inertia[side],
                          Vec2(side == 0 ? -pair.radius[0] : pair.radius[1], 0.0)};
    plane.body[0].velocity = {before.normal, before.tangential};
    const CollisionEnd right = rigidOutcome(law, pair, start);
    const auto end = convexImpact(plane);
    EXPECT_TRUE(end.judged);
    const Vec2 apart = end.stronge.velocity[0] - end.stronge.velocity[1];
    EXPECT_NEAR(apart.x(), right.en * start.vn, 1e-14);
    EXPECT_NEAR(apart.y(), right.centrePsi * start.vn, 1e-14);
    for (const int side : {0, 1}) EXPECT_NEAR(end.stronge.spin[side], right.spin[side], 1e-14);

    start.spinOutOfPlane[0] = {0.7, -2.0};
    start.spinOutOfPlane[1] = {0.1, 0.4};
    const SpaceMotion motion = spaceMotionBefore(pair, start);
    ConvexImpactStart<3> space{.normal = Vec3::UnitX(), .restitution = law.en, .mu = mu};
    for (const int side : {0, 1}) {
      space.body[side].mass = pair.mass[side];
      space.body[side].inverseInertia = Eigen::Matrix3d::Identity() / pair.inertia[side];
      space.body[side].arm = plane.body[side].arm.x() * Vec3::UnitX();
      space.body[side].spin = motion.spin[side];
    }
    space.body[0].velocity = motion.velocity;
    const CollisionEnd rightInSpace = rigidOutcomeInSpace(law, pair, start);
    const auto inSpace = convexImpact(space);
    EXPECT_TRUE(inSpace.judged);
    const Vec3 left = inSpace.stronge.velocity[0] - inSpace.stronge.velocity[1];
    EXPECT_NEAR(left.y(), rightInSpace.centrePsi * start.vn, 1e-14);
    for (const int side : {0, 1}) {
      const EndOutOfPlane& besides = *rightInSpace.outOfPlane;
      const Vec3 spin(besides.spinNormal[side], besides.spinTangent[side], rightInSpace.spin[side]);
      EXPECT_NEAR((inSpace.stronge.spin[side] - spin).norm(), 0.0, 1e-14);
    }
  }
}

Vec3 drawVector(Draw& draw) {
  return {draw.uniform(-1.0, 1.0), draw.uniform(-1.0, 1.0), draw.uniform(-1.0, 1.0)};
}

Eigen::Matrix3d drawTurn(Draw& draw) {
  return Eigen::AngleAxisd(draw.uniform(0.0, 6.0), drawVector(draw).normalized())
      .toRotationMatrix();
}

template <int D>
ConvexImpactBody<D> drawBody(Draw& draw) {
  ConvexImpactBody<D> body;
  body.mass = draw.logarithmic(0.1, 10.0);
  body.arm = drawVector(draw).head<D>();
  body.velocity = 2.0 * drawVector(draw).head<D>();
  const double unit = draw.logarithmic(1.0, 30.0) / body.mass;
  if constexpr (D == 2) {
    body.inverseInertia = unit;
    body.spin = draw.uniform(-2.0, 2.0);
  } else {
    const Eigen::Matrix3d turn = drawTurn(draw);
    const Vec3 axes(1.0, draw.uniform(1.0, 2.0), draw.uniform(1.0, 2.0));
    body.inverseInertia = unit * (turn * axes.asDiagonal() * turn.transpose());
    body.spin = 2.0 * drawVector(draw);
  }
  return body;
}

/// u at the start.
template <int D>
VecOf<D> approach(const ConvexImpactStart<D>& start) {
  return velocityAtContact(start.body[0]) - velocityAtContact(start.body[1]);
}

/// Two bodies, or one and a wall, that meet.
template <int D>
ConvexImpactStart<D> drawStart(Draw& draw) {
  ConvexImpactStart<D> start;
  start.body[0] = drawBody<D>(draw);
  if (draw.oneOf({true, false})) start.body[1] = drawBody<D>(draw);
  start.normal = drawVector(draw).head<D>().normalized();
  if (approach(start).dot(start.normal) > 0.0) start.normal *= -1.0;
  start.restitution = draw.oneOf({0.0, 1.0, draw.uniform(0.0, 1.0), draw.uniform(0.0, 1.0)});
  start.mu = draw.uniform(0.0, 1.5);
  return start;
}

/// u′ at the end.
template <int D>
VecOf<D> approachAfter(const ConvexImpactStart<D>& start, const ImpactOutcome<D>& end) {
  ConvexImpactStart<D> after = start;
  for (const int side : {0, 1}) {
    after.body[side].velocity = end.velocity[side];
    after.body[side].spin = end.spin[side];
  }
  return approach(after);
}

template <int D>
void momentumConeEnergyAndEnd() {
  Draw draw(7 + D);
  std::set<Kind> met;
  int judged = 0;
  for (int trial = 0; trial < (D == 2 ? 20'000 : 4'000); ++trial) {
    const ConvexImpactStart<D> start = drawStart<D>(draw);
    const auto all = convexImpact(start);
    judged += all.judged;
    const VecOf<D>& n = start.normal;
    const double un = approach(start).dot(n), speed = approach(start).norm();
    const auto check = [&](const ImpactOutcome<D>& end) {
      const double pn = end.impulse.dot(n);
      const double size = all.energyBefore + std::abs(un) * pn;
      ASSERT_GT(pn, 0.0);
      ASSERT_LE((end.impulse - pn * n).norm(), start.mu * pn * (1.0 + 1e-11) + 1e-12 * pn);
      for (const int side : {0, 1}) {
        const ConvexImpactBody<D>& body = start.body[side];
        const VecOf<D> impulse = side == 0 ? end.impulse : VecOf<D>(-end.impulse);
        if (std::isinf(body.mass)) continue;
        const double momentum = pn + body.mass * body.velocity.norm();
        ASSERT_LT((body.mass * (end.velocity[side] - body.velocity) - impulse).norm(),
                  1e-14 * momentum);
        if constexpr (D == 2)
          ASSERT_NEAR((end.spin[side] - body.spin) / body.inverseInertia, cross(body.arm, impulse),
                      1e-13 * momentum);
        else
          ASSERT_LT((body.inverseInertia.inverse() * (end.spin[side] - body.spin) -
                     body.arm.cross(impulse))
                        .norm(),
                    1e-13 * momentum);
      }
      ASSERT_NEAR(end.energyAfter - all.energyBefore, end.gain, 1e-12 * size);
      const VecOf<D> after = approachAfter(start, end);
      const VecOf<D> slip = after - after.dot(n) * n;
      if (end.kind == Kind::stick || end.kind == Kind::slipThenStick) {
        ASSERT_LT(slip.norm(), 1e-12 * speed);
      }
      if (start.restitution == 0.0) {
        ASSERT_NEAR(after.dot(n), 0.0, 1e-12 * speed);
      }
    };
    if (all.newton) {
      check(*all.newton);
      ASSERT_NEAR(approachAfter(start, *all.newton).dot(n), -start.restitution * un, 1e-12 * speed);
    }
    ASSERT_GE(approachAfter(start, all.stronge).dot(n), -1e-12 * speed);
    if (D == 2) {
      ASSERT_GE(approachAfter(start, all.poisson).dot(n), -1e-12 * speed);
    }
    for (const auto& end : {all.poisson, all.stronge}) {
      check(end);
      ASSERT_LE(end.gain, 1e-12 * (all.energyBefore + std::abs(un) * end.impulse.dot(n)));
      met.insert(end.kind);
    }
  }
  EXPECT_EQ(met.size(), 3u);  // with a slip at the start
  EXPECT_GT(judged, 100);
}

TEST(ConvexImpact, RandomBodiesInThePlane_MomentumConeEnergyAndEnd) {
  momentumConeEnergyAndEnd<2>();
}
TEST(ConvexImpact, RandomBodiesInSpace_MomentumConeEnergyAndEnd) {
  momentumConeEnergyAndEnd<3>();
}

template <int D>
void expectSame(const ImpactOutcome<D>& a, const ImpactOutcome<D>& b, double tolerance) {
  EXPECT_EQ(a.kind, b.kind);
  EXPECT_LT((a.impulse - b.impulse).norm(), tolerance * b.impulse.norm());
}

TEST(ConvexImpact, PlaneInSpace_AsInThePlane) {
  Draw draw(5);
  for (int trial = 0; trial < 500; ++trial) {
    const ConvexImpactStart<2> start = drawStart<2>(draw);
    const Eigen::Matrix3d turn = trial == 0 ? Eigen::Matrix3d::Identity() : drawTurn(draw);
    const auto up = [&](const Vec2& v) -> Vec3 { return turn * Vec3(v.x(), v.y(), 0.0); };
    ConvexImpactStart<3> space{{}, up(start.normal), start.restitution, start.mu};
    for (const int side : {0, 1}) {
      const ConvexImpactBody<2>& body = start.body[side];
      const Vec3 axes(draw.uniform(0.5, 3.0), 0.0, 1.0);  // it cannot turn about y
      space.body[side] = {body.mass,
                          body.inverseInertia * (turn * axes.asDiagonal() * turn.transpose()),
                          up(body.arm), up(body.velocity), turn * Vec3(0.0, 0.0, body.spin)};
    }
    const auto flat = convexImpact(start);
    const auto full = convexImpact(space);
    EXPECT_EQ(flat.judged, full.judged);
    EXPECT_NEAR(full.energyBefore, flat.energyBefore, 1e-12 * flat.energyBefore);
    for (const auto by : {&ConvexImpact<3>::poisson, &ConvexImpact<3>::stronge}) {
      const ImpactOutcome<3>& end = full.*by;
      const auto& right = by == &ConvexImpact<3>::poisson ? flat.poisson : flat.stronge;
      EXPECT_EQ(end.kind, right.kind);
      EXPECT_LT((end.impulse - up(right.impulse)).norm(), 1e-10 * right.impulse.norm());
      EXPECT_LT((end.spin[0] - turn * Vec3(0.0, 0.0, right.spin[0])).norm(), 1e-10 * 30.0);
    }
    ASSERT_TRUE(full.newton && flat.newton);
    EXPECT_LT((full.newton->impulse - up(flat.newton->impulse)).norm(),
              1e-10 * flat.newton->impulse.norm());
  }
}

TEST(ConvexImpact, TurnedScene_TurnedOutcome) {
  Draw draw(3);
  for (int trial = 0; trial < 500; ++trial) {
    const ConvexImpactStart<3> start = drawStart<3>(draw);
    const Eigen::Matrix3d turn = drawTurn(draw);
    ConvexImpactStart<3> turned{{}, turn * start.normal, start.restitution, start.mu};
    for (const int side : {0, 1}) {
      const ConvexImpactBody<3>& body = start.body[side];
      turned.body[side] = {body.mass, turn * body.inverseInertia * turn.transpose(),
                           turn * body.arm, turn * body.velocity, turn * body.spin};
    }
    const auto here = convexImpact(start), there = convexImpact(turned);
    ImpactOutcome<3> right = here.stronge;
    right.impulse = turn * right.impulse;
    expectSame(there.stronge, right, 1e-10);
    for (const int side : {0, 1})
      EXPECT_LT((there.stronge.velocity[side] - turn * here.stronge.velocity[side]).norm(), 1e-9);
    // Bodies that change places.
    const auto swapped = convexImpact<3>(
        {{start.body[1], start.body[0]}, -start.normal, start.restitution, start.mu});
    right.impulse = -here.stronge.impulse;
    expectSame(swapped.stronge, right, 1e-10);
  }
}

/// B = 1 + 8 · 3² + 3² = 82 and C along the slip 8 · 2 · 3 = 48: with µ = 2 the impulse of a slip
/// that does not turn deepens the approach, and without slip at the end it is outside the cone.
TEST(ConvexImpact, JamInSpace_NewtonsHasNone) {
  ConvexImpactStart<3> start{{}, Vec3::UnitZ(), 0.5, 2.0};
  start.body[0] = {1.0, Vec3(8.0, 1.0, 1.0).asDiagonal(), Vec3(-3.0, 3.0, -2.0),
                   Vec3(0.0, 4.0, -1.0)};
  const auto end = convexImpact(start);
  EXPECT_FALSE(end.newton);
  EXPECT_FALSE(end.judged);
  EXPECT_TRUE(std::isinf(end.spread));
  EXPECT_LT(end.stronge.gain, 0.0);
  EXPECT_GT(approachAfter(start, end.stronge).z(), 0.0);
}

/// u and M are twice those of one body: the impulse is the same.
template <int D>
void bodyAndItsInversion() {
  Draw draw(13);
  for (int trial = 0; trial < 200; ++trial) {
    ConvexImpactStart<D> start = drawStart<D>(draw);
    start.body[1] = {};
    if (approach(start).dot(start.normal) > 0.0) start.normal *= -1.0;
    const auto wall = convexImpact(start);
    start.body[1] = start.body[0];
    start.body[1].arm *= -1.0;
    start.body[1].velocity *= -1.0;
    expectSame(convexImpact(start).stronge, wall.stronge, 1e-10);
  }
}

TEST(ConvexImpact, BodyAndItsInversion_AsOneAndAWall) {
  bodyAndItsInversion<2>();
  bodyAndItsInversion<3>();
}

/// du/dp = M (n − µ t) in equal steps of p, by the rule of Runge and Kutta.
TEST(ConvexImpact, SlipThatTurns_AsIntegratedByTheNormalImpulse) {
  Draw draw(17);
  int slips = 0;
  for (int trial = 0; slips < 20 && trial < 10'000; ++trial) {
    const ConvexImpactStart<3> start = drawStart<3>(draw);
    const auto all = convexImpact(start);
    if (all.poisson.kind != Kind::slip || all.stronge.kind != Kind::slip || all.judged) continue;
    const Vec3& n = start.normal;
    const auto change = [&](const Vec3& u) {
      const Vec3 slip = u - u.dot(n) * n;
      const Vec3 impulse = n - start.mu * slip.normalized();
      Vec3 sum = Vec3::Zero();
      for (const ConvexImpactBody<3>& body : start.body)
        sum +=
            impulse / body.mass + (body.inverseInertia * body.arm.cross(impulse)).cross(body.arm);
      return sum;
    };
    Vec3 u = approach(start);
    double work = 0.0, nearest = 1.0;
    const auto go = [&](double length) {
      constexpr int steps = 4000;
      const double h = length / steps;
      for (int i = 0; i < steps; ++i) {
        const Vec3 a = change(u), b = change(u + 0.5 * h * a), c = change(u + 0.5 * h * b),
                   d = change(u + h * c);
        work += h * (u.dot(n) + h / 6.0 * (a + b + c).dot(n));
        u += h / 6.0 * (a + 2.0 * b + 2.0 * c + d);
        nearest = std::min(nearest, (u - u.dot(n) * n).norm());
      }
    };
    const double compression = all.poisson.impulse.dot(n) / (1.0 + start.restitution);
    go(compression);
    const double ofCompression = work;
    const double closing = u.dot(n);
    go(all.stronge.impulse.dot(n) - compression);
    if (nearest < 0.05) continue;  // where equal steps of p are too long
    ++slips;
    EXPECT_NEAR(closing, 0.0, 1e-11);
    EXPECT_NEAR(work, (1.0 - start.restitution * start.restitution) * ofCompression, 1e-11);
    EXPECT_LT((u - approachAfter(start, all.stronge)).norm(), 1e-11);
  }
  EXPECT_EQ(slips, 20);
}

/// A body in space on a wall, and one whose impact stays in a plane.
ConvexImpactStart<3> drawOnWall(Draw& draw, bool flat) {
  ConvexImpactStart<3> start;
  ConvexImpactBody<3>& body = start.body[0];
  body = drawBody<3>(draw);
  start.normal = drawVector(draw);
  if (flat) {
    start.normal.z() = body.arm.z() = body.velocity.z() = body.spin.x() = body.spin.y() = 0.0;
    body.inverseInertia = body.inverseInertia(2, 2) * Eigen::Matrix3d::Identity();
  }
  start.normal.normalize();
  if (approach(start).dot(start.normal) > 0.0) start.normal *= -1.0;
  start.restitution = draw.uniform(0.2, 1.0);
  start.mu = draw.uniform(0.1, 1.5);
  return start;
}

/// Largest distance of velocity and spin, as a share of the speed at the contact.
double distanceFrom(const ConvexImpactStart<3>& start, const Vec3& velocity, const Vec3& spin) {
  const auto right = convexImpact(start).stronge;
  const double arm = start.body[0].arm.norm(), speed = approach(start).norm();
  return std::max((velocity - right.velocity[0]).norm(), arm * (spin - right.spin[0]).norm()) /
         speed;
}

/// Overlaps of about 1e-8 m. What is of first order in the step is extrapolated away.
TEST(ConvexImpact, StiffBodyInTime_ComesToStrongesOutcome) {
  for (const bool flat : {true, false})
    for (const Kind kind : {Kind::slip, Kind::slipThenStick, Kind::slipThenReversed}) {
      Draw draw(31);
      int found = 0;
      for (int trial = 0; found < 5 && trial < 10'000; ++trial) {
        const ConvexImpactStart<3> start = drawOnWall(draw, flat);
        if (convexImpact(start).stronge.kind != kind) continue;
        ++found;
        const double k = 1e16 * start.body[0].mass;
        const auto coarse = test::penaltyImpact(start, {k, 1000}),
                   fine = test::penaltyImpact(start, {k, 2000});
        const double d = distanceFrom(start, 2.0 * fine.velocity - coarse.velocity,
                                      2.0 * fine.spin - coarse.spin);
        EXPECT_LT(d, 1e-6) << "flat " << flat << ", kind " << int(kind) << ", number " << found;
      }
      EXPECT_EQ(found, 5);
    }
}

TEST(ConvexImpact, StiffBodyInTime_DistanceFallsAsTheOverlap) {
  ConvexImpactStart<3> start;
  start.body[0] = {1.0, Eigen::Matrix3d::Identity(), Vec3(2.0, -1.0, 0.0),
                   Vec3(-3.0, -18.0, 0.0)};  // as reversal()
  start.normal = Vec3::UnitY();
  start.restitution = 0.5;
  start.mu = 0.5;
  double before = 0.0;
  for (const double k : {1e8, 1e10, 1e12}) {
    const auto end = test::penaltyImpact(start, {k, 2000});
    const double distance = distanceFrom(start, end.velocity, end.spin);
    if (before > 0.0) {
      EXPECT_NEAR(before / distance, 10.0, 0.5);
    }
    before = distance;
  }
}

}  // namespace

// Springs of pairs whose motion is prescribed (studies/conformance/moved_pairs.hpp) against
// integrals in closed form.
#include "studies/conformance/moved_pairs.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

namespace crossgrain::conformance {
namespace {

constexpr int many = 20000;  // steps: what is of first order in one is 1e-4 in a turn of 1 rad

Vec3 lastForce(const MovedPair& pair, const ContactLaw& law, int steps = many) {
  return springForces(pair, {law}, movedTime / steps, steps).back();
}

TEST(MovedPairs, PassingPair_StretchesItsSpringByTheIntegralOfItsSlip) {
  // In the plane of the path, n = (cos θ, sin θ), tan θ = v t/b: v_t = v cos θ − Σ c ω_z, of which
  // the first is v b/√(b² + v² t²), with the integral 2 b asinh(h/b) from −h to h. Across it is
  // (c_0 − c_1) ω_n′ with ω_n′ = p cos θ of the opposite spins ±p along the path, whose integral is
  // (c_0 − c_1) p b/v · 2 asinh(h/b). With arms that are the radii c is constant.
  const MovedPair pair = passingPair();
  ContactLaw law = movedLaw();
  law.conventions.velocityArm = VelocityArm::radius;
  const Vec3 relative = pair.velocity[0] - pair.velocity[1];
  const double v = relative.norm(), half = 0.5 * v * movedTime;
  const Vec3 along = relative / v, across = pair.apart(0.0).cross(along).normalized();
  const double b = pair.apart(0.5 * movedTime).norm();
  const double covered = 2.0 * b * std::asinh(half / b);
  double spins = 0.0;
  for (const int side : {0, 1}) spins += pair.radii[side] * pair.spin[side].dot(across);
  const double inPlane = covered - spins * movedTime;
  const double p = pair.spin[0].dot(along);
  const double outOfPlane = (pair.radii[0] - pair.radii[1]) * p * covered / v;
  const Vec3 n = pair.apart(movedTime).normalized();
  for (const SpringTurn turn :
       {SpringTurn::rotated, SpringTurn::firstOrder, SpringTurn::rescaled, SpringTurn::projected}) {
    law.conventions.springTurn = turn;
    const Vec3 stretch = -lastForce(pair, law) / law.kt;
    EXPECT_NEAR(stretch.dot(n), 0.0, 1e-12);
    EXPECT_NEAR(stretch.dot(across.cross(n)), inPlane, 1e-4 * std::abs(inPlane));
    EXPECT_NEAR(std::abs(stretch.dot(across)), std::abs(outOfPlane), 1e-4 * std::abs(outOfPlane));
  }
}

TEST(MovedPairs, SpringThatDoesNotFollow_KeepsWhatTheNormalTurnedAwayFrom) {
  const MovedPair pair = passingPair();
  SpringMotion motion{movedLaw()};
  const double follows = springForces(pair, motion, movedTime / many, many).back().norm();
  motion.staysInSpace = true;
  const double stays = springForces(pair, motion, movedTime / many, many).back().norm();
  EXPECT_GT(std::abs(follows - stays), 0.01 * follows);
}

TEST(MovedPairs, TwistingPair_HasASpringThatIsAChordOfItsTurn) {
  // dξ/dt = u + Ω n × ξ with constant u ⟂ n: |ξ| = 2 (u/Ω) sin(Ω t/2), and u t without a twist.
  const MovedPair pair = twistingPair();
  ContactLaw law = movedLaw();
  const Vec3 n = pair.apart(0.0).normalized();
  const double turn = 0.5 * (pair.spin[0] + pair.spin[1]).dot(n);
  EXPECT_NEAR(turn * movedTime, 1.0, 1e-12);
  const double slip = pair.apart(0.0).norm() * (pair.spin[0] - pair.spin[0].dot(n) * n).norm();
  const double chord = 2.0 * slip / turn * std::sin(0.5 * turn * movedTime);
  EXPECT_NEAR(lastForce(pair, law).norm(), law.kt * chord, 1e-4 * law.kt * chord);
  law.conventions.springTwist = SpringTwist::none;
  law.conventions.springUpdate = SpringUpdate::before;
  const double straight = law.kt * slip * movedTime;
  EXPECT_NEAR(lastForce(pair, law).norm(), straight, 1e-4 * straight);
}

TEST(MovedPairs, ArmsThatAreTheRadii_StretchATurningPairsSpringByItsOverlap) {
  // Two of the same spin ω that turn by ω t: v_t by arms that add up to a_i + a_j is larger by δ ω
  // than by arms that add up to the distance, so that F_t differs by k_t δ Θ.
  const MovedPair pair = twistingPair();
  ContactLaw law = movedLaw();
  law.conventions.springTwist = SpringTwist::none;
  law.conventions.springUpdate = SpringUpdate::before;
  const Vec3 meet = lastForce(pair, law, movedSteps);
  law.conventions.velocityArm = VelocityArm::radius;
  const Vec3 radii = lastForce(pair, law, movedSteps);
  const Vec3 n = pair.apart(0.0).normalized();
  const double overlap = pair.reach() - pair.apart(0.0).norm();
  const double turn = (pair.spin[0] - pair.spin[0].dot(n) * n).norm() * movedTime *
                      (movedSteps + 1.0) / movedSteps;  // a stretch at 0 s, too
  EXPECT_NEAR((radii - meet).norm(), law.kt * overlap * turn, 1e-9 * radii.norm());
}

TEST(MovedPairs, FirstOrderAndProjection_GrowAndShrinkAsMuch) {
  // exp(±½ Σ ΔΘ²) of a spring that turns by Θ: opposite, to the order of ΔΘ².
  const MovedPair pair = passingPair();
  ContactLaw law = movedLaw();
  const double wanted = lastForce(pair, law, movedSteps).norm();
  law.conventions.springTurn = SpringTurn::firstOrder;
  const double grown = lastForce(pair, law, movedSteps).norm() - wanted;
  law.conventions.springTurn = SpringTurn::projected;
  const double shrunk = wanted - lastForce(pair, law, movedSteps).norm();
  EXPECT_GT(grown, 1e-4 * wanted);
  EXPECT_NEAR(grown, shrunk, 0.02 * grown);
}

TEST(MovedPairs, RollingPair_HasASpringThatIsAChordOfItsTurn) {
  // dθ/dt = ω_r + Ω n × θ with constant ω_r ⟂ n, as ξ of the twisting pair: M = k_r R₁₂² 2 (ω_r/Ω)
  // sin(Ω t/2), R₁₂ = 2.4 mm. n stays, so that θ × n is turned with it.
  const MovedPair pair = rollingPair();
  ContactLaw law = rollingLaw(movedLaw());
  const Vec3 n = pair.apart(0.0).normalized(), relative = pair.spin[0] - pair.spin[1];
  const double turn = 0.5 * (pair.spin[0] + pair.spin[1]).dot(n);
  const double rolls = (relative - relative.dot(n) * n).norm();
  EXPECT_NEAR(rolls, 600.0, 1e-9);
  const double angle = 2.0 * rolls / turn * std::sin(0.5 * turn * movedTime);
  const double wanted = law.kr * 0.0024 * 0.0024 * angle;
  for (const bool asDisplacement : {false, true}) {
    SpringMotion motion{law};
    motion.asDisplacement = asDisplacement;
    const Vec3 torque = rollingTorques(pair, motion, movedTime / many, many).back();
    EXPECT_NEAR(torque.norm(), wanted, 1e-4 * wanted);
    EXPECT_NEAR(torque.dot(n), 0.0, 1e-9 * wanted);
  }
}

TEST(MovedPairs, RollingSpringAsDisplacement_TurnsAsTheAngleToSecondOrder) {
  // Where |ξ| is kept by its length alone, θ and θ × n leave the plane of n's turn by other parts:
  // ½ ΔΘ² of each step, Σ ½ ΔΘ² = ½ Θ ΔΘ in all at most.
  const MovedPair pair = passingPair();
  SpringMotion motion{rollingLaw(movedLaw())};
  motion.law.conventions.springTurn = SpringTurn::rescaled;
  for (const int steps : {movedSteps, 10 * movedSteps}) {
    const double dt = movedTime / steps;
    motion.asDisplacement = false;
    const Vec3 angle = rollingTorques(pair, motion, dt, steps).back();
    motion.asDisplacement = true;
    const Vec3 displacement = rollingTorques(pair, motion, dt, steps).back();
    const double turn = 0.76, part = (angle - displacement).norm() / angle.norm();
    EXPECT_GT(part, 1e-2 * turn * turn / steps);
    EXPECT_LT(part, turn * turn / steps);
  }
}

TEST(MovedPairs, Motions_BeginWithWhatIsDeclared) {
  const std::vector<SpringMotion> motions = springMotions(movedLaw());
  EXPECT_EQ(motions.front().differenceFrom(movedLaw()), "");
  EXPECT_EQ(motions[1].differenceFrom(movedLaw()).find(';'), std::string::npos);
  EXPECT_NE(motions.back().differenceFrom(movedLaw()).find(';'), std::string::npos);
}

}  // namespace
}  // namespace crossgrain::conformance

// The oracle of contacts that resist rolling: closed forms, coupling with friction, small steps.
#include <gtest/gtest.h>

#include <cmath>

#include "oracle/collision_end.hpp"
#include "oracle/collision_oracle.hpp"
#include "oracle/impact.hpp"
#include "random_pair.hpp"
#include "tests/support/pairs.hpp"

namespace {

using namespace crossgrain;
using namespace test;

/// A disk of 5 mm and 1 g, k_n = 1e4 N/m, neither damping nor friction: f_n = k_n (v/ω₀) sin ω₀t.
CollidingPair disk() {
  return diskOnWall(5e-3, 1e-3, 0.5 * 1e-3 * 25e-6);
}
ContactLaw rolling(RollingLaw kind) {
  return ContactLaw{.tangential = TangentialLaw::none, .kn = 1e4, .rolling = kind};
}
const double speed = 0.1, contact = M_PI / std::sqrt(1e4 / 1e-3), impulse = 2.0 * 1e-3 * speed;

/// ω falls by µ_r L ∫ f_n dt/J = µ_r L 2 m v/J, or to rest.
TEST(RollingOracle, ConstantTorque_TakesTheImpulseTimesItsArm) {
  ContactLaw law = rolling(RollingLaw::constantTorque);
  law.muR = 0.02;
  const CollidingPair pair = disk();
  for (const auto& [length, arm] :
       {std::pair{RollingLength::effective, 5e-3}, std::pair{RollingLength::twiceEffective, 1e-2},
        std::pair{RollingLength::smallerRadius, 5e-3}}) {
    law.conventions.rollingLength = length;
    const double lost = law.muR * arm * impulse / pair.inertia[0];
    for (const double factor : {0.5, 3.0}) {
      const double psi = factor * lost * 5e-3 / speed;  // ω = −Ψ v/a
      const CollisionEnd end = oracleOutcome(law, pair, {psi, speed, Approach::firstSpin});
      EXPECT_NEAR(end.spin[0], factor > 1.0 ? -(factor - 1.0) * lost : 0.0, 1e-9 * lost);
      EXPECT_NEAR(end.en, 1.0, 1e-10);
      EXPECT_NEAR(end.lost->rolling.value(), end.energyBefore - end.energyAfter,
                  1e-10 * end.energyBefore);
      EXPECT_FALSE(end.lost->rollingDamping);
    }
  }
}

/// ω = ω₀ exp(−γ_r L² t_c/J); by the load exp(−µ_r L² 2 m v/J).
TEST(RollingOracle, Viscous_DecaysExponentially) {
  const CollidingPair pair = disk();
  ContactLaw law = rolling(RollingLaw::viscous);
  law.gr = 0.3;
  const double omega = -speed / 5e-3;
  const CollisionStart start{1.0, speed, Approach::firstSpin};
  CollisionEnd end = oracleOutcome(law, pair, start);
  EXPECT_NEAR(end.spin[0], omega * std::exp(-0.3 * 25e-6 * contact / pair.inertia[0]), 1e-9);
  EXPECT_NEAR(end.lost->rollingDamping.value(), end.energyBefore - end.energyAfter,
              1e-10 * end.energyBefore);
  EXPECT_FALSE(end.lost->rolling);
  law = rolling(RollingLaw::viscousByLoad);
  law.muR = 2.0;
  end = oracleOutcome(law, pair, start);
  EXPECT_NEAR(end.spin[0], omega * std::exp(-2.0 * 25e-6 * impulse / pair.inertia[0]), 1e-9);
}

/// A pair with its own moments of inertia and a spring that does not slip, µ_r → ∞ times a load
/// that begins at F_po (a dashpot slips where there is none): ω_r = ω_r0 e^(−ηt) (cos Ωt − η/Ω sin
/// Ωt), J_i ω_i + J_j ω_j kept.
TEST(RollingOracle, Spring_OscillatesAsItsClosedForm) {
  const CollidingPair pair = unequalPair();
  const double inverse = 1.0 / pair.inertia[0] + 1.0 / pair.inertia[1];
  const double a = pair.radius[0], b = pair.radius[1], R = pair.reducedRadius();
  for (const auto& [stiffness, square] :
       {std::pair{RollingStiffness::lengthSquare, R * R}, std::pair{RollingStiffness::radii, a * b},
        std::pair{RollingStiffness::constant, 1.0}})
    for (const double ratio : {0.0, 0.2}) {
      ContactLaw law = thesisLaw();
      law.gn = 0.0;
      law.tangential = TangentialLaw::none;
      law.cohesion = CohesionLaw::dmt;
      law.w = 1e-4;
      law.conventions.cohesionLoad = CohesionLoad::plusTwicePullOff;
      law.rolling = RollingLaw::spring;
      law.muR = 1e9;
      law.gr = ratio;
      law.conventions.rollingStiffness = stiffness;
      law.conventions.rollingDamper = RollingDamper::critical;
      law.conventions.rollingReset = SpringReset::springOnly;
      const double K = 0.4 * law.kn * a * a;
      law.kr = K / square;
      const double about = 1.0 / (pair.inertia[0] + pair.mass[0] * a * a) +
                           1.0 / (pair.inertia[1] + pair.mass[1] * b * b);
      const double eta = ratio * std::sqrt(K / about) * inverse;
      const double omega = std::sqrt(K * inverse - eta * eta);
      const CollisionStart start{1.0, 0.01, Approach::firstSpin};
      const double before = motionBefore(pair, start).spin[0];
      const CollisionEnd end = oracleOutcome(law, pair, start);
      const double t = end.duration.value();
      const double expected =
          before * std::exp(-eta * t) * (std::cos(omega * t) - eta / omega * std::sin(omega * t));
      EXPECT_NEAR(end.spin[0] - end.spin[1], expected, 1e-7 * std::abs(before)) << ratio;
      EXPECT_NEAR(pair.inertia[0] * end.spin[0] + pair.inertia[1] * end.spin[1],
                  pair.inertia[0] * before, 1e-12 * pair.inertia[0] * std::abs(before));
      EXPECT_EQ(end.lost->rollingDamping.has_value(), ratio > 0.0);
    }
}

/// Sliding throughout beside type A: both bounds act, Δω = (a µ ∓ µ_r L) 2 m v/J.
TEST(RollingOracle, BesideSliding_BothBoundsAct) {
  ContactLaw law = rolling(RollingLaw::constantTorque);
  law.tangential = TangentialLaw::coulomb;
  law.mu = 0.1;
  law.muR = 0.05;
  const CollidingPair pair = disk();
  const CollisionEnd end = oracleOutcome(law, pair, {5.0, speed, Approach::firstSpin});
  const double before = -5.0 * speed / 5e-3;
  const double turned = (5e-3 * law.mu + law.muR * 5e-3) * impulse / pair.inertia[0];
  EXPECT_NEAR(end.spin[0], before + turned, 1e-8 * turned);
  EXPECT_NEAR(end.centrePsi * speed, -law.mu * impulse / 1e-3, 1e-9);
}

/// µ_r so large that the disk does not turn: friction alone moves the centre, as of a body that
/// cannot turn, v_t' = −µ 2 v, or to rest.
TEST(RollingOracle, FrictionAndRollingBothHold_TheDiskRests) {
  ContactLaw law = rolling(RollingLaw::constantTorque);
  law.tangential = TangentialLaw::coulomb;
  law.mu = 0.4;
  law.muR = 5.0;
  const CollisionEnd end = oracleOutcome(law, disk(), {0.3, speed, Approach::oblique});
  EXPECT_NEAR(end.spin[0], 0.0, 1e-9);
  EXPECT_NEAR(end.centrePsi, 0.0, 1e-9);
  const CollisionEnd slides = oracleOutcome(law, disk(), {2.0, speed, Approach::oblique});
  EXPECT_NEAR(slides.centrePsi, 2.0 - 0.8, 1e-8);
}

/// A torque that holds until the bound falls to it: with the load of the spring alone both are
/// equal to the last bit at a step's end, from where it slips. It turned for ever between both
/// before.
TEST(RollingOracle, HoldThatReachesItsBoundToTheLastBit_Slips) {
  ContactLaw law = rolling(RollingLaw::constantTorque);
  law.gn = 0.2;
  law.tangential = TangentialLaw::spring;
  law.kt = 3e3;
  law.mu = 0.4;
  law.muR = 0.1;
  law.conventions.springUpdate = SpringUpdate::midpoint;
  law.conventions.leverArm = LeverArm::contactPoint;
  law.conventions.rollingLoad = RollingLoad::elastic;
  const CollisionEnd left = oracleOutcome(law, disk(), {-0.2, speed, Approach::oblique});
  const CollisionEnd right = oracleOutcome(law, disk(), {0.2, speed, Approach::oblique});
  EXPECT_NEAR(left.psi, -right.psi, 1e-12);
  EXPECT_NEAR(left.energyAfter, right.energyAfter, 1e-12 * left.energyBefore);
  // As without the dashpot in the load, but for what that takes of it.
  law.conventions.rollingLoad = RollingLoad::compression;
  EXPECT_NEAR(oracleOutcome(law, disk(), {0.2, speed, Approach::oblique}).psi, right.psi, 0.02);
}

TEST(RollingOracle, OutsideAfterTotal_HasNoLimitAndIsRefused) {
  ContactLaw law = rolling(RollingLaw::spring);
  law.kr = 1e3;
  law.gr = 0.1;
  law.muR = 0.1;
  law.conventions.rollingDashpot = Dashpot::outside;
  EXPECT_THROW(oracleOutcome(law, disk(), {1.0, speed, Approach::firstSpin}),
               std::invalid_argument);
  law.conventions.springUpdate = SpringUpdate::before;
  EXPECT_NO_THROW(oracleOutcome(law, disk(), {1.0, speed, Approach::firstSpin}));
}

/// A bound that outruns the spring from the first touch on, where both are 0: it does not slip and
/// turns as a damped oscillator, J ω′ = −K θ − C ω, over the contact.
TEST(RollingOracle, OutsideWithSpringOnly_BeginsRelaxed) {
  ContactLaw law = rolling(RollingLaw::spring);
  law.kr = 1e3;
  law.gr = 0.1;
  law.muR = 1e9;
  law.conventions.rollingDashpot = Dashpot::outside;
  law.conventions.rollingReset = SpringReset::springOnly;
  const CollidingPair pair = disk();
  const double eta = 0.5 * 0.1 * 25e-6 / pair.inertia[0];
  const double omega = std::sqrt(1e3 * 25e-6 / pair.inertia[0] - eta * eta);
  const double turn = omega * contact, before = -speed / 5e-3;
  for (const RollingLoad load :
       {RollingLoad::compression, RollingLoad::elastic, RollingLoad::whileCompressed}) {
    law.conventions.rollingLoad = load;
    const CollisionEnd end = oracleOutcome(law, pair, {1.0, speed, Approach::firstSpin});
    EXPECT_NEAR(end.spin[0],
                before * std::exp(-eta * contact) * (std::cos(turn) - eta / omega * std::sin(turn)),
                1e-7 * std::abs(before));
  }
}

/// A spring that outruns its bound from the first touch on is reset to −γ_r L² ω, which is beyond
/// the bound on the other side and stays there: the law turns the disk on, with all of the bound,
/// µ_r L 2 m v/J in all.
TEST(RollingOracle, OutsideWithSpringOnly_SpringFasterThanItsBound_TurnsTheDiskOn) {
  ContactLaw law = rolling(RollingLaw::spring);
  law.kr = 4e5;
  law.muR = 0.02;
  law.conventions.rollingDashpot = Dashpot::outside;
  law.conventions.rollingReset = SpringReset::springOnly;
  for (const double gr : {0.05, 0.5}) {
    law.gr = gr;
    const CollisionEnd end = oracleOutcome(law, disk(), {2.0, speed, Approach::firstSpin});
    const double gained = law.muR * 5e-3 * impulse / disk().inertia[0];
    EXPECT_NEAR(end.spin[0], -2.0 * speed / 5e-3 - gained, 1e-8 * gained);
  }
}

/// The in-house engine in steps of t_c/2000, which hold a disk of type A at rest to a step's
/// torque.
TEST(RollingOracle, Engine_MeetsIt) {
  Case setup = smallPairCase();
  collisionIn(setup).radius[1] = 2.0 * smallRadius;
  collisionIn(setup).mass[1] = 4.0 * smallMass;
  setup.law.tangential = TangentialLaw::spring;
  setup.law.muR = 0.1;
  setup.law.kr = 0.3 * setup.law.kn;
  setup.law.conventions.springUpdate = SpringUpdate::midpoint;
  setup.law.conventions.integrator = Integrator::velocityVerlet;
  for (const bool wall : {false, true})
    for (const RollingLaw kind : {RollingLaw::constantTorque, RollingLaw::viscous,
                                  RollingLaw::viscousByLoad, RollingLaw::spring})
      for (const double psi : {0.0, 0.3, 2.0}) {
        setup.law.rolling = kind;
        setup.law.gr = kind == RollingLaw::viscous ? 0.5 * setup.law.gn : 0.0;
        collisionIn(setup).wall = wall;
        const CollidingPair pair = collidingPair(setup);
        const CollisionStart start{psi, 0.01, Approach::oblique, wall ? 0.0 : 1.0};
        const CollisionEnd expected = oracleOutcome(setup.law, pair, start);
        const double time = contactTime(setup.law, pair.reducedMass());
        const auto found = endByEngine(setup, start, time / 2000.0, 2.5 * time);
        ASSERT_TRUE(found);
        EXPECT_NEAR(found->psi, expected.psi, 2e-3) << static_cast<int>(kind) << " " << psi;
        for (const int side : {0, 1})
          EXPECT_NEAR(found->spin[side] * smallRadius, expected.spin[side] * smallRadius,
                      2e-3 * 0.01)
              << static_cast<int>(kind) << " " << psi;
      }
}

ContactLaw randomRolling(Draw& draw, const CollidingPair& pair) {
  ContactLaw law;
  LawConventions& how = law.conventions;
  law.kn = draw.logarithmic(1e3, 1e5);
  law.damper = Damper::critical;
  law.gn = draw.oneOf({0.0, 0.1, 0.4});
  law.gt = 0.2;
  law.kt = law.kn * draw.uniform(0.3, 1.2);
  law.mu = draw.uniform(0.05, 0.8);
  law.tangential = draw.oneOf({TangentialLaw::none, TangentialLaw::coulomb, TangentialLaw::viscous,
                               TangentialLaw::springDashpot});
  law.rolling = draw.oneOf({RollingLaw::constantTorque, RollingLaw::viscous,
                            RollingLaw::viscousByLoad, RollingLaw::spring, RollingLaw::spring});
  const double a = std::min(pair.radius[0], pair.plane ? pair.radius[0] : pair.radius[1]);
  how.tension = draw.oneOf({Tension::allow, Tension::cut});
  how.springUpdate = draw.oneOf({SpringUpdate::before, SpringUpdate::midpoint});
  how.springReset = SpringReset::springOnly;
  how.rollingLength = draw.oneOf({RollingLength::effective, RollingLength::twiceEffective,
                                  RollingLength::smallerRadius, RollingLength::meanRadius});
  how.rollingStiffness = draw.oneOf(
      {RollingStiffness::lengthSquare, RollingStiffness::radii, RollingStiffness::constant});
  how.rollingDamper = draw.oneOf({RollingDamper::constant, RollingDamper::critical});
  how.rollingLoad = draw.oneOf({RollingLoad::compression, RollingLoad::magnitude,
                                RollingLoad::elastic, RollingLoad::whileCompressed});
  how.rollingDashpot = draw.oneOf({Dashpot::inside, Dashpot::inside, Dashpot::outside});
  how.rollingReset = draw.oneOf({SpringReset::total, SpringReset::springOnly});
  law.muR = draw.uniform(0.02, 0.6);
  if (law.rolling == RollingLaw::viscousByLoad) law.muR = draw.uniform(0.1, 5.0);
  const bool constant = how.rollingStiffness == RollingStiffness::constant;
  law.kr = law.kn * draw.uniform(0.1, 1.0) * (constant ? a * a : 1.0);
  const bool critical =
      law.rolling == RollingLaw::spring && how.rollingDamper == RollingDamper::critical;
  law.gr = draw.uniform(0.05, 0.5);
  if (!critical) law.gr *= std::sqrt(law.kn * pair.reducedMass());
  if (law.rolling == RollingLaw::spring && draw.oneOf({false, true})) law.gr = 0.0;
  return law;
}

TEST(RandomRolling, Oracle_ClosesTheAccountAndIsWhatSmallStepsGive) {
  Draw draw(31);
  int noLimit = 0;
  double worst = 0.0;
  for (int k = 0; k < 160; ++k) {
    SCOPED_TRACE(k);
    Case setup;
    drawPair(draw, setup.source.emplace<Collision>());
    collisionIn(setup).wall = draw.oneOf({false, true});
    const CollidingPair pair = collidingPair(setup);
    const ContactLaw law = randomRolling(draw, pair);
    const double time = contactTime(law, pair.reducedMass());
    const CollisionStart start{draw.uniform(0.0, 3.0),
                               pair.radius[0] * draw.logarithmic(1e-4, 1e-2) / time,
                               draw.oneOf({Approach::firstSpin, Approach::oblique}),
                               pair.plane ? 0.0 : draw.uniform(-3.0, 3.0)};
    const CollisionEnd end = oracleOutcome(law, pair, start);
    EXPECT_NEAR(accountOf(end), end.energyBefore, 1e-8 * end.energyBefore);
    EXPECT_GE(end.lost->rollingDamping.value_or(0.0), 0.0);
    noLimit += end.noLimit;
    if (end.noLimit) continue;
    const auto plain = PlainIntegration::run(law, pair, start, time, 8000.0, 0.3);
    EXPECT_NEAR(end.psi, plain.psi, 1e-2) << static_cast<int>(law.rolling);
    const double unit = start.vn / pair.radius[0];
    EXPECT_NEAR((end.spin[0] - end.spin[1]) / unit, plain.rollingSpin / unit, 1e-2)
        << static_cast<int>(law.rolling);
    worst = std::max(worst, std::abs(end.psi - plain.psi));
  }
  RecordProperty("largest_difference_of_psi", std::to_string(worst));
  EXPECT_LT(noLimit, 25);
}

}  // namespace

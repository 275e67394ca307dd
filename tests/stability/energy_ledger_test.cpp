#include <gtest/gtest.h>

#include <cmath>

#include "adapters/grain.hpp"
#include "cases/collision_scene.hpp"
#include "oracle/collision_oracle.hpp"
#include "stability/recording.hpp"
#include "tests/support/pairs.hpp"

// The in-house engine's energy ledger against the account that the oracle integrates.

namespace {

using namespace crossgrain;

struct Sides {
  EnergyLedger ledger;
  CollisionEnd oracle;
};

Sides collide(const ContactLaw& law, double psi, double stepsPerContact) {
  Case setup = test::smallPairCase();
  setup.law = law;
  collisionIn(setup).psi = {psi};
  collisionIn(setup).vn = {0.01};
  setup.run.energyLedger = true;
  const auto starts = collisionStarts(setup);
  const auto engine = makeGrain();
  engine->load(collisionScene(setup, starts, test::smallContactTime / stepsPerContact), {});
  engine->advance(3.0 * test::smallContactTime);
  const Snapshot end = engine->snapshot(ContactReport::none);
  return {end.ledger.value(), oracleOutcome(law, collidingPair(setup), starts.front())};
}

ContactLaw lawOf(TangentialLaw tangential) {
  ContactLaw law = test::thesisLaw();
  law.tangential = tangential;
  law.conventions.springUpdate = SpringUpdate::midpoint;
  return law;
}

class LedgerAgainstOracle : public testing::TestWithParam<std::tuple<TangentialLaw, double>> {};

/// A thousandth of the energy before: at 2000 steps the first and the last touch are known to a
/// step, in which a dashpot takes up to 2 η dt = 1.5e-3 of it, on average half of that amiss.
TEST_P(LedgerAgainstOracle, EveryTermIsTheOracles) {
  const auto& [tangential, psi] = GetParam();
  const auto [ledger, oracle] = collide(lawOf(tangential), psi, 2000.0);
  ASSERT_TRUE(oracle.lost);
  const double before = oracle.energyBefore;
  EXPECT_NEAR(ledger.initial, before, 1e-9 * before);
  EXPECT_NEAR(ledger.kinetic, oracle.energyAfter, 1e-3 * before);
  EXPECT_NEAR(ledger.lostNormalDamping, oracle.lost->normalDamping, 1e-3 * before);
  EXPECT_NEAR(ledger.lostTangentialDamping, oracle.lost->tangentialDamping, 1e-3 * before);
  // The oracle subtracts the energy that a slip's resets of the spring bring in from the sliding.
  EXPECT_NEAR(ledger.lostSliding - ledger.gainedByConvention,
              oracle.lost->sliding + oracle.lost->stiffening, 1e-3 * before);
  EXPECT_NEAR(ledger.lostRelease, oracle.lost->stored, 1e-3 * before);
  EXPECT_LT(std::abs(residual(ledger)), 2.5e-6 * before);  // (ω dt)²
}

INSTANTIATE_TEST_SUITE_P(
    Collisions, LedgerAgainstOracle,
    testing::Combine(testing::Values(TangentialLaw::coulomb, TangentialLaw::viscous,
                                     TangentialLaw::spring, TangentialLaw::springDashpot),
                     testing::Values(0.3, 1.0, 2.0, 5.0)));

/// Hertz and Mindlin without dampers: what a stiffness that follows the overlap costs or gives.
TEST(LedgerAgainstOracleOfHertz, StiffeningIsTheOracles) {
  for (const History history : {History::displacement, History::force}) {
    ContactLaw law = lawOf(TangentialLaw::spring);
    law.normal = NormalLaw::hertz;
    law.kn = 1e6;
    law.kt = 8e5;
    law.gn = law.gt = 0.0;
    law.conventions.history = history;
    const auto [ledger, oracle] = collide(law, 1.0, 4000.0);
    ASSERT_TRUE(oracle.lost);
    const double before = oracle.energyBefore;
    EXPECT_GT(std::abs(oracle.lost->stiffening), 1e-3 * before);
    EXPECT_NEAR(ledger.kinetic, oracle.energyAfter, 1e-3 * before);
    EXPECT_NEAR(ledger.lostSliding - ledger.gainedByConvention,
                oracle.lost->sliding + oracle.lost->stiffening, 1e-3 * before);
    EXPECT_NEAR(ledger.lostNormalDamping, 0.0, 1e-12 * before);
  }
}

TEST(EnergyLedgers, AreAbsentWhereNobodyAsks) {
  Case setup = test::smallPairCase();
  collisionIn(setup).psi = {1.0};
  collisionIn(setup).vn = {0.01};
  const auto engine = makeGrain();
  EXPECT_TRUE(engine->capabilities().energyLedger);
  engine->load(collisionScene(setup, collisionStarts(setup), 1e-6), {});
  EXPECT_FALSE(engine->snapshot(ContactReport::none).ledger);
}

TEST(EnergyLedgers, ResidualIsWhatNoTermAccountsFor) {
  EnergyLedger ledger;
  ledger.initial = 1.0;
  EXPECT_EQ(residual(ledger), -1.0);
  ledger.kinetic = 0.5;
  ledger.elasticNormal = 0.25;
  ledger.elasticTangential = 0.125;
  ledger.potential = -2.0;
  ledger.plateSprings = 0.125;
  EXPECT_EQ(residual(ledger), -2.0);
  ledger.lostNormalDamping = 0.5;
  ledger.lostTangentialDamping = 0.25;
  ledger.lostSliding = 0.125;
  ledger.lostBottom = 0.0625;
  ledger.lostRelease = 2.0625;
  EXPECT_EQ(residual(ledger), 1.0);
  ledger.workOfWalls = 0.75;
  ledger.gainedByConvention = 0.25;
  EXPECT_EQ(residual(ledger), 0.0);
}

/// Energy of contacts in an engine without a ledger, compared with the in-house engine's ledger: a
/// disk with spin falls on one that lies on a plane, elastic and sticky, and comes back or stays.
class EnergyWithoutLedger : public testing::TestWithParam<CohesionLaw> {};

TEST_P(EnergyWithoutLedger, OfCohesionAndRolling_IsTheLedgers) {
  Recording run;
  Scene& scene = run.scene;
  scene.energyLedger = true;
  scene.dt = 1e-6;
  scene.disks = {{1e-3, 1.2e-3},
                 {4e-6, 5e-6},
                 {1.6e-12, 2.9e-12},
                 {{0.0, 0.999e-3}, {1e-4, 3.21e-3}},
                 {{0.0, 0.0}, {0.0, -0.05}},
                 {0.0, 20.0}};
  WallBody floor;
  floor.planes.push_back({{0.0, 0.0}, {0.0, 1.0}});
  scene.bodies.push_back(floor);
  ContactLaw& law = scene.law;
  const bool linear = GetParam() == CohesionLaw::elastoPlastic;
  law.normal = linear ? NormalLaw::linear : NormalLaw::hertz;
  law.kn = linear ? 100.0 : 7e6;
  law.tangential = TangentialLaw::spring;
  law.kt = linear ? 70.0 : 5e6;
  law.mu = 0.5;
  law.rolling = RollingLaw::spring;
  law.kr = 20.0;
  law.muR = 0.2;
  law.cohesion = GetParam();
  law.w = 0.3;
  law.kc = linear ? 20.0 : 1e5;
  law.kUnload = 300.0;
  law.conventions.cohesionArea = CohesionArea::firstOrder;
  law.conventions.springUpdate = SpringUpdate::before;
  law.conventions.integrator = Integrator::velocityVerlet;
  const auto engine = makeGrain();
  run.effective = engine->load(scene, {});
  run.law = law;
  double largest = 0.0, smallest = 0.0, rolling = 0.0;
  for (int k = 1; k <= 200; ++k) {
    engine->advance(k * 2e-5);
    Snapshot now = engine->snapshot(ContactReport::instant);
    const EnergyLedger ledger = now.ledger.value();
    // Springs of friction are no part of it: k_t changes with a Hertz contact's depth.
    const double known = ledger.elasticNormal + ledger.elasticRolling;
    now.ledger.reset();
    run.effective.effects.erase(Effect::tangentialSpring);
    const EnergyState found = energyOf(run, now);
    EXPECT_NEAR(found.elastic, known, 1e-6 * 1e-8) << k;
    EXPECT_NEAR(found.kinetic, ledger.kinetic, 1e-12 * 1e-8) << k;
    largest = std::max(largest, found.elastic);
    smallest = std::min(smallest, found.elastic);
    rolling = std::max(rolling, ledger.elasticRolling);
  }
  EXPECT_GT(largest - smallest, 1e-9);  // of 1e-8 J
  EXPECT_GT(rolling, 1e-12);
  if (GetParam() == CohesionLaw::dmt || GetParam() == CohesionLaw::jkr) {
    EXPECT_LT(smallest, 0.0);
  }
}

INSTANTIATE_TEST_SUITE_P(Laws, EnergyWithoutLedger,
                         testing::Values(CohesionLaw::none, CohesionLaw::area, CohesionLaw::dmt,
                                         CohesionLaw::jkr, CohesionLaw::elastoPlastic));

}  // namespace

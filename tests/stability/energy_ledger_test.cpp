#include <gtest/gtest.h>

#include <cmath>

#include "adapters/grain.hpp"
#include "cases/collision_scene.hpp"
#include "oracle/collision_oracle.hpp"
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
  setup.collision.psi = {psi};
  setup.collision.vn = {0.01};
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
  // What a slip's resets of the spring bring in, the oracle takes off the sliding.
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
  setup.collision.psi = {1.0};
  setup.collision.vn = {0.01};
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

}  // namespace

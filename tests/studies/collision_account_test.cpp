#include "studies/collide/contact_account.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "adapters/box2d.hpp"
#include "adapters/grain.hpp"
#include "studies/collide/sweep.hpp"
#include "tests/support/pairs.hpp"

namespace {

using namespace crossgrain;

Case sweepCase(LeverArm arm = LeverArm::radius, VelocityArm ofVelocity = VelocityArm::leverArm) {
  Case setup = test::smallPairCase();
  setup.law.conventions.springUpdate = SpringUpdate::before;
  setup.law.conventions.leverArm = arm;
  setup.law.conventions.velocityArm = ofVelocity;
  setup.collision.psi = {0.0, 0.5, 1.0, 1.5, 2.5, 4.0};
  setup.collision.vn = {0.01};
  setup.run.mayDiffer = {"integrator", "damping_velocity"};
  return setup;
}

CollisionCurve swept(const Case& setup, const EngineEntry& entry, double stepsPerContact,
                     bool watch) {
  const auto engine = entry.make();
  const auto starts = collisionStarts(setup);
  return runSweep(*engine, entry, setup, test::smallContactTime / stepsPerContact, starts,
                  oracleCurve(setup, starts), watch);
}

const EngineEntry& grain() {
  static const EngineEntry entry{"grain", "", makeGrain, {}, {}, ""};
  return entry;
}

const EngineEntry& penalty() {
  static const EngineEntry entry{"box2d-penalty", "", makeBox2dPenalty, {}, {}, ""};
  return entry;
}

double errorOf(const CollisionCurve& curve, QuantityId quantity) {
  return curve.score.of[quantity].value().max;
}

TEST(ContactAccounts, ChangeNoBitOfTheOutcome) {
  for (const EngineEntry* entry : {&grain(), &penalty()}) {
    const CollisionCurve watched = swept(sweepCase(), *entry, 50.0, true),
                         blind = swept(sweepCase(), *entry, 50.0, false);
    EXPECT_TRUE(watched.points.columns[QuantityId::maxOverlap]);
    EXPECT_FALSE(blind.points.columns[QuantityId::maxOverlap]);
    EXPECT_EQ(watched.points.psi, blind.points.psi);
    EXPECT_EQ(watched.points.vn, blind.points.vn);
    EXPECT_EQ(watched.points.reason, blind.points.reason);
    for (const CollisionQuantity& quantity : collisionQuantities())
      if (const auto& values = blind.points.columns[quantity.id]) {
        EXPECT_EQ(watched.points.columns[quantity.id], values)
            << entry->name << " " << quantity.name;
      }
    EXPECT_EQ(watched.stats->steps, blind.stats->steps);
  }
}

/// What was lost against the work of the two forces, and their parts' sum, in units of the energy
/// before.
void expectWorkIsWhatWasLost(const CollisionPoints& points, bool parts, const std::string& what) {
  using enum QuantityId;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const auto value = [&](QuantityId id) { return points.at(id, k).value(); };
    const double before = value(energyBefore);
    EXPECT_NEAR((before - value(energyAfter)) / before,
                (value(lostNormalDamping) + value(lostTangential)) / before, 1e-8)
        << what << " " << k;
    if (!parts) continue;
    EXPECT_NEAR(value(lostTangential) / before,
                (value(lostTangentialDamping) + value(lostSliding) + value(lostStored)) / before,
                1e-8)
        << what << " " << k;
  }
}

/// The forces took out of the motion what the motion lost. For schemes of the leapfrog family the
/// sum is exact, whatever the lever arm; Euler's velocities are half a step from its positions.
/// Points have nine digits of energies of which a hundredth may be left.
TEST(ContactAccounts, WorkIsWhatTheMotionLost) {
  for (const LeverArm arm : {LeverArm::radius, LeverArm::contactPoint})
    for (const EngineEntry* entry : {&grain(), &penalty()})
      expectWorkIsWhatWasLost(swept(sweepCase(arm), *entry, 50.0, true).points, true, entry->name);
}

/// So it is where the law sees another velocity than its force works on: the account is of forces.
TEST(ContactAccounts, WorkIsWhatTheMotionLostAlsoWithTwoArms) {
  const Case setup = sweepCase(LeverArm::overlapMiddle, VelocityArm::radius);
  expectWorkIsWhatWasLost(swept(setup, grain(), 50.0, true).points, false, "two arms");
}

/// Parts of the energy err by at most a quarter of dt/t_c, each of them: first order, with the
/// instants of touch, slip and separation falling anywhere within a step.
TEST(ContactAccounts, EnergiesApproachTheOraclesAtFirstOrder) {
  for (const EngineEntry* entry : {&grain(), &penalty()})
    for (const double steps : {100.0, 400.0, 1600.0}) {
      using enum QuantityId;
      const CollisionCurve curve = swept(sweepCase(), *entry, steps, true);
      for (const QuantityId part :
           {lostNormalDamping, lostTangential, lostTangentialDamping, lostSliding, lostStored})
        EXPECT_LT(errorOf(curve, part), 0.25 / steps)
            << entry->name << " " << collisionQuantity(part).name;
    }
}

/// The largest overlap has the scheme's own order: sixteen times the steps, 256 or 16 times closer.
TEST(ContactAccounts, OverlapApproachesTheOraclesAtTheSchemesOrder) {
  const auto gain = [](const EngineEntry& entry) {
    return errorOf(swept(sweepCase(), entry, 100.0, true), QuantityId::maxOverlap) /
           errorOf(swept(sweepCase(), entry, 1600.0, true), QuantityId::maxOverlap);
  };
  EXPECT_GT(gain(grain()), 128.0);
  EXPECT_NEAR(gain(penalty()), 16.0, 2.0);
}

TEST(ContactAccounts, WithoutSlidingFlagsThereIsOnlyTheSum) {
  const Case setup = sweepCase();
  const auto starts = collisionStarts(setup);
  const double dt = test::smallContactTime / 50.0;
  const Scene scene = collisionScene(setup, starts, dt);
  std::vector<double> sums[2];
  for (const bool flags : {false, true}) {
    const auto engine = makeGrain();
    const EffectiveParameters effective = engine->load(scene, {});
    for (const auto& account :
         recordContacts(*engine, {scene, collidingPair(setup), scene.law, effective, flags},
                        2.0 * test::smallContactTime)) {
      ASSERT_TRUE(account);
      EXPECT_EQ(account->split.has_value(), flags);
      sums[flags ? 1 : 0].push_back(account->work.tangential);
    }
  }
  EXPECT_EQ(sums[0], sums[1]);
}

TEST(ContactAccounts, ImpulsesAreNoForcesOfAnInstant) {
  Case setup = sweepCase();
  setup.run.mayDiffer = {
      "normal",     "tangential",       "tangential_spring", "tangential_damping",
      "integrator", "damping_velocity", "spring_update",     "rounding"};
  const EngineEntry entry{"box2d-impulse", "", makeBox2dImpulse, {}, {}, ""};
  const CollisionCurve curve = swept(setup, entry, 50.0, true);
  EXPECT_FALSE(curve.points.columns[QuantityId::maxOverlap]);
  EXPECT_TRUE(curve.points.columns[QuantityId::psiF]);
}

}  // namespace

#include "studies/collide/contact_account.hpp"

#include <gtest/gtest.h>

#include "adapters/box2d_common.hpp"
#include "tests/studies/collision_sweeps.hpp"

namespace {

using namespace crossgrain;

const EngineEntry penalty{"box2d-penalty", "", makeBox2dPenalty, {}, {}, ""};

Case sweepCase(LeverArm arm = LeverArm::radius, VelocityArm ofVelocity = VelocityArm::leverArm) {
  Case setup = test::smallPairSweep({0.0, 0.5, 1.0, 1.5, 2.5, 4.0});
  setup.law.conventions.springUpdate = SpringUpdate::before;
  setup.law.conventions.leverArm = arm;
  setup.law.conventions.velocityArm = ofVelocity;
  collisionIn(setup).margins.clear();
  setup.run.mayDiffer = {"integrator", "damping_velocity"};
  return setup;
}

CollisionCurve watched(const EngineEntry& entry, double steps, const Case& setup = sweepCase()) {
  return test::swept(setup, test::smallContactTime / steps, true, entry);
}

TEST(ContactAccount, Watching_ChangesNoBitOfTheOutcome) {
  for (const EngineEntry* entry : {&test::inHouse, &penalty}) {
    const CollisionCurve seen = watched(*entry, 50.0),
                         blind = test::swept(sweepCase(), seen.dt, false, *entry);
    EXPECT_TRUE(seen.points.columns[QuantityId::maxOverlap]);
    EXPECT_FALSE(blind.points.columns[QuantityId::maxOverlap]);
    EXPECT_EQ(seen.points.psi, blind.points.psi);
    EXPECT_EQ(seen.points.vn, blind.points.vn);
    for (std::size_t k = 0; k < seen.points.size(); ++k)
      EXPECT_EQ(seen.points.status(k), blind.points.status(k));
    EXPECT_EQ(seen.points.reason, blind.points.reason);
    for (const CollisionQuantity& quantity : collisionQuantities())
      if (const auto& values = blind.points.columns[quantity.id]) {
        EXPECT_EQ(seen.points.columns[quantity.id], values) << entry->name << " " << quantity.name;
      }
    EXPECT_EQ(seen.stats->steps, blind.stats->steps);
  }
}

/// The forces took out of the motion what the motion lost, in units of the energy before. For
/// schemes of the leapfrog family the sum is exact, whatever the lever arm, also where the law sees
/// another velocity than its force works on. Points have nine digits of energies of which a
/// hundredth may be left.
TEST(ContactAccount, WorkOfForces_IsWhatTheMotionLost) {
  struct Account {
    const EngineEntry& engine;
    Case setup;
    bool parts;  ///< of the tangential force's work, too
  };
  for (const Account& of :
       {Account{test::inHouse, sweepCase(), true}, Account{penalty, sweepCase(), true},
        Account{test::inHouse, sweepCase(LeverArm::contactPoint), true},
        Account{penalty, sweepCase(LeverArm::contactPoint), true},
        Account{test::inHouse, sweepCase(LeverArm::overlapMiddle, VelocityArm::radius), false}}) {
    using enum QuantityId;
    const CollisionPoints points = watched(of.engine, 50.0, of.setup).points;
    for (std::size_t k = 0; k < points.size(); ++k) {
      SCOPED_TRACE(of.engine.name + " " + std::to_string(k));
      const auto value = [&](QuantityId id) { return points.at(id, k).value(); };
      const double within = 1e-8 * value(energyBefore);
      EXPECT_NEAR(value(energyBefore) - value(energyAfter),
                  value(lostNormalDamping) + value(lostTangential), within);
      if (!of.parts) continue;
      EXPECT_NEAR(value(lostTangential),
                  value(lostTangentialDamping) + value(lostSliding) + value(lostStored), within);
    }
  }
}

/// Parts of the energy err by at most a quarter of dt/t_c, each of them: first order, with the
/// instants of touch, slip and separation falling anywhere within a step. The largest overlap has
/// the scheme's own order: sixteen times the steps, 256 or 16 times closer.
TEST(ContactAccount, SmallerSteps_ApproachTheOracle) {
  for (const EngineEntry* entry : {&test::inHouse, &penalty}) {
    std::vector<double> overlap;
    for (const double steps : {100.0, 400.0, 1600.0}) {
      using enum QuantityId;
      const auto score = watched(*entry, steps).score.of;
      for (const QuantityId part :
           {lostNormalDamping, lostTangential, lostTangentialDamping, lostSliding, lostStored})
        EXPECT_LT(score[part].value().max, 0.25 / steps)
            << entry->name << " " << collisionQuantity(part).name;
      overlap.push_back(score[maxOverlap].value().max);
    }
    const double gain = overlap.front() / overlap.back();
    if (entry == &penalty)
      EXPECT_NEAR(gain, 16.0, 2.0);
    else
      EXPECT_GT(gain, 128.0);
  }
}

TEST(ContactAccount, WithoutSlidingFlags_HasOnlyTheSum) {
  const Case setup = sweepCase();
  const double dt = test::smallContactTime / 50.0;
  const Scene scene = collisionScene(setup, collisionStarts(setup), dt);
  std::vector<double> sums[2];
  for (const bool flags : {false, true}) {
    const auto engine = makeGrain();
    const EffectiveParameters effective = engine->load(scene, {});
    for (const auto& account : recordContacts(
             *engine, ContactRecording<2>{scene, collidingPair(setup), scene.law, effective, flags},
             2.0 * test::smallContactTime)) {
      ASSERT_TRUE(account);
      EXPECT_EQ(account->split.has_value(), flags);
      sums[flags ? 1 : 0].push_back(account->work.tangential);
    }
  }
  EXPECT_EQ(sums[0], sums[1]);
}

/// Constants that an engine does not report are the scene's.
TEST(ContactAccount, WithoutReportedPairs_HasTheSameParts) {
  const Case setup = sweepCase();
  const double dt = test::smallContactTime / 50.0;
  const Scene scene = collisionScene(setup, collisionStarts(setup), dt);
  std::vector<double> sliding[2], sticking[2];
  for (const bool reported : {false, true}) {
    const auto engine = makeGrain();
    EffectiveParameters effective = engine->load(scene, {});
    if (!reported) effective.pairs.clear();
    for (const auto& account : recordContacts(
             *engine, ContactRecording<2>{scene, collidingPair(setup), scene.law, effective, true},
             2.0 * test::smallContactTime)) {
      ASSERT_TRUE(account && account->split);
      sliding[reported].push_back(account->split->sliding);
      sticking[reported].push_back(account->split->tangentialDamping);
    }
  }
  EXPECT_EQ(sliding[0], sliding[1]);
  EXPECT_EQ(sticking[0], sticking[1]);
}

TEST(ContactAccount, OfImpulses_IsAbsent) {
  Case setup = sweepCase();
  setup.run.mayDiffer = {
      "normal",     "tangential",       "tangential_spring", "tangential_damping",
      "integrator", "damping_velocity", "spring_update",     "rounding"};
  const CollisionCurve curve =
      watched({"box2d-impulse", "", makeBox2dImpulse, {}, {}, ""}, 50.0, setup);
  EXPECT_FALSE(curve.points.columns[QuantityId::maxOverlap]);
  EXPECT_TRUE(curve.points.columns[QuantityId::psiF]);
}

}  // namespace

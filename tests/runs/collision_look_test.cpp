#include "runs/collide/look.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "adapters/box2d.hpp"
#include "adapters/grain.hpp"
#include "runs/collide/sweep.hpp"
#include "tests/oracle/thesis_pair.hpp"

namespace {

using namespace crossgrain;
using nlohmann::json;

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

json swept(const Case& setup, const EngineEntry& entry, double stepsPerContact, bool look) {
  const auto engine = entry.make();
  const auto starts = collisionStarts(setup);
  return runSweep(*engine, entry, setup, test::contactTime / stepsPerContact, starts,
                  oracleCurve(setup, starts), look);
}

const EngineEntry& grain() {
  static const EngineEntry entry{"grain", "", makeGrain, {}, {}, ""};
  return entry;
}

const EngineEntry& penalty() {
  static const EngineEntry entry{"box2d-penalty", "", makeBox2dPenalty, {}, {}, ""};
  return entry;
}

double errorOf(const json& curve, const char* quantity) {
  return curve["score"][quantity]["max"];
}

TEST(Looking, ChangesNoBitOfTheOutcome) {
  for (const EngineEntry* entry : {&grain(), &penalty()}) {
    const json looked = swept(sweepCase(), *entry, 50.0, true),
               blind = swept(sweepCase(), *entry, 50.0, false);
    EXPECT_TRUE(looked["points"].contains("max_overlap"));
    EXPECT_FALSE(blind["points"].contains("max_overlap"));
    for (const auto& [column, values] : blind["points"].items())
      EXPECT_EQ(looked["points"][column], values) << entry->name << " " << column;
    EXPECT_EQ(looked["stats"]["steps"], blind["stats"]["steps"]);
  }
}

/// The forces took out of the motion what the motion lost. For schemes of the leapfrog family the
/// sum is exact, whatever the lever arm; Euler's velocities are half a step from its positions.
/// Points have nine digits of energies of which a hundredth may be left.
TEST(Looking, WorkIsWhatTheMotionLost) {
  for (const LeverArm arm : {LeverArm::radius, LeverArm::contactPoint})
    for (const EngineEntry* entry : {&grain(), &penalty()}) {
      const json points = swept(sweepCase(arm), *entry, 50.0, true)["points"];
      for (std::size_t k = 0; k < points["psi_i"].size(); ++k) {
        const auto value = [&](const char* column) { return points[column][k].get<double>(); };
        const double before = value("energy_before");
        EXPECT_NEAR((before - value("energy_after")) / before,
                    (value("lost_normal_damping") + value("lost_tangential")) / before, 1e-8)
            << entry->name << " " << k;
        EXPECT_NEAR(
            value("lost_tangential") / before,
            (value("lost_tangential_damping") + value("lost_sliding") + value("lost_stored")) /
                before,
            1e-8);
      }
    }
}

/// So it is where the law sees another velocity than its force works on: the account is of forces.
TEST(Looking, WorkIsWhatTheMotionLostAlsoWithTwoArms) {
  const Case setup = sweepCase(LeverArm::overlapMiddle, VelocityArm::radius);
  const json points = swept(setup, grain(), 50.0, true)["points"];
  for (std::size_t k = 0; k < points["psi_i"].size(); ++k) {
    const auto value = [&](const char* column) { return points[column][k].get<double>(); };
    const double before = value("energy_before");
    EXPECT_NEAR((before - value("energy_after")) / before,
                (value("lost_normal_damping") + value("lost_tangential")) / before, 1e-8)
        << k;
  }
}

/// Parts of the energy err by at most a quarter of dt/t_c, each of them: first order, with the
/// instants of touch, slip and separation falling anywhere within a step.
TEST(Looking, EnergiesApproachTheOraclesAtFirstOrder) {
  for (const EngineEntry* entry : {&grain(), &penalty()})
    for (const double steps : {100.0, 400.0, 1600.0}) {
      const json curve = swept(sweepCase(), *entry, steps, true);
      for (const char* part : {"lost_normal_damping", "lost_tangential", "lost_tangential_damping",
                               "lost_sliding", "lost_stored"})
        EXPECT_LT(errorOf(curve, part), 0.25 / steps) << entry->name << " " << part;
    }
}

/// The largest overlap has the scheme's own order: sixteen times the steps, 256 or 16 times closer.
TEST(Looking, OverlapApproachesTheOraclesAtTheSchemesOrder) {
  const auto gain = [](const EngineEntry& entry) {
    return errorOf(swept(sweepCase(), entry, 100.0, true), "max_overlap") /
           errorOf(swept(sweepCase(), entry, 1600.0, true), "max_overlap");
  };
  EXPECT_GT(gain(grain()), 128.0);
  EXPECT_NEAR(gain(penalty()), 16.0, 2.0);
}

TEST(Looking, WithoutSlidingFlagsThereIsOnlyTheSum) {
  const Case setup = sweepCase();
  const auto starts = collisionStarts(setup);
  const double dt = test::contactTime / 50.0;
  const Scene scene = collisionScene(setup, starts, dt);
  std::vector<double> sums[2];
  for (const bool flags : {false, true}) {
    const auto engine = makeGrain();
    const Realised realised = engine->load(scene, {});
    for (const auto& account :
         lookThrough(*engine, {scene, collidingPair(setup), scene.law, realised, flags},
                     2.0 * test::contactTime)) {
      ASSERT_TRUE(account);
      EXPECT_EQ(account->split.has_value(), flags);
      sums[flags ? 1 : 0].push_back(account->work.tangential);
    }
  }
  EXPECT_EQ(sums[0], sums[1]);
}

TEST(Looking, ImpulsesAreNoForcesOfAnInstant) {
  Case setup = sweepCase();
  setup.run.mayDiffer = {
      "normal",     "tangential",       "tangential_spring", "tangential_damping",
      "integrator", "damping_velocity", "spring_update",     "rounding"};
  const EngineEntry entry{"box2d-impulse", "", makeBox2dImpulse, {}, {}, ""};
  const json curve = swept(setup, entry, 50.0, true);
  EXPECT_FALSE(curve["points"].contains("max_overlap"));
  EXPECT_TRUE(curve["points"].contains("psi_f"));
}

}  // namespace

// Collisions in space: the shipped case on the in-house engine, and the same in another frame.
#include <gtest/gtest.h>

#include <cmath>

#include "adapters/grain.hpp"
#include "cases/loader.hpp"
#include "cases/time_step.hpp"
#include "support/bad_input.hpp"
#include "tests/studies/collision_sweeps.hpp"
#include "tests/support/refusal.hpp"

namespace {

using namespace crossgrain;

Case variantOf(const std::string& name, const std::vector<std::string>& overrides = {}) {
  for (Case& setup :
       loadCase(std::filesystem::path(CROSSGRAIN_CASES) / "space/spheres.toml", overrides))
    if (setup.variant == name) return setup;
  throw std::logic_error("no variant " + name);
}

CollisionCurve sweptAt(const Case& setup, double stepsPerContact) {
  return test::swept(setup, impactTimes(setup).shortest / stepsPerContact);
}

TEST(CollisionInSpace, ShippedCase_PassesAndConverges) {
  for (const char* const name : {"in-plane", "out-of-plane", "twist", "dashpot", "wall"}) {
    SCOPED_TRACE(name);
    const Case setup = variantOf(name);
    const double steps = collisionIn(setup).stepsPerContact.front();
    const CollisionCurve coarse = sweptAt(setup, steps), fine = sweptAt(setup, 8.0 * steps);
    EXPECT_EQ(coarse.score.verdict, Verdict::pass);
    EXPECT_TRUE(fine.allParted());
    // Of first order where a dashpot's force jumps: an eighth, and as much again for where in a
    // step contacts end.
    const bool inPlane = std::string(name) == "in-plane";
    for (const QuantityId id : {QuantityId::psiF, QuantityId::en, QuantityId::psiFOut}) {
      if (inPlane && id == QuantityId::psiFOut) continue;
      EXPECT_LT(fine.score.of[id]->max, coarse.score.of[id]->max / 4.0)
          << collisionQuantity(id).name;
    }
    const bool zero = fine.score.of[QuantityId::psiFOut]->unitIs == ErrorUnitKind::absolute;
    EXPECT_EQ(zero, inPlane);
  }
}

TEST(CollisionInSpace, TurnedCase_GivesTheSameNumbers) {
  const CollisionCurve own = sweptAt(variantOf("twist"), 50);
  const CollisionCurve turned = sweptAt(variantOf("twist-turned"), 50);
  ASSERT_EQ(own.points.size(), 26u);
  int compared = 0;
  for (const CollisionQuantity& quantity : scoredQuantities())
    for (std::size_t k = 0; k < own.points.size(); ++k) {
      const auto a = own.points.at(quantity.id, k), b = turned.points.at(quantity.id, k);
      ASSERT_EQ(a.has_value(), b.has_value()) << quantity.name;
      if (!a) continue;
      // Files hold nine digits; positions of 0.1 m are rounded in another way.
      EXPECT_NEAR(*a, *b, 2e-8 * std::max(1.0, std::abs(*a))) << quantity.name << " " << k;
      ++compared;
    }
  EXPECT_GT(compared, 26 * 12);
}

TEST(CollisionInSpace, TwistConvention_IsSeen) {
  // A spring that does not turn with its pair is another law: the scene's oracle tells them apart.
  Case setup = variantOf("twist");
  const auto starts = collisionStarts(setup);
  const Outcomes turns = outcomesOf(oracleCurve(setup, starts));
  setup.law.conventions.springTwist = SpringTwist::none;
  const Outcomes stays = outcomesOf(oracleCurve(setup, starts));
  double most = 0.0;
  for (std::size_t k = 0; k < starts.size(); ++k)
    most = std::max(most, std::abs(turns[k]->end.psi - stays[k]->end.psi));
  EXPECT_GT(most, 0.05);
}

TEST(CollisionInSpace, EngineWhoseSpringDoesNotTwist_IsTrueToItsOwnLawAlone) {
  Case setup = variantOf("twist");
  setup.run.mayDiffer.emplace_back("spring_twist");
  const EngineEntry untwisted{.name = "untwisted", .summary = "", .make = [] {
                                return makeGrainMirror({{"spring_twist", {"none"}}});
                              }};
  const auto starts = collisionStarts(setup);
  DeclaredOracles declared;
  const CollisionCurve curve =
      runSweep(*untwisted.make(), untwisted, setup, impactTimes(setup).shortest / 200.0, starts,
               oracleCurve(setup, starts), false, &declared);
  EXPECT_EQ(curve.score.verdict, Verdict::fail);
  ASSERT_TRUE(curve.declared);
  EXPECT_EQ(curve.declared->reference, DeclaredReference::oracle);
  EXPECT_EQ(curve.declared->score.verdict, Verdict::pass);
  EXPECT_EQ(verdictOf(curve), Verdict::modelDifference);
}

TEST(CollisionInSpace, InertiaOfADisk_IsFound) {
  Case disks = variantOf("in-plane");
  const auto starts = collisionStarts(disks);
  const OracleCurve spheres = oracleCurve(disks, starts);
  collisionIn(disks).inertiaFactor = 0.5;
  const CollisionCurve curve =
      runSweep(*test::inHouse.make(), test::inHouse, disks, impactTimes(disks).shortest / 200.0,
               starts, spheres, false);
  EXPECT_EQ(curve.score.verdict, Verdict::fail);
}

TEST(CollisionInSpace, WatchedContacts_TellOverlapAndWhereTheEnergyGoes) {
  // Forces of a leapfrog scheme take the energy Σ f·v dt out of its motion, with velocities of the
  // time of the force, here interpolated between snapshots: of second order in t_c/200, as the
  // overlap is.
  for (const char* const name : {"in-plane", "out-of-plane", "twist", "wall"}) {
    SCOPED_TRACE(name);
    const Case setup = variantOf(name);
    const double dt = impactTimes(setup).shortest / 200.0;
    const CollisionCurve curve = test::swept(setup, dt, true);
    ASSERT_TRUE(curve.score.of[QuantityId::maxOverlap]);
    EXPECT_LT(curve.score.of[QuantityId::maxOverlap]->max, 1e-3);
    for (std::size_t k = 0; k < 26; ++k) {
      const auto of = [&](QuantityId id) { return curve.points.at(id, k).value(); };
      const double before = of(QuantityId::energyBefore);
      const double lost = before - of(QuantityId::energyAfter);
      const double worked = of(QuantityId::lostNormalDamping) + of(QuantityId::lostTangential);
      EXPECT_NEAR(worked, lost, 1e-3 * before) << k;
    }
  }
}

TEST(CollisionInSpace, OtherCommands_RefuseIt) {
  const Case setup = variantOf("in-plane");
  EXPECT_NE(test::refusalOf<BadInput>([&] {
              collisionScene(setup, collisionStarts(setup), 1e-6);
            }).find("collide and check alone know collisions in space"),
            std::string::npos);
}

}  // namespace

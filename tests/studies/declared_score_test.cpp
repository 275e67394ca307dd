// Curves against the law that an engine declares: what is its model, and what is a fault.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "adapters/box2d_common.hpp"
#include "cases/loader.hpp"
#include "cases/time_step.hpp"
#include "results/collision.hpp"
#include "studies/collide/sweep.hpp"
#include "tests/studies/planted_engine.hpp"
#include "tests/support/pairs.hpp"

namespace {

using namespace crossgrain;

Case variantOf(const std::string& file, const std::string& variant) {
  for (const Case& setup : loadCase(CROSSGRAIN_CASES "/collision/" + file, {}))
    if (setup.variant == variant) return setup;
  ADD_FAILURE() << file << " has no " << variant;
  return {};
}

/// The first sweep of a case.
CollisionCurve firstSweep(Engine& engine, const Case& setup, const std::string& mirrors = "",
                          bool passesFiner = false) {
  EngineEntry entry = test::inHouse;
  entry.mirrors = mirrors;
  const auto starts = collisionStarts(setup);
  DeclaredOracles declared;
  return runSweep(engine, entry, setup, collisionTimeSteps(setup).front(), starts,
                  oracleCurve(setup, starts), true, &declared, passesFiner);
}

/// The in-house engine that declares some conventions and really has those of `scene`.
class Declares : public test::PlantedEngine {
 public:
  Declares(LawConventionSets conventions, std::function<void(Scene&)> fault)
      : PlantedEngine(std::move(fault)), conventions_(std::move(conventions)) {}
  Capabilities capabilities() const override {
    Capabilities can = PlantedEngine::capabilities();
    for (const auto& [name, values] : conventions_) can.lawOptions[name] = values;
    return can;
  }

 private:
  LawConventionSets conventions_;
};

double largest(const Numbers& numbers) {
  double most = 0.0;
  for (const auto& value : numbers) most = std::max(most, std::abs(value.value()));
  return most;
}

const LawConventionSets cutsTension = {{"tension", {"cut"}}};

Case withTension() {
  return variantOf("figure-4-3.toml", "coulomb-tension");
}

TEST(DeclaredScore, ConventionThatTheCaseAllows_IsAModelDifference) {
  Declares engine(cutsTension, [](Scene&) {});
  const CollisionCurve curve = firstSweep(engine, withTension());
  EXPECT_EQ(curve.score.verdict, Verdict::fail);
  ASSERT_TRUE(curve.declared);
  EXPECT_EQ(curve.declared->law, (LawDescription{{"tension", "cut"}}));
  EXPECT_EQ(curve.declared->reference, DeclaredReference::oracle);
  EXPECT_EQ(curve.declared->score.verdict, Verdict::pass);
  EXPECT_EQ(verdictOf(curve), Verdict::modelDifference);
}

TEST(DeclaredScore, ConventionThatMovesTheOutcome_IsItsCause) {
  // Two conventions differ in every sweep. With k_t/k_n of MFiX' DEM05 the spring's update moves
  // Ψ_f by limits, and an arm shorter by half the overlap, 1e-4 of a, by nothing.
  Case setup = variantOf("glass-foerster-soft.toml", "");
  setup.law.conventions.springUpdate = SpringUpdate::after;
  setup.law.gn = 0.0;
  setup.law.kt = 0.86 * setup.law.kn;
  Declares engine({{"spring_update", {"before"}}, {"lever_arm", {"overlap_middle"}}},
                  [](Scene& scene) {
                    scene.law.conventions.springUpdate = SpringUpdate::before;
                    scene.law.conventions.leverArm = LeverArm::overlapMiddle;
                  });
  const CollisionCurve curve = firstSweep(engine, setup);
  EXPECT_EQ(verdictOf(curve), Verdict::modelDifference);
  ASSERT_TRUE(curve.causes && curve.causes->of[QuantityId::psiF]);
  const QuantityCauses& causes = *curve.causes->of[QuantityId::psiF];
  ASSERT_EQ(curve.causes->differences.size(), 2u);
  EXPECT_EQ(curve.causes->differences[0].name, "spring_update");
  EXPECT_GT(largest(causes.parts[0]), *causes.limit);
  EXPECT_LT(largest(causes.parts[1]), 0.1 * *causes.limit);
  EXPECT_LT(largest(causes.remainder), 1e-9);
}

/// A fault behind the convention, a convention that is only declared, and a fault without any.
TEST(DeclaredScore, FaultOfTheEngine_IsNoModelDifference) {
  const auto slippery = [](Scene& scene) { scene.law.mu *= 1.2; };
  Declares faulty(cutsTension, slippery), undeclared({}, slippery);
  const CollisionCurve curve = firstSweep(faulty, withTension());
  EXPECT_EQ(curve.declared->score.verdict, Verdict::fail);
  EXPECT_EQ(verdictOf(curve), Verdict::fail);
  Declares only(cutsTension, [](Scene& scene) { scene.law.conventions.tension = Tension::allow; });
  const CollisionCurve scenes = firstSweep(only, withTension());
  EXPECT_EQ(scenes.score.verdict, Verdict::pass);
  EXPECT_EQ(verdictOf(scenes), Verdict::fail);
  const CollisionCurve plain = firstSweep(undeclared, withTension());
  EXPECT_FALSE(plain.declared);
  EXPECT_EQ(verdictOf(plain), Verdict::fail);
}

/// A dashpot outside the bound has no limit of small steps: the in-house engine decides.
TEST(DeclaredScore, LawWithoutALimit_IsComparedWithTheMirror) {
  const Case setup = variantOf("figure-4-3.toml", "spring_dashpot-cut");
  const LawConventionSets outside = {{"dashpot", {"outside"}}};
  Declares right(outside, [](Scene&) {});
  const CollisionCurve curve = firstSweep(right, setup);
  EXPECT_EQ(curve.declared->reference, DeclaredReference::mirror);
  EXPECT_NE(curve.declared->oracleReason.find("dashpot"), std::string::npos);
  EXPECT_EQ(curve.declared->score.verdict, Verdict::pass);
  EXPECT_EQ(curve.declared->score.of[QuantityId::psiF]->max, 0.0);
  Declares wrong(outside, [](Scene& scene) { scene.law.gt *= 1.5; });
  EXPECT_EQ(verdictOf(firstSweep(wrong, setup)), Verdict::fail);
  // A mirror is the in-house engine: it would be compared with itself.
  const CollisionCurve itself = firstSweep(right, setup, "somebody");
  EXPECT_EQ(itself.declared->reference, DeclaredReference::itself);
  EXPECT_EQ(itself.declared->score.verdict, Verdict::notMeasured);
  EXPECT_NE(verdictOf(itself), Verdict::fail);
}

/// At 10 mm/s and t_c/2000 a step's way is less than what single precision rounds places by; at 1
/// m/s and t_c/50 it is three thousand times as long.
TEST(DeclaredScore, SinglePrecision_IsJudgedWhereRoundingOfPlacesLeavesTheOutcome) {
  Case setup = variantOf("figure-4-3.toml", "spring_dashpot-tension");
  test::PlantedEngine right([](Scene& scene) { scene.precision = Precision::float32; });
  test::PlantedEngine wrong([](Scene& scene) {
    scene.precision = Precision::float32;
    scene.law.kn *= 1.2;
  });
  collisionIn(setup).stepsPerContact = {2000.0};
  const CollisionCurve slow = firstSweep(right, setup);
  EXPECT_GT(slow.score.of[QuantityId::duration]->max, *slow.score.of[QuantityId::duration]->limit);
  EXPECT_GT(slow.score.rounding.value(), 1.0);
  EXPECT_EQ(verdictOf(slow), Verdict::notMeasured);
  EXPECT_NE(slow.reason.find("float precision"), std::string::npos) << slow.reason;
  collisionIn(setup).stepsPerContact = {50.0};
  collisionIn(setup).vn = {1.0};
  EXPECT_EQ(verdictOf(firstSweep(right, setup)), Verdict::pass);
  EXPECT_EQ(verdictOf(firstSweep(wrong, setup)), Verdict::fail);
  test::PlantedEngine inDouble([](Scene&) {});
  EXPECT_FALSE(firstSweep(inDouble, setup).score.rounding);
}

/// A dashpot outside the bound jumps between steps, and where rounding decides: at a speed that
/// single precision resolves otherwise, too.
TEST(DeclaredScore, SinglePrecisionUnderALawWithoutALimit_IsNotJudgedWhereItFallsShort) {
  Case setup = variantOf("figure-4-3.toml", "spring_dashpot-cut");
  collisionIn(setup).vn = {0.3};
  Declares single({{"dashpot", {"outside"}}}, [](Scene& scene) {
    scene.precision = Precision::float32;
    scene.law.gt *= 1.5;  // stands for what other roundings do
  });
  const CollisionCurve curve = firstSweep(single, setup);
  EXPECT_EQ(curve.declared->reference, DeclaredReference::mirror);
  EXPECT_EQ(verdictOf(curve), Verdict::notMeasured);
  EXPECT_NE(curve.reason.find("jumps between steps"), std::string::npos) << curve.reason;
}

/// A spring that is let go of without the dashpot begins half a step late under a bound that is
/// µ γ_n v_n at the first touch, 0.04 of Ψ_f at t_c/50, where the margin is 0.03, in any engine.
TEST(DeclaredScore, StepTooCoarseForTheMargin_IsNotTheEnginesFault) {
  Case setup = variantOf("figure-4-3.toml", "spring_dashpot-tension");
  setup.law.conventions.springReset = SpringReset::springOnly;
  setup.law.conventions.dampingVelocity = DampingVelocity::lagged;
  collisionIn(setup).stepsPerContact = {50.0};
  test::PlantedEngine right([](Scene&) {});
  EXPECT_EQ(verdictOf(firstSweep(right, setup)), Verdict::fail);
  const CollisionCurve coarse = firstSweep(right, setup, "", true);
  EXPECT_EQ(verdictOf(coarse), Verdict::notMeasured);
  EXPECT_EQ(coarse.score.of[QuantityId::en]->held, true);
  EXPECT_FALSE(coarse.score.of[QuantityId::psiF]->held);
  EXPECT_NE(coarse.reason.find("at this time step"), std::string::npos) << coarse.reason;
  test::PlantedEngine slippery([](Scene&scene) { scene.law.mu *= 1.2; }),
      soft([](Scene&scene) { scene.law.kn *= 0.9; });
  EXPECT_EQ(verdictOf(firstSweep(slippery, setup, "", true)), Verdict::fail);
  EXPECT_EQ(verdictOf(firstSweep(soft, setup, "", true)), Verdict::fail);
}

/// Nothing known of the declared law is no excuse.
TEST(DeclaredScore, UnknownLaw_IsComparedWithTheScenes) {
  CollisionCurve curve;
  curve.score.verdict = Verdict::fail;
  curve.declared.emplace();
  EXPECT_EQ(verdictOf(curve), Verdict::fail);
  curve.score.verdict = Verdict::pass;
  EXPECT_EQ(verdictOf(curve), Verdict::pass);
}

/// Contacts that are stiffer by as much as the engine says, at the same restitution.
TEST(DeclaredScore, DeclaredStiffness_IsAModelDifference) {
  const Case setup = variantOf("restitution-sweep.toml", "base");
  const auto engine = makeStiffGrain(25.0);
  const CollisionCurve curve = firstSweep(*engine, setup);
  EXPECT_EQ(curve.score.of[QuantityId::duration]->held, false);
  ASSERT_TRUE(curve.declared);
  EXPECT_EQ(curve.declared->law.at("kn"), LawValue(25.0 * setup.law.kn));
  EXPECT_EQ(curve.declared->score.verdict, Verdict::pass);
  EXPECT_EQ(verdictOf(curve), Verdict::modelDifference);
}

/// Of another normal law the restitutions are those that the engine reports.
TEST(DeclaredScore, RigidContacts_AreComparedWithTheirOwnLaw) {
  const Case setup = variantOf("figure-4-3.toml", "coulomb-cut");
  const auto engine = makeBox2dImpulse();
  const CollisionCurve curve = firstSweep(*engine, setup);
  ASSERT_TRUE(curve.declared);
  EXPECT_EQ(curve.declared->law.at("normal"), LawValue("rigid"));
  EXPECT_EQ(curve.declared->law.at("e_n"), LawValue(curve.effective->pairs.front().en));
  EXPECT_EQ(curve.declared->score.verdict, Verdict::pass);
}

/// Too stiff by a twentieth: contacts are 2.4 % shorter (1.9 % of Hertz' law), in every case, and
/// overlaps less deep by as much, which shows but where e_n is below a third.
TEST(CollisionMargins, ContactTooStiffByATwentieth_IsBeyondThem) {
  struct Where {
    const char *file, *variant;
    bool byOverlap;
  };
  const Where places[] = {{"figure-4-3.toml", "spring_dashpot-cut", false},
                          {"figure-4-3.toml", "coulomb-tension", false},
                          {"speeds.toml", "1e-3", false},
                          {"unequal.toml", "radii-1-3", false},
                          {"wall-spin.toml", "fixed", true},
                          {"restitution-sweep.toml", "base", true},
                          {"becker-no-slip.toml", "kt-0.2", true},
                          {"glass-foerster-soft.toml", "", true},
                          {"measured-disk.toml", "", true},
                          {"chung-ooi-1.toml", "glass", true},
                          {"chung-ooi-5.toml", "steel", true},
                          {"chung-ooi-6.toml", "nylon", true}};
  for (const Where& where : places) {
    const Case setup = variantOf(where.file, where.variant);
    const auto heldWith = [&](double factor, QuantityId quantity) {
      test::PlantedEngine engine([&](Scene& scene) {
        scene.law.kn *= factor;
        scene.law.kn3 *= factor;
      });
      const auto score = firstSweep(engine, setup).score.of[quantity];
      EXPECT_TRUE(score && score->held) << where.file;
      return score && score->held.value_or(false);
    };
    for (const QuantityId quantity : {QuantityId::duration, QuantityId::maxOverlap})
      EXPECT_TRUE(heldWith(1.0, quantity)) << where.file << " " << where.variant;
    EXPECT_FALSE(heldWith(1.05, QuantityId::duration)) << where.file << " " << where.variant;
    EXPECT_EQ(heldWith(1.05, QuantityId::maxOverlap), !where.byOverlap)
        << where.file << " " << where.variant;
  }
}

}  // namespace

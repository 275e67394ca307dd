// Engines against the discrete oracle of their own scheme, right ones and ones with a fault.
#include "studies/collide/score.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "adapters/box2d_common.hpp"
#include "law/law_options.hpp"
#include "oracle/impact.hpp"
#include "stability/transform.hpp"
#include "tests/studies/planted_engine.hpp"
#include "tests/support/pairs.hpp"

namespace {

using namespace crossgrain;

constexpr double aFiftieth = test::smallContactTime / 50.0;

SchemeScore ownScheme(Engine& engine, const Case& setup) {
  return schemeScore(engine, test::inHouse, setup, aFiftieth);
}

SchemeScore planted(std::function<void(Scene&)> fault) {
  test::PlantedEngine engine(std::move(fault));
  return ownScheme(engine, test::smallPairCase());
}

/// Every integrator with every damping velocity, with tension and without, of disks alike and not,
/// and on a wall.
TEST(OwnScheme, InHouseEngine_FollowsEachSchemeToRounding) {
  Case unequal = test::smallPairCase(), wall = test::smallPairCase();
  const CollidingPair pair = test::unequalPair();
  for (const int side : {0, 1}) {
    collisionIn(unequal).radius[side] = pair.radius[side];
    collisionIn(unequal).mass[side] = pair.mass[side];
  }
  collisionIn(wall).wall = true;
  int schemes = 0;
  for (Case setup : {test::smallPairCase(), unequal, wall})
    for (const char* integrator : {"position_verlet", "velocity_verlet", "semi_implicit_euler"})
      for (const char* damping : {"lagged", "predicted", "implicit"})
        for (const char* tension : {"allow", "cut"})
          for (const char* damper : {"constant", "critical"}) {
            setLawOption(setup.law, "integrator", integrator);
            setLawOption(setup.law, "damping_velocity", damping);
            setLawOption(setup.law, "tension", tension);
            setLawOption(setup.law, "damper", damper);
            setup.law.gn = setup.law.damper == Damper::critical ? 0.4 : 0.19;
            setup.run.mayDiffer = {"damping_velocity"};
            const auto engine = makeGrain();
            const SchemeScore score = ownScheme(*engine, setup);
            EXPECT_EQ(score.held, true) << integrator << " " << damping << " " << tension << ": "
                                        << *score.position << ", " << *score.velocity;
            EXPECT_EQ(score.scheme, integrator);
            EXPECT_LT(*score.velocity, 2e-13);
            ++schemes;
          }
  EXPECT_EQ(schemes, 3 * 3 * 3 * 2 * 2);
}

/// An engine that holds a scene otherwise rounds it otherwise, and does nothing wrong.
TEST(OwnScheme, RoundingOfTheStart_IsNoFaultUnderAnyLaw) {
  for (const TangentialLaw tangential :
       {TangentialLaw::none, TangentialLaw::coulomb, TangentialLaw::viscous, TangentialLaw::spring,
        TangentialLaw::springDashpot}) {
    Case setup = test::smallPairCase();
    setup.law.tangential = tangential;
    test::PlantedEngine engine(
        [](Scene& scene) { scene.disks = nudged(scene.disks, 2.3e-16, 22); });
    EXPECT_EQ(ownScheme(engine, setup).held, true) << static_cast<int>(tangential);
  }
}

TEST(OwnScheme, Peer_FollowsItsOwnScheme) {
  Case setup = test::smallPairCase();
  setup.run.mayDiffer = {"integrator", "damping_velocity", "spring_update"};
  const auto engine = makeBox2dPenalty();
  const SchemeScore score = ownScheme(*engine, setup);
  EXPECT_EQ(score.held, true) << *score.position << " " << *score.velocity;
  EXPECT_EQ(score.scheme, "semi_implicit_euler");
}

TEST(OwnScheme, FaultFarBelowTruncation_IsFound) {
  const std::pair<const char*, std::function<void(Scene&)>> faults[] = {
      {"k_n + 1e-9", [](Scene& scene) { scene.law.kn *= 1.0 + 1e-9; }},
      {"gamma_n + 1e-9", [](Scene& scene) { scene.law.gn *= 1.0 + 1e-9; }},
      {"a mass + 1e-9", [](Scene& scene) { scene.disks.mass[0] *= 1.0 + 1e-9; }},
      {"a radius + 1e-9", [](Scene& scene) { scene.disks.radius[1] *= 1.0 + 1e-9; }},
      {"tension cut", [](Scene& scene) { scene.law.conventions.tension = Tension::cut; }},
      {"a dashpot half a step late",
       [](Scene& scene) { scene.law.conventions.dampingVelocity = DampingVelocity::lagged; }},
      {"gravity", [](Scene& scene) { scene.gravity = Vec2(0.0, -1e-6); }}};
  for (const auto& [what, plant] : faults) {
    const SchemeScore score = planted(plant);
    EXPECT_EQ(score.held, false) << what << ": " << *score.position << ", " << *score.velocity;
    EXPECT_GT(std::max(*score.position, *score.velocity), 1e-11) << what;
  }
  EXPECT_EQ(planted([](Scene&) {}).held, true);
}

/// An engine that does two steps where it says it does one.
class DoubleStep : public test::PlantedEngine {
 public:
  DoubleStep() : PlantedEngine([](Scene& scene) { scene.dt *= 2.0; }) {}
  EffectiveParameters load(const Scene& scene, const Settings& settings) override {
    EffectiveParameters effective = PlantedEngine::load(scene, settings);
    effective.dt = scene.dt;
    return effective;
  }
  double advance(double t) override { return PlantedEngine::advance(2.0 * t); }
};

TEST(OwnScheme, OtherTimeStepThanDeclared_IsFound) {
  DoubleStep engine;
  EXPECT_EQ(ownScheme(engine, test::smallPairCase()).held, false);
}

TEST(OwnScheme, NaNOnTheWay_IsFound) {
  test::PlantedEngine lost(
      [](Scene&) {},
      [](Snapshot& now) {
        if (now.positionTime > 20.0 * aFiftieth && now.positionTime < 21.5 * aFiftieth)
          now.position[0].x() = NAN;
      });
  EXPECT_EQ(ownScheme(lost, test::smallPairCase()).held, false);
}

TEST(OwnScheme, SinglePrecision_IsReportedAndNotJudged) {
  Case setup = test::smallPairCase();
  setup.run.precision = Precision::float32;
  const auto engine = makeGrain();
  const SchemeScore score = ownScheme(*engine, setup);
  EXPECT_FALSE(score.held);
  EXPECT_GT(*score.velocity, 1e-9);
  EXPECT_LT(*score.velocity, 1e-3);
  EXPECT_NE(score.reason.find("float"), std::string::npos);
}

TEST(OwnScheme, LawWithoutADiscreteOracle_HasNoScore) {
  Case plate = test::smallPairCase(), rigid = plate;
  plate.bottom = BottomPlate{0.5, 1.0, 0.0, 0.0};
  rigid.law = test::rigidLaw(0.9, 0.0, 0.4);
  rigid.run.dt = 1e-4;
  for (const Case& setup : {plate, rigid}) {
    const auto engine = makeGrain();
    const SchemeScore score = ownScheme(*engine, setup);
    EXPECT_FALSE(score.position);
    EXPECT_FALSE(score.held);
    EXPECT_NE(score.reason, "");
  }
}

TEST(OwnScheme, HertzLaw_IsHeldToItsScheme) {
  Case hertz = test::smallPairCase();
  hertz.law = test::hertzLaw();
  const auto engine = makeGrain();
  const SchemeScore score = ownScheme(*engine, hertz);
  EXPECT_EQ(score.held, true) << score.reason;
  EXPECT_LT(*score.velocity, 1e-12);
}

/// An engine of an unknown scheme.
class Unknown : public test::PlantedEngine {
 public:
  Unknown() : PlantedEngine([](Scene&) {}) {}
  EffectiveParameters load(const Scene& scene, const Settings& settings) override {
    EffectiveParameters effective = PlantedEngine::load(scene, settings);
    effective.integrator = "gear_5";
    return effective;
  }
};

TEST(OwnScheme, UnknownScheme_HasNoScore) {
  Unknown engine;
  const SchemeScore score = ownScheme(engine, test::smallPairCase());
  EXPECT_FALSE(score.position);
  EXPECT_NE(score.reason.find("gear_5"), std::string::npos);
}

}  // namespace

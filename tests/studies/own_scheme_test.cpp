// Engines against the discrete oracle of their own scheme, right ones and ones with a fault.
#include "studies/collide/own_scheme.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "adapters/box2d.hpp"
#include "adapters/law_options.hpp"
#include "oracle/impact.hpp"
#include "stability/transform.hpp"
#include "tests/studies/planted_engine.hpp"
#include "tests/support/pairs.hpp"

namespace {

using namespace crossgrain;

constexpr double aFiftieth = 2.18e-3 / 50.0;

SchemeScore ownScheme(Engine& engine, const Case& setup) {
  const EngineEntry entry{"here", "", makeGrain, {}, {}, ""};
  return schemeScore(engine, entry, setup, aFiftieth);
}

SchemeScore planted(std::function<void(Scene&)> fault) {
  test::PlantedEngine engine(std::move(fault));
  return ownScheme(engine, test::smallPairCase());
}

/// Every integrator with every damping velocity, with tension and without, of disks alike and not,
/// and on a wall.
TEST(OwnScheme, TheInHouseEngineHoldsToEachToRounding) {
  Case unequal = test::smallPairCase(), wall = test::smallPairCase();
  const CollidingPair pair = test::unequalPair();
  for (const int side : {0, 1}) {
    unequal.collision.radius[side] = pair.radius[side];
    unequal.collision.mass[side] = pair.mass[side];
  }
  wall.collision.wall = true;
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
TEST(OwnScheme, ARoundingOfTheStartIsNoFaultUnderAnyLaw) {
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

TEST(OwnScheme, APeerHoldsToItsOwn) {
  Case setup = test::smallPairCase();
  setup.run.mayDiffer = {"integrator", "damping_velocity", "spring_update"};
  const auto engine = makeBox2dPenalty();
  const SchemeScore score = ownScheme(*engine, setup);
  EXPECT_EQ(score.held, true) << *score.position << " " << *score.velocity;
  EXPECT_EQ(score.scheme, "semi_implicit_euler");
}

struct PlantedFault {
  const char* what;
  std::function<void(Scene&)> plant;
};

TEST(OwnScheme, FindsAFaultFarBelowTruncation) {
  const std::vector<PlantedFault> faults = {
      {"k_n + 1e-9", [](Scene& scene) { scene.law.kn *= 1.0 + 1e-9; }},
      {"gamma_n + 1e-9", [](Scene& scene) { scene.law.gn *= 1.0 + 1e-9; }},
      {"a mass + 1e-9", [](Scene& scene) { scene.disks.mass[0] *= 1.0 + 1e-9; }},
      {"a radius + 1e-9", [](Scene& scene) { scene.disks.radius[1] *= 1.0 + 1e-9; }},
      {"tension cut", [](Scene& scene) { scene.law.conventions.tension = Tension::cut; }},
      {"a dashpot half a step late",
       [](Scene& scene) { scene.law.conventions.dampingVelocity = DampingVelocity::lagged; }},
      {"gravity", [](Scene& scene) { scene.gravity = Vec2(0.0, -1e-6); }}};
  for (const PlantedFault& fault : faults) {
    const SchemeScore score = planted(fault.plant);
    EXPECT_EQ(score.held, false) << fault.what << ": " << *score.position << ", "
                                 << *score.velocity;
    EXPECT_GT(std::max(*score.position, *score.velocity), 1e-11) << fault.what;
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

TEST(OwnScheme, FindsAnotherTimeStepThanTheOneDeclared) {
  DoubleStep engine;
  EXPECT_EQ(ownScheme(engine, test::smallPairCase()).held, false);
}

/// Two disks on a line by Störmer's scheme, written for this test alone: velocities are shown half
/// a step before positions. `late` is how many steps the dashpot's velocity is behind.
class TwoOnALine : public Engine {
 public:
  explicit TwoOnALine(int late) : late_(late) {}
  Capabilities capabilities() const override {
    Capabilities can = makeGrain()->capabilities();
    can.lawOptions["damping_velocity"] = {"lagged"};
    return can;
  }
  EffectiveParameters load(const Scene& scene, const Settings&) override {
    scene_ = scene;
    steps_ = 0;
    for (const std::size_t i : {0u, 1u}) {
      x_[i] = scene.disks.position[i].x();
      v_[i] = scene.disks.velocity[i].x();
    }
    seen_.assign(2, v_[0] - v_[1]);
    EffectiveParameters effective;
    effective.dt = scene.dt;
    effective.precision = "double";
    effective.integrator = "position_verlet";
    return effective;
  }
  double advance(double t) override {
    for (; steps_ < std::llround(t / scene_.dt); ++steps_) {
      const double overlap = scene_.disks.radius[0] + scene_.disks.radius[1] - (x_[0] - x_[1]);
      const double approach = *(seen_.rbegin() + late_);
      const double force = overlap > 0.0 ? scene_.law.kn * overlap - scene_.law.gn * approach : 0.0;
      for (const std::size_t i : {0u, 1u}) {
        v_[i] += (i == 0 ? force : -force) / scene_.disks.mass[i] * scene_.dt;
        x_[i] += v_[i] * scene_.dt;
      }
      seen_.push_back(v_[0] - v_[1]);
    }
    return static_cast<double>(steps_) * scene_.dt;
  }
  Snapshot snapshot(ContactReport) override {
    Snapshot now;
    now.positionTime = static_cast<double>(steps_) * scene_.dt;
    now.velocityTime = now.positionTime - (steps_ > 0 ? 0.5 * scene_.dt : 0.0);
    for (const std::size_t i : {0u, 1u}) {
      now.position.emplace_back(x_[i], 0.0);
      now.velocity.emplace_back(v_[i], 0.0);
    }
    return now;
  }
  Stats stats() const override { return {}; }

 private:
  int late_;
  Scene scene_;
  long long steps_ = 0;
  double x_[2] = {}, v_[2] = {};
  std::vector<double> seen_;  ///< relative velocities, step by step
};

TEST(OwnScheme, AnEngineOfAFewLinesHoldsAndWithADashpotAStepLateDoesNot) {
  Case setup = test::smallPairCase();
  setup.run.mayDiffer = {"damping_velocity"};
  TwoOnALine right(0), late(1);
  const SchemeScore score = ownScheme(right, setup);
  EXPECT_EQ(score.held, true) << *score.position << " " << *score.velocity;
  EXPECT_EQ(ownScheme(late, setup).held, false);
}

/// A NaN is no small deviation.
class Lost : public test::PlantedEngine {
 public:
  Lost() : PlantedEngine([](Scene&) {}) {}
  Snapshot snapshot(ContactReport contacts) override {
    Snapshot now = PlantedEngine::snapshot(contacts);
    if (now.positionTime > 20.0 * aFiftieth && now.positionTime < 21.5 * aFiftieth)
      now.position[0].x() = NAN;
    return now;
  }
};

TEST(OwnScheme, ANumberThatIsNoneDoesNotHold) {
  Lost engine;
  EXPECT_EQ(ownScheme(engine, test::smallPairCase()).held, false);
}

TEST(OwnScheme, SinglePrecisionIsToldAndNotJudged) {
  Case setup = test::smallPairCase();
  setup.run.precision = Precision::float32;
  const auto engine = makeGrain();
  const SchemeScore score = ownScheme(*engine, setup);
  EXPECT_FALSE(score.held);
  EXPECT_GT(*score.velocity, 1e-9);
  EXPECT_LT(*score.velocity, 1e-3);
  EXPECT_NE(score.reason.find("float"), std::string::npos);
}

TEST(OwnScheme, IsAbsentWhereThereIsNoDiscreteOracle) {
  Case hertz = test::smallPairCase(), plate = hertz, rigid = hertz;
  hertz.law = test::hertzLaw();
  plate.bottom = BottomPlate{0.5, 1.0, 0.0, 0.0};
  rigid.law = test::rigidLaw(0.9, 0.0, 0.4);
  rigid.run.dt = 1e-4;
  for (const Case& setup : {hertz, plate, rigid}) {
    const auto engine = makeGrain();
    const SchemeScore score = ownScheme(*engine, setup);
    EXPECT_FALSE(score.position);
    EXPECT_FALSE(score.held);
    EXPECT_NE(score.reason, "");
  }
}

/// An engine of a scheme that nobody knows.
class Unknown : public test::PlantedEngine {
 public:
  Unknown() : PlantedEngine([](Scene&) {}) {}
  EffectiveParameters load(const Scene& scene, const Settings& settings) override {
    EffectiveParameters effective = PlantedEngine::load(scene, settings);
    effective.integrator = "gear_5";
    return effective;
  }
};

TEST(OwnScheme, IsAbsentForASchemeThatNobodyKnows) {
  Unknown engine;
  const SchemeScore score = ownScheme(engine, test::smallPairCase());
  EXPECT_FALSE(score.position);
  EXPECT_NE(score.reason.find("gear_5"), std::string::npos);
}

}  // namespace

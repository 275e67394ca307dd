// Errors of collisions, trajectories and averages, as cost measures them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "adapters/grain.hpp"
#include "cases/couette.hpp"
#include "cases/time_step.hpp"
#include "oracle/collision_oracle.hpp"
#include "studies/cost/averages.hpp"
#include "studies/cost/collision.hpp"
#include "studies/cost/trajectory.hpp"
#include "tests/studies/planted_engine.hpp"
#include "tests/studies/quick_cell.hpp"
#include "tests/support/refusal.hpp"

namespace {

using namespace crossgrain;

Case withSteps(const Case& setup, double steps) {
  Case at = setup;
  at.run.dt = costContactTime(setup) / steps;
  return at;
}

CollisionLimit limitOf(Engine& engine, const Case& setup, const CollisionReference& reference) {
  return collisionLimit(engine, test::inHouse, withSteps(setup, 800.0), withSteps(setup, 400.0),
                        reference);
}

CostSetting settingNamed(const std::string& knob, const std::string& setting) {
  const auto engine = makeGrain();
  for (const CostSetting& one :
       costSettings(test::costCase(), CostKind::collision, "grain", engine->capabilities()))
    if (one.knob == knob && one.setting == setting) return one;
  throw std::runtime_error("no such setting");
}

std::vector<CostPoint> pointsOf(const CostSetting& setting) {
  const Case setup = test::costCase();
  const auto engine = makeGrain();
  const CollisionReference reference = collisionReference(setup);
  const CollisionLimit limit = limitOf(*engine, setup, reference);
  std::vector<CostRun> runs;
  for (const std::size_t round : {0u, 1u})
    runs.push_back(runCollisions(*engine, test::inHouse, setting, reference, limit, round));
  return collisionPoints(test::inHouse, setting, limit, runs);
}
std::vector<CostPoint> pointsOf(const std::string& knob, const std::string& setting) {
  return pointsOf(settingNamed(knob, setting));
}

/// A setting of so many steps a contact, whole or not.
CostSetting inSteps(double steps) {
  CostSetting setting = settingNamed("time_step", "the case's own");
  setting.setup = withSteps(setting.setup, steps);
  return setting;
}

TEST(CostCollision, Point_HasErrorTimeAndWork) {
  const auto points = pointsOf("time_step", "t_c/50");
  ASSERT_EQ(points.size(), 4u);
  EXPECT_EQ(points[0].measure, "psi_f");
  EXPECT_EQ(points[1].measure, "psi_f_own");
  EXPECT_EQ(points[2].measure, "e_n");
  EXPECT_EQ(points[3].measure, "e_n_own");
  for (const CostPoint& point : points) {
    EXPECT_EQ(point.status, Status::finished);
    EXPECT_NEAR(*point.stepsPerContact, 50.0, 1e-9);
    EXPECT_GT(*point.error, 0.0);
    EXPECT_LT(*point.error, 0.05);
    EXPECT_GT(*point.cpuSeconds, 0.0);
    EXPECT_LE(*point.timeLow, *point.cpuSeconds);
    EXPECT_GE(*point.timeHigh, *point.cpuSeconds);
    EXPECT_LE(point.low(), *point.error);
    EXPECT_GE(point.high(), *point.error);
    EXPECT_GE(*point.worst, *point.error);
    // 9 pairs; a sweep lasts 2.5 t_c and 21 steps.
    EXPECT_EQ(point.steps, 146u);
    EXPECT_GT(*point.contactEvaluations, 9u * 45u);
  }
}

TEST(CostCollision, TimedSweep_IsOfTheSettingsStep) {
  // A sweep lasts 2.5 t_c and 21 steps.
  EXPECT_EQ(pointsOf("time_step", "t_c/200")[0].steps, 521u);
  for (const Case& pair : collisionsOf(settingNamed("time_step", "t_c/200").setup))
    EXPECT_NEAR(timeStep(pair) / (costContactTime(test::costCase()) / 200.0), 1.0, 1e-12);
}

TEST(CostCollision, ThesisScheme_ConvergesAtFirstOrder) {
  // Position Verlet is of second order but for the dashpot's jumps at touch and parting, which
  // leave first order: η dt times where in a step they happen.
  const double coarse = *pointsOf("time_step", "t_c/50")[0].error;
  const double fine = *pointsOf("time_step", "t_c/200")[0].error;
  const double order = std::log(coarse / fine) / std::log(4.0);
  EXPECT_GT(order, 0.8);
  EXPECT_LT(order, 1.2);
}

/// collision_pairs.hpp derives √(f (1 − f)) γ_n dt/m₁₂ over phases, half of γ_n dt/m₁₂ at most; the
/// same by an independent integration: 2.97 % at t_c/50, 1.5 % at t_c/100, 1.0 % at t_c/150.
TEST(CostCollision, Restitution_ErrsByHalfTheDashpotsJumpOfAStep) {
  const Case setup = test::costCase();
  const double reducedMass = 0.5 * couetteIn(setup).particles.smallMass;
  for (const double steps : {50.0, 54.4, 100.0, 150.0, 200.0}) {
    const CostPoint point = pointsOf(inSteps(steps))[2];
    const double jump = setup.law.gn * costContactTime(setup) / steps / reducedMass;
    EXPECT_NEAR(*point.error, 0.5 * jump, 0.08 * 0.5 * jump) << steps;  // of nine phases
    EXPECT_GT(*point.worst, 0.8 * jump) << steps;
    EXPECT_LT(*point.worst, 1.1 * jump) << steps;
  }
}

/// 1 % of e_n, which a whole number of steps seems to reach at t_c/50.
TEST(CostCollision, OnePercentOfRestitution_IsReachedByFinerStepsThanHalvesOfAContact) {
  const double half = 1.0 / 2.0;
  EXPECT_GT(pointsOf(inSteps(50.0))[2].low(), 0.01);
  EXPECT_GT(*pointsOf(inSteps(100.0))[2].error, 0.014);
  EXPECT_LT(pointsOf(inSteps(200.0))[2].high(), 0.01);
  // Whole or not, steps that are as fine err alike.
  EXPECT_NEAR(*pointsOf(inSteps(50.0))[2].error, *pointsOf(inSteps(50.0 + half))[2].error, 3e-3);
}

TEST(CostCollision, CycleOfSteps_MeetsEveryFractionOfAContactOnce) {
  for (int j = 0; j < cycleSteps; ++j) {
    EXPECT_NEAR(2e-3 / cycleStep(4e-5, 2e-3, j), 50.0 + j / 8.0, 1e-9);
    EXPECT_GE(cycleStep(4e-4, 2e-3, j), 4e-4 / 1.1);  // t_c/5: within a tenth
  }
  std::vector<double> phases;
  for (std::size_t k = 100; k < 200; ++k) phases.push_back(phaseOf(k));
  std::ranges::sort(phases);
  EXPECT_LT(phases.front(), 0.02);
  EXPECT_GT(phases.back(), 0.98);
  for (std::size_t k = 1; k < phases.size(); ++k) EXPECT_LT(phases[k] - phases[k - 1], 0.02);
}

/// Every two sizes, and walls; each against its own oracle, from one scene.
TEST(CostCollision, PairsOfTheCell_EachFollowsItsOracle) {
  const Case setup = withSteps(test::costCase(), 2000.0);
  const CollisionReference reference = collisionReference(setup);
  std::vector<std::string> names;
  for (const PairCurve& pair : reference.pairs) names.push_back(pair.collision.name);
  EXPECT_EQ(names, (std::vector<std::string>{"small-small", "small-large", "small-wall",
                                             "large-large", "large-wall"}));
  const auto engine = makeGrain();
  const PairOutcomes found = runPairs(*engine, test::inHouse, collisionsOf(setup), reference,
                                      timeStep(setup), /*first=*/0);
  for (std::size_t p = 0; p < names.size(); ++p) {
    const PairCurve& pair = reference.pairs[p];
    // Head on the normal does not turn.
    EXPECT_NEAR(pair.oracle.ends[0]->en,
                restitutionOfLinearLaw(setup.law, collidingPair(pair.collision).reducedMass()),
                1e-8)
        << names[p];
    for (std::size_t k = 0; k < pair.starts.size(); ++k) {
      EXPECT_NEAR(found.of[p][k]->end.en, pair.oracle.ends[k]->en, 2e-3) << names[p];
      EXPECT_NEAR(found.of[p][k]->end.psi, pair.oracle.ends[k]->psi, 0.02) << names[p];
    }
  }
}

TEST(CostCollision, StepBeyondTheStabilityLimit_FailsAndSaysSo) {
  // dt = t_c/1.2, where 2/ω is about t_c/1.6
  const auto engine = makeGrain();
  const CollisionReference reference = collisionReference(test::costCase());
  const CostRun run =
      runCollisions(*engine, test::inHouse, settingNamed("time_step", "t_c/1.2"), reference, {}, 0);
  EXPECT_EQ(run.status, Status::failed);
  EXPECT_TRUE(run.reason.starts_with(beyondLimit)) << run.reason;
}

TEST(CostCollision, OtherLaw_ErrsByTheDifferenceAlsoFromTheCasesOracle) {
  // Tension cut: e_n 0.341 where the case has 0.222, relative to 0.222.
  const auto cut = pointsOf("tension", "cut");
  EXPECT_NEAR(*cut[2].error, 0.119 / 0.222, 0.03);
  for (const auto& points : {pointsOf("time_step", "t_c/50"), cut}) {
    EXPECT_NEAR(*points[1].error, *points[0].error, 1e-8);
    EXPECT_NEAR(*points[3].error, *points[2].error, 1e-8);
  }
}

/// Of an engine that runs the case with another law.
CollisionLimit limitUnder(const std::string& law) {
  const auto engine = makeGrain();
  return limitOf(*engine, test::costCase("[law]\n" + law + "\n"),
                 collisionReference(test::costCase()));
}

TEST(CostCollision, LimitOfADeclaredLaw_IsItsOracle) {
  const CollisionLimit limit = limitUnder("tension = \"cut\"");
  EXPECT_EQ(limit.setting, "oracle of the law that it declares");
  EXPECT_NEAR(limit.model.at("e_n"), 0.119 / 0.222, 0.01);
  EXPECT_EQ(limit.error.at("e_n"), 0.0);
}

/// A dashpot outside the bound jumps with every step.
TEST(CostCollision, LimitOfALawWithoutOracle_IsSmallSteps) {
  const CollisionLimit limit = limitUnder("dashpot = \"outside\"");
  EXPECT_EQ(limit.setting, "t_c/800");
  EXPECT_GT(limit.error.at("psi_f"), 0.0);
  EXPECT_LT(limit.error.at("psi_f"), 0.01);
  EXPECT_GT(limit.model.at("psi_f"), limit.error.at("psi_f"));
}

/// An engine whose steps take a millisecond for each body of the scene that it has loaded.
class MillisecondABody final : public test::PlantedEngine {
 public:
  MillisecondABody() : PlantedEngine([this](Scene& scene) { bodies = scene.disks.size(); }) {}
  Stats stats() const override {
    Stats stats = PlantedEngine::stats();
    stats.wallSeconds = 1e-3 * static_cast<double>(bodies * stats.steps);
    return stats;
  }
  std::size_t bodies = 0;
};

/// A slow engine of a large scene has its collisions planned by the bodies that collide.
TEST(CostCollision, TimeOfAStep_IsOfTheBodiesThatCollide) {
  const Case setup = test::costCase();
  MillisecondABody engine;
  const SceneTimes times = timeCollisions(engine, test::inHouse, setup, timeStep(setup));
  std::size_t bodies = 0;
  for (const Case& pair : collisionsOf(setup))
    bodies += collisionIn(pair).psi.size() * (std::isinf(collisionIn(pair).mass[1]) ? 1 : 2);
  EXPECT_EQ(engine.bodies, bodies);
  EXPECT_NEAR(times.step, 1e-3 * static_cast<double>(bodies), 1e-9);
}

TEST(CostCollision, CurveError_SkipsStartsWithoutReference) {
  // 3 and 4 in units of 2: √(12.5)/2
  const auto error = curveError({3.0, 4.0, 9.0}, {0.0, 0.0, {}}, 2.0);
  EXPECT_NEAR(error->rms, std::sqrt(12.5) / 2.0, 1e-12);
  EXPECT_NEAR(error->worst, 2.0, 1e-12);
  // Squares 2.25 and 4: mean 3.125 ± 12.706 · 0.875, Student's t of one degree of freedom.
  EXPECT_EQ(error->low, 0.0);
  EXPECT_NEAR(error->high, std::sqrt(3.125 + 12.7062 * 0.875), 1e-3);
  EXPECT_FALSE(curveError({3.0, {}}, {0.0, 0.0}, 2.0));
  EXPECT_FALSE(curveError({3.0}, {{}}, 2.0));
  EXPECT_NEAR(
      rmsDistance({{3.0, 0.0, 0.0}, {0.0, 4.0, 0.0}}, {{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}}, 2.0),
      std::sqrt(12.5) / 2.0, 1e-12);
}

TEST(CostTime, Rounds_GiveAGeometricMeanAndItsInterval) {
  std::vector<CostRun> runs(3);
  const double cpu[] = {1.0, 2.0, 4.0};
  for (std::size_t k = 0; k < 3; ++k) {
    runs[k].dt = 1e-3;
    runs[k].cpuSeconds = cpu[k];
    runs[k].wallSeconds = 10.0 * cpu[k];
  }
  const CostSetting setting = settingNamed("time_step", "the case's own");
  const CostPoint point = timedPoint("a", setting, CostKind::collision, runs);
  EXPECT_NEAR(*point.cpuSeconds, 2.0, 1e-12);
  EXPECT_NEAR(*point.wallSeconds, 20.0, 1e-12);
  // Logarithms 0, ln 2, 2 ln 2: standard error ln 2/√3; Student's t of two degrees is 4.3027.
  EXPECT_NEAR(*point.timeHigh / 2.0, std::exp(4.3027 * std::log(2.0) / std::sqrt(3.0)), 1e-3);
  EXPECT_NEAR(*point.timeLow * *point.timeHigh, 4.0, 1e-9);
  runs[1].cpuSeconds = 0.0;  // not reported
  EXPECT_FALSE(timedPoint("a", setting, CostKind::collision, runs).cpuSeconds);
  EXPECT_FALSE(timedPoint("a", setting, CostKind::collision, {runs[0]}).timeLow);
}

/// A packing that needs no preparation: disks on a lattice between the walls, each moving.
class CostTrajectory : public testing::Test {
 protected:
  void SetUp() override {
    Disks disks = diskKinds(couetteIn(setup_).particles);
    disks.position.clear();
    const double spacing = 2.02 * couetteIn(setup_).particles.largeRadius;
    for (int row = -9; row <= 9; ++row)
      for (int column = -9; column <= 9; ++column) {
        const Vec2 at((column + 0.5 * (row & 1)) * spacing, row * 0.87 * spacing);
        const double margin =
            couetteIn(setup_).particles.largeRadius + couetteIn(setup_).cell.wallRadius;
        if (at.norm() < couetteIn(setup_).cell.innerRadius + margin ||
            at.norm() > couetteIn(setup_).cell.outerRadius - margin)
          continue;
        disks.position.push_back(at);
        disks.velocity.push_back({0.02 * std::sin(3.0 * row + column), 0.02 * std::cos(column)});
      }
    const std::size_t count = disks.position.size();
    disks.velocity.erase(disks.velocity.begin(),
                         disks.velocity.end() - static_cast<std::ptrdiff_t>(count));
    for (auto* list : {&disks.radius, &disks.mass, &disks.inertia, &disks.spin})
      list->resize(count, 0.0);
    packing_.disks = disks;
  }

  std::vector<Vec3> follow(const std::string& fragment, double time) {
    return followPacking(*makeGrain(), test::inHouse, test::costCase(fragment), packing_, time)
        .positions;
  }

  Case setup_ = test::costCase();
  Packing packing_;
};

TEST_F(CostTrajectory, Skin_ChangesTheTimeOnly) {
  const auto tuned = follow("", 0.1);
  for (const char* const skin : {"5e-5", "1e-3", "4e-3"})
    EXPECT_EQ(follow(std::string("[engines.grain]\nskin = ") + skin, 0.1), tuned) << skin;
}

TEST_F(CostTrajectory, Errors_FallWithTheStep) {
  const double window = 100.0 * costContactTime(setup_);
  const auto reference = follow("[run]\nsteps_per_contact = 800", window);
  const auto errorAt = [&](const char* steps) {
    return rmsDistance(follow(std::string("[run]\nsteps_per_contact = ") + steps, window),
                       reference, 2.0 * couetteIn(setup_).particles.smallRadius);
  };
  EXPECT_LT(errorAt("100"), 0.5 * errorAt("20"));
  EXPECT_GT(errorAt("100"), 0.0);
}

TEST_F(CostTrajectory, PackingThatBlowsUp_SaysSo) {
  const auto expectFailure = [&](const std::string& fragment, const std::string& words) {
    const std::string said = test::refusalOf<std::runtime_error>([&] { follow(fragment, 0.5); });
    EXPECT_NE(said.find(words), std::string::npos) << said;
  };
  // Of an engine that does not see it by itself, and of one that does.
  expectFailure("[run]\ndt = 2e-3\n[engines.grain]\nmax_overlap = 0", beyondLimit);
  expectFailure("[run]\ndt = 2e-3", "overlap by");
}

CostRun run(const std::vector<std::optional<double>>& stress, double slip) {
  CostRun run;
  run.numbers = {{"stress_rr", stress}, {"wall_slip", {slip}}};
  return run;
}

TEST(CostAverages, PairedError_SplitsScatterAndBias) {
  // Differences 1 and 3: mean 2, standard error 1. Scale: the mean of the reference, 20.
  const std::vector<CostRun> reference = {run({20.0}, 0.1), run({20.0}, 0.1)};
  const auto found =
      pairedError({run({21.0}, 0.2), run({23.0}, 0.2)}, reference, "stress_rr", 0.05);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->error, 2.0 / 20.0, 1e-12);
  EXPECT_NEAR(*found->statistical, 1.0 / 20.0, 1e-12);
  EXPECT_NEAR(*found->systematic, std::sqrt(3.0) / 20.0, 1e-12);
  // Student's t of one degree of freedom for 5 % is tan(π/2 · 0.95) = 12.706: the mean may be 0.
  EXPECT_EQ(*found->low, 0.0);
  EXPECT_NEAR(*found->high, 14.706 / 20.0, 1e-4);
  // 2 ± 0.01: from 2 − 0.12706 on
  const auto narrow =
      pairedError({run({21.99}, 0.2), run({22.01}, 0.2)}, reference, "stress_rr", 0.05);
  EXPECT_NEAR(*narrow->low, 1.87294 / 20.0, 1e-5);
}

/// 0.3 and 0.2 off 20 in units of 0.1: a run that differs from its repetition counts with the
/// larger error, and alike ones have no interval.
TEST(CostAverages, ExactError_IsTheLargestDistanceFromTheClosedForm) {
  const auto found = exactError({run({20.2}, 0.1), run({19.7}, 0.1)}, "stress_rr", 20.0, 0.1);
  EXPECT_NEAR(found->error, 3.0, 1e-9);
  EXPECT_NEAR(*found->low, 2.0, 1e-9);
  EXPECT_EQ(*found->high, found->error);
  EXPECT_EQ(*found->statistical, 0.0);
  const auto alike = exactError({run({20.2}, 0.1), run({20.2}, 0.1)}, "stress_rr", 20.0, 0.1);
  EXPECT_EQ(*alike->low, *alike->high);
  EXPECT_FALSE(exactError({run({20.0}, 0.1), CostRun{}}, "stress_rr", 20.0, 0.1));
  EXPECT_FALSE(exactError({}, "stress_rr", 20.0, 0.1));
}

TEST(CostAverages, OnePackingNoneOrAFraction_AreSpecialCases) {
  const auto one = pairedError({run({2.0}, 0.2)}, {run({1.0}, 0.1)}, "stress_rr", 0.05);
  EXPECT_NEAR(one->error, 1.0, 1e-12);
  EXPECT_FALSE(one->statistical);
  EXPECT_FALSE(one->systematic);
  EXPECT_FALSE(pairedError({CostRun{}}, {run({1.0}, 0.1)}, "stress_rr", 0.05));
  // Slip is a fraction of the rim's speed already.
  const auto slip = pairedError({run({1.0}, 0.2), run({1.0}, 0.2)},
                                {run({1.0}, 0.1), run({1.0}, 0.1)}, "wall_slip", 0.05, 1.0);
  EXPECT_NEAR(slip->error, 0.1, 1e-12);
  EXPECT_NEAR(*slip->systematic, 0.1, 1e-12);
  // Scatter that explains the difference leaves no bias.
  const auto chance = pairedError({run({2.0}, 0.0), run({0.0}, 0.0)},
                                  {run({1.0}, 0.0), run({1.0}, 0.0)}, "stress_rr", 0.05);
  EXPECT_NEAR(chance->error, 0.0, 1e-12);
  EXPECT_NEAR(*chance->statistical, 1.0, 1e-12);
  EXPECT_EQ(*chance->systematic, 0.0);
}

}  // namespace

// Errors of collisions, trajectories and averages, as cost measures them.
#include <gtest/gtest.h>

#include <cmath>

#include "adapters/grain.hpp"
#include "cases/couette.hpp"
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

std::vector<CostPoint> pointsOf(const std::string& knob, const std::string& setting) {
  const Case setup = test::costCase();
  const auto engine = makeGrain();
  for (const CostSetting& one :
       costSettings(setup, CostKind::collision, "grain", engine->capabilities()))
    if (one.knob == knob && one.setting == setting) {
      const CollisionReference reference = collisionReference(setup);
      return measureCollision(*engine, test::inHouse, one, reference,
                              limitOf(*engine, setup, reference));
    }
  throw std::runtime_error("no such setting");
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
    EXPECT_GT(*point.wallSeconds, 0.0);
    // 9 pairs; a sweep lasts 2.5 t_c and 21 steps.
    EXPECT_EQ(point.steps, 146u);
    EXPECT_GT(*point.contactEvaluations, 9u * 45u);
  }
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

TEST(CostCollision, StepBeyondTheStabilityLimit_FailsAndSaysSo) {
  // dt = t_c/1.2, where 2/ω is about t_c/1.6
  for (const CostPoint& point : pointsOf("time_step", "t_c/1.2")) {
    EXPECT_EQ(point.status, Status::failed);
    EXPECT_TRUE(point.reason.starts_with(beyondLimit)) << point.reason;
    EXPECT_FALSE(point.error);
  }
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

TEST(CostCollision, RmsDifference_SkipsStartsWithoutReference) {
  // 3 and 4 in units of 2: √(12.5)/2
  EXPECT_NEAR(*rmsDifference({3.0, 4.0, 9.0}, {0.0, 0.0, {}}, 2.0), std::sqrt(12.5) / 2.0, 1e-12);
  EXPECT_FALSE(rmsDifference({3.0, {}}, {0.0, 0.0}, 2.0));
  EXPECT_FALSE(rmsDifference({3.0}, {{}}, 2.0));
  EXPECT_NEAR(rmsDistance({{3.0, 0.0}, {0.0, 4.0}}, {{0.0, 0.0}, {0.0, 0.0}}, 2.0),
              std::sqrt(12.5) / 2.0, 1e-12);
}

/// A packing that needs no preparation: disks on a lattice between the walls, each moving.
class CostTrajectory : public testing::Test {
 protected:
  void SetUp() override {
    Disks disks = diskKinds(setup_.particles);
    disks.position.clear();
    const double spacing = 2.02 * setup_.particles.largeRadius;
    for (int row = -9; row <= 9; ++row)
      for (int column = -9; column <= 9; ++column) {
        const Vec2 at((column + 0.5 * (row & 1)) * spacing, row * 0.87 * spacing);
        const double margin = setup_.particles.largeRadius + setup_.cell.wallRadius;
        if (at.norm() < setup_.cell.innerRadius + margin ||
            at.norm() > setup_.cell.outerRadius - margin)
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

  std::vector<Vec2> follow(const std::string& fragment, double time) {
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
                       reference, 2.0 * setup_.particles.smallRadius);
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

AveragedPacking run(const std::vector<std::optional<double>>& stress, double slip) {
  AveragedPacking run;
  run.numbers = {{"stress_rr", stress}, {"wall_slip", {slip}}};
  return run;
}

TEST(CostAverages, PairedError_SplitsScatterAndBias) {
  // Differences in ring 1: 1, 3 (mean 2, error 1); in ring 2: 0, 0. Scale: the largest mean, 20.
  const std::vector<AveragedPacking> reference = {run({10.0, 20.0}, 0.1), run({10.0, 20.0}, 0.1)};
  const auto found =
      pairedError({run({11.0, 20.0}, 0.2), run({13.0, 20.0}, 0.2)}, reference, "stress_rr", 0.05);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->error, std::sqrt(4.0 / 2.0) / 20.0, 1e-12);
  EXPECT_NEAR(*found->statistical, std::sqrt(1.0 / 2.0) / 20.0, 1e-12);
  EXPECT_NEAR(*found->systematic, std::sqrt(3.0 / 2.0) / 20.0, 1e-12);
  // Student's t of one degree of freedom for half of 5 % each is tan(π/2 · 0.975) = 25.45: the mean
  // of ring 1 may be 0, and 2 + 25.45.
  EXPECT_EQ(*found->low, 0.0);
  EXPECT_NEAR(*found->high, 27.452 / std::sqrt(2.0) / 20.0, 1e-4);
  // 2 ± 0.01: from 2 − 0.2545 on
  const auto narrow =
      pairedError({run({11.99, 20.0}, 0.2), run({12.01, 20.0}, 0.2)}, reference, "stress_rr", 0.05);
  EXPECT_NEAR(*narrow->low, 1.7455 / std::sqrt(2.0) / 20.0, 1e-5);
}

TEST(CostAverages, OnePackingNoneOrAFraction_AreSpecialCases) {
  const auto one = pairedError({run({2.0}, 0.2)}, {run({1.0}, 0.1)}, "stress_rr", 0.05);
  EXPECT_NEAR(one->error, 1.0, 1e-12);
  EXPECT_FALSE(one->statistical);
  EXPECT_FALSE(one->systematic);
  EXPECT_FALSE(pairedError({AveragedPacking{}}, {run({1.0}, 0.1)}, "stress_rr", 0.05));
  // Slip is a fraction of the rim's speed already.
  const auto slip = pairedError({run({1.0}, 0.2), run({1.0}, 0.2)},
                                {run({1.0}, 0.1), run({1.0}, 0.1)}, "wall_slip", 0.05);
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

#include "runs/cost/collision.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "adapters/grain.hpp"
#include "runs/cost/limits.hpp"
#include "runs/cost/order.hpp"
#include "tests/runs/cost_cases.hpp"

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

TEST(CostCollision, APointHasErrorTimeAndWork) {
  const auto points = pointsOf("time_step", "t_c/50");
  ASSERT_EQ(points.size(), 4u);
  EXPECT_EQ(points[0].measure, "psi_f");
  EXPECT_EQ(points[1].measure, "psi_f_own");
  EXPECT_EQ(points[2].measure, "e_n");
  EXPECT_EQ(points[3].measure, "e_n_own");
  for (const CostPoint& point : points) {
    EXPECT_EQ(point.status, CostStatus::ran);
    EXPECT_NEAR(*point.stepsPerContact, 50.0, 1e-9);
    EXPECT_GT(*point.error, 0.0);
    EXPECT_LT(*point.error, 0.05);
    EXPECT_GT(*point.wallSeconds, 0.0);
    // 9 pairs; a sweep lasts 2.5 t_c and 21 steps.
    EXPECT_EQ(point.steps, 146u);
    EXPECT_GT(*point.contactEvaluations, 9u * 45u);
  }
}

TEST(CostCollision, ErrorsOfTheThesisSchemeFallInProportionToTheStep) {
  // Position Verlet is of second order but for the dashpot's jumps at touch and parting, which
  // leave first order: η dt times where in a step they happen.
  const double coarse = *pointsOf("time_step", "t_c/50")[0].error;
  const double fine = *pointsOf("time_step", "t_c/200")[0].error;
  const double order = std::log(coarse / fine) / std::log(4.0);
  EXPECT_GT(order, 0.8);
  EXPECT_LT(order, 1.2);
}

TEST(CostCollision, PastTheStabilityLimitItFailsAndSaysSo) {
  // dt = t_c/1.2, where 2/ω is about t_c/1.6
  for (const CostPoint& point : pointsOf("time_step", "t_c/1.2")) {
    EXPECT_EQ(point.status, CostStatus::failed);
    EXPECT_TRUE(point.reason.starts_with(beyondLimit)) << point.reason;
    EXPECT_FALSE(point.error);
  }
}

TEST(CostCollision, ALawThatIsNotTheCasesErrsByTheDifference) {
  // Tension cut: e_n 0.341 where the case has 0.222, relative to 0.222.
  EXPECT_NEAR(*pointsOf("tension", "cut")[2].error, 0.119 / 0.222, 0.03);
}

TEST(CostCollision, OfTheCasesLawTheOwnLimitIsItsOracle) {
  for (const auto& points : {pointsOf("time_step", "t_c/50"), pointsOf("tension", "cut")}) {
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

/// An engine of another law: with tension cut e_n is 0.341 where the case has 0.222.
TEST(CostCollision, TheModelErrorIsThatOfTheOwnLimit) {
  const CollisionLimit limit = limitUnder("tension = \"cut\"");
  EXPECT_EQ(limit.setting, "oracle of the law that it declares");
  EXPECT_NEAR(limit.model.at("e_n"), 0.119 / 0.222, 0.01);
  EXPECT_EQ(limit.error.at("e_n"), 0.0);
}

/// A dashpot outside the bound jumps with every step: no oracle, so the engine's own small steps.
TEST(CostCollision, OfALawWithoutAnOracleTheOwnLimitIsItsSmallSteps) {
  const CollisionLimit limit = limitUnder("dashpot = \"outside\"");
  EXPECT_EQ(limit.setting, "t_c/800");
  EXPECT_GT(limit.error.at("psi_f"), 0.0);
  EXPECT_LT(limit.error.at("psi_f"), 0.01);
  EXPECT_GT(limit.model.at("psi_f"), limit.error.at("psi_f"));
}

TEST(CostCollision, DifferencesAreRootMeanSquares) {
  // 3 and 4 in units of 2: √(12.5)/2
  EXPECT_NEAR(*rmsDifference({3.0, 4.0, 9.0}, {0.0, 0.0, {}}, 2.0), std::sqrt(12.5) / 2.0, 1e-12);
  EXPECT_FALSE(rmsDifference({3.0, {}}, {0.0, 0.0}, 2.0));
  EXPECT_FALSE(rmsDifference({3.0}, {{}}, 2.0));
}

}  // namespace

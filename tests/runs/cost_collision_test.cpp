#include "runs/cost/collision.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "adapters/grain.hpp"
#include "runs/cost/limits.hpp"
#include "runs/cost/order.hpp"
#include "tests/runs/cost_cases.hpp"

namespace {

using namespace crossgrain;

std::vector<CostPoint> pointsOf(const std::string& knob, const std::string& setting) {
  const Case setup = test::costCase();
  const auto engine = makeGrain();
  for (const CostSetting& one :
       costSettings(setup, CostKind::collision, "grain", engine->capabilities()))
    if (one.knob == knob && one.setting == setting)
      return measureCollision(*engine, test::inHouse, one, collisionReference(setup));
  throw std::runtime_error("no such setting");
}

TEST(CostCollision, APointHasErrorTimeAndWork) {
  const auto points = pointsOf("time_step", "t_c/50");
  ASSERT_EQ(points.size(), 2u);
  EXPECT_EQ(points[0].measure, "psi_f");
  EXPECT_EQ(points[1].measure, "e_n");
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
  EXPECT_NEAR(*pointsOf("tension", "cut")[1].error, 0.119 / 0.222, 0.03);
}

}  // namespace

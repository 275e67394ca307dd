#include "runs/collide/score.hpp"

#include <gtest/gtest.h>

#include "tests/oracle/thesis_pair.hpp"

namespace {

using namespace crossgrain;
using nlohmann::json;

TEST(ErrorUnit, IsTheRangeUnlessTheCurveHasHardlyAny) {
  EXPECT_STREQ(errorUnit({-1.0, 0.5, 2.0}).name, "range");
  EXPECT_EQ(errorUnit({-1.0, 0.5, 2.0}).value, 3.0);
  EXPECT_STREQ(errorUnit({0.34, 0.341, -0.35}).name, "range");
  EXPECT_STREQ(errorUnit({0.34, 0.341}).name, "magnitude");  // e_n of a linear law
  EXPECT_EQ(errorUnit({-0.34, -0.341}).value, 0.341);
  EXPECT_STREQ(errorUnit({0.0, 0.0}).name, "absolute");
  EXPECT_EQ(errorUnit({0.0, 0.0}).value, 1.0);
}

/// Outcomes with these Ψ_f, all else alike.
Outcomes outcomes(const std::vector<double>& psi, double overlap) {
  Outcomes list;
  for (const double value : psi) {
    CollisionOutcome outcome;
    outcome.end.psi = value;
    outcome.end.en = 0.5;
    outcome.end.maxOverlap = overlap;
    list.push_back(outcome);
  }
  return list;
}

TEST(Score, LargestAndRmsErrorInUnitsOfTheRange) {
  const Case setup = test::smallPairCase();
  const std::vector<CollisionStart> starts(3, {1.0, 0.1, Approach::spin});
  const json score =
      scoreSweep(setup, starts, outcomes({0.0, 1.3, 4.0}, 2e-6), outcomes({0.0, 1.0, 4.0}, 1e-6));
  EXPECT_NEAR(score["psi_f"]["max"].get<double>(), 0.3 / 4.0, 1e-15);
  EXPECT_NEAR(score["psi_f"]["rms"].get<double>(), 0.3 / 4.0 / std::sqrt(3.0), 1e-15);
  EXPECT_EQ(score["psi_f"]["unit"], 4.0);
  EXPECT_EQ(score["max_error"], score["psi_f"]["max"]);
  EXPECT_EQ(score["e_n_error"], 0.0);
  EXPECT_NEAR(score["max_overlap"]["max"].get<double>(), 1.0, 1e-12);  // twice as large
  EXPECT_EQ(score["max_overlap"]["unit_is"], "magnitude");
  EXPECT_EQ(score["verdict"], "not judged");  // the case has no margins
  EXPECT_FALSE(score.contains("duration"));   // neither has one
}

TEST(Score, HoldsWhereEveryQuantityWithAMarginDoes) {
  Case setup = test::smallPairCase();
  const std::vector<CollisionStart> starts(2, {1.0, 0.1, Approach::spin});
  const Outcomes oracle = outcomes({0.0, 2.0}, 1e-6), found = outcomes({0.0, 2.1}, 1.2e-6);
  const auto verdict = [&](const Outcomes& outcomes) {
    return scoreSweep(setup, starts, outcomes, oracle)["verdict"].get<std::string>();
  };
  setup.collision.margins["psi_f"] = {0.11, false, "in its own unit", ""};
  EXPECT_EQ(verdict(found), "held");
  setup.collision.margins["max_overlap"] = {0.1, true, "a tenth of the largest", ""};
  EXPECT_EQ(verdict(found), "fell short");
  setup.collision.margins["max_overlap"].value = 0.3;
  EXPECT_EQ(verdict(found), "held");
  setup.collision.margins["duration"] = {0.1, true, "nobody knows it", ""};
  EXPECT_EQ(verdict(found), "held");
  Outcomes one = found;
  one[1].reset();
  EXPECT_EQ(verdict(one), "fell short");  // a pair that did not part
}

json curve(double dt, double psi, double en) {
  return {
      {"engine", "a"}, {"dt", dt}, {"score", {{"psi_f", {{"rms", psi}}}, {"e_n", {{"rms", en}}}}}};
}

TEST(ConvergenceOrder, IsTheSlopeOfErrorOverStepForEachQuantity) {
  const json coarse = curve(4e-5, 16e-3, 4e-4), middle = curve(2e-5, 4e-3, 2e-4),
             fine = curve(1e-5, 1e-3, 1e-4);
  const auto order = convergenceOrder({&coarse, &middle, &fine});
  ASSERT_TRUE(order);
  EXPECT_NEAR((*order)["order"].get<double>(), 2.0, 1e-12);
  EXPECT_NEAR((*order)["stderr"].get<double>(), 0.0, 1e-7);
  EXPECT_EQ((*order)["error_at"].size(), 3u);
  EXPECT_NEAR((*order)["quantities"]["psi_f"]["order"].get<double>(), 2.0, 1e-12);
  EXPECT_NEAR((*order)["quantities"]["e_n"]["order"].get<double>(), 1.0, 1e-12);
  EXPECT_FALSE(convergenceOrder({&coarse}));
  EXPECT_FALSE(convergenceOrder({&coarse, &coarse}));  // one step taken twice tells nothing
}

}  // namespace

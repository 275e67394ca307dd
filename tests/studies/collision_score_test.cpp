#include "studies/collide/score.hpp"

#include <gtest/gtest.h>

#include "tests/support/pairs.hpp"

namespace {

using namespace crossgrain;

TEST(ErrorUnit, CurveWithHardlyAnyRange_TakesItsMagnitude) {
  EXPECT_EQ(errorUnit({-1.0, 0.5, 2.0}).kind, ErrorUnitKind::range);
  EXPECT_EQ(errorUnit({-1.0, 0.5, 2.0}).value, 3.0);
  EXPECT_EQ(errorUnit({0.34, 0.341, -0.35}).kind, ErrorUnitKind::range);
  EXPECT_EQ(errorUnit({0.34, 0.341}).kind, ErrorUnitKind::magnitude);  // e_n of a linear law
  EXPECT_EQ(errorUnit({-0.34, -0.341}).value, 0.341);
  EXPECT_EQ(errorUnit({0.0, 0.0}).kind, ErrorUnitKind::absolute);
  EXPECT_EQ(errorUnit({0.0, 0.0}).value, 1.0);
  // Opposite spins, and what their sum leaves: an engine that has 0 is right.
  EXPECT_EQ(errorUnit({1.7e-17, 0.0}, oracleIsGoodTo).kind, ErrorUnitKind::absolute);
  EXPECT_EQ(errorUnit({1.7e-17, 0.0}, oracleIsGoodTo).value, 1.0);
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

TEST(Score, Errors_AreInUnitsOfTheRange) {
  const Case setup = test::smallPairCase();
  const std::vector<CollisionStart> starts(3, {1.0, 0.1, Approach::spin});
  const CurveScore score =
      scoreSweep(setup, starts, outcomes({0.0, 1.3, 4.0}, 2e-6), outcomes({0.0, 1.0, 4.0}, 1e-6));
  const QuantityScore psi = score.of[QuantityId::psiF].value();
  EXPECT_NEAR(psi.max, 0.3 / 4.0, 1e-15);
  EXPECT_NEAR(psi.rms, 0.3 / 4.0 / std::sqrt(3.0), 1e-15);
  EXPECT_EQ(psi.unit, 4.0);
  EXPECT_EQ(score.of[QuantityId::en].value().max, 0.0);
  const QuantityScore overlap = score.of[QuantityId::maxOverlap].value();
  EXPECT_NEAR(overlap.max, 1.0, 1e-12);  // twice as large
  EXPECT_EQ(overlap.unitIs, ErrorUnitKind::magnitude);
  EXPECT_EQ(score.verdict, Verdict::notMeasured);  // the case has no margins
  EXPECT_FALSE(score.of[QuantityId::duration]);    // neither has one
}

TEST(Score, EveryQuantityWithinItsMargin_Passes) {
  Case setup = test::smallPairCase();
  const std::vector<CollisionStart> starts(2, {1.0, 0.1, Approach::spin});
  const Outcomes oracle = outcomes({0.0, 2.0}, 1e-6), found = outcomes({0.0, 2.1}, 1.2e-6);
  const auto verdict = [&](const Outcomes& outcomes) {
    return scoreSweep(setup, starts, outcomes, oracle).verdict;
  };
  collisionIn(setup).margins["psi_f"] = {0.11, false, "in its own unit", ""};
  EXPECT_EQ(verdict(found), Verdict::pass);
  collisionIn(setup).margins["max_overlap"] = {0.1, true, "a tenth of the largest", ""};
  EXPECT_EQ(verdict(found), Verdict::fail);
  collisionIn(setup).margins["max_overlap"].value = 0.3;
  EXPECT_EQ(verdict(found), Verdict::pass);
  collisionIn(setup).margins["duration"] = {0.1, true, "nobody knows it", ""};
  EXPECT_EQ(verdict(found), Verdict::pass);
  Outcomes one = found;
  one[1].reset();
  EXPECT_EQ(verdict(one), Verdict::fail);  // a pair that did not part
}

TEST(Score, MostReferencesMissing_NothingIsJudged) {
  Case setup = test::smallPairCase();
  collisionIn(setup).margins["psi_f"] = {0.11, false, "in its own unit", ""};
  const std::vector<CollisionStart> starts(4, {1.0, 0.1, Approach::spin});
  const Outcomes found = outcomes({0.0, 2.1, 3.0, 9.0}, 1e-6);
  Outcomes oracle = outcomes({0.0, 2.0, 2.0, 2.0}, 1e-6);
  oracle[2].reset();
  EXPECT_EQ(scoreSweep(setup, starts, found, oracle).verdict, Verdict::fail);
  oracle[3].reset();
  EXPECT_EQ(scoreSweep(setup, starts, found, oracle).verdict, Verdict::pass);
  oracle[0].reset();  // the one that is left is off by 0.1 of nothing
  const CurveScore score = scoreSweep(setup, starts, found, oracle);
  EXPECT_EQ(score.verdict, Verdict::notMeasured);
  EXPECT_FALSE(score.of[QuantityId::psiF].value().held);
}

TEST(Score, WhatIsBeyondALimitByNoMoreThanRounding_IsNotJudged) {
  Case setup = test::smallPairCase();
  collisionIn(setup).margins["psi_f"] = {0.1, false, "in its own unit", ""};
  collisionIn(setup).margins["max_overlap"] = {0.1, true, "a tenth of the largest", ""};
  const std::vector<CollisionStart> starts(2, {1.0, 0.1, Approach::spin});
  const Outcomes oracle = outcomes({0.0, 2.0}, 1e-6);
  const auto verdict = [&](double psi, double overlap, double rounding) {
    return scoreSweep(setup, starts, outcomes({0.0, psi}, overlap), oracle, nullptr, rounding)
        .verdict;
  };
  EXPECT_EQ(verdict(2.05, 1.05e-6, 0.5), Verdict::pass);  // within its limits: rounding or not
  EXPECT_EQ(verdict(2.55, 1.05e-6, 0.5), Verdict::notMeasured);
  EXPECT_EQ(verdict(2.65, 1.05e-6, 0.5), Verdict::fail);
  EXPECT_EQ(verdict(2.05, 1.55e-6, 0.5), Verdict::notMeasured);
  EXPECT_EQ(verdict(2.55, 1.65e-6, 0.5), Verdict::fail);  // one is enough
  Outcomes held = oracle;
  held[1].reset();
  EXPECT_EQ(scoreSweep(setup, starts, held, oracle, nullptr, 0.9).verdict, Verdict::fail);
  EXPECT_EQ(scoreSweep(setup, starts, held, oracle, nullptr, 1.1).verdict, Verdict::notMeasured);
}

CollisionCurve curve(double dt, double psi, double en) {
  CollisionCurve curve{.engine = "a", .dt = dt};
  curve.score.of[QuantityId::psiF].emplace().rms = psi;
  curve.score.of[QuantityId::en].emplace().rms = en;
  return curve;
}

TEST(ConvergenceOrder, SeveralSteps_GiveTheSlopeOfEachQuantity) {
  const CollisionCurve coarse = curve(4e-5, 16e-3, 4e-4), middle = curve(2e-5, 4e-3, 2e-4),
                       fine = curve(1e-5, 1e-3, 1e-4);
  const auto order = convergenceOrder({coarse, middle, fine});
  ASSERT_TRUE(order);
  EXPECT_EQ(order->engine, "a");
  const FittedOrder psi = order->of[QuantityId::psiF].value();
  EXPECT_NEAR(psi.order, 2.0, 1e-12);
  EXPECT_NEAR(psi.standardError.value(), 0.0, 1e-7);
  EXPECT_EQ(order->errorAt.size(), 3u);
  EXPECT_NEAR(order->of[QuantityId::en].value().order, 1.0, 1e-12);
  EXPECT_FALSE(convergenceOrder({coarse}));
  EXPECT_FALSE(convergenceOrder({coarse, coarse}));  // one step taken twice tells nothing
}

}  // namespace

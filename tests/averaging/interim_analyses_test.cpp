#include "averaging/interim_analyses.hpp"

#include <gsl/gsl_cdf.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

#include "averaging/pocock.hpp"

namespace crossgrain {
namespace {

using Values = std::vector<std::optional<double>>;

/// One endpoint whose paired differences are these.
PairedSample differing(const std::vector<double>& differences, double margin = 1.0) {
  PairedSample sample;
  for (const double difference : differences) {
    sample.reference.emplace_back(10.0);
    sample.other.emplace_back(10.0 + difference);
  }
  sample.margin = margin;
  return sample;
}

/// ±scatter about a mean, in turn: sd is scatter·√(n/(n − 1)).
std::vector<double> alternating(int packings, double mean, double scatter) {
  std::vector<double> values;
  for (int k = 0; k < packings; ++k) values.push_back(mean + (k % 2 ? scatter : -scatter));
  return values;
}

InterimAnswer answerOf(const PairedSample& sample, const InterimPlan& plan, int available) {
  return answersAfterInterims(std::vector{sample}, plan, available).front().value();
}

TEST(InterimSettings, SplitTheChanceOfErrorInHalves) {
  const InterimPlan plan = interimPlanAt(8, 4, 0.05);
  EXPECT_EQ(plan.packings, (std::vector{8, 16, 24, 32}));
  const std::vector<double> alpha = {0.00625, 0.00625, 0.0125, 0.025};
  ASSERT_EQ(plan.alpha.size(), 4u);
  for (std::size_t k = 0; k < 4; ++k) EXPECT_DOUBLE_EQ(plan.alpha[k], alpha[k]);
  EXPECT_DOUBLE_EQ(std::accumulate(plan.alpha.begin(), plan.alpha.end(), 0.0), 0.05);
  EXPECT_NEAR(plan.agreeAlpha, 0.0194, 1e-4);  // Pocock: 2.067 standard errors
  EXPECT_EQ(interimPlanAt(4, 1, 0.05).alpha, std::vector{0.05});
  EXPECT_EQ(interimPlanAt(4, 1, 0.05).agreeAlpha, 0.05);
  EXPECT_EQ(interimsTaken(plan, 7), 0u);
  EXPECT_EQ(interimsTaken(plan, 24), 3u);
  EXPECT_EQ(interimsTaken(plan, 100), 4u);
}

TEST(InterimSettings, AnswerInFiveWays) {
  // One look at 16 packings, t(15, 5 %) = 1.753. Scatter s gives se = s √(16/15)/4.
  const InterimPlan plan = interimPlanAt(16, 1, 0.05);
  const auto answer = [&](double mean, double scatter) {
    return answerOf(differing(alternating(16, mean, scatter)), plan, 16).verdict;
  };
  EXPECT_EQ(answer(0.1, 1.0), Verdict::pass);           // 0.1 ± 0.45
  EXPECT_EQ(answer(0.5, 0.5), Verdict::pass);           // 0.5 ± 0.23
  EXPECT_EQ(answer(0.99, 0.42), Verdict::borderline);   // 0.99 ± 0.19
  EXPECT_EQ(answer(-0.99, 0.42), Verdict::borderline);  // the same on the other side
  EXPECT_EQ(answer(2.0, 0.5), Verdict::fail);           // 2.0 ± 0.23
  EXPECT_EQ(answer(0.9, 2.5), Verdict::undecided);      // 0.9 ± 1.13: holds 0 and 2
  EXPECT_EQ(answer(1.7, 2.0), Verdict::undecided);      // 1.7 ± 0.91: holds the margin and 2
  const InterimAnswer found = answerOf(differing(alternating(16, 0.99, 0.42)), plan, 16);
  const double half = 1.7530503556925547 * 0.42 * std::sqrt(16.0 / 15.0) / 4.0;
  EXPECT_NEAR(found.difference, 0.99, 1e-14);
  EXPECT_NEAR(*found.low, 0.99 - half, 1e-9);
  EXPECT_NEAR(*found.high, 0.99 + half, 1e-9);
}

TEST(InterimSettings, KeepWhatIsDecidedAndGoOnWithTheRest) {
  // Within the margin over the first 8 packings, far outside it afterwards.
  std::vector<double> differences = alternating(8, 0.0, 0.1);
  const std::vector<double> late = alternating(24, 5.0, 0.1);
  differences.insert(differences.end(), late.begin(), late.end());
  const InterimPlan plan = interimPlanAt(8, 4, 0.05);
  const InterimAnswer first = answerOf(differing(differences), plan, 8);
  const InterimAnswer last = answerOf(differing(differences), plan, 32);
  for (const InterimAnswer& one : {first, last}) {
    EXPECT_EQ(one.verdict, Verdict::pass);
    EXPECT_EQ(one.look, 0u);
    EXPECT_EQ(one.packings, 8);
  }
  const InterimAnswer open = answerOf(differing(alternating(32, 0.0, 3.0)), plan, 24);
  EXPECT_EQ(open.verdict, Verdict::undecided);
  EXPECT_EQ(open.look, 2u);
  EXPECT_EQ(open.packings, 24);
}

TEST(InterimSettings, SayNothingBeforeTheFirst_AndCountLostPackings) {
  const InterimPlan plan = interimPlanAt(8, 4, 0.05);
  EXPECT_FALSE(answersAfterInterims(std::vector{differing(alternating(7, 0.0, 0.1))}, plan, 7)
                   .front()
                   .has_value());
  PairedSample sample = differing(alternating(8, 0.0, 0.1));
  sample.other[3].reset();
  sample.other[5].reset();
  const InterimAnswer found = answerOf(sample, interimPlanAt(8, 1, 0.05), 8);
  EXPECT_EQ(found.packings, 6);
  EXPECT_EQ(found.lost, 2);
}

TEST(InterimSettings, ABiasNarrowsAgreementAndWidensDisagreement) {
  const InterimPlan plan = interimPlanAt(16, 1, 0.05);
  const auto answer = [&](double mean, double scatter, double bias) {
    PairedSample sample = differing(alternating(16, mean, scatter));
    sample.bias = bias;
    return answerOf(sample, plan, 16).verdict;
  };
  EXPECT_EQ(answer(0.7, 0.4, 0.0), Verdict::pass);  // 0.7 ± 0.18
  EXPECT_EQ(answer(0.7, 0.4, 0.2), Verdict::borderline);
  EXPECT_EQ(answer(1.5, 0.4, 0.0), Verdict::fail);
  EXPECT_NE(answer(1.5, 0.4, 0.4), Verdict::fail);
}

/// A mirror's runs stand for an engine that differs from it by as much as the bias allows. The
/// true difference is the margin: an agreement is false, and the interval that is widened by the
/// bias is to hold it as often as it says.
TEST(InterimSettings, AnIntervalWidenedByABiasHoldsTheDifference) {
  std::mt19937_64 generator(11);
  std::normal_distribution<double> normal;
  const InterimPlan plan = interimPlanAt(8, 1, 0.05);
  constexpr int trials = 4000;
  constexpr double truth = 1.0, bias = 0.4;
  int held = 0, narrow = 0, falseAgree = 0;
  for (int trial = 0; trial < trials; ++trial) {
    std::vector<double> differences;  // of the mirror
    for (int k = 0; k < 8; ++k) differences.push_back(truth - bias + 0.5 * normal(generator));
    PairedSample sample = differing(differences, truth);
    sample.bias = bias;
    const InterimAnswer found = answerOf(sample, plan, 8);
    held += *found.low - bias <= truth && truth <= *found.high + bias;
    narrow += *found.low <= truth && truth <= *found.high;
    falseAgree += found.verdict == Verdict::pass;
  }
  // Three standard errors of 5 % among 4000; only one end is tried by a bias of one sign.
  constexpr double error = 3.0 * 0.00345;
  EXPECT_NEAR(held / static_cast<double>(trials), 0.95, error);
  EXPECT_LT(narrow / static_cast<double>(trials), 0.5);
  EXPECT_NEAR(falseAgree / static_cast<double>(trials), 0.05, error);
}

/// Families of nine endpoints whose true difference is exactly the margin, which is the hardest
/// case for both: a fraction of the families at most α may say disagree, and of the endpoints at
/// most α agree, over all looks together.
TEST(InterimSettings, HoldBothErrorsAtTheMargin) {
  std::mt19937_64 generator(7);
  std::normal_distribution<double> normal;
  const InterimPlan plan = interimPlanAt(8, 4, 0.05);
  constexpr int families = 1500, endpoints = 9;
  int falseDisagree = 0, falseAgree = 0, late = 0;
  for (int f = 0; f < families; ++f) {
    std::vector<PairedSample> family;
    for (int e = 0; e < endpoints; ++e) {
      std::vector<double> differences;
      for (int k = 0; k < 32; ++k) differences.push_back(1.0 + normal(generator));
      family.push_back(differing(differences));
    }
    bool any = false;
    for (const auto& found : answersAfterInterims(family, plan, 32)) {
      any = any || found->verdict == Verdict::fail;
      falseAgree += found->verdict == Verdict::pass;
      late += found->look == 3;
    }
    falseDisagree += any;
  }
  // Three standard errors of a true 5 %.
  const auto most = [](int trials) { return 0.05 + 3.0 * std::sqrt(0.05 * 0.95 / trials); };
  EXPECT_LE(falseDisagree, most(families) * families);
  EXPECT_LE(falseAgree, most(families * endpoints) * families * endpoints);
  EXPECT_GT(falseAgree, 0);  // the bound is used, not avoided
  EXPECT_GT(falseDisagree, 0);
  EXPECT_GT(late, families * endpoints / 2);
}

/// A scatter of one margin, which is what the endpoints of the small cell have: at two margins 98 %
/// of the differences are found.
TEST(InterimSettings, FindTwoMargins) {
  std::mt19937_64 generator(8);
  std::normal_distribution<double> normal;
  const InterimPlan plan = interimPlanAt(8, 4, 0.05);
  int found = 0;
  constexpr int trials = 400;
  for (int t = 0; t < trials; ++t) {
    std::vector<PairedSample> family(9, differing(alternating(32, 0.0, 1.0)));
    std::vector<double> differences;
    for (int k = 0; k < 32; ++k) differences.push_back(2.0 + normal(generator));
    family.front() = differing(differences);
    found += answersAfterInterims(family, plan, 32).front()->verdict == Verdict::fail;
  }
  EXPECT_GE(found, 0.98 * trials);
}

/// How often so many packings of a standard deviation of 1.5 come to that answer.
double shareDecided(int packings, double difference, Verdict answer) {
  std::mt19937_64 generator(9);
  std::normal_distribution<double> normal;
  const InterimPlan plan{{packings}, {0.025}, 0.025};
  int decided = 0;
  constexpr int trials = 2000;
  for (int t = 0; t < trials; ++t) {
    std::vector<double> differences;
    for (int k = 0; k < packings; ++k) differences.push_back(difference + 1.5 * normal(generator));
    decided += answerOf(differing(differences), plan, packings).verdict == answer;
  }
  return decided / static_cast<double>(trials);
}

// A mean 2.1 sd beyond the margin: 4 packings put it 4.2 standard errors there, and 3.18 (Student's
// t of 3) + 1.28 are needed for 9 chances in 10; 5 put it at 4.7, where 2.78 + 1.28 are.
TEST(InterimSettings, ForecastOfFewPackings_ByHand) {
  EXPECT_EQ(packingsFor(3.1, 1.0, 1.0, 0.025, 0.9), std::optional(5));
}

TEST(InterimSettings, ForecastPackingsThatDecideWithTheChanceAskedFor) {
  const auto packings = packingsFor(0.3, 1.5, 1.0, 0.025);
  ASSERT_TRUE(packings);
  EXPECT_NEAR(shareDecided(*packings, 0.3, Verdict::pass), 0.9, 0.025);
  const auto apart = packingsFor(2.0, 1.5, 1.0, 0.025);
  ASSERT_TRUE(apart);
  EXPECT_NEAR(shareDecided(*apart, 2.0, Verdict::fail), 0.9, 0.025);
  EXPECT_FALSE(packingsFor(1.0, 1.5, 1.0, 0.025));  // on the margin no number decides
  const auto range = packingsFor(0.3, 1.5, 30, 1.0, 0.025);
  ASSERT_TRUE(range);
  EXPECT_LT(range->low, *packings);
  EXPECT_GT(range->high.value(), *packings);
}

TEST(InterimSettings, ChanceOfOneAsFarIsStudentsOverAllTests) {
  // t(7) beyond 2.365 in either tail: 5 %.
  EXPECT_NEAR(chanceOfOneAsFar(2.3646242510102997, 1.0, 7, 1), 0.05, 1e-9);
  EXPECT_NEAR(chanceOfOneAsFar(-2.0 * 2.3646242510102997, 2.0, 7, 4), 0.2, 1e-9);
  EXPECT_EQ(chanceOfOneAsFar(0.1, 1.0, 7, 9), 1.0);
}

/// Jennison and Turnbull (2000), Table 2.1: the constant C_P(looks, α) of two-sided tests. Far from
/// 0 only one side counts, so that one side at α/2 has the same.
TEST(Pocock, HasThePublishedConstants) {
  const auto constant = [](int looks, double alpha) {
    return gsl_cdf_ugaussian_Qinv(pocockLevel(looks, alpha / 2.0));
  };
  EXPECT_NEAR(constant(2, 0.10), 1.875, 1.5e-3);
  EXPECT_NEAR(constant(3, 0.10), 1.992, 1.5e-3);
  EXPECT_NEAR(constant(4, 0.10), 2.067, 1.5e-3);
  EXPECT_NEAR(constant(5, 0.10), 2.122, 1.5e-3);
  EXPECT_NEAR(constant(2, 0.05), 2.178, 1e-3);
  EXPECT_NEAR(constant(4, 0.05), 2.361, 1e-3);
  EXPECT_NEAR(constant(5, 0.05), 2.413, 1e-3);
  EXPECT_NEAR(constant(4, 0.01), 2.939, 1e-3);
}

TEST(Pocock, OneLookIsTheTestItself) {
  EXPECT_EQ(pocockLevel(1, 0.05), 0.05);
  EXPECT_GT(pocockLevel(2, 0.05), 0.025);
  EXPECT_LT(pocockLevel(8, 0.05), pocockLevel(4, 0.05));
}

}  // namespace
}  // namespace crossgrain

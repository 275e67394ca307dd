// Rings of two engines packing by packing: the scale that they are compared on, and the verdict.
#include "studies/flow/agreement_table.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "averaging/agreement.hpp"
#include "studies/flow/ensemble.hpp"
#include "tests/studies/flow_runs.hpp"

namespace {

using namespace crossgrain;

/// The row of a field of one ring, whose value on each packing is given for engines a and b.
/// @param error  of each run by itself
AgreementRow rowOf(double margin, bool relative, const std::vector<double>& a,
                   const std::vector<double>& b, double error = 0.0) {
  Case setup;
  setup.averaging.margins["f"] = {margin, relative, "because", ""};
  std::vector<FlowRun> runs;
  const auto add = [&](const char* engine, std::size_t packing, double value) {
    runs.push_back(
        test::flowRun(engine, static_cast<int>(packing), {test::sliced("f", {value}, {error})}));
  };
  for (std::size_t k = a.size(); k-- > 0;) add("a", k, a[k]);  // pairs are found by packing
  for (std::size_t k = 0; k < b.size(); ++k) add("b", k, b[k]);
  return agreementOf(setup, runs, {{"a", "b", PairKind::peer, ""}}).at(0);
}

TEST(Ensemble, Packings_HaveMeanAndStandardError) {
  std::vector<FlowRun> runs;
  for (const int packing : {0, 1, 2, 3}) {
    runs.push_back(test::flowRun("a", packing, {test::sliced("f", {10.0 + packing})}));
    runs.back().fits.emplace_back().name = "p";
    runs.back().fits.back().value = 10.0 + packing;
  }
  runs.push_back(test::flowRun("a", 4));
  runs.back().status = Status::failed;
  const auto ensemble = ensembleOf(runs, {"a", "b"});
  ASSERT_EQ(ensemble.size(), 1u);  // b has no finished run
  const Profile& profile = ensemble[0].profiles[0];
  EXPECT_DOUBLE_EQ(*profile.mean[0], 11.5);
  // sd of 10, 11, 12, 13 is √(5/3); of the mean √(5/3)/2.
  EXPECT_NEAR(*profile.standardError[0], std::sqrt(5.0 / 3.0) / 2.0, 1e-14);
  EXPECT_EQ(profile.nEff[0], 4.0);
  EXPECT_DOUBLE_EQ(*ensemble[0].fits[0].value, 11.5);
}

/// 3 and −3 rad are 0.28 rad apart, on either side of π.
TEST(Ensemble, Angles_HaveTheirMeanAcrossTheTurn) {
  std::vector<FlowRun> runs;
  for (const double angle : {3.0, -3.0}) {
    runs.push_back(test::flowRun("a", static_cast<int>(runs.size()), {test::sliced("f", {1.0})}));
    runs.back().fits.push_back({.name = "angle", .value = angle, .period = 2.0 * std::numbers::pi});
  }
  EXPECT_NEAR(*ensembleOf(runs, {"a"}).at(0).fits[0].value, std::numbers::pi, 1e-12);
}

TEST(AgreementRow, AbsoluteMargin_TestsDifferencesOfPackings) {
  const std::vector<double> a = {0.0, 10.0, 20.0, 30.0}, b = {1.0, 11.0, 21.0, 31.0};
  EXPECT_EQ(rowOf(1.5, false, a, b).verdict, Verdict::pass);
  EXPECT_NEAR(*rowOf(1.5, false, a, b).rings[0].difference, 1.0, 1e-12);
  EXPECT_EQ(rowOf(0.5, false, a, b).verdict, Verdict::fail);
}

/// Packings differ by a factor of 8, the engines by 10 % throughout: agreement within 25 %, and
/// the mirror image of it for the shear stress of a wheel that turns clockwise.
TEST(AgreementRow, RelativeMargin_TestsRatiosOfEitherSign) {
  AgreementRing turned[2];
  for (const double sign : {1.0, -1.0}) {
    std::vector<double> a, b;
    for (const int packing : {0, 1, 2, 3}) {
      a.push_back(sign * 100.0 * std::pow(2.0, packing));
      b.push_back(a.back() * (1.1 + 0.001 * packing));
    }
    const AgreementRow row = rowOf(0.25, true, a, b);
    EXPECT_EQ(row.verdict, Verdict::pass);
    turned[sign < 0.0] = row.rings.at(0);
  }
  // In the field's unit: 10 % of the mean 375, and the margin 25 % of it.
  EXPECT_NEAR(*turned[0].difference, 37.5, 1.0);
  EXPECT_NEAR(*turned[0].margin, 93.75, 1e-9);
  EXPECT_LT(*turned[0].low, *turned[0].difference);
  EXPECT_EQ(turned[1].scale, TestScale::logarithmic);
  for (const auto same :
       {&AgreementRing::standardError, &AgreementRing::margin, &AgreementRing::detects})
    EXPECT_DOUBLE_EQ((turned[1].*same).value(), (turned[0].*same).value());
  EXPECT_DOUBLE_EQ(turned[1].difference.value(), -turned[0].difference.value());
  EXPECT_DOUBLE_EQ(turned[1].low.value(), -turned[0].high.value());
  EXPECT_DOUBLE_EQ(turned[1].high.value(), -turned[0].low.value());
}

TEST(AgreementRow, RelativeMarginOfASignChangingField_IsLinear) {
  const AgreementRow row = rowOf(0.25, true, {-1.0, 0.0, 1.0, 2.0}, {-0.9, 0.1, 1.1, 2.1});
  EXPECT_EQ(row.rings[0].scale, TestScale::linear);
}

/// Differences ±1 on four packings, each run's own error 0.7: 0.98 of the variance 4/3 is within.
TEST(AgreementRow, Undecided_HasDetectableSizeAndShareWithinRuns) {
  const AgreementRow row =
      rowOf(1.0, false, {0.0, 100.0, 200.0, 300.0}, {1.0, 99.0, 201.0, 299.0}, 0.7);
  EXPECT_EQ(row.verdict, Verdict::undecided);
  EXPECT_NEAR(*row.rings[0].withinFraction, 0.98 / (4.0 / 3.0), 1e-12);
  EXPECT_NEAR(*row.detects, *smallestDetectable(std::sqrt(1.0 / 3.0), 3, 1.0, 0.05), 1e-12);
  EXPECT_EQ(row.detects, row.rings[0].detects);
}

TEST(AgreementRow, ThreePackings_AreUndecided) {
  EXPECT_EQ(rowOf(0.5, false, {1.0, 1.0, 1.0}, {9.0, 10.0, 11.0}).verdict, Verdict::undecided);
}

TEST(PairedRings, RelativeMargin_IsOnLogarithms) {
  const PairedTest ring = testedRing({0.1, true, "", ""}, {-2.0, -4.0}, {-2.2, -4.4});
  ASSERT_TRUE(ring.logarithmic);
  EXPECT_EQ(ring.sign, -1.0);
  EXPECT_EQ(ring.reference, -3.0);
  EXPECT_NEAR(ring.sample.margin, std::log(1.1), 1e-15);
  for (std::size_t k = 0; k < 2; ++k)
    EXPECT_NEAR(*ring.sample.other[k] - *ring.sample.reference[k], -std::log(1.1), 1e-15);
  EXPECT_NEAR(inUnit(ring, -std::log(1.1)), -0.3, 1e-15);  // a tenth more of −3
}

/// ± 0.4 of 2 is a fifth, ± 0.4 of 4 a tenth; without logarithms 0.3² + 0.4² = 0.25.
TEST(PairedRings, ErrorsOfRuns_AreRelativeOnLogarithms) {
  PairedTest ratio = testedRing({0.1, true, "", ""}, {2.0, 4.0}, {4.0, 8.0});
  addWithinVariance(ratio, {0.4, 0.4}, {0.4, std::nullopt});
  EXPECT_NEAR(ratio.sample.withinVariance[0].value(), 0.2 * 0.2 + 0.1 * 0.1, 1e-15);
  EXPECT_FALSE(ratio.sample.withinVariance[1]);
  PairedTest difference = testedRing({0.1, false, "", ""}, {2.0, 4.0}, {2.5, 4.5});
  EXPECT_FALSE(difference.logarithmic);
  EXPECT_EQ(difference.sample.margin, 0.1);
  addWithinVariance(difference, {0.3, 0.3}, {0.4, 0.4});
  EXPECT_NEAR(difference.sample.withinVariance[0].value(), 0.25, 1e-15);
  EXPECT_EQ(inUnit(difference, 0.5), 0.5);
}

}  // namespace

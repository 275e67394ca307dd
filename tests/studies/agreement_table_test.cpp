#include "studies/flow/agreement_table.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "averaging/agreement.hpp"
#include "studies/flow/ensemble.hpp"

namespace {

using namespace crossgrain;
/// A finished run with one profile of one ring.
FlowRun runOf(const std::string& engine, int packing, const std::string& field, double value) {
  FlowRun run;
  run.engine = engine;
  run.packing = packing;
  run.profiles = {{"slicing", field, "N/m²", {value}, {}, {}, {}}};
  run.fits.resize(1);
  run.fits[0].name = "p";
  run.fits[0].value = value;
  return run;
}

using Runs = std::vector<FlowRun>;

std::vector<AgreementRow> agreementOfPair(const Case& setup, const Runs& runs) {
  return agreementOf(setup, runs, {{"a", "b", PairKind::peer, ""}});
}

Case withMargin(const std::string& field, Margin margin) {
  Case setup;
  setup.averaging.margins[field] = margin;
  return setup;
}

const AgreementRing& ringOf(const std::vector<AgreementRow>& table) {
  return table.at(0).rings.at(0);
}

TEST(AgreementTable, EnsembleIsTheMeanOverPackingsWithItsStandardError) {
  Runs runs;
  for (const int packing : {0, 1, 2, 3})
    runs.push_back(runOf("a", packing, "stress_rr", 10.0 + packing));
  runs.push_back({});
  runs.back().engine = "a";
  runs.back().packing = 4;
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

TEST(AgreementTable, PairsPackingsByTheirIndex) {
  // b is a + 1 on every packing, whatever order the runs come in: a difference without scatter.
  Runs runs;
  for (const int packing : {3, 0, 2, 1}) runs.push_back(runOf("a", packing, "f", 10.0 * packing));
  for (const int packing : {0, 1, 2, 3})
    runs.push_back(runOf("b", packing, "f", 10.0 * packing + 1.0));
  const auto table = agreementOfPair(withMargin("f", {1.5, false, "because", ""}), runs);
  EXPECT_EQ(table[0].verdict, Verdict::pass);
  EXPECT_NEAR(*ringOf(table).difference, 1.0, 1e-12);
  const auto strict = agreementOfPair(withMargin("f", {0.5, false, "because", ""}), runs);
  EXPECT_EQ(strict[0].verdict, Verdict::fail);
}

TEST(AgreementTable, RelativeMarginsAreTestedOnRatios) {
  // Packings differ by a factor of 8, the engines by 10 % throughout: agreement within 25 %.
  Runs runs;
  for (const int packing : {0, 1, 2, 3}) {
    const double pressure = 100.0 * std::pow(2.0, packing);
    runs.push_back(runOf("a", packing, "stress_rr", pressure));
    runs.push_back(runOf("b", packing, "stress_rr", pressure * (1.1 + 0.001 * packing)));
  }
  const auto table = agreementOfPair(withMargin("stress_rr", {0.25, true, "because", ""}), runs);
  EXPECT_EQ(table[0].verdict, Verdict::pass);
  EXPECT_EQ(ringOf(table).scale, TestScale::logarithmic);
  // In the field's unit: 10 % of the mean 375, and the margin 25 % of it.
  EXPECT_NEAR(*ringOf(table).difference, 37.5, 1.0);
  EXPECT_NEAR(*ringOf(table).margin, 93.75, 1e-9);
}

TEST(AgreementTable, TheSignOfAFieldDoesNotMatterToItsRatios) {
  // The shear stress of a wheel that turns clockwise: the verdict and all bounds of the mirror
  // image.
  AgreementRing turned[2];
  for (const double sign : {1.0, -1.0}) {
    Runs runs;
    for (const int packing : {0, 1, 2, 3}) {
      const double stress = sign * 100.0 * std::pow(2.0, packing);
      runs.push_back(runOf("a", packing, "stress_rp", stress));
      runs.push_back(runOf("b", packing, "stress_rp", stress * (1.1 + 0.001 * packing)));
    }
    const auto table = agreementOfPair(withMargin("stress_rp", {0.25, true, "because", ""}), runs);
    EXPECT_EQ(table[0].verdict, Verdict::pass);
    turned[sign < 0.0] = ringOf(table);
  }
  EXPECT_EQ(turned[1].scale, TestScale::logarithmic);
  for (const auto same :
       {&AgreementRing::standardError, &AgreementRing::margin, &AgreementRing::detects})
    EXPECT_DOUBLE_EQ((turned[1].*same).value(), (turned[0].*same).value());
  EXPECT_DOUBLE_EQ(turned[1].difference.value(), -turned[0].difference.value());
  EXPECT_DOUBLE_EQ(turned[1].low.value(), -turned[0].high.value());
  EXPECT_DOUBLE_EQ(turned[1].high.value(), -turned[0].low.value());
}

TEST(AgreementTable, RelativeMarginsOfASignChangingFieldAreLinear) {
  Runs runs;
  for (const int packing : {0, 1, 2, 3}) {
    runs.push_back(runOf("a", packing, "spin", packing - 1.0));
    runs.push_back(runOf("b", packing, "spin", packing - 0.9));
  }
  const auto table = agreementOfPair(withMargin("spin", {0.25, true, "because", ""}), runs);
  EXPECT_EQ(ringOf(table).scale, TestScale::linear);
}

TEST(AgreementTable, SaysWhatItDetectsAndWhatIsTheRunsOwn) {
  // Differences ±1 on four packings, each run's own error 0.7: 0.98 of the variance 4/3 is within.
  Runs runs;
  for (const int packing : {0, 1, 2, 3}) {
    runs.push_back(runOf("a", packing, "f", 100.0 * packing));
    runs.push_back(runOf("b", packing, "f", 100.0 * packing + (packing % 2 == 0 ? 1.0 : -1.0)));
    for (auto run = runs.end() - 2; run != runs.end(); ++run)
      run->profiles[0].standardError = {0.7};
  }
  Case setup = withMargin("f", {1.0, false, "because", ""});
  const auto table = agreementOfPair(setup, runs);
  EXPECT_EQ(table[0].verdict, Verdict::undecided);
  const double share = 0.98 / (4.0 / 3.0);
  EXPECT_NEAR(*ringOf(table).withinFraction, share, 1e-12);
  EXPECT_NEAR(*ringOf(table).detects, *smallestDetectable(std::sqrt(1.0 / 3.0), 4, 1.0, 0.05),
              1e-12);
  EXPECT_EQ(table[0].detects, ringOf(table).detects);
}

TEST(AgreementTable, ThreePackingsDecideNothing) {
  Runs runs;
  for (const int packing : {0, 1, 2}) {
    runs.push_back(runOf("a", packing, "f", 1.0));
    runs.push_back(runOf("b", packing, "f", 9.0 + packing));
  }
  const auto table = agreementOfPair(withMargin("f", {0.5, false, "because", ""}), runs);
  EXPECT_EQ(table[0].verdict, Verdict::undecided);
}

}  // namespace

#include "runs/couette/agreement_table.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "averaging/agreement.hpp"

namespace {

using namespace crossgrain;
using nlohmann::json;

/// A finished run with one profile of one ring.
json runOf(const std::string& engine, int packing, const std::string& field, double value) {
  return {{"engine", engine},
          {"packing", packing},
          {"status", "finished"},
          {"profiles",
           {{{"method", "slicing"}, {"field", field}, {"unit", "N/m²"}, {"mean", {value}}}}},
          {"fits", {{{"name", "p"}, {"value", value}, {"reason", ""}}}},
          {"head", json::array()}};
}

Case withMargin(const std::string& field, Margin margin) {
  Case setup;
  setup.averaging.margins[field] = margin;
  return setup;
}

json ringOf(const json& table) {
  return table.at(0).at("rings").at(0);
}

TEST(AgreementTable, EnsembleIsTheMeanOverPackingsWithItsStandardError) {
  json runs = json::array();
  for (const int packing : {0, 1, 2, 3})
    runs.push_back(runOf("a", packing, "stress_rr", 10.0 + packing));
  runs.push_back({{"engine", "a"}, {"packing", 4}, {"status", "failed"}});
  const json ensemble = ensembleOf(runs, {"a", "b"});
  ASSERT_EQ(ensemble.size(), 1u);  // b has no finished run
  const json& profile = ensemble[0]["profiles"][0];
  EXPECT_DOUBLE_EQ(profile["mean"][0].get<double>(), 11.5);
  // sd of 10, 11, 12, 13 is √(5/3); of the mean √(5/3)/2.
  EXPECT_NEAR(profile["stderr"][0].get<double>(), std::sqrt(5.0 / 3.0) / 2.0, 1e-14);
  EXPECT_EQ(profile["n_eff"][0], 4.0);
  EXPECT_DOUBLE_EQ(ensemble[0]["fits"][0]["value"].get<double>(), 11.5);
}

TEST(AgreementTable, PairsPackingsByTheirIndex) {
  // b is a + 1 on every packing, whatever order the runs come in: a difference without scatter.
  json runs = json::array();
  for (const int packing : {3, 0, 2, 1}) runs.push_back(runOf("a", packing, "f", 10.0 * packing));
  for (const int packing : {0, 1, 2, 3})
    runs.push_back(runOf("b", packing, "f", 10.0 * packing + 1.0));
  const json table =
      agreementOf(withMargin("f", {1.5, false, "because", ""}), runs, {{"a", "b", "peer", ""}});
  EXPECT_EQ(table[0]["verdict"], "agree");
  EXPECT_NEAR(ringOf(table)["difference"].get<double>(), 1.0, 1e-12);
  const json strict =
      agreementOf(withMargin("f", {0.5, false, "because", ""}), runs, {{"a", "b", "peer", ""}});
  EXPECT_EQ(strict[0]["verdict"], "disagree");
}

TEST(AgreementTable, RelativeMarginsAreTestedOnRatios) {
  // Packings differ by a factor of 8, the engines by 10 % throughout: agreement within 25 %.
  json runs = json::array();
  for (const int packing : {0, 1, 2, 3}) {
    const double pressure = 100.0 * std::pow(2.0, packing);
    runs.push_back(runOf("a", packing, "stress_rr", pressure));
    runs.push_back(runOf("b", packing, "stress_rr", pressure * (1.1 + 0.001 * packing)));
  }
  const json table = agreementOf(withMargin("stress_rr", {0.25, true, "because", ""}), runs,
                                 {{"a", "b", "peer", ""}});
  EXPECT_EQ(table[0]["verdict"], "agree");
  EXPECT_EQ(ringOf(table)["scale"], "logarithmic");
  // In the field's unit: 10 % of the mean 375, and the margin 25 % of it.
  EXPECT_NEAR(ringOf(table)["difference"].get<double>(), 37.5, 1.0);
  EXPECT_NEAR(ringOf(table)["margin"].get<double>(), 93.75, 1e-9);
}

TEST(AgreementTable, TheSignOfAFieldDoesNotMatterToItsRatios) {
  // The shear stress of a wheel that turns clockwise: the verdict and all bounds of the mirror
  // image.
  json turned[2];
  for (const double sign : {1.0, -1.0}) {
    json runs = json::array();
    for (const int packing : {0, 1, 2, 3}) {
      const double stress = sign * 100.0 * std::pow(2.0, packing);
      runs.push_back(runOf("a", packing, "stress_rp", stress));
      runs.push_back(runOf("b", packing, "stress_rp", stress * (1.1 + 0.001 * packing)));
    }
    const json table = agreementOf(withMargin("stress_rp", {0.25, true, "because", ""}), runs,
                                   {{"a", "b", "peer", ""}});
    EXPECT_EQ(table[0]["verdict"], "agree");
    turned[sign < 0.0] = ringOf(table);
  }
  EXPECT_EQ(turned[1]["scale"], "logarithmic");
  for (const char* same : {"stderr", "margin", "detects"})
    EXPECT_DOUBLE_EQ(turned[1][same].get<double>(), turned[0][same].get<double>()) << same;
  EXPECT_DOUBLE_EQ(turned[1]["difference"].get<double>(), -turned[0]["difference"].get<double>());
  EXPECT_DOUBLE_EQ(turned[1]["low"].get<double>(), -turned[0]["high"].get<double>());
  EXPECT_DOUBLE_EQ(turned[1]["high"].get<double>(), -turned[0]["low"].get<double>());
}

TEST(AgreementTable, RelativeMarginsOfASignChangingFieldAreLinear) {
  json runs = json::array();
  for (const int packing : {0, 1, 2, 3}) {
    runs.push_back(runOf("a", packing, "spin", packing - 1.0));
    runs.push_back(runOf("b", packing, "spin", packing - 0.9));
  }
  const json table =
      agreementOf(withMargin("spin", {0.25, true, "because", ""}), runs, {{"a", "b", "peer", ""}});
  EXPECT_EQ(ringOf(table)["scale"], "linear");
}

TEST(AgreementTable, SaysWhatItDetectsAndWhetherLongerRunsWouldHelp) {
  // Differences ±1 on four packings, each run's own error 0.7: 0.98 of the variance 4/3 is within.
  json runs = json::array();
  for (const int packing : {0, 1, 2, 3}) {
    runs.push_back(runOf("a", packing, "f", 100.0 * packing));
    runs.push_back(runOf("b", packing, "f", 100.0 * packing + (packing % 2 == 0 ? 1.0 : -1.0)));
    for (auto run = runs.end() - 2; run != runs.end(); ++run)
      (*run)["profiles"][0]["stderr"] = {0.7};
  }
  Case setup = withMargin("f", {1.0, false, "because", ""});
  setup.averaging.rotations = 3.0;
  const json table = agreementOf(setup, runs, {{"a", "b", "peer", ""}});
  EXPECT_EQ(table[0]["verdict"], "undecided");
  const double share = 0.98 / (4.0 / 3.0);
  EXPECT_NEAR(ringOf(table)["within_share"].get<double>(), share, 1e-12);
  // (1 − w + w/R) must be (1/1.3587)²: R times as long (see ComparePaired).
  const double longer = share / (std::pow(1.0 / 1.3587, 2) - (1.0 - share));
  EXPECT_NEAR(table[0]["more_rotations"].get<double>(), (longer - 1.0) * 3.0, 0.01);
  EXPECT_NEAR(ringOf(table)["detects"].get<double>(),
              *smallestDetectable(std::sqrt(1.0 / 3.0), 4, 1.0, 0.05), 1e-12);
  EXPECT_EQ(table[0]["detects"], ringOf(table)["detects"]);
}

TEST(AgreementTable, ThreePackingsDecideNothing) {
  json runs = json::array();
  for (const int packing : {0, 1, 2}) {
    runs.push_back(runOf("a", packing, "f", 1.0));
    runs.push_back(runOf("b", packing, "f", 9.0 + packing));
  }
  const json table =
      agreementOf(withMargin("f", {0.5, false, "because", ""}), runs, {{"a", "b", "peer", ""}});
  EXPECT_EQ(table[0]["verdict"], "undecided");
}

}  // namespace

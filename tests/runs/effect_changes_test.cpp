#include "runs/effects/changes.hpp"

#include <gsl/gsl_cdf.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace {

using namespace crossgrain;
using nlohmann::json;

json profile(const std::string& field, const json& mean, double error) {
  return {{"method", "slicing"},
          {"field", field},
          {"unit", "m/s"},
          {"mean", mean},
          {"stderr", json(std::vector<double>(mean.size(), error))}};
}

json runOf(const std::string& without, int packing, const json& profiles) {
  json run = {
      {"engine", "a"}, {"packing", packing}, {"status", "finished"}, {"profiles", profiles}};
  if (!without.empty()) run["without"] = without;
  return run;
}

/// v of ring 0 changes by 1 ± 0.1 and of ring 1 by 0 ± 0.1 from packing to packing, whose own
/// values are far apart; spin is lost.
json runs(int packings) {
  json all = json::array();
  for (int k = 0; k < packings; ++k) {
    const double own = 100.0 * k, scatter = k % 2 == 0 ? 0.1 : -0.1;
    const auto v = [&](double first, double second, double error) {
      return profile("v", json::array({own + first, own + second}), error);
    };
    const json spin = profile("spin", json::array({2.0, 3.0}), 0.1);
    all.push_back(runOf("", k, json::array({v(0.0, 5.0, 0.3), spin})));
    all.push_back(runOf("friction", k, json::array({v(1.0 + scatter, 5.0 + scatter, 0.4)})));
    all.push_back(runOf("rotation", k, json::array({v(0.0, 5.0, 0.4), spin})));
  }
  return all;
}

Case judging(const std::vector<std::string>& fields) {
  Case setup;
  for (const std::string& field : fields)
    setup.averaging.margins[field] = {2.0, false, "because", ""};
  return setup;
}

const json& ring(const json& changes, std::size_t field, std::size_t ring) {
  return changes.at("fields").at(field).at("rings").at(ring);
}

TEST(EffectChanges, PairEachPackingWithItself) {
  const json changes = effectChanges(judging({"v"}), runs(8), "a", "friction");
  EXPECT_EQ(changes["packings"], 8);
  EXPECT_EQ(changes["stderr_kind"], "packings");
  const json& first = ring(changes, 0, 0);
  EXPECT_NEAR(first["change"].get<double>(), 1.0, 1e-12);
  // Differences 1.1 and 0.9, four of each: sd = 0.1·√(8/7), over √8.
  EXPECT_NEAR(first["stderr"].get<double>(), 0.1 / std::sqrt(7.0), 1e-12);
  EXPECT_NEAR(first["reference"].get<double>(), 350.0, 1e-12);
  EXPECT_EQ(changes["fields"][0]["unit"], "m/s");
}

TEST(EffectChanges, AreToldApartUnderOneFamilyOfTests) {
  const json changes = effectChanges(judging({"v"}), runs(8), "a", "friction");
  const json &one = ring(changes, 0, 0), &none = ring(changes, 0, 1);
  EXPECT_EQ(one["resolved"], true);
  EXPECT_EQ(none["resolved"], false);
  EXPECT_NEAR(none["p"].get<double>(), 1.0, 1e-9);
  // Two tests at 5 % together, two-sided, 7 degrees of freedom; t by GSL. Holm holds the larger t
  // against half of it, and as that is passed the other against all.
  const double error = 0.1 / std::sqrt(7.0);
  EXPECT_NEAR(one["smallest"].get<double>(), gsl_cdf_tdist_Qinv(0.05 / 2.0 / 2.0, 7.0) * error,
              1e-12);
  EXPECT_NEAR(none["smallest"].get<double>(), gsl_cdf_tdist_Qinv(0.05 / 2.0, 7.0) * error, 1e-12);
  EXPECT_NEAR(one["low"].get<double>(), 1.0 - one["smallest"].get<double>(), 1e-12);
  // Within the margin of 2 in both rings.
  EXPECT_EQ(changes["fields"][0]["verdict"], "agree");
}

/// The interval that is told leaves out 0 exactly where the change is told apart, whatever the
/// number of rings and however many of them change.
TEST(EffectChanges, TheIntervalTellsWhatTheVerdictTells) {
  std::mt19937_64 generator(5);
  std::normal_distribution<double> normal;
  int resolved = 0, open = 0;
  for (int draw = 0; draw < 200; ++draw)
    for (const bool relative : {false, true}) {
      json all = json::array();
      const int packings = 4 + draw % 5;
      std::vector<double> effect(12);
      for (double& one : effect) one = generator() % 3 == 0 ? 0.4 * std::abs(normal(generator)) : 0;
      for (int k = 0; k < packings; ++k) {
        json whole = json::array(), switched = json::array();
        for (const double by : effect) {
          const double own = std::exp(0.2 * normal(generator));
          whole.push_back(own);
          switched.push_back(own * std::exp(-by + 0.1 * normal(generator)));
        }
        all.push_back(runOf("", k, json::array({profile("v", whole, 0.1)})));
        all.push_back(runOf("friction", k, json::array({profile("v", switched, 0.1)})));
      }
      Case setup;
      setup.averaging.margins["v"] = {0.05, relative, "because", ""};
      const json changes = effectChanges(setup, all, "a", "friction");
      for (const json& ring : changes["fields"][0]["rings"]) {
        const bool leavesOut0 = ring["low"] > 0.0 || ring["high"] < 0.0;
        EXPECT_EQ(ring["resolved"].get<bool>(), leavesOut0) << ring.dump();
        (leavesOut0 ? resolved : open) += 1;
        // Beyond the margin is the larger claim of the same test.
        EXPECT_TRUE(ring["verdict"] != "disagree" || ring["resolved"] == true);
      }
    }
  EXPECT_GT(resolved, 500);
  EXPECT_GT(open, 500);
}

TEST(EffectChanges, WhatARunDoesNotHaveIsAbsent) {
  const json changes = effectChanges(judging({"v", "spin"}), runs(8), "a", "friction");
  ASSERT_EQ(changes["fields"].size(), 2u);
  EXPECT_TRUE(changes["fields"][1]["rings"].empty());
}

TEST(EffectChanges, NoChangeAtAllIsNotToldApart) {
  const json changes = effectChanges(judging({"v"}), runs(4), "a", "rotation");
  EXPECT_EQ(ring(changes, 0, 0)["change"], 0.0);
  EXPECT_EQ(ring(changes, 0, 0)["resolved"], false);
}

TEST(EffectChanges, FieldsWithoutAMarginAreNotTested) {
  Case setup = judging({"spin"});
  const json changes = effectChanges(setup, runs(8), "a", "friction");
  EXPECT_EQ(changes["fields"][0]["judged"], false);
  EXPECT_TRUE(ring(changes, 0, 0)["change"].is_number());
  EXPECT_TRUE(ring(changes, 0, 0)["p"].is_null());
  EXPECT_EQ(effectChanges(Case(), runs(8), "a", "friction")["fields"][0]["judged"], true);
}

TEST(EffectChanges, FewPackingsDecideNothing) {
  const json three = effectChanges(judging({"v"}), runs(3), "a", "friction");
  EXPECT_TRUE(ring(three, 0, 0)["stderr"].is_number());
  EXPECT_TRUE(ring(three, 0, 0)["resolved"].is_null());
  EXPECT_TRUE(ring(three, 0, 0)["smallest"].is_null());
  const json one = effectChanges(judging({"v"}), runs(1), "a", "friction");
  EXPECT_EQ(one["stderr_kind"], "within_run");
  EXPECT_NEAR(ring(one, 0, 0)["stderr"].get<double>(), 0.5, 1e-12);  // 0.3 and 0.4
}

TEST(EffectChanges, OfRunsThatDidNotFinishThereAreNone) {
  const json changes = effectChanges(judging({"v"}), runs(4), "a", "bottom_friction");
  EXPECT_EQ(changes["packings"], 0);
  EXPECT_TRUE(changes["fields"].empty());
}

}  // namespace

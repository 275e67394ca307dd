// The results of collisions as they are kept in files.
#include "results/collision.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace crossgrain::inline results {
namespace {

CollisionCurve curveOfTwo() {
  CollisionCurve curve;
  curve.engine = "grain";
  curve.dt = 1e-5;
  curve.stepsPerContact = 50.0;
  curve.stats.emplace();
  curve.points.psi = {0.0, 1.0};
  curve.points.vn = {1e-4, 1e-4};
  curve.points.columns[QuantityId::psiF] = {-0.0, std::nullopt};
  curve.points.reason = {"", ""};
  QuantityScore& psi = curve.score.of[QuantityId::psiF].emplace();
  psi.max = 0.3;
  psi.rms = 0.1;
  psi.limit = 0.5;
  psi.held = true;
  psi.why = "";
  QuantityScore& en = curve.score.of[QuantityId::en].emplace();
  en.max = 0.1;
  en.unit = 3.0;
  curve.score.verdict = Verdict::pass;
  curve.declared = {{{"tension", "cut"}, {"gt", 0.0}}, DeclaredReference::mirror, curve.score, "?"};
  curve.ownScheme = {"position_verlet", 1e-14, 2e-14, 1e-12, true, ""};
  return curve;
}

CollideResults resultsOfOneCase() {
  CollideResults results;
  results.head.kind = "collide";
  results.elapsed = 2.5;
  results.engines = {{"grain", "in-house", "1", "", Status::finished, ""}};
  CollisionVariant& variant = results.variants.emplace_back();
  variant.law = {{"tension", "cut"}, {"mu", 0.44}};
  variant.effects = {"friction"};
  variant.oracle.psi = {0.0};
  variant.oracle.noLimit = {true, false};
  variant.noLimit = {{0.5, 1e-4, -0.2, "it jumps"}};
  variant.curves = {curveOfTwo(), {}};
  ConvergenceOrder& order = results.orders.emplace_back();
  order.errorAt = {{"1e-05", 1e-300}};
  order.of[QuantityId::psiF] = {2.0, 0.1};
  return results;
}

TEST(CollideResults, RoundTrip) {
  const Json there = Json::parse(toJson(resultsOfOneCase()).dump());
  EXPECT_EQ(Json::parse(toJson(collideFromJson(there)).dump()), there);
}

TEST(CollideResults, OnlyColumnsOfWhichSomethingIsKnownAreThere) {
  const Json points = jsonOf(curveOfTwo())["points"];
  EXPECT_EQ(points.dump(), R"({"psi_f":[-0.0,null],"psi_i":[0.0,1.0],"reason":["",""],)"
                           R"("status":["parted","not parted"],"v_n":[0.0001,0.0001]})");
  const Json none = jsonOf(CollisionCurve{});
  EXPECT_EQ(none["points"], Json::object());
  EXPECT_FALSE(none.contains("stats"));
  EXPECT_TRUE(none["realised"].is_null());
  EXPECT_TRUE(none["declared"].is_null());
  EXPECT_FALSE(none.contains("own_scheme"));
}

TEST(CollideResults, ScoresOfPsiAndRestitutionStandThereTwice) {
  const Json score = jsonOf(curveOfTwo())["score"];
  EXPECT_EQ(score["max_error"], 0.3);
  EXPECT_EQ(score["rms_error"], 0.1);
  EXPECT_EQ(score["limit"], 0.5);
  EXPECT_EQ(score["e_n_error"], 0.1 * 3.0);
  EXPECT_EQ(score["psi_f"]["held"], true);
  EXPECT_TRUE(score["psi_f"].contains("why"));
  EXPECT_TRUE(score["e_n"]["held"].is_null());
  EXPECT_FALSE(score["e_n"].contains("why"));
  const Json none = jsonOf(CurveScore{});
  EXPECT_EQ(none.dump(), R"({"e_n_error":null,"limit":null,"max_error":null,"rms_error":null,)"
                         R"("verdict":"not judged"})");
}

TEST(CollideResults, OrderOfPsiStandsThereTwice) {
  const Json order = toJson(resultsOfOneCase())["orders"][0];
  EXPECT_EQ(order["order"], 2.0);
  EXPECT_EQ(order["stderr"], 0.1);
  EXPECT_EQ(order["quantities"].dump(), R"({"psi_f":{"order":2.0,"stderr":0.1}})");
}

TEST(CollisionTable, WhatIsNotKnownIsAbsent) {
  CollisionTable table;
  table.columns[QuantityId::en] = {0.5, NAN};
  EXPECT_EQ(table.at(QuantityId::en, 0), 0.5);
  EXPECT_FALSE(table.at(QuantityId::en, 1));
  EXPECT_FALSE(table.at(QuantityId::en, 2));
  EXPECT_FALSE(table.at(QuantityId::beta, 0));
}

}  // namespace
}  // namespace crossgrain::inline results

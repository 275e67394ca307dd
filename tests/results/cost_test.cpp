// What accuracy costs, as a document and back.
#include "results/cost.hpp"

#include <gtest/gtest.h>

#include "results/json_fields.hpp"

namespace crossgrain::inline results {
namespace {

CostPoint point() {
  CostPoint point;
  point.engine = "grain";
  point.knob = "time_step";
  point.setting = "t_c/50";
  point.fragment = "[run]\nsteps_per_contact = 50\n";
  point.kind = CostKind::averages;
  point.measure = "stress_rr";
  point.dt = 4e-5;
  point.stepsPerContact = 50.0;
  point.error = 0.1;
  point.statistical = 0.01;
  point.systematic = 0.0995;
  point.low = 0.05;
  point.high = 0.15;
  point.equivalent = 1e-3;
  point.bound = 4e-3;
  point.wallSeconds = 1.5;
  point.cpuSeconds = 1.4;
  point.steps = 157080;
  point.contactEvaluations = 64281150;
  return point;
}

CostResults study() {
  CostResults results;
  results.head.schema = "crossgrain-results-1";
  results.head.kind = "cost";
  results.elapsed = 12.5;
  results.effects = {"friction"};
  results.notes = {"a note"};
  results.engines = {{"grain", "", "0.1.0", "", EngineStatus::ran, ""},
                     {"yade", "", "", "", EngineStatus::failed, "gone"}};
  results.cell.omega = 1.0;
  results.averaging.method = "slicing";
  results.rings.r = {0.1, 0.2};
  results.packings = {{0, 1, "d8", true}};
  results.budget = 60.0;
  results.budgetForTheRest = 0.0;
  CostPoint left = point();
  left.error.reset();
  left.status = CostStatus::notMeasured;
  left.reason = "would take about 90 s";
  results.points = {point(), left};
  results.references = {{CostKind::collision, "oracle", "the case's law", {}, "exact"}};
  results.trajectory = ChaosStudy{{{0.0, 1e-10}, {0.1, 2e-10}}, {9.0, 0.2}, {0.8, "chaos"}};
  results.averages.falls = {{"grain", "stress_rr", 0.125, 0.04}};
  results.startup = {{"grain", 0.01, 0.002}};
  results.theory = {{"grain", 2}, {"grain semi_implicit_euler", 1}};
  results.engineFailures = {"gone"};
  OrderFit fit;
  fit.engine = "grain";
  fit.order = 1.02;
  fit.used = {0, 1};
  fit.leftOut = {{1, "too few"}};
  fit.theory = 2.0;
  fit.verdict = OrderVerdict::notMet;
  results.orders = {fit};
  results.fronts = {{CostKind::averages, "stress_rr", "", {0}, {0.1}}};
  results.cheapest = {{"grain", CostKind::averages, "stress_rr", 0.01, CostVerdict::notMeasured}};
  results.cheapest[0].point = 0;
  Advice advice;
  advice.engine = "grain";
  advice.target = 0.1;
  advice.verdict = CostVerdict::reached;
  advice.kinds = {CostKind::collision, CostKind::averages};
  advice.cheapest = true;
  results.advice = {advice};
  results.models = {{"grain", CostKind::collision, "psi_f", 0.25, 0.24, 0.26}};
  results.averages.responses = {{"stress_rr", "kn", 0.1, 0.2, 0.5}};
  results.cells = {{"grain", CostKind::averages, CostBasis::scene, 0.01, CostVerdict::notReached}};
  results.cells[0].model = 0;
  return results;
}

TEST(CostResults, RoundTrip) {
  const Json there = toJson(study());
  EXPECT_EQ(toJson(costFromJson(Json::parse(there.dump()))).dump(), there.dump());
}

TEST(CostResults, AreWrittenAsTheLayoutSays) {
  const Json json = toJson(study());
  EXPECT_EQ(json["points"][1]["status"], "undecided");
  EXPECT_EQ(json["points"][0]["error_kind"], "averages");
  EXPECT_EQ(json["theory"].dump(), R"({"grain":2,"grain semi_implicit_euler":1})");
  EXPECT_EQ(json["orders"][0]["verdict"], "not met");
  EXPECT_EQ(json["orders"][0]["theory"].dump(), "2.0");
  EXPECT_EQ(json["cheapest"][0]["want"], 0.01);
  EXPECT_EQ(json["advice"][0]["cost_kind"], "averages");
  EXPECT_EQ(json["cells"][0]["basis"], "scene");
  EXPECT_EQ(json["cells"][0]["verdict"], "not reached");
  EXPECT_EQ(json["points"][0]["bound"], 4e-3);
  EXPECT_EQ(json["trajectory"]["growth"][1]["separation"], 2e-10);
  EXPECT_EQ(toJson(CostResults{})["theory"].dump(), "{}");
  EXPECT_FALSE(toJson(CostResults{}).contains("trajectory"));
}

TEST(CostResults, WhatAFileLacksIsAbsent) {
  const CostResults empty = costFromJson({{"schema", "crossgrain-results-1"}, {"kind", "cost"}});
  EXPECT_TRUE(empty.points.empty());
  EXPECT_FALSE(empty.budget);
  EXPECT_FALSE(empty.trajectory);
}

TEST(CostResults, WhatIsOfAnotherTypeIsNamed) {
  Json json = toJson(study());
  json["points"][1]["wall_s"] = "long";
  try {
    costFromJson(json);
    FAIL() << "read";
  } catch (const FieldError& error) {
    EXPECT_STREQ(error.what(), "points.1.wall_s: is string, not a number");
  }
}

TEST(CostPoint, WhatWasNotMeasuredIsNullInItsEntry) {
  CostResults results = study();
  for (auto* absent : {&results.points[0].dt, &results.points[0].statistical}) absent->reset();
  results.points[0].steps.reset();
  results.points[0].contactEvaluations.reset();
  const Json entry = toJson(results)["points"][0];
  for (const char* key : {"dt_s", "steps", "contact_evaluations", "statistical"})
    EXPECT_TRUE(entry.at(key).is_null()) << key;
  EXPECT_FALSE(costFromJson(toJson(results)).points[0].steps);
}

/// Two runs of a scheme are joined; a setting without a step belongs to none.
TEST(CostPoint, BelongsToTheSchemeItsSettingNames) {
  EXPECT_EQ(schemeOf("time_step", "t_c/50"), "");
  EXPECT_EQ(schemeOf("integrator", "velocity_verlet, t_c/50"), "velocity_verlet");
  EXPECT_FALSE(schemeOf("integrator", "velocity_verlet"));
  EXPECT_FALSE(schemeOf("precision", "float"));
}

}  // namespace
}  // namespace crossgrain::inline results

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
  point.intervalLow = 0.05;
  point.intervalHigh = 0.15;
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
  results.engines = {{"grain", "", "0.1.0", "", Status::finished, ""},
                     {"yade", "", "", "", Status::failed, "gone"}};
  results.cell.omega = 1.0;
  results.averaging.method = "slicing";
  results.rings.r = {0.1, 0.2};
  results.packings = {{0, 1, "d8", true}};
  results.budget = 60.0;
  results.budgetForTheRest = 0.0;
  CostPoint left = point();
  left.error.reset();
  left.status = Status::notRun;
  left.reason = "would take about 90 s";
  left.knob = "effect:friction";
  results.points = {point(), left};
  results.references = {{CostKind::collision, "oracle", "the case's law", {}, "exact"}};
  results.window = 0.8;
  results.startup = {{"grain", 0.01, 0.002}};
  results.engineFailures = {"gone"};
  results.fronts = {{CostKind::averages, "stress_rr", "", {0}, {0.1}}};
  Advice advice;
  advice.engine = "grain";
  advice.target = 0.1;
  advice.verdict = Verdict::pass;
  advice.kinds = {CostKind::collision, CostKind::averages};
  advice.cheapest = true;
  results.advice = {advice};
  results.models = {{"grain", CostKind::collision, "psi_f", 0.25, 0.24, 0.26}};
  results.cells = {{"grain", CostKind::averages, CostBasis::scene, 0.01, Verdict::fail}};
  results.cells[0].model = 0;
  return results;
}

TEST(CostResults, RoundTrip_KeepsEveryMember) {
  const Json there = toJson(study());
  EXPECT_EQ(toJson(costFromJson(Json::parse(there.dump()))).dump(), there.dump());
  const CostResults empty = costFromJson({{"schema", "crossgrain-results-1"}, {"kind", "cost"}});
  EXPECT_TRUE(empty.points.empty());
  EXPECT_FALSE(empty.budget);
  EXPECT_FALSE(empty.window);
}

TEST(CostResults, Document_HasTheNamesOfTheContract) {
  CostResults results = study();
  results.points[0].steps.reset();
  const Json json = toJson(results);
  EXPECT_EQ(json["points"][1]["status"], "undecided");
  EXPECT_EQ(json["points"][0]["error_kind"], "averages");
  EXPECT_EQ(json["points"][0]["low"], 0.05);
  EXPECT_TRUE(json["points"][0].at("steps").is_null());
  EXPECT_EQ(json["advice"][0]["cost_kind"], "averages");
  EXPECT_EQ(json["cells"][0]["basis"], "scene");
  EXPECT_EQ(json["cells"][0]["verdict"], "not reached");
  EXPECT_EQ(json["window_s"], 0.8);
}

TEST(CostResults, WrongType_IsNamedByItsPath) {
  Json json = toJson(study());
  json["points"][1]["knob"] = "effect:fric tion";
  EXPECT_THROW(costFromJson(json), FieldError);
  json = toJson(study());
  json["points"][1]["wall_s"] = "long";
  try {
    costFromJson(json);
    FAIL() << "read";
  } catch (const FieldError& error) {
    EXPECT_STREQ(error.what(), "points.1.wall_s: is string, not a number");
  }
}

TEST(CostPoint, Scheme_IsThatOfTheIntegratorNamed) {
  EXPECT_EQ(schemeOf("time_step", "t_c/50"), "");
  EXPECT_EQ(schemeOf("integrator", "velocity_verlet, t_c/50"), "velocity_verlet");
  EXPECT_FALSE(schemeOf("integrator", "velocity_verlet"));
  EXPECT_FALSE(schemeOf("precision", "float"));
}

TEST(CostPoint, OwnMeasures_ArePairedWithTheScenes) {
  EXPECT_EQ(ownOf("psi_f"), "psi_f_own");
  EXPECT_EQ(withoutOwn("psi_f_own"), "psi_f");
  EXPECT_TRUE(isOwn("position_rms_own"));
  EXPECT_EQ(withoutOwn("position_rms_own"), "position_rms_own");
}

}  // namespace
}  // namespace crossgrain::inline results

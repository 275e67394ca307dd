#include "reports/common/report.hpp"

#include <gtest/gtest.h>

#include "reports/collide/report.hpp"
#include "reports/common/overview.hpp"
#include "reports/stability/report.hpp"
#include "tests/reports/report_text.hpp"

namespace crossgrain::reports {
namespace {

TEST(JUnit, Suite_CountsOutcomesAndHasMessages) {
  EXPECT_EQ(junitXml("stability", {{"pile", "grain: drift", Verdict::pass, "", 0.5},
                                   {"pile", "other: drift", Verdict::fail, "2 of 1"},
                                   {"gas", "other: drift", Verdict::notMeasured, "died", 0.0, true},
                                   {"gas", "grain: drift", Verdict::notMeasured, "refused"},
                                   {"column", "grain: drift", Verdict::pass, "degraded"}}),
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
            "<testsuites tests=\"5\" failures=\"1\" errors=\"1\" skipped=\"1\" time=\"0.500\">\n"
            "<testsuite name=\"crossgrain stability\" tests=\"5\" failures=\"1\" errors=\"1\" "
            "skipped=\"1\" time=\"0.500\">\n"
            "<testcase classname=\"pile\" name=\"grain: drift\" time=\"0.500\"/>\n"
            "<testcase classname=\"pile\" name=\"other: drift\" time=\"0.000\">"
            "<failure message=\"2 of 1\"/></testcase>\n"
            "<testcase classname=\"gas\" name=\"other: drift\" time=\"0.000\">"
            "<error message=\"died\"/></testcase>\n"
            "<testcase classname=\"gas\" name=\"grain: drift\" time=\"0.000\">"
            "<skipped message=\"refused\"/></testcase>\n"
            "<testcase classname=\"column\" name=\"grain: drift\" time=\"0.000\">"
            "<system-out>degraded</system-out></testcase>\n"
            "</testsuite>\n</testsuites>\n");
}

TEST(JUnit, WhatXmlCannotHold_IsReplaced) {
  const std::string xml = junitXml("x", {{"a<b & \"c\"", "\x1b[31m\xff\n", Verdict::pass, ""}});
  EXPECT_TRUE(has(xml, "classname=\"a&lt;b &amp; &quot;c&quot;\"")) << xml;
  EXPECT_TRUE(has(xml, "name=\"?[31m\xEF\xBF\xBD&#10;\"")) << xml;
}

TEST(JUnit, Matrix_IsACaseAnAnswer) {
  using enum Verdict;
  Overview overview;
  const std::vector<std::optional<Verdict>> verdicts = {
      pass, fail, modelDifference, borderline, undecided, notMeasured, {}, notApplicable};
  for (const auto verdict : verdicts) {
    overview.columns.push_back({"question " + std::to_string(overview.columns.size()), "", ""});
    if (overview.rows.empty()) overview.rows.push_back({"ours", true, {}});
    overview.rows.front().cells.push_back({verdict, {}, "", "2 margins", "of pressure", ""});
  }
  const auto cases = overviewCases(overview, "compare quick");
  ASSERT_EQ(cases.size(), 6u);  // neither the number nor what does not apply
  const std::string xml = junitXml("compare", cases);
  EXPECT_TRUE(has(xml, "tests=\"6\" failures=\"1\" errors=\"0\" skipped=\"3\"")) << xml;
  EXPECT_EQ(cases[1].group, "compare quick");
  EXPECT_EQ(cases[1].name, "ours: question 1");
  EXPECT_EQ(cases[1].message, "2 margins, of pressure");
  EXPECT_EQ(cases[2].message, "model difference, 2 margins, of pressure");
}

std::string junitOfStability(const StabilityResults& results) {
  return junitOf(reportOf(results));
}

std::string junitOfCollide(const CollideResults& results) {
  return junitOf(reportOf(results));
}

StabilityResults hardResults(Status status, Verdict verdict, const std::string& reason) {
  StabilityRun run;
  run.engine = "grain";
  run.name = "pile";
  run.variant = "slow";
  run.measure = "drift";
  run.status = status;
  run.verdict = verdict;
  run.limit = 0.1;
  run.unit = "d";
  run.reason = reason;
  HardCase pile;
  pile.name = "pile";
  pile.variant = "slow";
  pile.why = "a pile rests";
  return StabilityResults{.cases = {pile}, .runs = {run}};
}

TEST(StabilityJunit, Failure_HasFigureLimitAndReason) {
  StabilityResults results = hardResults(Status::finished, Verdict::fail, "it slides");
  results.runs.front().value = 0.25;
  const std::string xml = junitOfStability(results);
  EXPECT_TRUE(has(xml, "classname=\"pile slow\" name=\"grain: drift\"")) << xml;
  EXPECT_TRUE(has(xml,
                  "<failure message=\"unstable: 0.25 d against a limit of 0.1 (a pile rests); "
                  "it slides\"/>"))
      << xml;
}

TEST(StabilityJunit, DegradedPassesWithAMessage) {
  StabilityResults results = hardResults(Status::finished, Verdict::borderline, "");
  results.runs.front().value = 0.15;
  const Report report = reportOf(results);
  EXPECT_TRUE(has(junitOf(report), "<system-out>degraded: 0.15 d against a limit of 0.1"));
}

TEST(StabilityJunit, BrokenDownIsAnError_RefusedIsSkipped) {
  EXPECT_TRUE(has(junitOfStability(hardResults(Status::failed, Verdict::fail, "failed: signal 11")),
                  "<error message=\"failed: signal 11\"/>"));
  EXPECT_TRUE(
      has(junitOfStability(hardResults(Status::refused, Verdict::notApplicable, "has no springs")),
          "<skipped message=\"has no springs\"/>"));
}

CollideResults sweeps(std::vector<CollisionCurve> curves) {
  CollisionVariant variant{.name = "pair", .variant = "cut"};
  variant.curves = std::move(curves);
  CollideResults results;
  results.variants = {std::move(variant)};
  return results;
}

CollisionCurve curve(Status status, const std::optional<QuantityScore>& psi) {
  CollisionCurve curve{.engine = "grain", .dt = 2e-5, .status = status, .reason = "because"};
  curve.score.verdict = Verdict::pass;
  curve.score.of[QuantityId::psiF] = psi;
  curve.stats.emplace().wallSeconds = 0.25;
  return curve;
}

QuantityScore scoreOf(double max, const char* why = nullptr) {
  QuantityScore score{.max = max, .limit = 0.1, .held = max <= 0.1};
  if (why) score.why = why;
  return score;
}

TEST(CollideJunit, JudgesEachQuantityThatHasALimit) {
  const std::string xml =
      junitOfCollide(sweeps({curve(Status::finished, scoreOf(0.5, "the scheme"))}));
  EXPECT_TRUE(has(xml,
                  "<testcase classname=\"pair cut\" name=\"grain, dt 2e-05 s: psi_f\" "
                  "time=\"0.250\"><failure message=\"largest error 0.5 of the range against a "
                  "limit of 0.1 (the scheme)\"/></testcase>"))
      << xml;
  EXPECT_TRUE(has(xml, "tests=\"1\"")) << xml;
}

TEST(CollideJunit, ModelDifferenceIsNoFailure_FaultBehindItIs) {
  CollisionCurve one = curve(Status::finished, scoreOf(0.5));
  one.declared.emplace().reference = DeclaredReference::oracle;
  one.declared->score.of[QuantityId::psiF] = scoreOf(0.05);
  const std::string model = junitOfCollide(sweeps({one}));
  EXPECT_TRUE(has(model, "failures=\"0\"")) << model;
  EXPECT_TRUE(has(model,
                  "psi_f\" time=\"0.250\"><skipped message=\"model difference: largest "
                  "error 0.5"))
      << model;
  EXPECT_TRUE(has(model, "psi_f, declared law\" time=\"0.000\"/>")) << model;
  one.declared->score.of[QuantityId::psiF] = scoreOf(0.3);
  const std::string fault = junitOfCollide(sweeps({one}));
  EXPECT_TRUE(has(fault, "failures=\"2\"")) << fault;
}

TEST(CollideJunit, OwnScheme_IsACaseOfItsOwn) {
  CollisionCurve one = curve(Status::finished, scoreOf(0.05));
  SchemeScore& own = one.ownScheme.emplace();
  own.position = 1e-14;
  own.velocity = 3e-9;
  own.reason = "not judged: it runs in float precision";
  EXPECT_TRUE(has(junitOfCollide(sweeps({one})), "own scheme\" time=\"0.000\"><skipped"));
  own.limit = 1e-12;
  own.held = false;
  const std::string fault = junitOfCollide(sweeps({one}));
  EXPECT_TRUE(has(fault,
                  "<failure message=\"deviates by 1e-14 d and 3e-09 of the speed against a "
                  "limit of 1e-12\"/>"))
      << fault;
}

TEST(CollideJunit, WhatWasNotJudgedIsNeverASuccess) {
  const QuantityScore held = scoreOf(0.05);
  // Of two sweeps only the first shows the quantity.
  const std::string missing = junitOfCollide(
      sweeps({curve(Status::finished, held), curve(Status::finished, std::nullopt)}));
  EXPECT_TRUE(has(missing, "<skipped message=\"not measured")) << missing;
  const std::string none = junitOfCollide(sweeps({curve(Status::finished, std::nullopt)}));
  EXPECT_TRUE(has(none, "<skipped message=\"not judged")) << none;
  CollisionCurve apartCurve = curve(Status::finished, held);
  apartCurve.points.psi = {0.5};  // and no outcome
  const std::string apart = junitOfCollide(sweeps({apartCurve}));
  EXPECT_TRUE(has(apart, "all pairs part\" time=\"0.000\"><failure message=\"because\"/>"))
      << apart;
}

TEST(CollideJunit, FailedIsAnError_RefusedIsSkipped) {
  EXPECT_TRUE(has(junitOfCollide(sweeps({curve(Status::failed, std::nullopt)})),
                  "<error message=\"because\"/>"));
  EXPECT_TRUE(has(junitOfCollide(sweeps({curve(Status::refused, std::nullopt)})),
                  "<skipped message=\"because\"/>"));
}

TEST(CollideJunit, Quantities_AreInTheOrderOfTheirNames) {
  CollisionCurve both = curve(Status::finished, scoreOf(0.05));
  both.score.of[QuantityId::en] = both.score.of[QuantityId::psiF];
  const std::string xml = junitOfCollide(sweeps({both}));
  EXPECT_LT(xml.find(": e_n\""), xml.find(": psi_f\"")) << xml;
}

}  // namespace
}  // namespace crossgrain::reports

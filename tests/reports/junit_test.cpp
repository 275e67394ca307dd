#include "reports/common/junit.hpp"

#include <gtest/gtest.h>

#include "reports/collide/report.hpp"
#include "reports/stability/report.hpp"
#include "tests/reports/sample_results.hpp"

namespace crossgrain::reports {
namespace {

using Outcome = JUnitCase::Outcome;

TEST(JUnit, CountsAndSaysWhatHappened) {
  EXPECT_EQ(junitXml("stability", {{"pile", "grain: drift", Outcome::passed, "", 0.5},
                                   {"pile", "other: drift", Outcome::failed, "2 of 1"},
                                   {"gas", "other: drift", Outcome::error, "died"},
                                   {"gas", "grain: drift", Outcome::skipped, "refused"},
                                   {"column", "grain: drift", Outcome::passed, "degraded"}}),
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

TEST(JUnit, WhatXmlCannotHoldIsReplaced) {
  const std::string xml = junitXml("x", {{"a<b & \"c\"", "\x1b[31m\xff\n", Outcome::passed, ""}});
  EXPECT_NE(xml.find("classname=\"a&lt;b &amp; &quot;c&quot;\""), std::string::npos) << xml;
  EXPECT_NE(xml.find("name=\"?[31m\xEF\xBF\xBD&#10;\""), std::string::npos) << xml;
}

StabilityResults hardResults(HardRunStatus status, StabilityVerdict verdict,
                             const std::string& reason) {
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
  StabilityResults results;
  results.cases = {pile};
  results.runs = {run};
  return results;
}

TEST(StabilityJunit, AFailureSaysFigureLimitAndReason) {
  StabilityResults results =
      hardResults(HardRunStatus::finished, StabilityVerdict::unstable, "it slides");
  results.runs.front().value = 0.25;
  const std::string xml = stabilityJunit(results);
  EXPECT_NE(xml.find("classname=\"pile slow\" name=\"grain: drift\""), std::string::npos) << xml;
  EXPECT_NE(xml.find("<failure message=\"unstable: 0.25 d against a limit of 0.1 (a pile rests); "
                     "it slides\"/>"),
            std::string::npos)
      << xml;
}

TEST(StabilityJunit, AnEngineThatBrokeDownIsAnErrorAndARefusalIsSkipped) {
  EXPECT_NE(stabilityJunit(
                hardResults(HardRunStatus::failed, StabilityVerdict::unstable, "failed: signal 11"))
                .find("<error message=\"failed: signal 11\"/>"),
            std::string::npos);
  EXPECT_NE(stabilityJunit(
                hardResults(HardRunStatus::refused, StabilityVerdict::refused, "has no springs"))
                .find("<skipped message=\"has no springs\"/>"),
            std::string::npos);
}

/// Of an array: braces around one curve would be that curve itself.
Json sweeps(const Json::array_t& curves) {
  return {{"variants", {{{"case", "pair"}, {"variant", "cut"}, {"curves", curves}}}}};
}

Json curve(const char* status, const Json& psi) {
  Json score = {{"max_error", 0.5}, {"limit", 0.1}, {"verdict", "held"}};
  if (!psi.is_null()) score["psi_f"] = psi;
  return {{"engine", "grain"},   {"dt", 2e-5},     {"status", status},
          {"reason", "because"}, {"score", score}, {"stats", {{"wall_s", 0.25}}}};
}

TEST(CollideJunit, JudgesEachQuantityThatHasALimit) {
  const Json beyond = {
      {"max", 0.5}, {"unit_is", "range"}, {"limit", 0.1}, {"held", false}, {"why", "the scheme"}};
  const std::string xml = collideJunit(sweeps(Json::array({curve("finished", beyond)})));
  EXPECT_NE(xml.find("<testcase classname=\"pair cut\" name=\"grain, dt 2e-05 s: psi_f\" "
                     "time=\"0.250\"><failure message=\"largest error 0.5 of the range against a "
                     "limit of 0.1 (the scheme)\"/></testcase>"),
            std::string::npos)
      << xml;
  EXPECT_NE(xml.find("tests=\"1\""), std::string::npos) << xml;
}

TEST(CollideJunit, WhatWasNotJudgedIsNeverASuccess) {
  const Json held = {{"max", 0.05}, {"unit_is", "range"}, {"limit", 0.1}, {"held", true}};
  // Of two sweeps only the first shows the quantity.
  const std::string missing =
      collideJunit(sweeps(Json::array({curve("finished", held), curve("finished", nullptr)})));
  EXPECT_NE(missing.find("<skipped message=\"not measured"), std::string::npos) << missing;
  const std::string none = collideJunit(sweeps(Json::array({curve("finished", nullptr)})));
  EXPECT_NE(none.find("<skipped message=\"not judged"), std::string::npos) << none;
  const std::string apart = collideJunit(sweeps(Json::array({curve("incomplete", held)})));
  EXPECT_NE(apart.find("all pairs part\" time=\"0.000\"><failure message=\"because\"/>"),
            std::string::npos)
      << apart;
}

TEST(CollideJunit, AnEngineThatFailedIsAnErrorAndARefusalIsSkipped) {
  EXPECT_NE(collideJunit(sweeps(Json::array({curve("failed", nullptr)})))
                .find("<error message=\"because\"/>"),
            std::string::npos);
  EXPECT_NE(collideJunit(sweeps(Json::array({curve("refused", nullptr)})))
                .find("<skipped message=\"because\"/>"),
            std::string::npos);
}

TEST(Junit, OfEverythingThatTheReportsShow) {
  for (const std::string& xml :
       {stabilityJunit(sample::stabilityResults()), collideJunit(sample::collideResults())})
    EXPECT_EQ(xml.find("tests=\"0\""), std::string::npos) << xml;
}

}  // namespace
}  // namespace crossgrain::reports

// What a climb through the thesis' claims finds out, as it is kept in files.
#include "results/thesis.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace crossgrain::inline results {
namespace {

ThesisResults resultsOfOneLeg() {
  ThesisResults results;
  results.head.kind = "thesis";
  results.elapsed = 12.5;
  results.engines = {{"grain", "in-house", "1", "", Status::finished, ""}};
  results.surrogates = {{"other", "grain-as-other", true, 1e-9, 16, "same to rounding"}};
  results.rules = "[common]\n";
  results.collisions.emplace().head.kind = "collide";
  ThesisCase& setup = results.cases.emplace_back();
  setup.name = "nu-0.804";
  setup.families = {"packings", "kn"};
  setup.cell.small = 2511;
  setup.label = 0.804;
  setup.kn = 352.1;
  setup.bottomFriction = false;
  setup.settleRotations = 5.0;
  setup.averagedRotations = 3.0;
  setup.caseToml = "[case]\n";
  ThesisRun& run = results.runs.emplace_back();
  run.setup = setup.name;
  run.engine = run.run.engine = "grain";
  run.packing = 2;
  run.seed = 7;
  RingAverages& finer = run.finer.emplace_back();
  finer.rings = 2;
  finer.places = {{0.1, 0.2}, {0.5, 1.5}, 0.1};
  finer.profiles = {{"slicing", "volume_fraction", "-", {0.8, {}}, {1e-3, {}}, {}, {}}};
  ThesisSpan& span = run.history.emplace_back();
  span.from = 0.0;
  span.to = 1.0;
  span.outerPressure = 1.0 / 3.0;
  span.wheelTouched = 0.0;
  span.maxOverlap = 1e-300;
  ClaimRow& claim = results.claims.emplace_back();
  claim.id = "C7";
  claim.mirror = "grain-as-other";
  claim.figures = {{"B", "d", 2.5, {}, 0.5, {}}};
  claim.verdict = Verdict::fail;
  claim.cases = {"nu-0.804"};
  claim.plot = "figure 6.7";
  results.notes = {"one was left out"};
  return results;
}

TEST(ThesisResults, RoundTrip) {
  const Json there = Json::parse(toJson(resultsOfOneLeg()).dump());
  EXPECT_EQ(Json::parse(toJson(thesisFromJson(there)).dump()), there);
}

TEST(ThesisResults, ComeBackAsTheyWere) {
  const ThesisResults results = thesisFromJson(Json::parse(toJson(resultsOfOneLeg()).dump()));
  EXPECT_EQ(results.runs.at(0).seed, 7u);
  const ThesisSpan& span = results.runs[0].history.at(0);
  EXPECT_EQ(span.outerPressure, 1.0 / 3.0);  // to the bit
  EXPECT_EQ(span.maxOverlap, 1e-300);
  EXPECT_EQ(span.wheelTouched, 0.0);
  EXPECT_FALSE(span.wheelTorque);  // absent, not zero
  EXPECT_EQ(results.runs[0].finer.at(0).places.width, 0.1);
  EXPECT_EQ(results.claims.at(0).verdict, Verdict::fail);
  EXPECT_FALSE(results.claims[0].figures.at(0).high);
  EXPECT_FALSE(results.cases.at(0).bottomFriction);
  EXPECT_TRUE(results.surrogates.at(0).accepted);
  EXPECT_TRUE(results.collisions);
}

}  // namespace
}  // namespace crossgrain::inline results

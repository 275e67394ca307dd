// Results of Couette cases as JSON and back: everything once, and what may be absent once without.
#include <gtest/gtest.h>

#include <cmath>

#include "results/effects.hpp"
#include "results/rev.hpp"
#include "results/schema.hpp"

namespace crossgrain {
namespace {

EffectiveParameters effective() {
  EffectiveParameters result;
  result.engine = "one";
  result.dt = 1e-5;
  result.effects = {Effect::friction, Effect::rotation};
  result.pairs = {{"a – b", 352.1, 0.19, 0.0, 0.0, 0.44}};
  result.deviations = {{"tension", 0.341, "-", "always cut"}};
  return result;
}

FlowRun finishedRun() {
  FlowRun run;
  run.engine = "one";
  run.packing = 1;
  run.effective = effective();
  run.stats = Stats{7, 11, 0.5, 0.25, {{"impacts", 3.0}}};
  run.head = {{"inertial_number", "-", 0.0041, {}, {}}};
  run.regime = RegimeRow{Regime::blocked, "it stands", 15.5, 0.9, {}, 1e-4, 1.0};
  run.steadiness = {{"outer_pressure", {Drift::drifts, -0.5, 0.25, 0.75}}};
  run.profiles = {{"slicing", "spin", "rad/s", {0.1, {}}, {1e-30, {}}, {12.5, {}}, {7.0, {}}}};
  FitRow phase, spin;
  phase.name = "spin_phase";
  phase.value = 0.5;
  phase.chi2PerDof = 1.5;
  phase.period = 6.28;
  spin.name = spinInRing1;
  spin.reason = "no disks in ring 1";
  run.fits = {phase, spin};
  run.checks = {{"torque_balance", "torque", {1.0, {}}, {0.1, {}}, {1.0, 1.0}, 0.01, {}},
                {"wall_pressure", "pressure", {1.0}, {{}}, {2.0}, {}, "half"}};
  run.series = RunSeries{{"t_s", {0.0, 0.5}}, {"wheel_torque", {{}, 2e-3}}};
  run.distributions = {{"spin", 0, {{-1.0, 0.5, 3}}, {0.25, 0.0, 1.5}, {}, 0.125, 8.0}};
  ScenePicture picture;
  picture.radius = picture.x = picture.y = picture.startR = picture.startPhi = {0.25};
  picture.contactI = picture.contactJ = std::vector<int>{0};
  picture.contactForce = {0.5};
  picture.time = 3.0;
  run.picture = picture;
  return run;
}

FlowRun failedRun() {
  FlowRun run;
  run.engine = "one";
  run.status = Status::failed;
  run.reason = "died";
  return run;
}

template <typename Study>
Study studyOf(std::string_view kind) {
  Study study;
  study.head.schema = schemaVersion;
  study.head.kind = kind;
  study.cell.innerRadius = 0.1;
  study.averaging = {"slicing", 0.25, 1.0, 0.25, 1.25, {}, 400, 0.99, {}};
  study.effects = {"friction"};
  study.rings = {{0.11, 0.12}, {0.5, 1.5}, 0.01};
  study.notes = {"a note"};
  return study;
}

template <typename Study>
Study ranStudy(std::string_view kind) {
  Study study = studyOf<Study>(kind);
  study.elapsed = 12.5;
  study.engines = {{"one", "an engine", "1.0", "", Status::finished, ""}};
  study.packings = {{0, 18446744073709551615u, "9f86", true}};
  study.runs = {finishedRun(), failedRun()};
  study.ensemble = {{"one", "", 2, finishedRun().profiles, finishedRun().distributions, {}, {}}};
  return study;
}

TEST(FlowRuns, ComeBackAsTheyWere) {
  const Json there = toJson(finishedRun());
  EXPECT_EQ(toJson(runFromJson(Json::parse(there.dump()))).dump(), there.dump());
  EXPECT_EQ(there["regime"]["name"], "blocked");
  EXPECT_EQ(there["series"]["wheel_torque"], Json({nullptr, 2e-3}));
  // What is read off a profile has no χ²; a fit that nothing is known of has one that is null.
  EXPECT_EQ(there["fits"][0]["chi2_per_dof"], 1.5);
  EXPECT_FALSE(there["fits"][1].contains("chi2_per_dof"));
  EXPECT_EQ(there["checks"][1]["note"], "half");
  EXPECT_FALSE(there["checks"][0].contains("note"));
  EXPECT_FALSE(there.contains("without"));
}

TEST(FlowRuns, ThatDidNotFinishHoldNothingElse) {
  EXPECT_EQ(toJson(failedRun()),
            Json({{"engine", "one"}, {"packing", 0}, {"status", "failed"}, {"reason", "died"}}));
}

TEST(FlowRuns, WithoutSeriesShowNeitherDistributionsNorPicture) {
  FlowRun run = finishedRun();
  run.without = "friction";
  run.series.reset();
  const Json there = toJson(run);
  for (const char* bulky : {"series", "distributions", "picture"})
    EXPECT_FALSE(there.contains(bulky)) << bulky;
  EXPECT_EQ(runFromJson(there).without, "friction");
  // Snapshots of a file: crossgrain ran nothing.
  run = finishedRun();
  run.effective.reset();
  EXPECT_FALSE(toJson(run).contains("picture"));
  EXPECT_TRUE(toJson(run).contains("series"));
}

TEST(FlowRuns, OfAPackingWithoutAPictureSaySo) {
  FlowRun run = finishedRun();
  run.picture.reset();
  EXPECT_TRUE(toJson(run).at("picture").is_null());
  EXPECT_FALSE(runFromJson(toJson(run)).picture);
}

TEST(CompareResults, RoundTrip) {
  CompareResults results = ranStudy<CompareResults>(kindCompare);
  results.regimes = {{"one", "two", PairKind::mirrorModel, 2, {1}}};
  results.steadiness = {{{"wheel_torque", {Drift::cannotTell, {}, {}, {}}}, "one", 2, {0}}};
  results.ensemble[0].fits = finishedRun().fits;
  results.ensemble[0].fits[1].packings = 1;
  results.ensemble[0].fits[1].ofPackings = 2;
  results.ensemble[0].head = {{"inertial_number", "-", 0.1, 0.01, 2}};
  AgreementRing ring;
  ring.difference = -0.5;
  ring.scale = TestScale::logarithmic;
  ring.packings = 4;
  ring.verdict = Verdict::pass;
  AgreementRow row;
  row.a = "one";
  row.b = "two";
  row.field = "spin";
  row.margin = 0.25;
  row.marginRelative = true;
  row.rings = {ring};
  results.agreement = {row};
  results.nothingJudged = NothingJudged{"one engine", true};
  EndpointRow endpoint;
  endpoint.endpoint = "pressure";
  endpoint.verdict = Verdict::borderline;
  endpoint.distance = -0.99;
  endpoint.surrogateB = "mirror";
  endpoint.bound = 1e-3;
  endpoint.reach = 5e-4;
  results.endpoints = {{{{8, 0.0125}}, 0.0193, 1, 120.0, "all is decided"},
                       {endpoint},
                       {{"one", "two", PairKind::peer, "far off"}},
                       {{"two",
                         "mirror",
                         1e-5,
                         16,
                         0,
                         {{"pressure", 0.5, 1.0, {}, 3.9}},
                         "",
                         true,
                         {1, {0.0, 0.1}, 0.1, {{"mu", 1e-4}}, ""}}},
                       {{"pressure", "kn", 0.1, 0.2, 0.5, 0.3, 8}}};
  const Json there = toJson(results);
  EXPECT_EQ(there["endpoints"]["rows"][0]["answer"], "borderline");
  EXPECT_EQ(there["endpoints"]["carried"][0]["canary"][0]["chance"], nullptr);
  EXPECT_EQ(toJson(compareFromJson(Json::parse(there.dump()))).dump(), there.dump());
  EXPECT_EQ(there["agreement"][0]["rings"][0]["scale"], "logarithmic");
  EXPECT_EQ(there["regimes"][0]["kind"], "mirror_model");
  EXPECT_TRUE(there["averaging"]["prepared_rotations"].is_null());
  EXPECT_EQ(there["packings"][0]["seed"], 18446744073709551615u);
  // Means of numbers have the members of means of fits.
  for (const char* member : {"chi2_per_dof", "reason", "stderr", "packings"})
    EXPECT_TRUE(there["ensemble"][0]["head"][0].contains(member)) << member;
}

TEST(AverageResults, AreThoseOfAComparisonWithoutOne) {
  CompareResults results = studyOf<CompareResults>(kindAverage);
  results.averaging = {};
  results.averaging.snapshots = 3;
  const Json there = toJson(results);
  EXPECT_EQ(there["averaging"], Json({{"method", ""}, {"snapshots", 3}, {"confidence", 0.95}}));
  for (const char* none : {"packings", "regimes", "ensemble", "agreement", "elapsed_s"})
    EXPECT_FALSE(there.contains(none)) << none;
  EXPECT_EQ(toJson(compareFromJson(there)), there);
}

TEST(EffectsResults, RoundTrip) {
  EffectsResults results = ranStudy<EffectsResults>(kindEffects);
  EffectVariant whole, switched, refused;
  whole.engine = switched.engine = refused.engine = "one";
  whole.timeRatio = 1.0;
  switched.effect = "friction";
  switched.precision = "double";
  switched.effects = {{"rotation"}};
  RingChange ring;
  ring.change = -0.5;
  ring.resolved = false;
  ring.verdict = Verdict::fail;
  switched.changes = {
      1, BarKind::withinRun, {{"spin", "rad/s", true, Verdict::notApplicable, {ring}}}};
  refused.effect = "rotation";
  refused.status = Status::refused;
  refused.reason = "cannot";
  results.variants = {whole, switched, refused};
  results.switches = {{"friction", "No tangential force."}};
  results.timing = {0.02, 3};
  const Json there = toJson(results);
  EXPECT_EQ(toJson(effectsFromJson(Json::parse(there.dump()))).dump(), there.dump());
  EXPECT_FALSE(there["legs"][0].contains("fields"));
  EXPECT_EQ(there["legs"][1]["fields"][0]["verdict"], "");
  EXPECT_EQ(there["legs"][1]["stderr_kind"], "within_run");
  EXPECT_EQ(there["legs"][2].size(), 4u);
}

TEST(RevResults, RoundTrip) {
  RevResults results = studyOf<RevResults>(kindRev);
  results.averaging.lineWidth = 0.5;
  results.engine = "one";
  results.curves = {{"slicing", "spin", "rad/s", 0.12, {0.5, 1.0}, {0.1, {}}, {{}, {}}}};
  results.meetings = {{"centre", "spin", 1.0, 0.95, 0.01}};
  const Json there = toJson(results);
  EXPECT_EQ(toJson(revFromJson(Json::parse(there.dump()))).dump(), there.dump());
  EXPECT_EQ(there["averaging"]["line_width"], 0.5);
}

TEST(CouetteResults, WhatAFileLacksIsAbsentAndWhatItHasWrongIsNamed) {
  const Json little = {{"schema", "crossgrain-results-1"}, {"kind", "compare"}};
  Json one = little;
  one["engines"] = Json::array({{{"name", "one"}}});
  EXPECT_TRUE(compareFromJson(one).runs.empty());
  EXPECT_THROW(compareFromJson(little), FieldError);  // there is no reference
  EXPECT_TRUE(effectsFromJson(little).variants.empty());
  EXPECT_TRUE(revFromJson(little).curves.empty());
  Json broken = toJson(ranStudy<CompareResults>(kindCompare));
  broken["runs"][0]["profiles"][0]["mean"] = "not a list";
  try {
    compareFromJson(broken);
    FAIL() << "read";
  } catch (const FieldError& error) {
    EXPECT_STREQ(error.what(), "runs.0.profiles.0.mean: is string, not a list");
  }
}

TEST(CouetteResults, ProfilesAreFoundByFieldAndMethod) {
  std::vector<Profile> profiles(2);
  profiles[0].method = "slicing";
  profiles[1].method = "centre";
  profiles[0].field = profiles[1].field = "spin";
  EXPECT_EQ(profileOf(profiles, "spin"), &profiles[0]);
  EXPECT_EQ(profileOf(profiles, "centre", "spin"), &profiles[1]);
  EXPECT_EQ(profileOf(profiles, "velocity"), nullptr);
}

}  // namespace
}  // namespace crossgrain

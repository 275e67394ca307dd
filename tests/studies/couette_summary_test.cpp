#include "studies/flow/summary.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "averaging/rings.hpp"
#include "cases/couette.hpp"
#include "studies/flow/notes.hpp"
#include "studies/flow/run.hpp"
#include "tests/studies/flow_runs.hpp"
#include "tests/support/refusal.hpp"
#include "tests/support/thesis.hpp"

namespace {

using namespace crossgrain;

Case cell() {
  Case setup;
  couetteIn(setup).cell = {0.03, 0.075, test::wallRadius, 2.5e-3, 6e-3, 1.0};
  couetteIn(setup).particles.smallRadius = test::smallRadius;
  couetteIn(setup).particles.smallMass = couetteIn(setup).particles.largeMass = test::smallMass;
  couetteIn(setup).times.rings = 6;
  setup.law.kn = test::thesis.kn;
  setFlowOfCell(setup);
  return setup;
}

Profile profile(const std::string& field, const std::function<double(double r)>& value) {
  const Rings rings = ringsOf(cell());
  Numbers means, errors;
  for (int ring = 0; ring < rings.count(); ++ring) {
    means.emplace_back(value(rings.centre(ring)));
    errors.emplace_back(0.01 * std::abs(*means.back()));
  }
  return test::sliced(field, means, errors);
}

TEST(CouetteSummary, TorqueBalance_OfAnExactStressField_IsExact) {
  // σ_φr = T/(2π r² h) carries the torque T through every ring.
  const double torque = 0.003, h = 6e-3;
  const std::vector<Profile> profiles = {profile(
      "stress_pr", [&](double r) { return torque / (2.0 * std::numbers::pi * r * r * h); })};
  RunSeries series;
  series["wheel_torque"] = Numbers(50, torque);
  const auto checks = couetteChecks(cell(), profiles, series);
  ASSERT_EQ(checks.size(), 1u);
  for (std::size_t ring = 0; ring < 6; ++ring) {
    EXPECT_NEAR(*checks[0].value[ring], torque, 1e-15);
    EXPECT_NEAR(*checks[0].reference[ring], torque, 1e-15);
  }
}

TEST(CouetteSummary, WallPressure_IsComparedWithStressAlongBranches) {
  // P = 100; R_o/r_m = 75/71.25 adds 5.26, the hoop stress takes 3.26: 102. Along branches there
  // are 101, which leaves −1; slicing shows 106.
  RunSeries series;
  series["outer_pressure"] = Numbers(50, 100.0);
  const std::vector<Profile> profiles = {profile("stress_rr", [](double) { return 106.0; })};
  const double hoop = 100.0 * 75.0 / 71.25 - 102.0;
  const std::vector<WallBalance> wall(50, {101.0, hoop});
  const auto checks = couetteChecks(cell(), profiles, series, wall);
  ASSERT_EQ(checks.size(), 1u);
  EXPECT_EQ(checks[0].name, "wall_pressure");
  EXPECT_NEAR(*checks[0].value[0], 101.0, 1e-12);
  EXPECT_NEAR(*checks[0].reference[0], 102.0, 1e-12);
  EXPECT_TRUE(checks[0].note->starts_with(
      "The averaged σ_rr of that ring (slicing) is +6.0 % off P: +5.3 % as its mean radius is "
      "smaller than R_o, -3.3 % by the hoop stress in it, +5.0 % as "))
      << *checks[0].note;
  EXPECT_NE(checks[0].note->find("-1.0 % left"), std::string::npos);
  // Without contacts nothing is known of branches, and nothing is checked.
  EXPECT_TRUE(couetteChecks(cell(), profiles, series).empty());
  // No pressure at all: the check stands, and there is no share of it to tell.
  series["outer_pressure"] = Numbers(50, 0.0);
  const auto none = couetteChecks(cell(), profiles, series, std::vector<WallBalance>(50));
  EXPECT_FALSE(none[0].note);
}

TEST(CouetteSummary, ExactPowerLaw_HasItsExponent) {
  const std::vector<Profile> profiles = {
      profile("stress_rp", [](double r) { return 1e-2 / (r * r); })};
  const auto fits = couetteFits(cell(), profiles);
  ASSERT_EQ(fits[0].name, "stress_rp_exponent");
  EXPECT_NEAR(*fits[0].value, -2.0, 1e-6);
  EXPECT_EQ(fits[0].expected, -2.0);
}

TEST(CouetteSummary, HeadNumbers_AreOfTheEnginesOwnStiffness) {
  const std::vector<Profile> profiles = {profile("stress_rr", [](double) { return 200.0; }),
                                         profile("stress_pp", [](double) { return 200.0; }),
                                         profile("stress_rp", [](double) { return 50.0; })};
  RunSeries series;
  for (const char* name : {"mean_overlap", "max_overlap", "sliding_fraction", "coordination"})
    series[name] = Numbers{1e-5, 3e-5};
  EffectiveParameters effective;
  effective.dt = 1e-5;
  effective.pairs.push_back({"pair", 1000.0, 0, 0, 0, 0, 0, 0});
  std::map<std::string, std::optional<double>> head;
  for (const HeadNumber& row : headNumbers(cell(), profiles, series, effective))
    head[row.name] = row.value;
  EXPECT_DOUBLE_EQ(head["kn_over_p"].value(), 1000.0 / (200.0 * 6e-3));
  EXPECT_DOUBLE_EQ(head["stress_ratio_wheel"].value(), 0.25);
  EXPECT_DOUBLE_EQ(head["max_overlap_over_d"].value(), 3e-5 / 7.4e-3);
  effective.pairs[0].kn = 0.0;  // an engine without springs has no such number
  for (const HeadNumber& row : headNumbers(cell(), profiles, series, effective))
    head[row.name] = row.value;
  EXPECT_FALSE(head["kn_over_p"]);
}

TEST(VelocityNotes, MirrorThatDiffersAlike_ExplainsTheDifference) {
  CompareResults results;
  results.averaging.method = "slicing";
  results.engines.resize(3);
  results.engines[0].name = "ours";
  results.engines[1].name = results.engines[2].mirrors = "peer";
  results.engines[2].name = "mirror";
  for (const int packing : {0, 1, 2, 3}) {
    const double scatter = 1e-4 * packing;
    for (const auto& [engine, velocity] : {std::pair("ours", 1.0 + scatter),
                                           {"peer", 1.4 - scatter},
                                           {"mirror", 1.39 + 2.0 * scatter}})
      results.runs.push_back(test::flowRun(
          engine, packing, {test::sliced("azimuthal_velocity", Numbers(3, velocity))}));
  }
  auto notes = velocityNotes(results);
  ASSERT_EQ(notes.size(), 1u);
  test::expectSays(notes[0], {"the model makes the difference", "in rings 1 to 3"});
  results.region.emplace();
  EXPECT_NE(velocityNotes(results)[0].find("in bins 1 to 3"), std::string::npos);
  results.region.reset();

  for (FlowRun& run : results.runs)
    if (run.engine == "mirror")
      run.profiles[0].mean = Numbers(3, 1.0);  // the mirror stays with the reference
  notes = velocityNotes(results);
  EXPECT_NE(notes[0].find("is not what makes the difference"), std::string::npos);

  std::erase_if(results.runs, [](const FlowRun& run) { return run.packing > 0; });
  EXPECT_TRUE(velocityNotes(results).empty());  // one packing has no interval
}

TEST(ContactNotes, PairsListedWithoutForce_AreReportedWhereTheyChangeTheCoordination) {
  const auto contacts = [](const char* engine, const Numbers& coordination, const Numbers& listed) {
    FlowRun run = test::flowRun(engine, 0);
    run.series = RunSeries{{"coordination", coordination}, {"pairs_listed", listed}};
    return run;
  };
  CompareResults study;
  for (const char* name : {"blind", "soft", "rigid"}) study.engines.emplace_back().name = name;
  study.runs = {contacts("blind", {std::nullopt}, {std::nullopt})};
  EXPECT_TRUE(contactNotes(study).empty());
  study.runs.push_back(contacts("soft", {2.0, 4.0}, {2.0, 4.0}));
  study.runs.push_back(contacts("rigid", {1.0, {}}, {2.5, {}}));
  study.runs.push_back(contacts("rigid", {2.0}, {3.5}));
  const auto notes = contactNotes(study);
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_TRUE(notes[0].ends_with("would be: rigid 3 instead of 1.5; no other for soft."))
      << notes[0];
}

}  // namespace

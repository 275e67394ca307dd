#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "reports/effects/report.hpp"
#include "reports/effects/variants.hpp"
#include "tests/reports/report_text.hpp"
#include "tests/reports/sample_results.hpp"

namespace crossgrain::reports {
namespace {

std::string lineOf(const std::string& table, std::size_t line) {
  std::size_t begin = 0;
  for (; line > 0; --line) begin = table.find('\n', begin) + 1;
  return table.substr(begin, table.find('\n', begin) - begin);
}

TEST(EffectsCsv, BeginsWithTheContractsColumns) {
  EXPECT_EQ(lineOf(csvOf(reportOf(sample::effectsResults(4)), "effects.csv"), 0),
            "engine,effect,time_ratio,field,ring,change,stderr,r_tilde,reference,unit,resolved,"
            "p_adjusted,smallest_resolvable,family_level,packings,stderr_kind,time_ratio_stderr,"
            "step_s,contacts_per_step,precision,status,reason");
}

TEST(EffectsCsv, HasARowPerRingOfEachFieldWithoutEachEffect) {
  const std::string table = csvOf(reportOf(sample::effectsResults(4)), "effects.csv");
  EXPECT_EQ(std::ranges::count(table, '\n'), 1 + 2 * 2 * 3 + 1);
  EXPECT_EQ(lineOf(table, 2),
            "grain,friction,0.5,azimuthal_velocity,2,-0.004,0.0002,1.5,0.01,m/s,yes,1e-05,0.001,"
            "0.05,4,packings,0.01,2.5e-06,45,double,ran,");
}

TEST(EffectsCsv, WhatWasRefusedIsOneRowWithItsReason) {
  const std::string last = lineOf(csvOf(reportOf(sample::effectsResults(4)), "effects.csv"), 13);
  EXPECT_TRUE(last.starts_with("grain,tension_cut,,,,,,,,,,,,,,,,,,,refused,\"odd")) << last;
}

TEST(EffectsCsv, WhatIsNotTestedIsEmpty) {
  EXPECT_EQ(lineOf(csvOf(reportOf(sample::effectsResults(1)), "effects.csv"), 2),
            "grain,friction,0.5,azimuthal_velocity,2,-0.004,0.0002,1.5,0.01,m/s,,,,,1,within_run,"
            "0.01,2.5e-06,45,double,ran,");
}

TEST(EffectVariants, HaveTheDecisiveRingAsAShareOfTheProfilesLargestValue) {
  const auto variants = variantSummaries(sample::effectsResults(4));
  ASSERT_EQ(variants.size(), 3u);
  const FieldChange& velocity = *variants[0].of("azimuthal_velocity");
  EXPECT_EQ(velocity.ring, 1u);
  EXPECT_NEAR(velocity.change, -0.2, 1e-12);  // −0.004 of 0.02
  EXPECT_NEAR(*velocity.error, 0.01, 1e-12);
  EXPECT_NEAR(*velocity.inErrors, 20.0, 1e-9);
  EXPECT_EQ(velocity.detected, true);
  EXPECT_EQ(variants[0].of("volume_fraction")->detected, false);
  EXPECT_NEAR(*variants[0].saved, 0.5, 1e-12);
  EXPECT_FALSE(variants[2].ran());
}

TEST(EffectVariants, AreRunsOfTheirOwn) {
  const EffectsResults results = sample::effectsResults(4);
  EXPECT_EQ(engineRuns(results, results.ensemble).front().runs.size(), 4u);  // with everything on
  const auto variants = variantRuns(results, "grain");
  ASSERT_EQ(variants.size(), 4u);
  EXPECT_EQ(variants[1].name, "without friction");
  EXPECT_EQ(variants[1].finished.size(), 4u);
  EXPECT_EQ(variants[1].ensemble->without, "friction");
  EXPECT_EQ(variants[3].name, "tension cut off");
  EXPECT_TRUE(variants[3].runs.empty());
}

TEST(EffectFigures, MarkSignificantChangesByShapeToo) {
  const auto figures = effectFigures(sample::effectsResults(4));
  ASSERT_EQ(figures.front().name, "effects_1_cost");
  const Panel& cost = figures.front().panels[0];
  EXPECT_EQ(cost.rows, (std::vector<std::string>{"friction", "bottom friction"}));
  EXPECT_NEAR(cost.curves[0].points[0].x, 50.0, 1e-9);
  EXPECT_NEAR(cost.curves[0].points[1].x, 0.5, 1e-9);
  const Panel& velocity = figures.front().panels[1];
  ASSERT_EQ(velocity.curves.size(), 2u);
  EXPECT_EQ(velocity.curves[0].style.pointType, 8);   // up, open: bottom friction
  EXPECT_EQ(velocity.curves[1].style.pointType, 11);  // down, filled: friction
  EXPECT_NEAR(velocity.curves[1].points[0].x, 20.0, 1e-9);
  EXPECT_EQ(velocity.curves[1].points[0].y, 0.0);
}

TEST(EffectFigures, ProfilesNameWhatChangesThem) {
  for (const Figure& figure : effectFigures(sample::effectsResults(4))) {
    if (figure.name != "effects_1_profile_azimuthal_velocity") continue;
    std::vector<std::string> names;
    for (const Curve& curve : figure.panels[0].curves) names.push_back(curve.name);
    EXPECT_EQ(names, (std::vector<std::string>{"", "everything on", "without friction"}));
    return;
  }
  FAIL() << "no profile of the velocity";
}

/// "−68.9 ± 7.3 %, beyond the margin" beside a change that is not significant was one such cell.
TEST(EffectsReport, NotSignificant_HasAnIntervalThatContainsZero) {
  EffectsResults results = sample::effectsResults(4);
  RingChange& ring = results.variants[2].changes.fields[0].rings[0];  // bottom friction
  ring.change = -0.01378;                                             // of 0.02
  ring.standardError = 0.00146;                                       // 9 standard errors
  ring.low = -0.0290;
  ring.high = 0.0014;
  ring.smallest = 0.0152;
  const auto text = [&] { return textOf(reportOf(results)); };
  EXPECT_TRUE(has(text(), "○ −69 % (−145 to +7 %) // ring 1; seen from 76 %; margin: undecided"))
      << text();
  EXPECT_FALSE(has(text(), "beyond the margin"));
  // Beyond it only where that is shown, and in which ring.
  ChangedField& velocity = results.variants[1].changes.fields[0];
  velocity.verdict = Verdict::fail;
  EXPECT_TRUE(has(text(), "shown beyond the margin in another ring"));
  velocity.rings[1].verdict = Verdict::fail;
  EXPECT_TRUE(has(text(), "ring 2; shown beyond the margin"));
}

TEST(EffectsReport, FewPackings_NothingIsTested) {
  const std::string text = textOf(reportOf(sample::effectsResults(1)));
  EXPECT_TRUE(has(text, "Fewer than 4 packings"));
  EXPECT_FALSE(has(text, "○ −"));  // not significant is one thing, no test another
  EXPECT_TRUE(has(text, "too few packings"));
  EXPECT_TRUE(has(text, "(one standard error)"));
  EXPECT_TRUE(has(text, "within the two runs of one packing"));
}

TEST(EffectsReport, SeveralEngines_HaveASectionEach) {
  EffectsResults results = sample::effectsResults(4);
  results.engines.push_back(results.engines[0]);
  results.engines[1].name = "other";
  const auto ofTheOther = [](auto& rows) {
    for (std::size_t k = 0, all = rows.size(); k < all; ++k) {
      rows.push_back(rows[k]);
      rows.back().engine = "other";
    }
  };
  ofTheOther(results.variants);
  ofTheOther(results.runs);
  ofTheOther(results.ensemble);
  const std::string text = textOf(reportOf(results));
  EXPECT_TRUE(has(text, "## What each effect costs and changes: other (effects-2)"));
  EXPECT_TRUE(has(text, "[effects_2_cost]"));
}

}  // namespace
}  // namespace crossgrain::reports

// Parts of reports of effects, scaling and hard cases that their kept texts do not cover.
#include <gtest/gtest.h>

#include <algorithm>

#include "reports/effects/report.hpp"
#include "reports/flow/report.hpp"
#include "reports/stability/report.hpp"
#include "tests/reports/report_text.hpp"
#include "tests/reports/sample_results.hpp"
#include "tests/support/refusal.hpp"

namespace crossgrain::reports {
namespace {

std::string lineOf(const std::string& table, std::size_t line) {
  std::size_t begin = 0;
  for (; line > 0; --line) begin = table.find('\n', begin) + 1;
  return table.substr(begin, table.find('\n', begin) - begin);
}

TEST(EffectsCsv, NotTested_IsEmpty) {
  EXPECT_EQ(lineOf(csvOf(reportOf(sample::effectsResults(1)), "effects.csv"), 2),
            "grain,friction,0.5,azimuthal_velocity,2,-0.004,0.0002,1.5,0.01,m/s,,,,,1,within_run,"
            "0.01,2.5e-06,45,double,ran,");
}

TEST(EffectVariants, DecisiveRing_IsAShareOfTheProfilesLargestValue) {
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

TEST(EffectFigures, SignificantChange_HasAShapeOfItsOwn) {
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
  EXPECT_TRUE(has(text(), "shown beyond the margin elsewhere"));
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

TEST(EffectsReport, OneStart_SpeaksOfNoPackingsAndNoErrors) {
  EffectsResults results = sample::effectsResults(2);
  results.packings[1].hash = results.packings[0].hash;
  const Report report = reportOf(results);
  const std::string text = textOf(report);
  EXPECT_TRUE(has(text, "The scene has one start")) << text;
  EXPECT_TRUE(has(text, "One start, run 2 times"));
  for (const char* const ofMany :
       {"ewer than 4 packings", "oo few packings", "standard error)", "at least 4 packings; with"})
    EXPECT_FALSE(has(text, ofMany)) << ofMany;
  for (const std::string& sentence : report.overview.conclusion)
    EXPECT_FALSE(has(sentence, "packing")) << sentence;
}

TEST(StabilityOverview, DegradedCase_StandsInTheHead) {
  StabilityResults results = sample::stabilityResults();
  const auto conclusion = reportOf(results).overview.conclusion;
  ASSERT_GE(conclusion.size(), 2u);
  EXPECT_TRUE(has(conclusion[1], "Degraded: grain in ")) << conclusion[1];
  for (StabilityRun& run : results.runs)
    if (run.verdict == Verdict::borderline) run.verdict = Verdict::pass;
  EXPECT_FALSE(has(reportOf(results).overview.conclusion[1], "Degraded"));
}

TEST(StabilityPictures, SceneFarAway_IsCentred) {
  const auto pictures = stabilityPictures(sample::stabilityResults());
  ASSERT_EQ(pictures.size(), 1u);
  EXPECT_LT(pictures[0].drawing.window.larger(), 10.0);
  // The plane at y = −1 is a line through the window.
  const auto isLine = [](const StrokeGroup& group) {
    return !group.strokes.empty() && group.strokes[0].x1 != group.strokes[0].x2;
  };
  const auto lines = std::ranges::find_if(pictures[0].drawing.groups, isLine);
  ASSERT_NE(lines, pictures[0].drawing.groups.end());
  const Stroke& line = lines->strokes.front();
  EXPECT_NEAR(line.y1, -1.0, 1e-12);
  EXPECT_NEAR(line.y2, -1.0, 1e-12);
}

/// Engines and a case with two transformations, after which all runs are the same.
StabilityResults transforms(const std::vector<const char*>& engines) {
  StabilityResults results;
  for (const char* engine : engines)
    results.engines.push_back({engine, "", "", "", Status::finished, ""});
  for (const auto& [measure, variant] :
       {std::pair("turned", "turned by 1 rad"), std::pair("renumbered", "renumbered")}) {
    HardCase one{.name = "cell", .variant = variant, .measure = measure};
    results.cases.push_back(one);
    for (const EngineRow& engine : results.engines) {
      StabilityRun run;
      run.engine = engine.name;
      run.name = "cell";
      run.variant = variant;
      run.measure = measure;
      run.verdict = Verdict::pass;
      results.runs.push_back(run);
    }
  }
  return results;
}

/// A case that nothing ran is not among those that are stable somewhere.
TEST(StabilityReport, Cases_StandByWhatBecameOfThem) {
  StabilityResults results = sample::stabilityResults();
  const auto titles = [&] {
    std::vector<std::string> found;
    for (const Section& section : reportOf(results).sections) found.push_back(section.title);
    return found;
  };
  const auto has = [](const std::vector<std::string>& all, const char* title) {
    return std::ranges::find(all, title) != all.end();
  };
  EXPECT_TRUE(has(titles(), "pile: unstable: odd-one; degraded: grain"));
  EXPECT_TRUE(has(titles(), "Stable where it was run: 1 case"));
  for (StabilityRun& run : results.runs)
    if (run.name == "gas") run.verdict = Verdict::notApplicable;
  EXPECT_TRUE(has(titles(), "Refused by every engine: 1 case"));
  EXPECT_FALSE(has(titles(), "Stable where it was run: 1 case"));
  for (StabilityRun& run : results.runs)
    if (run.name == "gas") run.verdict = Verdict::pass;
  EXPECT_TRUE(has(titles(), "✓ stable on every engine: 1 case"));
}

TEST(StabilityOverview, OfTransforms_NamesWhatDiffers) {
  StabilityResults results = transforms({"mine", "theirs"});
  EXPECT_EQ(reportOf(results).overview.conclusion[0], "mine and theirs: both runs the same.");
  results.runs[1].verdict = Verdict::fail;
  const Overview overview = reportOf(results).overview;
  ASSERT_EQ(overview.columns.size(), 2u);
  EXPECT_EQ(shown(rowNamed(overview, "theirs").cells[0]), "bad 0 of 1");
  EXPECT_EQ(shown(rowNamed(overview, "theirs").cells[1]), "good 1 of 1");
  EXPECT_EQ(overview.conclusion[1],
            "Different after a transformation: theirs with cell turned by 1 rad.");
}

TEST(StabilityReport, WhatWasNotRun_IsNotAmongThePassed) {
  StabilityResults results = transforms({"slow"});
  results.runs[1].status = Status::notRun;
  results.runs[1].verdict = Verdict::notMeasured;
  results.runs[1].reason = "its part of the budget, 1 s, leaves no time for it";
  const Report report = reportOf(results);
  const Overview& overview = report.overview;
  EXPECT_EQ(overview.rows[0].cells[0].verdict, Verdict::pass);
  EXPECT_EQ(overview.rows[0].cells[1].verdict, Verdict::notMeasured);
  ASSERT_EQ(overview.conclusion.size(), 2u);
  EXPECT_EQ(overview.conclusion[0], "slow: 1 of 2 runs the same, 1 not run.");
  EXPECT_EQ(overview.conclusion[1],
            "Next: the same command with a larger --budget, for what was not run.");
  EXPECT_NE(csvOf(report, "stability.csv").find("slow,cell,not_run,renumbered,,"),
            std::string::npos);
  test::expectSays(junitOf(report), {"<skipped message=\"its part of the budget, 1 s"});
  const std::string text = textOf(report);
  EXPECT_TRUE(has(text, "– not run"));
}

TEST(RevReport, NearnessToSlicing_DecidesTheMatrix) {
  RevResults results = sample::revResults();
  // 0.1/0.7 apart in the narrowest ring, the same from 1 d on.
  results.curves[1].mean[0] = 0.8;
  const Overview overview = reportOf(results).overview;
  ASSERT_EQ(overview.rows.size(), 1u);
  EXPECT_EQ(overview.rows[0].name, "volume fraction");
  EXPECT_EQ(overview.rows[0].cells[1].shown, "≥ 1 d");
  EXPECT_EQ(overview.rows[0].cells[0].verdict, Verdict::notMeasured);
  EXPECT_EQ(overview.conclusion[1], "Within 5 % of slicing in every field: centre from 1 d.");
  results.curves[1].mean[2] = 0.9;
  EXPECT_EQ(reportOf(results).overview.rows[0].cells[1].verdict, Verdict::borderline);
}

}  // namespace
}  // namespace crossgrain::reports

#include <gtest/gtest.h>

#include <algorithm>

#include "reports/stability/report.hpp"
#include "tests/reports/report_text.hpp"
#include "tests/reports/sample_results.hpp"

namespace crossgrain::reports {
namespace {

TEST(StabilityCsv, IsTheContract) {
  const std::string table = csvOf(reportOf(sample::stabilityResults()), "stability.csv");
  EXPECT_TRUE(table.starts_with(
      "engine,case,verdict,measure,value,limit,unit,step,reason,degraded_limit,variant,time_s\n"
      "grain,pile,stable,energy_gain,0.001,0.01,of the energy,,,0.1,slow,\n"));
  EXPECT_NE(table.find("odd-one,pile,unstable,energy_gain,0.5,0.01,of the energy,120,,0.1,fast,"
                       "0.12\n"),
            std::string::npos);
  EXPECT_NE(table.find("odd-one,gas,refused,energy_gain,,0.01,of the energy,,\"odd"),
            std::string::npos);
}

TEST(StabilityTable, TheWorstVariantSpeaksForTheCase) {
  const StabilityResults results = sample::stabilityResults();
  const auto groups = hardGroups(results);
  ASSERT_EQ(groups.size(), 2u);
  EXPECT_EQ(worstRun(results, "grain", groups[0])->verdict, Verdict::borderline);
  EXPECT_EQ(worstRun(results, "odd-one", groups[0])->variant, "fast");
  EXPECT_EQ(worstRun(results, "odd-one", groups[1])->verdict, Verdict::notApplicable);
}

TEST(StabilityFigures, AMapAndWhatWentWrongOverTime) {
  const auto figures = stabilityFigures(sample::stabilityResults());
  ASSERT_EQ(figures.size(), 2u);
  const Panel& map = figures[0].panels[0];
  EXPECT_EQ(map.rows, (std::vector<std::string>{"pile", "gas"}));
  std::size_t tiles = 0;
  for (const Curve& curve : map.curves) tiles += curve.points.size();
  EXPECT_EQ(tiles, 4u);
  EXPECT_EQ(figures[1].name, "stability_1");
}

TEST(StabilityPictures, AreCentredWhereverTheSceneIs) {
  const auto pictures = stabilityPictures(sample::stabilityResults());
  ASSERT_EQ(pictures.size(), 1u);
  EXPECT_LT(pictures[0].drawing.halfWidth, 10.0);
  // The plane at y = −1 is a line through the window.
  const Stroke& line = pictures[0].drawing.groups.back().strokes.front();
  EXPECT_NEAR(line.y1, -1.0, 1e-12);
  EXPECT_NEAR(line.y2, -1.0, 1e-12);
}

/// One engine and a case with two transformations: one gave the same, one was not run.
StabilityResults transformsInTime() {
  StabilityResults results;
  EngineRow engine;
  engine.name = "slow";
  results.engines = {engine};
  for (const char* variant : {"mirrored", "renumbered"}) {
    HardCase one;
    one.name = "cell";
    one.variant = one.measure = variant;
    results.cases.push_back(one);
    StabilityRun run;
    run.engine = "slow";
    run.name = "cell";
    run.variant = run.measure = variant;
    results.runs.push_back(run);
  }
  results.runs[0].verdict = Verdict::pass;
  results.runs[0].value = 0.0;
  results.runs[1].status = Status::notRun;
  results.runs[1].verdict = Verdict::notMeasured;
  results.runs[1].reason = "its part of the budget, 1 s, leaves no time for it";
  return results;
}

TEST(StabilityReport, WhatWasNotRun_IsNotAmongThePassed) {
  const StabilityResults results = transformsInTime();
  const Report report = reportOf(results);
  const Overview& overview = report.overview;
  EXPECT_EQ(overview.rows[0].cells[0].state, CellState::good);
  EXPECT_EQ(overview.rows[0].cells[1].state, CellState::notMeasured);
  ASSERT_EQ(overview.conclusion.size(), 2u);
  EXPECT_EQ(overview.conclusion[0], "slow: 1 of 2 runs the same, 1 not run.");
  EXPECT_EQ(overview.conclusion[1],
            "Next: the same command with a larger --budget, for what was not run.");
  EXPECT_NE(csvOf(report, "stability.csv").find("slow,cell,not_run,renumbered,,"),
            std::string::npos);
  EXPECT_NE(junitOf(report).find("<skipped message=\"its part of the budget, 1 s"),
            std::string::npos);
  const std::string text = textOf(report);
  EXPECT_TRUE(has(text, "– not run"));
}

}  // namespace
}  // namespace crossgrain::reports

// Scaling as a table, as CSV and as a page.
#include "reports/scale/report.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "tests/reports/has.hpp"
#include "tests/reports/sample_results.hpp"

namespace crossgrain::reports {
namespace {

std::vector<std::string> textLines(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

TEST(ScaleText, IsAlignedAndWhatIsAbsentIsADash) {
  const auto lines = textLines(scaleText(sample::scaleResults()));
  ASSERT_EQ(lines.size(), 1u + 9u + 2u);  // head, points, who differs, the one that failed
  EXPECT_EQ(lines[1],
            "grain       1000     1 thread  16.0 µs     16.0     5 %       –     –     1.00      "
            "20\u202f300");
  EXPECT_EQ(lines[2],
            "grain       1000    2 threads  10.0 µs     10.0     5 %    0.80     –    0.625      "
            "20\u202f300");
  EXPECT_EQ(
      lines[3],
      "odd-one     1000  one process   160 µs      160       –       –     –     10.0           "
      "–");
  EXPECT_TRUE(has(lines[9], "–  "));
  EXPECT_EQ(lines[10], "odd-one: deviations from the scene: bottom_friction and slop");
  EXPECT_TRUE(lines[11].starts_with("odd-one, 100\u202f000 disks, one process: failed: odd <b>"));
}

TEST(ScaleCsv, IsTheContract) {
  const auto lines = textLines(csvOf(reportOf(sample::scaleResults()), "scale.csv"));
  ASSERT_EQ(lines.size(), 10u);
  EXPECT_EQ(lines[0],
            "engine,disks,workers,workers_are,status,step_s,spread,ns_per_disk,strong,weak,ratio,"
            "memory_bytes,bytes_per_disk,contacts_per_step,steps,repetitions,dt_s,precision,"
            "measured,differs,reason");
  EXPECT_TRUE(lines[9].starts_with("odd-one,100000,1,,failed,,,,,,,,,,100,0,,,,,\"odd"));
}

TEST(ScaleOverview, TellsTheLargestCellThatEachRan) {
  const Overview overview = scaleOverview(sample::scaleResults());
  ASSERT_EQ(overview.rows.size(), 2u);
  const OverviewCell& perDisk = overview.rows[0].cells[0];
  EXPECT_EQ(perDisk.words, "100\u202f000 disks, 2 threads");
  EXPECT_NEAR(*perDisk.value, 16.0 * 1.21 / 1.6, 1e-9);
  EXPECT_EQ(overview.rows[1].cells[0].words, "10\u202f000 disks, one process");
  EXPECT_EQ(overview.rows[1].cells[1].verdict, Verdict::notApplicable);  // it has one process
  EXPECT_EQ(overview.rows[1].cells[3].verdict, Verdict::fail);
  EXPECT_TRUE(has(overview.conclusion.at(0), "2 threads)"));
  EXPECT_TRUE(has(overview.conclusion.at(0), "one process; deviations: bottom_friction and slop)"));
  EXPECT_TRUE(has(overview.conclusion.at(1), "odd-one ends at 100\u202f000 disks"));
}

TEST(ScaleFigures, HavePointsForWhatRan) {
  const auto figures = reportOf(sample::scaleResults()).figures;
  ASSERT_EQ(figures.size(), 3u);
  const auto& curves = figures[0].panels[0].curves;
  ASSERT_EQ(curves.size(), 3u);
  EXPECT_EQ(curves[2].name, "odd-one, one process");
  EXPECT_EQ(curves[2].points.size(), 2u);
  EXPECT_NE(curves[0].style.pointType, curves[1].style.pointType);
}

}  // namespace
}  // namespace crossgrain::reports

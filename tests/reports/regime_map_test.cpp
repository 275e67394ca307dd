// States over volume fractions and rotations, and what carries the stress.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "reports/thesis/drawing.hpp"
#include "reports/thesis/report.hpp"
#include "tests/reports/report_text.hpp"
#include "tests/reports/sample_results.hpp"

namespace crossgrain::reports {
namespace {

ThesisCase caseAt(double label, double omega = 0.1) {
  ThesisCase setup;
  setup.name = fmt::format("nu-{:.3f}-{}", label, omega);
  setup.families = {"packings"};
  setup.label = label;
  setup.kn = 352.1;
  setup.mu = 0.44;
  setup.cell.small = static_cast<std::size_t>(std::lround(1e4 * label));
  setup.cell.wallSpacing = 0.0025;
  setup.cell.smallRadius = 0.0037;
  setup.cell.omega = omega;
  return setup;
}

/// @param until  the rotation up to which the wheel has ten contacts, of so many
void addRun(ThesisResults& results, const ThesisCase& setup, int packing, int until,
            int rotations) {
  ThesisRun& run = results.runs.emplace_back();
  run.setup = setup.name;
  run.engine = "engine";
  run.packing = packing;
  for (int k = 0; k < rotations; ++k) {
    ThesisSpan& span = run.history.emplace_back();
    span.from = k;
    span.to = k + 1;
    span.wheelContacts = k < until ? 10.0 : 0.5;
    span.outerPressure = k < until ? 100.0 : 1.0;
  }
}

/// Two packings of each of four ν̄; after five rotations one of those at 0.796 carries no more.
ThesisResults fourDensities() {
  ThesisResults results;
  for (const double label : {0.789, 0.793, 0.796, 0.800}) results.cases.push_back(caseAt(label));
  const std::vector<int> untils[] = {{1, 2}, {3, 4}, {4, 99}, {99, 99}};
  for (std::size_t k = 0; k < 4; ++k)
    for (int packing = 0; packing < 2; ++packing)
      addRun(results, results.cases[k], packing, untils[k][static_cast<std::size_t>(packing)], 8);
  return results;
}

/// The rows of a table that begin so.
std::vector<std::string> rowsOf(const std::string& csv, const std::string& start) {
  std::vector<std::string> rows;
  std::istringstream lines(csv);
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with(start)) rows.push_back(line.substr(start.size()));
  return rows;
}

const std::string ofDefault = "engine,\"default, Ω = 0.1 /s\",";

TEST(RegimeMap, CriticalDensity_FollowsFromThePackingsThatCarry) {
  const auto rows = rowsOf(regimeMapCsv(fourDensities()), ofDefault + ",");
  ASSERT_EQ(4u, rows.size());                       // 1, 2, 5, 8: nothing was followed to 10
  EXPECT_TRUE(rows[0].starts_with("1,8,8,,,,,,"));  // all carry: none follows
  EXPECT_TRUE(rows[1].starts_with("2,8,7,"));
  EXPECT_TRUE(rows[2].starts_with("5,8,3,,,,,0.796")) << rows[2];
}

TEST(RegimeMap, OtherInterpretationRateOrLaw_IsNotMixed) {
  ThesisResults results = fourDensities();
  ThesisCase wide = caseAt(0.800);
  wide.name = "wide";
  wide.cell.wallSpacing = 0.007;
  ThesisCase soft = caseAt(0.800);
  soft.name = "soft";
  soft.kn = 100.0;
  const ThesisCase fast = caseAt(0.800, 1.0);
  for (const ThesisCase& setup : {wide, soft, fast}) {
    results.cases.push_back(setup);
    addRun(results, setup, 0, 99, 8);
  }
  const std::string csv = regimeMapCsv(results);
  EXPECT_EQ(4u, rowsOf(csv, "engine,\"wall spacing 7 mm, Ω = 0.1 /s\",,").size());
  EXPECT_EQ(4u, rowsOf(csv, "engine,\"default, Ω = 1 /s\",,").size());
  EXPECT_EQ(rowsOf(csv, ofDefault), rowsOf(regimeMapCsv(fourDensities()), ofDefault));
}

TEST(RegimeMap, SeveralRunsOfAPacking_TheLongestStandsForIt) {
  ThesisResults results = fourDensities();
  ThesisCase longer = caseAt(0.800);
  longer.name = "time";
  longer.families = {"time"};
  results.cases.push_back(longer);
  addRun(results, longer, 1, 12, 20);
  const auto rows = rowsOf(regimeMapCsv(results), ofDefault + ",");
  ASSERT_EQ(6u, rows.size());
  EXPECT_TRUE(rows[0].starts_with("1,8,8,"));
  EXPECT_TRUE(rows[5].starts_with("20,1,0,"));
}

TEST(RegimeMap, Captions_SayWhereTheWheelHasContacts) {
  const auto figures = mapFigures(fourDensities());
  const auto contacts = std::ranges::find(figures, "map_contacts", &Figure::name);
  EXPECT_TRUE(has(contacts->caption,
                  "after 8 rotations: fewer than one contact at ν̄ = 0.789 … 0.793, one or more at "
                  "ν̄ = 0.796 … 0.800"));
  const auto critical = std::ranges::find(figures, "map_critical", &Figure::name);
  EXPECT_TRUE(
      has(critical->caption, "packings that carry 8 of 8 (1), 7 of 8 (2), 3 of 8 (5), 3 of 8 (8)"));
  EXPECT_TRUE(has(critical->caption, "(5), 0.7962")) << critical->caption;
}

TEST(RegimeMap, States_AreFollowedOverRotations) {
  const auto figures = mapFigures(fourDensities());
  const auto time = std::ranges::find(figures, "map_time", &Figure::name);
  ASSERT_NE(figures.end(), time);
  ASSERT_EQ(2u, time->panels.size());  // these runs have no ν at the wheel
  const Curve& curve = time->panels[1].curves.at(2);
  EXPECT_EQ("0.796", curve.name);
  ASSERT_EQ(8u, curve.points.size());
  EXPECT_EQ(0.5, curve.points[0].x);
  EXPECT_NEAR(10.0, curve.points[3].y, 1e-12);
  EXPECT_NEAR(5.25, curve.points[4].y, 1e-12);  // one of two packings carries
  EXPECT_TRUE(
      has(time->caption, "at ν̄ = 0.789 100 → 1.00 (up to 8), ν̄ = 0.800 100 → 100 (up to 8)"))
      << time->caption;
  ThesisResults brief;  // nothing was followed for two rotations
  brief.cases = {caseAt(0.796)};
  addRun(brief, brief.cases[0], 0, 1, 1);
  const auto none = mapFigures(brief);
  EXPECT_TRUE(std::ranges::find(none, "map_time", &Figure::name)->panels.empty());
}

/// I = γ̇ d √(ρ/p): of the sample at 0.804 in the first ring.
TEST(RegimeMap, Rings_AreDrawnAgainstTheInertialNumber) {
  ThesisResults results = sample::thesisResults();
  std::erase_if(results.runs, [](const ThesisRun& run) {
    return run.setup != "nu-0.804" || run.engine != "alpha" || run.packing != 0;
  });
  const Figure figure = collapseFigure(results);
  ASSERT_EQ(4u, figure.panels.size());
  const double x = 0.5 * 0.1492 / 20.0 / 0.0074, nu = 0.804 - 0.2 * std::exp(-x);
  const double rate = 0.5 * std::exp(-x / 1.9), p = 1e3 * 0.024, density = 1000.0 * 0.804;
  const double inertial = rate * 0.0074 * std::sqrt(density / nu / p);
  const Point& first = figure.panels[0].curves.at(0).points.at(0);
  EXPECT_NEAR(inertial, first.x, 1e-12);
  EXPECT_NEAR(250.0 * 0.024 / std::pow(1.0 + x * 0.0074 / 0.1032, 2) / p, first.y, 1e-12);
  const double moving = 5e-4 * std::exp(-x);
  EXPECT_NEAR(moving / (moving + p), figure.panels[1].curves.at(0).points.at(0).y, 1e-15);
  EXPECT_NEAR(352.1 / (p * 0.006), figure.panels[2].curves.at(0).points.at(0).x, 1e-9);
  // On the plane a line of one I holds the points of that I.
  const Point& plane = figure.panels[3].curves.at(0).points.at(0);
  EXPECT_NEAR(plane.x * plane.x * 4.0 / std::numbers::pi / (inertial * inertial), plane.y,
              1e-9 * plane.y);
  EXPECT_TRUE(has(figure.caption, "in no regime that is known (1 run)"));
}

/// The narrowest rings are those that were averaged; two of them have the mean by their rooms.
TEST(RegimeMap, WiderRings_ArePutTogetherOfNarrowOnes) {
  const auto figures = widthOfRingFigures(sample::thesisResults());
  ASSERT_EQ(1u, figures.size());
  const Panel& panel = figures[0].panels.at(0);
  ASSERT_EQ(8u, panel.curves.size());
  const std::vector<Point>& slices = panel.curves[0].points;
  const double width = 0.1492 / 60.0;
  EXPECT_NEAR(width / 0.0074, slices[0].x, 1e-12);
  const auto ring = [&](int k) {
    const double x = (k + 0.5) * width / 0.0074;
    return 1.05 * (0.804 - 0.2 * std::exp(-x));  // two packings, 1 and 1.1
  };
  EXPECT_NEAR(ring(6), slices[0].y, 1e-12);  // 0.12 m
  const double r6 = 0.1032 + 6.5 * width, r5 = 0.1032 + 5.5 * width;
  const double lower = (ring(5) * r5 + ring(6) * r6) / (r5 + r6);
  const double r7 = 0.1032 + 7.5 * width;
  const double upper = (ring(6) * r6 + ring(7) * r7) / (r6 + r7);
  EXPECT_TRUE(std::abs(slices[1].y - lower) < 1e-12 || std::abs(slices[1].y - upper) < 1e-12);
}

}  // namespace
}  // namespace crossgrain::reports

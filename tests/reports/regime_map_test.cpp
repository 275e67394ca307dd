// States over volume fractions and rotations.
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "reports/thesis/report.hpp"
#include "tests/reports/has.hpp"

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

TEST(RegimeMap, AnInterpretationARateAndALawAreNotMixed) {
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

TEST(RegimeMap, TheLongestRunOfAPackingStandsForIt) {
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

TEST(RegimeMap, IsATableToo) {
  const std::string csv = regimeMapCsv(fourDensities());
  EXPECT_TRUE(has(csv,
                  "engine,group,nu,after_rotations,packings,carry,wheel_contacts,"
                  "wheel_contacts_stderr,outer_pressure,outer_pressure_stderr,critical_nu,"
                  "critical_nu_stderr\n"));
  EXPECT_TRUE(has(csv, "engine,\"default, Ω = 0.1 /s\",0.796,5,2,1,5.25,4.75,50.5,49.5,,\n"));
  EXPECT_TRUE(has(csv, "engine,\"default, Ω = 0.1 /s\",,1,8,8,,,,,,\n"));
}

}  // namespace
}  // namespace crossgrain::reports

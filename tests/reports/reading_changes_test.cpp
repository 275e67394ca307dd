// What a reading of the thesis changes: pairs of runs, and nothing where there are none.
#include "reports/thesis/reading_changes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "reports/thesis/report.hpp"
#include "tests/reports/has.hpp"

namespace crossgrain::reports {
namespace {

ThesisLeg cellLeg(const std::string& name, const std::string& family, double label) {
  ThesisLeg leg;
  leg.name = name;
  leg.families = {family};
  leg.label = label;
  leg.kn = 352.1;
  leg.mu = 0.44;
  leg.cell.wallSpacing = 0.0025;
  leg.cell.smallRadius = 0.0037;
  leg.cell.omega = 0.1;
  leg.cell.innerRadius = 0.1;
  leg.cell.outerRadius = 0.26;
  leg.cell.diameter = 0.008;
  leg.settleRotations = 5.0;
  leg.averagedRotations = 3.0;
  return leg;
}

void addRun(ThesisResults& results, const std::string& leg, int packing, double filling,
            double stress) {
  ThesisRun& run = results.runs.emplace_back();
  run.leg = leg;
  run.engine = "engine";
  run.packing = packing;
  const Numbers error(20, 0.01);
  run.run.profiles.push_back(
      {"slicing", "volume_fraction", "", Numbers(20, filling), error, {}, {}});
  run.run.profiles.push_back({"slicing", "stress_rr", "", Numbers(20, stress), error, {}, {}});
}

/// At two ν̄ walls of 7 mm leave 0.02 and 0.05 less at the wheel and a tenth of the stress.
ThesisResults twoReadings() {
  ThesisResults results;
  results.legs = {cellLeg("low", "packings", 0.796),    cellLeg("high", "packings", 0.804),
                  cellLeg("low-7mm", "spacing", 0.796), cellLeg("high-7mm", "spacing", 0.804),
                  cellLeg("soft", "kn", 0.804),         cellLeg("later", "spacing", 0.804)};
  results.legs[2].cell.wallSpacing = results.legs[3].cell.wallSpacing = 0.007;
  results.legs[4].kn = 176.05;
  results.legs[5].cell.wallSpacing = 0.007;
  results.legs[5].settleRotations = 17.0;
  addRun(results, "low", 0, 0.80, 10.0);
  addRun(results, "high", 0, 0.82, 100.0);
  addRun(results, "low-7mm", 0, 0.78, 1.0);
  addRun(results, "high-7mm", 0, 0.77, 10.0);
  addRun(results, "high-7mm", 1, 0.50, 1.0);  // of a packing that the default has not
  addRun(results, "later", 0, 0.50, 1.0);     // of other rotations
  return results;
}

const ReadingChange& changeOf(const ReadingRow& row, const char* key) {
  const auto& numbers = profileNumbers();
  const auto at = std::ranges::find(numbers, std::string_view(key), &ProfileNumber::key);
  return row.changes.at(static_cast<std::size_t>(at - numbers.begin()));
}

TEST(ReadingChanges, AreOfPairsOfTheSameDensityPackingAndRotations) {
  const auto rows = readingRows(twoReadings());
  const auto row = std::ranges::find_if(rows, [](const ReadingRow& each) {
    return each.words == "wall spacing 7 mm" && each.rotations == "5 to 8";
  });
  ASSERT_NE(rows.end(), row);
  EXPECT_EQ(2, row->pairs);
  EXPECT_EQ((std::vector<double>{0.796, 0.804}), row->labels);
  const ReadingChange& filling = changeOf(*row, "filling_wheel");
  EXPECT_NEAR(0.81, filling.standard.value(), 1e-12);
  EXPECT_NEAR(-0.035, filling.change.value(), 1e-12);
  EXPECT_NEAR(0.015, filling.error.value(), 1e-12);  // sd of −0.02 and −0.05 over √2
  EXPECT_NEAR(-1.0, changeOf(*row, "stress_rr_bulk").change.value(), 1e-12);
  EXPECT_FALSE(changeOf(*row, "velocity_wheel").change);
}

TEST(ReadingChanges, AreAbsentWhereRunsAreMissing) {
  const auto rows = readingRows(twoReadings());
  for (const char* words : {"k_n 176.1 N/m", "wall spacing 7 mm"}) {
    const auto row = std::ranges::find_if(rows, [&](const ReadingRow& each) {
      return each.words.starts_with(words) && each.pairs == 0;
    });
    ASSERT_NE(rows.end(), row) << words;  // of 7 mm: the later rotations
    for (const ReadingChange& change : row->changes) {
      EXPECT_FALSE(change.change);
      EXPECT_FALSE(change.error);
    }
  }
}

TEST(ReadingChanges, OnePairHasNoError) {
  const auto rows = readingRows(twoReadings(), true);
  const auto row = std::ranges::find_if(rows, [](const ReadingRow& each) {
    return each.rotations == "5 to 8" && each.labels == std::vector<double>{0.804} &&
           each.family == "spacing";
  });
  ASSERT_NE(rows.end(), row);
  EXPECT_EQ(1, row->pairs);
  EXPECT_NEAR(-0.05, changeOf(*row, "filling_wheel").change.value(), 1e-12);
  EXPECT_FALSE(changeOf(*row, "filling_wheel").error);
}

TEST(ReadingChanges, AreATableAndOnThePage) {
  const ThesisResults results = twoReadings();
  const std::string csv = readingsCsv(results);
  EXPECT_TRUE(
      has(csv, "engine,family,reading,nu,rotations,number,unit,default,change,stderr,pairs\n"));
  EXPECT_TRUE(has(csv, "engine,spacing,wall spacing 7 mm,0.796,5 to 8,\"ν, ring 1\",,0.8,"));
  EXPECT_TRUE(has(csv, "engine,kn,k_n 176"));
  const std::string page = thesisPage(results, {{}, {}, {}});
  EXPECT_TRUE(has(page, "What each reading changes"));
  EXPECT_TRUE(has(page, "<td class=\"n\">2</td><td class=\"n\">−0.035"));
}

}  // namespace
}  // namespace crossgrain::reports

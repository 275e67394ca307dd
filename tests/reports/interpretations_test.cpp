// What an interpretation of the thesis changes: pairs of runs, and nothing where there are none.
#include "reports/thesis/report.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/reports/report_text.hpp"

namespace crossgrain::reports {
namespace {

ThesisCase cellCase(const std::string& name, const std::string& family, double label) {
  ThesisCase setup;
  setup.name = name;
  setup.families = {family};
  setup.label = label;
  setup.kn = 352.1;
  setup.mu = 0.44;
  setup.cell.wallSpacing = 0.0025;
  setup.cell.smallRadius = 0.0037;
  setup.cell.omega = 0.1;
  setup.cell.innerRadius = 0.1;
  setup.cell.outerRadius = 0.26;
  setup.cell.diameter = 0.008;
  setup.settleRotations = 5.0;
  setup.averagedRotations = 3.0;
  return setup;
}

void addRun(ThesisResults& results, const std::string& setup, int packing, double filling,
            double stress) {
  ThesisRun& run = results.runs.emplace_back();
  run.setup = setup;
  run.engine = "engine";
  run.packing = packing;
  const Numbers error(20, 0.01);
  run.run.profiles.push_back(
      {"slicing", "volume_fraction", "", Numbers(20, filling), error, {}, {}});
  run.run.profiles.push_back({"slicing", "stress_rr", "", Numbers(20, stress), error, {}, {}});
}

/// At two ν̄ walls of 7 mm leave 0.02 and 0.05 less at the wheel and a tenth of the stress.
ThesisResults twoInterpretations() {
  ThesisResults results;
  results.cases = {cellCase("low", "packings", 0.796),    cellCase("high", "packings", 0.804),
                   cellCase("low-7mm", "spacing", 0.796), cellCase("high-7mm", "spacing", 0.804),
                   cellCase("soft", "kn", 0.804),         cellCase("later", "spacing", 0.804)};
  results.cases[2].cell.wallSpacing = results.cases[3].cell.wallSpacing = 0.007;
  results.cases[4].kn = 176.05;
  results.cases[5].cell.wallSpacing = 0.007;
  results.cases[5].settleRotations = 17.0;
  addRun(results, "low", 0, 0.80, 10.0);
  addRun(results, "high", 0, 0.82, 100.0);
  addRun(results, "low-7mm", 0, 0.78, 1.0);
  addRun(results, "high-7mm", 0, 0.77, 10.0);
  addRun(results, "high-7mm", 1, 0.50, 1.0);  // of a packing that the default has not
  addRun(results, "later", 0, 0.50, 1.0);     // of other rotations
  return results;
}

const InterpretationChange& changeOf(const InterpretationRow& row, const char* label) {
  const auto at = std::ranges::find(profileNumbers, std::string_view(label), &ProfileNumber::label);
  return row.changes.at(static_cast<std::size_t>(at - std::begin(profileNumbers)));
}

TEST(InterpretationChanges, Pairs_AreOfTheSameDensityPackingAndRotations) {
  const auto rows = interpretationRows(twoInterpretations());
  const auto row = std::ranges::find_if(rows, [](const InterpretationRow& each) {
    return each.label == "wall spacing 7 mm" && each.rotations == "5 to 8";
  });
  ASSERT_NE(rows.end(), row);
  EXPECT_EQ(2, row->pairs);
  EXPECT_EQ((std::vector<double>{0.796, 0.804}), row->labels);
  const InterpretationChange& filling = changeOf(*row, "ν, ring 1");
  EXPECT_NEAR(0.81, filling.standard.value(), 1e-12);
  EXPECT_NEAR(-0.035, filling.change.value(), 1e-12);
  EXPECT_NEAR(0.015, filling.error.value(), 1e-12);  // sd of −0.02 and −0.05 over √2
  EXPECT_NEAR(-1.0, changeOf(*row, "lg σ_rr [N/m²], bulk").change.value(), 1e-12);
  EXPECT_FALSE(changeOf(*row, "v_φ/(ΩR_i), ring 1").change);
}

TEST(InterpretationChanges, MissingRuns_AreAbsent) {
  const auto rows = interpretationRows(twoInterpretations());
  for (const char* label : {"k_n 176.1 N/m", "wall spacing 7 mm"}) {
    const auto row = std::ranges::find_if(rows, [&](const InterpretationRow& each) {
      return each.label.starts_with(label) && each.pairs == 0;
    });
    ASSERT_NE(rows.end(), row) << label;  // of 7 mm: the later rotations
    for (const InterpretationChange& change : row->changes) {
      EXPECT_FALSE(change.change);
      EXPECT_FALSE(change.error);
    }
  }
}

TEST(InterpretationChanges, OnePair_HasNoError) {
  const auto rows = interpretationRows(twoInterpretations(), true);
  const auto row = std::ranges::find_if(rows, [](const InterpretationRow& each) {
    return each.rotations == "5 to 8" && each.labels == std::vector<double>{0.804} &&
           each.family == "spacing";
  });
  ASSERT_NE(rows.end(), row);
  EXPECT_EQ(1, row->pairs);
  EXPECT_NEAR(-0.05, changeOf(*row, "ν, ring 1").change.value(), 1e-12);
  EXPECT_FALSE(changeOf(*row, "ν, ring 1").error);
}

}  // namespace
}  // namespace crossgrain::reports

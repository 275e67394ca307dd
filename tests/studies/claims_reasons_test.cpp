// What a refuted claim has for reasons: found by rule, and written ones while they hold.
#include <gtest/gtest.h>

#include <algorithm>

#include "claims_world.hpp"

namespace crossgrain::test {
namespace {

std::vector<ClaimRow> reasoned(const ThesisResults& results, const std::string& text = "") {
  const ClaimRules rules = shippedRules();
  std::vector<ClaimRow> rows = judgeClaims(results, rules);
  addReasons(results, rules, claimReasonsOf(text, rules), rows);
  return rows;
}

bool says(const ClaimRow& row, const std::string& words) {
  return std::ranges::any_of(row.reasons, [&](const std::string& reason) {
    return reason.find(words) != std::string::npos;
  });
}

std::string all(const ClaimRow& row) {
  std::string text;
  for (const std::string& reason : row.reasons) text += reason + "\n";
  return text;
}

/// The dilated zone is too wide at the lowest ν̄ of shear flow, where runs are collisional.
ThesisResults wideZoneWhereCollisional() {
  ThesisResults results = world(3);
  changeAll(results, [](ThesisRun& run, const ThesisCase& setup) {
    const bool wide = setup.label < 0.8055 && setup.cell.wallSpacing < 0.005;
    if (wide) setFit(run, "dilation_decay", 1.0 / (12.0 + 0.1 * run.packing));
    run.run.regime->regime = wide ? Regime::collisional : Regime::flowing;
    for (ThesisSpan& span : run.history)
      if (wide) span.outerPressure = span.from < 1.0 ? 100.0 : 1.0;
  });
  return results;
}

TEST(ClaimReasons, RefutedClaimsAlone_HaveThemAndTheSameVerdicts) {
  const ThesisResults results = wideZoneWhereCollisional();
  const std::vector<ClaimRow> before = judgeClaims(results, shippedRules()),
                              after = reasoned(results);
  ASSERT_EQ(before.size(), after.size());
  for (std::size_t k = 0; k < before.size(); ++k) {
    EXPECT_EQ(before[k].verdict, after[k].verdict);
    EXPECT_EQ(before[k].why, after[k].why);
    EXPECT_TRUE(after[k].verdict == Verdict::fail || after[k].reasons.empty());
  }
}

TEST(ClaimReasons, RunsOutsideTheBand_NameTheirStateAndWhereItWouldHold) {
  const ClaimRow row = rowOf(reasoned(wideZoneWhereCollisional()), "C5");
  ASSERT_EQ(row.verdict, Verdict::fail) << row.why;
  for (const char* reason :
       {"Of its 27 runs 21 were collisional, 6 flowing while averaged",
        "(up to 20) is 0.0100 times that of the first, in the median of 27 runs",
        "C⁻¹ lies in its band under wall spacing 7 mm", "of runs that are flowing alone",
        "at ν̄ = 0.807 alone", "The whole claim is reproduced under wall spacing 7 mm"})
    EXPECT_TRUE(says(row, reason)) << reason << "\n" << all(row);
  EXPECT_FALSE(says(row, "at ν̄ = 0.804 alone")) << all(row);
  EXPECT_FALSE(says(row, "at Ω = 0.1 /s, rotations 5 to 8")) << all(row);  // those judged
}

TEST(ClaimReasons, BandHeldNowhere_IsReported) {
  ThesisResults results = world(3);
  changeAll(results, [](ThesisRun& run, const ThesisCase&) {
    setFit(run, "dilation_decay", 1.0 / (12.0 + 0.1 * run.packing));
  });
  const ClaimRow row = rowOf(reasoned(results), "C5");
  EXPECT_TRUE(says(row, "C⁻¹ is shown in its band by none of")) << all(row);
}

constexpr const char* written = R"(
[[reasons]]
claim = "C5"
when = [{ figure = "width", above = 11.0 }, { claim = "C7", figure = "slip", below = 1.0 }]
text = "Impacts dilate the whole cell."
evidence = "figure 6.5"
)";

TEST(ClaimReasons, WrittenReason_StandsWhileItsConditionsHold) {
  ThesisResults results = wideZoneWhereCollisional();
  EXPECT_FALSE(says(rowOf(reasoned(results, written), "C5"), "dilate"));  // 10.5 over all runs
  changeAll(results, [](ThesisRun& run, const ThesisCase&) {
    setFit(run, "dilation_decay", 1.0 / (12.0 + 0.1 * run.packing));
  });
  const ClaimRow row = rowOf(reasoned(results, written), "C5");
  EXPECT_TRUE(says(row, "Impacts dilate the whole cell. (Rests on figure 6.5.)")) << all(row);
  changeAll(results, [](ThesisRun& run, const ThesisCase&) {
    setFit(run, "velocity_amplitude", 1.2 + 0.01 * run.packing);
  });
  EXPECT_FALSE(says(rowOf(reasoned(results, written), "C5"), "dilate"));
}

}  // namespace
}  // namespace crossgrain::test

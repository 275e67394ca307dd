// What is written of a campaign about the thesis' claims.
#include "reports/thesis/report.hpp"

#include <gtest/gtest.h>

#include "reports/render/html.hpp"
#include "tests/reports/report_text.hpp"

namespace crossgrain::reports {
namespace {

ThesisResults twoClaims() {
  ThesisResults results;
  results.engines = {{"grain", "in-house", "1", "", Status::finished, ""}};
  results.cases.resize(2);
  ThesisCase& setup = results.cases[0];
  setup.name = "nu-0.804";
  setup.purpose = "a packing";
  setup.families = {"packings"};
  setup.label = 0.804;
  setup.cell.omega = 1.0;
  setup.cell.innerRadius = 0.1;
  setup.cell.outerRadius = 0.25;
  setup.cell.diameter = 0.01;
  setup.settleRotations = 1.0;
  setup.averagedRotations = 3.0;
  results.cases[1] = setup;
  results.cases[1].name = "nobody-ran-it";
  ThesisRun& run = results.runs.emplace_back();
  run.setup = setup.name;
  run.engine = run.run.engine = "grain";
  run.run.stats.emplace().wallSeconds = 40.0;
  run.run.stats->cpuSeconds = 34.56;
  ThesisSpan& first = run.history.emplace_back();
  first.to = 1.0;
  first.outerPressure = 200.0;
  first.wheelContacts = 50.0;
  ThesisSpan last = first;
  last.from = 1.0;
  last.to = 2.0;
  last.outerPressure = 6.0;
  last.wheelContacts.reset();
  run.history.push_back(last);

  ClaimRow refuted;
  refuted.id = "C5";
  refuted.claim = "a zone is dilated";
  refuted.engine = "grain";
  refuted.interpretation = "default";
  refuted.figures = {{"C⁻¹", "d", 9.0, 0.5, 4.0, 7.0}, {"ν₀", "", 0.84, {}, {}, 0.87}};
  refuted.figures[0].verdict = Verdict::fail;
  refuted.verdict = Verdict::fail;
  refuted.why = "it is 9, not 4 to 7";
  refuted.plot = "figure 6.5";
  refuted.reasons = {"Impacts dilate it."};
  results.claims = {refuted, refuted};
  results.claims.back().interpretation = "wall spacing 7 mm";
  results.claims.back().verdict = Verdict::pass;
  ClaimRow& open = results.claims.emplace_back();
  open.id = "C6";
  open.engine = "grain";
  open.why = "no runs";
  return results;
}

TEST(ThesisTables, HoldEveryFigureOfEveryClaim) {
  EXPECT_EQ(
      claimsCsv(twoClaims()),
      "id,engine,carrier,reading,figure,value,stderr,low,high,unit,verdict,why,figure_verdict,"
      "reasons\n"
      "C5,grain,,default,C⁻¹,9,0.5,4,7,d,refuted,\"it is 9, not 4 to 7\",refuted,Impacts dilate "
      "it.\n"
      "C5,grain,,default,ν₀,0.84,,,0.87,,refuted,\"it is 9, not 4 to 7\",,Impacts dilate it.\n"
      "C5,grain,,wall spacing 7 mm,C⁻¹,9,0.5,4,7,d,reproduced,\"it is 9, not 4 to "
      "7\",refuted,Impacts dilate it.\n"
      "C5,grain,,wall spacing 7 mm,ν₀,0.84,,,0.87,,reproduced,\"it is 9, not 4 to "
      "7\",,Impacts dilate it.\n"
      "C6,grain,,,,,,,,,undecided,no runs,,\n");
}

TEST(ThesisTables, HoldEveryRotation) {
  const std::string table = historyCsv(twoClaims());
  EXPECT_TRUE(has(table, "\nnu-0.804,grain,0,0,1,200,,50,,,,,,,,\n"));
  EXPECT_TRUE(has(table, "\nnu-0.804,grain,0,1,2,6,,,,,,,,,,\n"));
}

TEST(ThesisTables, ClaimsText_IsALineEach) {
  EXPECT_EQ(claimsText(twoClaims()).substr(0, claimsText(twoClaims()).find('\n')),
            "C5   refuted    grain            C⁻¹: 9.00\u00a0±\u00a00.50 d [4 … 7]; default");
}

TEST(ThesisOverview, HasEveryClaimUnderItsFirstInterpretation) {
  ThesisResults results = twoClaims();
  ClaimRow model = results.claims.front();
  model.engine = "-";
  model.id = "C1";
  model.verdict = Verdict::pass;
  model.figures.front().value.reset();
  results.claims.insert(results.claims.begin(), model);
  // The figure that refutes it is shown, not the first.
  std::swap(results.claims[1].figures[0], results.claims[1].figures[1]);
  const Overview overview = thesisOverview(results);
  ASSERT_EQ(overview.columns.size(), 3u);
  EXPECT_EQ(overview.columns[1].name, "C5");
  EXPECT_EQ(overview.columns[1].asks, "a zone is dilated");
  ASSERT_EQ(overview.rows.size(), 2u);
  EXPECT_EQ(overview.rows[0].name, "grain");
  EXPECT_EQ(overview.rows[0].cells[0].verdict, Verdict::notApplicable);
  const OverviewCell& refuted = overview.rows[0].cells[1];
  EXPECT_EQ(refuted.verdict, Verdict::fail);
  EXPECT_EQ(refuted.shown, "9.00\u00a0d");
  EXPECT_EQ(refuted.words, "C⁻¹ [4 … 7]; ✓ under wall spacing 7 mm");
  EXPECT_EQ(refuted.anchor, "C5");
  EXPECT_EQ(overview.rows[0].cells[2].verdict, Verdict::undecided);
  EXPECT_EQ(overview.rows[1].name, "no engine");
  EXPECT_FALSE(overview.rows[1].isEngine);
  EXPECT_EQ(overview.rows[1].cells[0].verdict, Verdict::pass);
  EXPECT_EQ(overview.rows[1].cells[0].shown, "");
}

TEST(ThesisOverview, ConcludesByRule) {
  ThesisResults results = twoClaims();
  EXPECT_EQ(thesisOverview(results).conclusion,
            (std::vector<std::string>{
                "Claims on grain: 0 reproduced, 1 refuted, 1 undecided.",
                "Refuted: C5 on grain; the table of claims has what was found of the reason.",
                "Next: the same command with a larger --budget runs the 1 of 2 cases that nobody "
                "has run; what is undecided may rest on them."}));
  results.claims.front().reasons.clear();
  EXPECT_TRUE(has(thesisOverview(results).conclusion[1], "found of why, of 1 nothing."));
  results.claims.pop_back();
  EXPECT_EQ(thesisOverview(results).conclusion.back(), "Nothing is left to decide by these rules.");
  results.claims.clear();
  EXPECT_TRUE(thesisOverview(results).rows.empty());
  EXPECT_TRUE(thesisOverview(results).conclusion.empty());
}

TEST(ThesisPage, SaysWhatWasFoundWhatItTookAndWhatNobodyRan) {
  ThesisResults results = twoClaims();
  results.claims.push_back(results.claims.front());
  results.claims.back().reasons.clear();
  const std::string page = html(reportOf(results), {});
  for (const char* words :
       {"✗ refuted", "✓ reproduced", "? undecided", "C⁻¹ = 9.00\u00a0±\u00a00.50 d [4 … 7]",
        "200 → 6.00", "nobody-ran-it: a packing", ">not run<", "<td class=\"n\">1</td>",
        "<small>Impacts dilate it.</small>", "<small>No reason was found.</small>",
        "<tr id=\"C5\">",
        // 34.56 s over four rotations at 1 /s are 86.4 s for one at 0.1 /s: a thousandth of a day.
        "1 min 26 s of CPU time (the median of 1 run); in 2003 it took 1 to 2 CPU days, 1000 to "
        "2000 times as much"})
    EXPECT_TRUE(has(page, words)) << words;
}

}  // namespace
}  // namespace crossgrain::reports

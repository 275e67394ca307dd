// What is written of a climb through the thesis' claims.
#include "reports/thesis/report.hpp"

#include <gtest/gtest.h>

#include "tests/reports/has.hpp"

namespace crossgrain::reports {
namespace {

ThesisResults twoClaims() {
  ThesisResults results;
  results.engines = {{"grain", "in-house", "1", "", EngineStatus::ran, ""}};
  results.legs.resize(2);
  ThesisLeg& leg = results.legs[0];
  leg.name = "nu-0.804";
  leg.purpose = "a packing";
  leg.families = {"packings"};
  leg.label = 0.804;
  leg.cell.omega = 1.0;
  leg.settleRotations = 1.0;
  leg.averagedRotations = 3.0;
  results.legs[1] = leg;
  results.legs[1].name = "nobody-ran-it";
  ThesisRun& run = results.runs.emplace_back();
  run.leg = leg.name;
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
  refuted.reading = "default";
  refuted.figures = {{"C⁻¹", "d", 9.0, 0.5, 4.0, 7.0}, {"ν₀", "", 0.84, {}, {}, 0.87}};
  refuted.verdict = ClaimVerdict::refuted;
  refuted.why = "it is 9, not 4 to 7";
  refuted.plot = "figure 6.5";
  refuted.reasons = {"Impacts dilate it."};
  results.claims = {refuted, refuted};
  results.claims.back().reading = "wall spacing 7 mm";
  results.claims.back().verdict = ClaimVerdict::reproduced;
  ClaimRow& open = results.claims.emplace_back();
  open.id = "C6";
  open.engine = "grain";
  open.why = "no runs";
  return results;
}

TEST(ThesisTables, HoldEveryFigureOfEveryClaim) {
  EXPECT_EQ(claimsCsv(twoClaims()),
            "id,engine,carrier,reading,figure,value,stderr,low,high,unit,verdict,why\n"
            "C5,grain,,default,C⁻¹,9,0.5,4,7,d,refuted,\"it is 9, not 4 to 7\"\n"
            "C5,grain,,default,ν₀,0.84,,,0.87,,refuted,\"it is 9, not 4 to 7\"\n"
            "C5,grain,,wall spacing 7 mm,C⁻¹,9,0.5,4,7,d,reproduced,\"it is 9, not 4 to 7\"\n"
            "C5,grain,,wall spacing 7 mm,ν₀,0.84,,,0.87,,reproduced,\"it is 9, not 4 to 7\"\n"
            "C6,grain,,,,,,,,,undecided,no runs\n");
}

TEST(ThesisTables, HoldEveryRotation) {
  const std::string table = historyCsv(twoClaims());
  EXPECT_TRUE(has(table, "\nnu-0.804,grain,0,0,1,200,,50,,,,,,,,\n"));
  EXPECT_TRUE(has(table, "\nnu-0.804,grain,0,1,2,6,,,,,,,,,,\n"));
}

TEST(ThesisTables, CountAClaimOnceWhateverItsReadings) {
  EXPECT_EQ(claimCounts(twoClaims()),
            std::vector<std::string>{"Claims on grain: 0 reproduced, 1 refuted, 1 undecided"});
  // What needs no engine comes last, wherever it stands among the claims.
  ThesisResults results = twoClaims();
  results.claims.insert(results.claims.begin(), results.claims.front());
  results.claims.front().engine = "-";
  EXPECT_EQ(claimCounts(results).size(), 2u);
  EXPECT_EQ(claimCounts(results).back().substr(0, 27), "Claims that need no engine:");
}

TEST(ThesisTables, TellAClaimInALine) {
  EXPECT_EQ(claimsText(twoClaims()).substr(0, claimsText(twoClaims()).find('\n')),
            "C5   refuted    grain            C⁻¹: 9.00\u00a0±\u00a00.50 d [4 … 7]; default");
}

TEST(ThesisPage, SaysWhatWasFoundWhatItTookAndWhatNobodyRan) {
  ThesisResults results = twoClaims();
  results.claims.push_back(results.claims.front());
  results.claims.back().reasons.clear();
  const std::vector<Figure> figures;
  const std::vector<Picture> pictures;
  const std::string page = thesisPage(results, {figures, pictures, "", std::nullopt});
  for (const char* words :
       {"✗ refuted", "✓ reproduced", "? undecided", "C⁻¹ = 9.00\u00a0±\u00a00.50 d <small>[4 … 7]",
        "200 → 6.00", "<td>not run</td>", "<th rowspan=\"1\">nobody-ran-it",
        "<td class=\"n\">1</td>", "<i>Impacts dilate it.</i>", "<i>No reason was found.</i>",
        // 34.56 s over four rotations at 1 /s are 86.4 s for one at 0.1 /s: a thousandth of a day.
        "1 min 26 s of CPU time (the median of 1 run); in 2003 it took 1 to 2 CPU days, 1000 to "
        "2000 times as much"})
    EXPECT_TRUE(has(page, words)) << words;
}

}  // namespace
}  // namespace crossgrain::reports

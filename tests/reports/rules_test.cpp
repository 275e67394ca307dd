// Rules of reports that hold whatever the words: what is counted, what is no
// success, what is a dash.
#include <gtest/gtest.h>

#include "reports/collide/report.hpp"
#include "reports/flow/overview.hpp"
#include "reports/flow/report.hpp"
#include "tests/reports/report_text.hpp"
#include "tests/reports/sample_results.hpp"

namespace crossgrain::reports {
namespace {

TEST(CompareReport, FailedAndRefusedRuns_HaveTheirReasons) {
  const std::string text = textOf(compareReport(sample::compareResults(4, 300)));
  EXPECT_TRUE(has(text, "| yade | 1 | failed | worker died at t = 0.31 s (signal 11) <oops>"));
  EXPECT_TRUE(has(text, "| odd-one | all | refused | it lacks \"bottom_friction\"")) << text;
}

TEST(CompareReport, Cost_IsSummedOverFinishedRuns) {
  const std::string text = textOf(compareReport(sample::compareResults(4, 300)));
  // 7.85 s at dt = 4e-5 s are 196 250 steps a run; 4 runs of the first engine,
  // 3 of the second.
  EXPECT_TRUE(has(text, "| steps | 785\u202f000 | 588\u202f750 |"));
  // 1.1e-4 s of wall time a step.
  EXPECT_TRUE(has(text, "| wall time per step | 110 |"));
}

TEST(CompareReport, ChecksOfOneNumber_AreATable) {
  const Report report = compareReport(sample::compareResults(4, 300));
  EXPECT_TRUE(has(
      textOf(report),
      "| σ_rr at the ring <outside> | grain | 41.5\u00a0±\u00a01.2 | 40.25\u00a0±\u00a00.50\n"));
  for (const Figure& figure : report.figures) EXPECT_NE(figure.name, "check_2");
}

TEST(CompareReport, EffectsLeftOutOrExtra_AreNamed) {
  const std::string text = textOf(compareReport(sample::compareResults(4, 300)));
  EXPECT_TRUE(has(text, "✗ not simulated"));
  EXPECT_TRUE(has(text, "+ though not called for"));
}

TEST(CompareReport, OnePacking_BarsAreConditional) {
  const std::string conditional = "conditional on its one packing";
  EXPECT_TRUE(has(textOf(compareReport(sample::compareResults(1, 100))), conditional));
  EXPECT_FALSE(has(textOf(compareReport(sample::compareResults(4, 100))), conditional));
}

TEST(CompareReport, RegimesAndSteadiness_ComeBeforeAnyMean) {
  const std::string text = textOf(compareReport(sample::compareResults(4, 300)));
  EXPECT_LT(text.find("Packing 2 is blocked on grain, yade, grain~yade; flows "
                      "on box2d-impulse."),
            text.find("## Profiles"));
}

/// What engines simulate is compared with the effects of the variant that they
/// ran.
TEST(CollideReport, Effects_AreThoseOfEachVariant) {
  CollideResults results = sample::collideResults();
  const std::string all = textOf(reportOf(results));
  EXPECT_TRUE(has(all, "| friction | called for | ✓ simulated |"));
  // The sample's engines simulate moving walls, which no collision calls for.
  EXPECT_TRUE(has(all, "| moving walls | – | + though not called for |"));
  results.variants[1].effects = {"normal_damping", "rotation"};
  EXPECT_TRUE(has(textOf(reportOf(results)),
                  "| friction | called for in 1 of 2 scenes | ✓ simulated; + "
                  "though not called for "
                  "in 3 of 6 runs |"));
  for (CollisionVariant& variant : results.variants)
    variant.effects.reset();  // of an earlier version
  EXPECT_FALSE(has(textOf(reportOf(results)), "though not called for"));
}

TEST(CollideReport, NothingJudged_IsNoSuccess) {
  CollideResults results = sample::collideResults();
  for (CollisionVariant& variant : results.variants)
    for (CollisionCurve& curve : variant.curves) {
      curve.score.verdict = Verdict::notMeasured;
      if (auto& psi = curve.score.of[QuantityId::psiF]) {
        psi->limit.reset();
        psi->held.reset();
      }
    }
  EXPECT_EQ(collideOverview(results).conclusion.back(),
            "Nothing was judged: the case has no [collision.margins] for what "
            "was measured.");
  EXPECT_EQ(countOf(results).judged(), 0);
  for (CollisionVariant& variant : results.variants) {
    variant.oracleReason = "no limit";
    for (CollisionCurve& curve : variant.curves) curve.score.of[QuantityId::psiF].reset();
  }
  EXPECT_EQ(nothingJudged(results), "there is no oracle to judge by: no limit");
  EXPECT_EQ(nothingJudged(sample::collideResults()), "");
}

TEST(CollideReport, ModelDifference_IsNoFailure) {
  CollideResults results = sample::collideResults();
  for (CollisionVariant& variant : results.variants)
    for (CollisionCurve& curve : variant.curves)
      if (curve.engine == "yade") {
        DeclaredScore& declared = curve.declared.emplace();
        declared.law = {{"tension", "cut"}};
        declared.reference = DeclaredReference::oracle;
        declared.score = curve.score;
        declared.score.of[QuantityId::psiF]->max = 0.001;
        declared.score.of[QuantityId::psiF]->held = true;
        declared.score.verdict = Verdict::pass;
      }
  const std::string page = textOf(reportOf(results));
  EXPECT_TRUE(has(page, "| ≠ 4 of 6 passed, 2 ≠"));
  EXPECT_TRUE(has(page, "Declared instead: yade: tension cut."));
  EXPECT_TRUE(has(page, " | declared | "));
  const SweepCount count = countOf(results);
  EXPECT_EQ(count.modelDifference, 2);
  EXPECT_EQ(count.beyondLimits, 2);
}

TEST(CollideReport, OwnSchemeBeyondItsLimit_Fails) {
  CollideResults results = sample::collideResults();
  SchemeScore& own = results.variants[0].curves[0].ownScheme.emplace();
  own.position = 2e-14;
  own.velocity = 1e-9;
  own.limit = 1e-12;
  own.held = false;
  const std::string page = textOf(reportOf(results));
  EXPECT_TRUE(has(page, "own scheme 1×10⁻⁹"));
  EXPECT_TRUE(has(page, "| ✗ 1×10⁻⁹ |"));
  EXPECT_EQ(verdictOf(results.variants[0].curves[0]), Verdict::fail);
}

/// A mirror beside its peer shows what the peer should do; alone it is an
/// engine like any other.
TEST(CollideReport, MirrorsBesideTheirPeers_AreNotCounted) {
  CollideResults results = sample::collideResults();
  const int before = countOf(results).judged();
  results.engines[1].mirrors = "grain";
  EXPECT_EQ(countOf(results).judged(), before - 6);
  results.engines[1].mirrors = "somebody else";
  EXPECT_EQ(countOf(results).judged(), before);
}

TEST(CollideReport, PointsWithoutALimit_AreNamedWithTheReason) {
  CollideResults results = sample::collideResults();
  results.variants[1].noLimit = {{0.5573, 1e-4, 0.1, "the law jumps"}};
  EXPECT_TRUE(has(textOf(reportOf(results)),
                  "Not judged: spring and dashpot, Ψ_i = 0.5573: the law jumps."));
}

TEST(CollideScores, PassedBetweenTimeSteps_IsLeftOut) {
  // 3 + 3 + 1 curves, less the middle ones of two engines that passed.
  CollideResults results = sample::collideResults();
  const auto rows = [&] { return scoreTable(casesOf(results).front()).rows.size(); };
  const std::size_t before = rows();
  CollisionCurve& middle = results.variants[0].curves[2];
  ASSERT_EQ(middle.engine, "grain");
  middle.score.verdict = Verdict::fail;
  EXPECT_EQ(rows(), before + 1) << "what failed is there";
}

TEST(AverageReport, ComparesNothing) {
  const Report report = averageReport(sample::averageResults());
  const std::string text = textOf(report);
  EXPECT_TRUE(has(text, "12 snapshots of grain averaged: 7 fields in 20 rings."));
  for (const char* claim : {"could be compared", "No engine reports any deviation", "What ran",
                            "not simulated", "after hand-over"})
    EXPECT_FALSE(has(text, claim)) << claim;
  for (const auto& [name, table] : report.tables) EXPECT_NE(name, "agreement.csv");
}

TEST(RevReport, NearnessToSlicing_DecidesTheMatrix) {
  RevResults results = sample::revResults();
  // 0.1/0.7 apart in the narrowest ring, the same from 1 d on.
  results.curves[1].mean[0] = 0.8;
  const Overview overview = revOverview(results);
  ASSERT_EQ(overview.rows.size(), 1u);
  EXPECT_EQ(overview.rows[0].name, "volume fraction");
  EXPECT_EQ(overview.rows[0].cells[1].shown, "≥ 1 d");
  EXPECT_EQ(overview.rows[0].cells[0].verdict, Verdict::notMeasured);
  EXPECT_EQ(overview.conclusion[1], "Within 5 % of slicing in every field: centre from 1 d.");
  results.curves[1].mean[2] = 0.9;
  EXPECT_EQ(revOverview(results).rows[0].cells[1].verdict, Verdict::borderline);
  // Under "near d" of the first method, and a dash where no width was there to
  // meet at.
  EXPECT_TRUE(has(textOf(reportOf(sample::revResults())), "| 0.95 (1 %) | –"));
}

}  // namespace
}  // namespace crossgrain::reports

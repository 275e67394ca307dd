// Collisions: numbers that are counted, failures, and differences by the model.
#include <gtest/gtest.h>

#include "reports/collide/report.hpp"
#include "reports/common/causes.hpp"
#include "reports/common/overview.hpp"
#include "tests/reports/report_text.hpp"
#include "tests/reports/sample_results.hpp"

namespace crossgrain::reports {
namespace {

TEST(CauseWords, PartsThatCancelAreOne) {
  CauseAccount account{-3.9e-6,
                       {{"spring_update", 0.00118}, {"dashpot", -0.00118}, {"lever_arm", -4.1e-6}},
                       0.0,
                       2e-7,
                       "rest"};
  EXPECT_EQ(account.largest(), "lever_arm");
  const std::string words = accountWords(account);
  EXPECT_TRUE(words.starts_with("lever arm 4.1")) << words;
  EXPECT_EQ(words.find("0.00118"), std::string::npos) << words;
  // Two that do not cancel, and two that are no more than the whole, stay apart.
  account.parts[1].value = -0.001;
  EXPECT_EQ(account.largest(), "dashpot");
  account = {1.0, {{"a", 1.5}, {"b", -1.49}}, 0.0, 0.99, "rest"};
  EXPECT_TRUE(accountWords(account).starts_with("a 1.50, b −1.49")) << accountWords(account);
}

TEST(CauseWords, NamesOfCaseFilesAreWords) {
  EXPECT_EQ(termWords("dashpot+spring_reset"), "dashpot with spring reset");
  EXPECT_EQ(termWords("damper+gn"), "damper with γ_n");
  EXPECT_EQ(termWords("spring_update and mu together"), "spring update and µ together");
  EXPECT_EQ(termWords("time step"), "time step");
  EXPECT_EQ(differenceWords({"spring_reset", "total", "spring_only", false}),
            "spring reset total → spring only (not declared)");
}

/// Effects that engines simulate are compared with those of the variant that they ran.
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

/// YADE passes the law that it declares, tension cut, wherever it does not pass the scene's.
CollideResults withDeclaredLaw() {
  CollideResults results = sample::collideResults();
  for (CollisionVariant& variant : results.variants)
    for (CollisionCurve& curve : variant.curves)
      if (curve.engine == "yade") {
        DeclaredScore& declared = curve.declared.emplace();
        declared.law = {{"tension", std::string("cut")}};
        declared.reference = DeclaredReference::oracle;
        declared.score = curve.score;
        declared.score.of[QuantityId::psiF]->max = 0.001;
        declared.score.of[QuantityId::psiF]->held = true;
        declared.score.verdict = Verdict::pass;
      }
  return results;
}

TEST(CollideOverview, LargestShareOfALimit_IsAModelDifferenceWhereTheDeclaredLawPasses) {
  const Overview scene = collideOverview(sample::collideResults());
  // 12/50² at t_c/50, half of it is told, the limit is 0.01.
  EXPECT_EQ(shown(rowNamed(scene, "grain").cells[1]), "good 0.24 × limit");
  EXPECT_EQ(shown(rowNamed(scene, "yade").cells[1]), "bad 1.2 × limit");
  CollideResults results = withDeclaredLaw();
  const Overview declared = collideOverview(results);
  EXPECT_EQ(shown(rowNamed(declared, "yade").cells[1]), "model_difference 1.2 × limit");
  // Four of yade's sweeps hold in spite of it, two differ: it explains nothing.
  EXPECT_EQ(declared.conclusion[1], "Fails most often: tangential rebound Ψ_f.");
}

/// Of the first sweep that yade fails, at Ψ_i = 0.5 of two: 0.03 apart, and at 0.25 by 0.001.
CollideResults withCauses() {
  CollideResults results = sample::collideResults();
  CollisionCurve& curve = results.variants[0].curves[1];
  CollisionCauses& causes = curve.causes.emplace();
  causes.differences = {{"lever_arm", "radius", "overlap_middle"},
                        {"spring_update", "after", "before"},
                        {"mu", "0.44", "0.45", false}};
  causes.interactions = {{"lever_arm", "spring_update", 0.25}};
  causes.remainder = "implementation";
  causes.of[QuantityId::psiF] = {{0.001, -0.03},
                                 {{0.0, 0.002}, {0.001, -0.03}, {0.0, -0.00201}},
                                 {0.0, 0.0},
                                 {0.0, 1e-5},
                                 0.01};
  return results;
}

TEST(CollideReport, LargestDifference_IsToldWithItsCauses) {
  const CollideResults results = withCauses();
  const Overview overview = collideOverview(results);
  EXPECT_EQ(
      overview.conclusion[1],
      "Causes: tangential rebound Ψ_f of yade is 0.0300 lower than grain's (the in-house engine "
      "under the scene's law) at Ψ_i = 0.5 of spring, "
      "tension cut: spring update 0.0300, µ 0.0020 (not declared), lever arm −0.0020, "
      "implementation < "
      "0.0001 (1 limit = 0.0100); fails most often: tangential rebound Ψ_f.");
  EXPECT_EQ(rowNamed(overview, "yade").cells[1].words,
            "by spring update: Ψ_f, spring, tension cut");
  const std::string all = textOf(reportOf(results));
  // Over both points, each by its own size: 0.001² and 0.03².
  EXPECT_TRUE(has(all, "spring update 100, µ 7 (not declared), lever arm −7, implementation < 1"));
  EXPECT_TRUE(has(all, "Act on each other: lever arm and spring update (25 %)."));
  EXPECT_TRUE(has(all, "| spring_update | after, before, midpoint |"));
  EXPECT_FALSE(has(textOf(reportOf(sample::collideResults())), "Causes of differences"));
}

TEST(CollideReport, LawThatIsNotDeclared_StandsBesideWhatTheEngineReports) {
  CollideResults results = withCauses();
  CollisionCurve& curve = results.variants[0].curves[1];
  curve.causes->undeclared = {{"kr", "3000", "3008", false}};
  curve.effective.emplace().deviations = {{"tension", 0.0, "", "cut"},
                                          {"rounding", 1e-7, "", "places are of single precision"}};
  EXPECT_TRUE(has(textOf(reportOf(results)),
                  "yade differs from the law that it declares as if k_r were 3008, not 3000. It "
                  "reports, beside options of the law: places are of single precision."));
}

/// Of a constant there is no row that a link could go to.
TEST(CollideReport, CauseIsLinkedToItsTerm_WhereThereIsOne) {
  EXPECT_EQ(termLink("spring_update"), "#term_spring_update");
  EXPECT_EQ(termLink("damper+gn"), "#term_damper");
  EXPECT_EQ(termLink("mu"), "");
  EXPECT_EQ(termLink("implementation"), "");
}

TEST(CollideReport, NotAttributed_SaysWhy) {
  CollideResults results = withCauses();
  CollisionCauses& causes = *results.variants[0].curves[1].causes;
  causes = {};
  causes.reason = "has no such law";
  EXPECT_TRUE(has(textOf(reportOf(results)), "Not attributed: has no such law."));
  EXPECT_FALSE(has(collideOverview(results).conclusion[1], "Causes"));
}

TEST(CollideReport, ModelDifference_IsNoFailure) {
  const CollideResults results = withDeclaredLaw();
  EXPECT_TRUE(has(textOf(reportOf(results)), "| ≠ 4 of 6 passed, 2 ≠"));
  const SweepCount count = countOf(results);
  EXPECT_EQ(count.modelDifference, 2);
  EXPECT_EQ(count.beyondLimits, 2);
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

/// Points without a reference count in no pass, and are no lack of margins.
TEST(CollideReport, PassOnFewPoints_SaysOnHowMany) {
  CollideResults results = sample::collideResults();
  const auto leaveUnjudged = [&](std::size_t count) {
    for (CollisionVariant& variant : results.variants)
      for (CollisionCurve& curve : variant.curves) {
        curve.points.reason.assign(curve.points.size(), "");
        std::fill_n(curve.points.reason.begin(), std::min(count, curve.points.size()),
                    "hypotheses differ");
      }
  };
  const auto passed = [&] { return collideOverview(results).conclusion.front(); };
  EXPECT_TRUE(has(passed(), "Passed every sweep: grain")) << passed();
  leaveUnjudged(6);  // of 16
  EXPECT_TRUE(has(passed(), "Passed every sweep, on 60 of 96 points: grain")) << passed();
  EXPECT_EQ(rowNamed(collideOverview(results), "grain").cells[0].shown,
            "6 of 6, on 60 of 96 points");
  leaveUnjudged(9);
  EXPECT_TRUE(has(passed(), "Passed every sweep, by the gain of energy alone: grain")) << passed();
  for (CollisionVariant& variant : results.variants) {
    variant.noLimit.emplace_back();
    variant.convex.emplace();
    for (CollisionCurve& curve : variant.curves) {
      curve.score.verdict = Verdict::notMeasured;
      curve.score.of[QuantityId::psiF]->held.reset();
      curve.status = Status::finished;
    }
  }
  EXPECT_EQ(nothingJudged(results),
            "at most points of the sweep Newton's, Poisson's and Stronge's restitution differ, and "
            "the case has no margin of energy_gained");
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

}  // namespace
}  // namespace crossgrain::reports

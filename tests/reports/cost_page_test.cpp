#include <gtest/gtest.h>

#include <algorithm>

#include "reports/common/engines.hpp"
#include "reports/cost/report.hpp"
#include "reports/cost/tables.hpp"
#include "reports/cost/words.hpp"
#include "reports/report.hpp"
#include "results/schema.hpp"
#include "support/files.hpp"
#include "tests/reports/has.hpp"
#include "tests/reports/sample_results.hpp"
#include "tests/support/temporary_folder.hpp"

namespace crossgrain::reports {
namespace {

/// One kind, one measure, one engine: 10 % in 1 s, 1 % in 10 s, a failure; analysed by hand.
CostResults byHand() {
  const auto of = [](const std::string& setting, double dt, double error, double wall) {
    CostPoint point;
    point.engine = "a";
    point.knob = "time_step";
    point.setting = setting;
    point.fragment = "[run]\ndt = 1\n";
    point.measure = "psi_f";
    point.dt = dt;
    point.stepsPerContact = 1.0 / dt;
    point.error = error;
    point.wallSeconds = point.cpuSeconds = wall;
    point.steps = 100;
    point.contactEvaluations = 200;
    return point;
  };
  CostResults results;
  results.head.schema = schemaVersion;
  results.head.kind = kindCost;
  results.engines = {{"a", "", "", "", EngineStatus::ran, ""}};
  results.points = {of("t_c/10", 0.1, 0.1, 1.0), of("t_c/100", 0.01, 0.01, 10.0),
                    of("t_c/1", 1.0, 0.0, 0.1), of("float, slow", 0.01, 0.01, 20.0)};
  CostPoint& failed = results.points[2];
  failed.error.reset();
  failed.status = CostStatus::failed;
  failed.reason = "NaN, at 3";
  results.points[3].knob = "precision";
  results.fronts = {{CostKind::collision, "psi_f", "", {0, 1}, {}}};
  return results;
}

TEST(CostCsv, HasEveryPointAlsoThoseThatFailed) {
  EXPECT_EQ(
      costCsv(byHand()),
      "engine,setting,dt_s,error,error_kind,wall_s,cpu_s,steps,contact_evaluations,status,"
      "reason,knob,measure,statistical,systematic,reference_error,steps_per_contact,on_front,low,"
      "high,equivalent,bound\n"
      "a,t_c/10,0.1,0.1,collision,1,1,100,200,ran,,time_step,psi_f,,,,10,yes,,,,\n"
      "a,t_c/100,0.01,0.01,collision,10,10,100,200,ran,,time_step,psi_f,,,,100,yes,,,,\n"
      "a,t_c/1,1,,collision,0.1,0.1,100,200,failed,\"NaN, at 3\",time_step,psi_f,,,,1,,,,,\n"
      "a,\"float, slow\",0.01,0.01,collision,20,20,100,200,ran,,precision,psi_f,,,,100,no,,,,\n");
}

TEST(CostCsv, OfNothingIsItsHead) {
  EXPECT_EQ(std::ranges::count(costCsv({}), '\n'), 1);
}

/// The engine's, filled; the open one is its predecessor.
int markOf(const CostResults& results) {
  return engineStyles(results.engines).front().pointType;
}

const Curve* curveOf(const Panel& panel, int pointType, Draw draw) {
  for (const Curve& curve : panel.curves)
    if (curve.style.pointType == pointType && curve.draw == draw) return &curve;
  return nullptr;
}

TEST(CostFigures, JoinStepsNumberOtherSettingsAndCrossFailuresAtTheUpperEdge) {
  const auto figures = costFigures(byHand());
  ASSERT_EQ(figures[0].name, "cost_collision");
  const Panel& panel = figures[0].panels[0];
  EXPECT_TRUE(panel.logX && panel.logY);
  const Curve& front = panel.curves[0];
  ASSERT_EQ(front.points.size(), 3u);  // 10 % from 1 s on, 1 % from 10 s on
  EXPECT_EQ(front.points[1].x, 10.0);
  EXPECT_EQ(front.points[1].y, 0.1);
  const Curve* steps = curveOf(panel, markOf(byHand()), Draw::linesAndPoints);
  ASSERT_TRUE(steps);
  EXPECT_EQ(steps->name, "a");
  EXPECT_EQ(steps->points.size(), 2u);
  const Curve* others = curveOf(panel, markOf(byHand()) - 1, Draw::points);
  ASSERT_TRUE(others);
  EXPECT_EQ(others->points[0].label, "1");
  EXPECT_TRUE(has(figures[0].caption, "Other settings: 1 precision float, slow."));
  const Curve* crosses = curveOf(panel, 2, Draw::points);
  ASSERT_TRUE(crosses);
  EXPECT_EQ(crosses->points[0].x, 0.1);
  EXPECT_GT(crosses->points[0].y, 0.1);  // above every error, on the panel
  EXPECT_LT(crosses->points[0].y, panel.yRange->high);
}

TEST(CostFigures, DrawWhatMayBeChanceAtItsUpperBound) {
  CostResults results = byHand();
  results.points[1].referenceError = 0.03;
  const auto figures = costFigures(results);
  const Panel& panel = figures[0].panels[0];
  EXPECT_EQ(panel.shadedTo, 0.03);
  const Curve* chance = curveOf(panel, 10, Draw::points);
  ASSERT_TRUE(chance);
  EXPECT_NEAR(chance->points[0].y, 0.04, 1e-15);
  EXPECT_EQ(curveOf(panel, markOf(byHand()), Draw::linesAndPoints)->points.size(), 1u);
}

TEST(CostFigures, OfNothingAreNone) {
  EXPECT_TRUE(costFigures({}).empty());
}

TEST(CostTables, HoldAKnobAgainstTheSameStep) {
  const CostResults results = byHand();
  const Json knobs = knobGroups(results, costEngines(results));
  ASSERT_EQ(knobs.size(), 1u);
  const Json& row = knobs[0]["rows"][0];
  EXPECT_EQ(row["base"], "t_c/100");
  EXPECT_EQ(row["ratio"], "2.00");
  EXPECT_EQ(row["cells"][0]["text"], "1 %");
  EXPECT_EQ(row["cells"][0]["was"], "was 1 %");
}

TEST(CostTables, SayWhatAnErrorIs) {
  EXPECT_EQ(percentText(0.0123), "1.2 %");
  EXPECT_EQ(percentText(2.13e-7), "2.1×10⁻⁷");
  EXPECT_EQ(percentText(9.5), "950 %");
  EXPECT_EQ(percentText(0.0), "0");
  EXPECT_EQ(percentText({}), "–");
  EXPECT_EQ(targetText(0.001), "0.1 %");
  EXPECT_EQ(targetText(1e-6), "10⁻⁶");
}

/// The engine of byHand() with another law: 25 % off, whatever the step.
CostResults ofAnotherLaw() {
  CostResults results = byHand();
  CostCell own{"a", CostKind::collision, CostBasis::own, 0.1, CostVerdict::reached};
  own.knob = "time_step";
  own.setting = "t_c/10";
  own.wallSeconds = 1.0;
  own.point = 0;
  CostCell scene{"a", CostKind::collision, CostBasis::scene, 0.1, CostVerdict::notReached};
  scene.model = 0;
  results.models = {{"a", CostKind::collision, "psi_f", 0.25, 0.24, 0.26}};
  results.cells = {own, scene};
  return results;
}

TEST(CostAccuracy, TellsDiscretisationAndModelApart) {
  const CostResults results = ofAnotherLaw();
  EXPECT_EQ(
      costAccuracyText(results),
      "a, collision, its own limit:\n"
      "   10 %  t_c/10, 1.00 s, Ψ_f: 10 %\n"
      "a, collision, the case's law:\n"
      "  its limit of small steps is 25 % off the case's law in Ψ_f (24 % to 26 %)\n"
      "   10 %  not reached, its limit of small steps is 25 % off the case's law in Ψ_f (24 % "
      "to 26 %)\n"
      "Which setting reaches an accuracy for the least time is decided for 1 of 1 against "
      "engines' own limits of small steps and 1 of 1 against the case's law.\n");
  const Json groups = accuracyGroups(results, costEngines(results));
  ASSERT_EQ(groups.size(), 1u);
  EXPECT_EQ(groups[0]["rows"][0]["cells"][0]["text"], "t_c/10");
  EXPECT_TRUE(groups[0]["rows"][0]["models"].empty());
  EXPECT_EQ(groups[0]["rows"][1]["models"].size(), 1u);
  EXPECT_EQ(groups[0]["rows"][1]["cells"][0]["text"], "not reached");
  EXPECT_EQ(accuracyInWords(results),
            (std::vector<std::string>{"10 % of the case's law is reached for the least time in: "
                                      "collision: no engine is shown to."}));
}

TEST(CostAccuracy, ABoundIsToldAsOne) {
  CostPoint point = byHand().points[0];
  point.kind = CostKind::averages;
  point.error = 0.03;
  point.statistical = 0.04;
  point.low = 0.0;
  point.high = 0.12;
  EXPECT_EQ(intervalText(point), "3 % (0 to 12 %)");
  point.bound = 0.004;
  EXPECT_EQ(intervalText(point), "at most 0.4 % (bound)");
  point.error = point.statistical = point.low = point.high = std::nullopt;
  EXPECT_EQ(intervalText(point), "at most 0.4 % (bound)");
  EXPECT_EQ(errorText(point), "at most 0.4 %");
}

class CostPage : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TemporaryFolder;
    writeReport(sample::costResults(), folder_->path());
    page_ = new std::string(readFile(folder_->path() / "report.html").value());
  }
  static void TearDownTestSuite() {
    delete folder_;
    delete page_;
  }
  static const TemporaryFolder* folder_;
  static const std::string* page_;
};
const TemporaryFolder* CostPage::folder_ = nullptr;
const std::string* CostPage::page_ = nullptr;

TEST_F(CostPage, BeginsWithItsVerdicts) {
  EXPECT_TRUE(has(*page_,
                  "<p class=\"lead\">Which setting reaches an accuracy for the least time is "
                  "decided for 9 of 9 against engines&apos; own limits of small steps and 12 of 18 "
                  "against the case&apos;s law.</p>"))
      << page_->substr(page_->find("<p class=\"lead\""), 300);
  EXPECT_TRUE(has(*page_, "10 %: cheapest with grain at t<sub>c</sub>/25, "));
  EXPECT_TRUE(has(*page_,
                  "Finding: grain, semi implicit euler: order 2 is claimed and not met: "
                  "collision Ψ<sub>f</sub> 1.00"));
  EXPECT_FALSE(has(*page_, "±\u00a00.00,")) << "an error is never none";
  EXPECT_TRUE(has(*page_, "box2d-impulse refused the scene: odd &lt;b&gt;"));
}

TEST_F(CostPage, NotMeasuredIsNeitherUndecidedNorNotReached) {
  EXPECT_TRUE(has(*page_,
                  " not measured, for they did not fit into the budget of 12 min 00 s: with "
                  "--resume and a budget of about 23 min 20 s they would."))
      << page_->substr(page_->find(" points: "), 300);
  EXPECT_TRUE(has(*page_, "<b>… not measured</b>"));
  EXPECT_FALSE(has(*page_, ">undecided</td>"));  // a status of points: they were not measured
}

/// Under a budget that left most out, no engine is said not to reach anything.
TEST(CostPageOf, ABudgetThatLeftOutFinerStepsSaysSo) {
  const auto on = [](const std::string& engine, CostVerdict verdict) {
    Advice advice;
    advice.engine = engine;
    advice.target = 1e-6;
    advice.verdict = verdict;
    return advice;
  };
  CostResults results = byHand();
  results.advice = {on("a", CostVerdict::notMeasured), on("b", CostVerdict::undecided)};
  EXPECT_EQ(
      targetInWords(results, 1e-6),
      "10⁻⁶: of 2 engines, none is shown to reach it; of 1 it is undecided, of 1 not measured "
      "far enough to tell.");
  results.advice = {on("a", CostVerdict::notReached)};
  EXPECT_EQ(targetInWords(results, 1e-6), "10⁻⁶: no engine reaches it with any setting measured.");
  results.advice = {on("a", CostVerdict::notReached), on("b", CostVerdict::notMeasured)};
  EXPECT_EQ(
      targetInWords(results, 1e-6),
      "10⁻⁶: of 2 engines, none is shown to reach it; of 1 not measured far enough to tell, 1 "
      "does not reach it with any setting measured.");
}

TEST_F(CostPage, HasWhatDidNotRunWithItsReason) {
  EXPECT_TRUE(has(*page_, "would take about 140 s, budget 60 s"));
  EXPECT_TRUE(has(*page_, "a disk left the cell at step 37; odd &lt;b&gt;"));
}

TEST_F(CostPage, EndsWithFragmentsToPaste) {
  const auto advice = page_->find("<h2 id=\"advice\">");
  ASSERT_NE(advice, std::string::npos);
  EXPECT_TRUE(has(page_->substr(advice), ">grain for 10 %: t<sub>c</sub>/25<"));
  EXPECT_TRUE(has(page_->substr(advice), "</h3>\n<pre>[run]\nsteps_per_contact = 25\n"));
}

TEST_F(CostPage, TakesNothingLiterally) {
  for (const char* bad : {"{{", "}}", ">nan", ">null", "http:", "<script s", "odd <b>"})
    EXPECT_FALSE(has(*page_, bad)) << bad;
}

TEST_F(CostPage, HasItsPlotsAndTableBesideIt) {
  for (const char* file :
       {"cost.csv", "plots/cost_collision.svg", "plots/cost_collision.png",
        "plots/cost_trajectory.svg", "plots/cost_averages.svg", "plots/cost_contacts.svg",
        "plots/cost_orders_collision.svg", "plots/cost_parts.svg", "plots/cost_growth.svg"})
    EXPECT_TRUE(std::filesystem::exists(folder_->path() / file)) << file;
  EXPECT_FALSE(std::filesystem::exists(folder_->path() / "plots" / "gnuplot.log"));
}

TEST(CostPageOf, NothingSaysSo) {
  const TemporaryFolder folder;
  writeReport(Json{{"schema", "crossgrain-results-1"}, {"kind", "cost"}}, folder.path());
  const std::string page = readFile(folder.path() / "report.html").value();
  EXPECT_TRUE(has(page, "Nothing was measured."));
  EXPECT_FALSE(has(page, "{{"));
}

}  // namespace
}  // namespace crossgrain::reports

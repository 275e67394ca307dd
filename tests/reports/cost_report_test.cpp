#include <gtest/gtest.h>

#include <algorithm>

#include "reports/common/engines.hpp"
#include "reports/common/figure.hpp"
#include "reports/cost/report.hpp"
#include "results/schema.hpp"
#include "tests/reports/report_text.hpp"
#include "tests/reports/sample_results.hpp"

namespace crossgrain::reports {
namespace {

/// One kind, one measure, one engine: 10 % in 1 s, 1 % in 10 s, a failure, another setting.
CostResults byHand() {
  const auto of = [](const std::string& setting, double dt, double error, double wall) {
    CostPoint point;
    point.engine = "a";
    point.knob = "time_step";
    point.setting = setting;
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
  results.engines = {{"a", "", "", "", Status::finished, ""}};
  results.points = {of("t_c/10", 0.1, 0.1, 1.0), of("t_c/100", 0.01, 0.01, 10.0),
                    of("t_c/1", 1.0, 0.0, 0.1), of("float, slow", 0.01, 0.01, 20.0)};
  CostPoint& failed = results.points[2];
  failed.error.reset();
  failed.status = Status::failed;
  failed.reason = "NaN, at 3";
  results.points[3].knob = "precision";
  results.points[0].worst = 0.3;
  results.points[0].timeLow = 0.5;
  results.points[0].timeHigh = 2.0;
  results.fronts = {{CostKind::collision, "psi_f", "", {0, 1}, {}}};
  return results;
}

TEST(CostCsv, Rows_AreAllPointsAlsoThoseThatFailed) {
  EXPECT_EQ(
      costCsv(byHand()),
      "engine,setting,dt_s,error,error_kind,wall_s,cpu_s,steps,contact_evaluations,status,"
      "reason,knob,measure,statistical,systematic,reference_error,steps_per_contact,on_front,low,"
      "high,equivalent,bound,worst,time_low_s,time_high_s,tied\n"
      "a,t_c/10,0.1,0.1,collision,1,1,100,200,ran,,time_step,psi_f,,,,10,yes,,,,,0.3,0.5,2,no\n"
      "a,t_c/100,0.01,0.01,collision,10,10,100,200,ran,,time_step,psi_f,,,,100,yes,,,,,,,,no\n"
      "a,t_c/1,1,,collision,0.1,0.1,100,200,failed,\"NaN, at 3\",time_step,psi_f,,,,1,,,,,,,,,\n"
      "a,\"float, slow\",0.01,0.01,collision,20,20,100,200,ran,,precision,psi_f,,,,100,no,,,,,,,,"
      "\n");
  EXPECT_EQ(std::ranges::count(costCsv({}), '\n'), 1);
}

const Curve* curveOf(const Panel& panel, int pointType, Draw draw) {
  for (const Curve& curve : panel.curves)
    if (curve.style.pointType == pointType && curve.draw == draw) return &curve;
  return nullptr;
}

TEST(CostFigures, Panel_JoinsStepsNumbersOtherSettingsAndCrossesFailures) {
  const int mark = engineStyles(byHand().engines).front().pointType;  // open: its predecessor
  const auto figures = costFigures(byHand());
  ASSERT_EQ(figures[1].name, "cost_collision");
  const Panel& panel = figures[1].panels[0];
  EXPECT_TRUE(panel.logX && panel.logY);
  const Curve& front = panel.curves[0];
  ASSERT_EQ(front.points.size(), 3u);  // 10 % from 1 s on, 1 % from 10 s on
  EXPECT_EQ(front.points[1].x, 10.0);
  EXPECT_EQ(front.points[1].y, 0.1);
  const Curve* steps = curveOf(panel, mark, Draw::linesAndPoints);
  ASSERT_TRUE(steps);
  EXPECT_EQ(steps->name, "a");
  EXPECT_EQ(steps->points.size(), 2u);
  const Curve* others = curveOf(panel, mark - 1, Draw::points);
  ASSERT_TRUE(others);
  EXPECT_EQ(others->points[0].label, "1");
  EXPECT_TRUE(has(figures[1].caption, "other settings: 1 precision float, slow."));
  const Curve* crosses = curveOf(panel, 2, Draw::points);
  ASSERT_TRUE(crosses);
  EXPECT_EQ(crosses->points[0].x, 0.1);
  EXPECT_GT(crosses->points[0].y, 0.1);  // above every error, on the panel
  EXPECT_LT(crosses->points[0].y, panel.yRange->high);
  EXPECT_TRUE(costFigures({}).empty());
}

/// A point that is on the front since its time may be the shorter one, and errs more.
TEST(CostCsv, PointOnTheFrontByATie_IsMarkedAndNotDrawn) {
  CostResults results = byHand();
  results.points[1].timeLow = 0.9;
  results.points[1].timeHigh = 12.0;
  EXPECT_TRUE(has(costCsv(results), "10,yes,,,,,0.3,0.5,2,yes\n"));
  results.points[1].cpuSeconds = 0.9;
  results.fronts[0].points = {1, 0};
  EXPECT_EQ(costFigures(results)[1].panels[0].curves[0].points.size(), 1u);
}

TEST(CostFigures, ErrorBelowTheReferences_IsDrawnAtItsUpperEnd) {
  CostResults results = byHand();
  results.points[1].referenceError = 0.03;
  const auto figures = costFigures(results);
  const Panel& panel = figures[1].panels[0];
  EXPECT_EQ(panel.shadedTo, 0.03);
  const Curve* chance = curveOf(panel, 10, Draw::points);
  ASSERT_TRUE(chance);
  EXPECT_NEAR(chance->points[0].y, 0.04, 1e-15);
  results.points[1].referenceError = 1e-9;  // below the axis
  EXPECT_FALSE(costFigures(results)[1].panels[0].shadedTo);
}

/// An endpoint at three steps, margin 0.05: the ring is at the largest whose interval lies inside.
TEST(CostFigures, Picture_HasMarginIntervalsAndTheLargestStepInside) {
  CostResults results = byHand();
  for (CostPoint& point : results.points) {
    point.kind = CostKind::averages;
    point.measure = "discharge";
    point.statistical = 1e-3;
  }
  results.points[1].intervalLow = 0.005;
  results.points[1].intervalHigh = 0.06;  // of t_c/100: reaches beyond
  CostPoint& fine = results.points.emplace_back(results.points[1]);
  fine.setting = "t_c/400";
  fine.fragment = "run.steps_per_contact = 400";
  fine.dt = 0.0025;
  fine.cpuSeconds = 40.0;
  fine.intervalHigh = 0.03;
  results.margins = {{"discharge", 0.05}};
  const auto figures = costFigures(results);
  ASSERT_EQ(figures[0].name, "cost_picture_discharge");
  const Panel& panel = figures[0].panels[0];
  EXPECT_EQ(panel.shadedTo, 0.05);
  const Curve& line = panel.curves[0];
  EXPECT_EQ(line.name, "a");
  EXPECT_EQ(line.points.size(), 3u);
  const Curve& rings = panel.curves.back();
  ASSERT_EQ(rings.points.size(), 1u);
  EXPECT_EQ(rings.points[0].x, 40.0);
  EXPECT_EQ(rings.points[0].label, "t_c/400");
  const auto bar = std::ranges::find_if(panel.curves, [](const Curve& curve) {
    return curve.draw == Draw::lines && curve.points[0].x == 40.0;
  });
  ASSERT_NE(bar, panel.curves.end());
  EXPECT_EQ(bar->points[1].y, 0.03);
}

/// The engine of byHand() with another law: 25 % off, whatever the step.
TEST(CostOverview, Answer_HasStepTimeAndWhatStandsInTheWay) {
  CostResults results = byHand();
  results.models = {{"a", CostKind::collision, "psi_f", 0.25, 0.24, 0.26}};
  results.cells = {{{}, "a", CostKind::collision, CostBasis::scene, 0.1, Verdict::pass},
                   {{}, "a", CostKind::collision, CostBasis::scene, 0.01, Verdict::fail}};
  Advice reached, off;
  reached.engine = off.engine = "a";
  reached.target = 0.1;
  reached.verdict = Verdict::pass;
  reached.knob = "time_step";
  reached.setting = "t_c/10";
  reached.kinds = {CostKind::collision};
  reached.cpuSeconds = 1.0;
  reached.cheapest = true;
  off.target = 0.01;
  off.verdict = Verdict::fail;
  off.model = 0;
  results.advice = {reached, off};
  results.largestSteps = {{"a", CostKind::averages, 0.1, 1.0, 1.0}};
  const Overview overview = reportOf(results).overview;
  const auto& cells = overview.rows[0].cells;
  ASSERT_EQ(cells.size(), 3u);
  EXPECT_EQ(cells[0].value, 0.1);
  EXPECT_TRUE(has(cells[0].words, "t_c/10; unstable at 1.00 s")) << cells[0].words;
  EXPECT_EQ(cells[1].shown, "t_c/10");
  EXPECT_EQ(cells[1].words, "0.100 s; 1.00 s; the cheapest engine");
  EXPECT_EQ(cells[2].verdict, Verdict::modelDifference);
  EXPECT_EQ(cells[2].shown, "25 % off");
  EXPECT_EQ(cells[2].words, "Ψ_f, whatever the step");
  EXPECT_TRUE(has(overview.conclusion.front(),
                  "10 %: a with t_c/10 (step 0.100 s; 1.00 s for one sweep of collisions); 1 %: no "
                  "setting (3 tried)"))
      << overview.conclusion.front();
}

/// Budgets are those that the option takes, and come before what else there is to say.
TEST(CostOverview, EndpointsWithoutRoom_ComeFirstWithTheirBudget) {
  CostResults results = byHand();
  results.budget = 60.0;
  results.budgetForTheRest = 172'330.0;
  results.missingAnswers = {{"a", 61.5}, {"b", 7'190.0}};
  results.points[1].status = Status::notRun;
  const auto conclusion = reportOf(results).overview.conclusion;
  EXPECT_EQ(conclusion.front(),
            "No endpoint of the scene was measured within the budget of 1 min 00 s; predicted: "
            "--budget 62s for a and --budget 120m for b. Sizes and threads were not timed.");
  EXPECT_TRUE(has(conclusion.back(), "with --budget 48h measures the 1 point "))
      << conclusion.back();
  results.points[0].kind = CostKind::averages;
  results.missingAnswers.erase(results.missingAnswers.begin());
  EXPECT_EQ(reportOf(results).overview.conclusion.front(),
            "No endpoint of b was measured within the budget of 1 min 00 s; predicted: --budget "
            "120m for b.");
  results.missingAnswers.insert(results.missingAnswers.begin(), {"a", 14.6});
  EXPECT_EQ(reportOf(results).overview.conclusion.front(),
            "No endpoint of a and b was measured within the budget of 1 min 00 s; predicted: the "
            "same command again for a, as what ran longer than predicted is kept and --budget 120m "
            "for b.");
  results.missingAnswers.clear();
  EXPECT_FALSE(has(reportOf(results).overview.conclusion.front(), "No endpoint"));
}

TEST(CostToml, AdviceForTheTarget_IsAFragmentWithCommentsAlone) {
  CostResults results = byHand();
  results.target = 0.1;
  Advice advice;
  advice.engine = "a";
  advice.target = 0.1;
  advice.verdict = Verdict::pass;
  advice.knob = "time_step";
  advice.setting = "t_c/10";
  advice.fragment = "[run]\nsteps_per_contact = 10\n";
  advice.kinds = {CostKind::collision, CostKind::averages};
  advice.wallSeconds = 800.0;
  advice.cheapest = true;
  results.advice = {advice};
  EXPECT_EQ(costToml(results),
            "# a, wanted 10 %: reached by t_c/10, 800 s of wall time per second of the scene "
            "(measured in "
            "collision and averages); the cheapest engine\n[run]\nsteps_per_contact = 10\n");
  results.advice[0].cpuSeconds = 700.0;
  results.advice[0].ties = {{"time_step", "t_c/20"}, {"precision", "float"}};
  results.advice.push_back(results.advice[0]);
  results.advice[1].engine = "b";
  EXPECT_TRUE(has(
      costToml(results),
      "reached by t_c/10, 700 s of processor time per second of the scene (measured in collision "
      "and averages); a tie with t_c/20 or precision float; the cheapest engine, a tie "
      "with b\n[run]"));
  results.advice.pop_back();
  results.advice[0].ties.clear();
  results.advice[0].obstacle = 0;
  results.advice[0].decides = "more packings";
  EXPECT_TRUE(has(costToml(results),
                  "# collision, psi_f: 0.100 of its scale, which does not decide\n"
                  "# what would decide: more packings\n[run]\n"));
  results.advice[0].verdict = Verdict::notMeasured;
  EXPECT_TRUE(has(costToml(results), "not measured far enough; the best so far is t_c/10"));
  results.models = {{"a", CostKind::collision, "psi_f", 0.25, 0.24, 0.26}};
  results.advice[0].verdict = Verdict::fail;
  results.advice[0].model = 0;
  EXPECT_TRUE(has(costToml(results),
                  "# collision, Ψ_f: its limit of small steps is off by 25.0 % (24.0 to 26.0)\n"));
  results.advice[0].verdict = Verdict::notMeasured;
  EXPECT_FALSE(has(costToml(results), "[run]"));
  results.target = 0.01;
  EXPECT_EQ(costToml(results), "");
}

/// Few settings show little: how many there were is said with "not reached".
TEST(CostToml, NotReached_SaysOfHowManySettings) {
  CostResults results = byHand();
  results.target = 0.1;
  Advice advice;
  advice.engine = results.points.front().engine;
  advice.target = 0.1;
  advice.verdict = Verdict::fail;
  advice.knob = "time_step";
  advice.setting = "t_c/10";
  results.advice = {advice};
  std::set<std::pair<std::string, std::string>> tried;
  for (const CostPoint& point : results.points)
    if (point.engine == advice.engine && point.measured()) tried.emplace(point.knob, point.setting);
  const std::string best =
      fmt::format("the best of {} setting{} is t_c/10", tried.size(), tried.size() == 1 ? "" : "s");
  EXPECT_TRUE(has(costToml(results), "not reached, " + best)) << costToml(results);
  results.cells = {{{}, advice.engine, CostKind::averages, CostBasis::scene, 0.1}};
  EXPECT_TRUE(has(textOf(reportOf(results)), "10 %: no setting ("));
}

}  // namespace
}  // namespace crossgrain::reports

// Fronts, advice and cells of made-up points.
#include "studies/cost/analysis.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace crossgrain;

using Points = std::vector<CostPoint>;
using Places = std::vector<std::size_t>;

CostPoint at(double error, std::optional<double> time, const std::string& setting = "t_c/50",
             const std::string& measure = "psi_f") {
  CostPoint point;
  point.engine = "a";
  point.knob = "time_step";
  point.setting = setting;
  point.fragment = "[run]\n# " + setting + "\n";
  point.measure = measure;
  point.dt = time ? 1.0 / *time : 1.0;
  point.error = error;
  point.wallSeconds = time;
  return point;
}

/// Of averages, ± standard error.
CostPoint average(CostPoint point, double error, std::optional<double> statistical) {
  point.kind = CostKind::averages;
  point.measure = "stress_rr";
  point.error = error;
  point.statistical = statistical;
  *point.wallSeconds *= 100.0;
  return point;
}

CostPoint without(CostPoint point, Status status, const std::string& reason) {
  point.status = status;
  point.reason = reason;
  point.error.reset();
  return point;
}

CostPoint of(const std::string& engine, CostPoint point) {
  point.engine = engine;
  return point;
}

/// Error 4⁻ᵏ at t_c/2ᵏ in 2ᵏ s, k = 1 … 4; averages the same + `bias` ± `statistical`.
Points ladder(double bias, std::optional<double> statistical) {
  Points points;
  for (int k = 1; k <= 4; ++k)
    points.push_back(at(std::pow(4.0, -k), std::pow(2.0, k), "t_c/" + std::to_string(1 << k)));
  for (int k = 0; k < 4; ++k)
    points.push_back(average(points[static_cast<std::size_t>(k)],
                             *points[static_cast<std::size_t>(k)].error + bias, statistical));
  return points;
}

TEST(CostPoint, Interval_OfStatisticalAndReferenceError_IsTheirSum) {
  CostPoint point = at(0.1, 1.0);
  point.statistical = 0.02;
  point.referenceError = 0.01;
  EXPECT_EQ(*point.counted(), 0.1);
  EXPECT_NEAR(point.low(), 0.07, 1e-15);
  EXPECT_NEAR(point.high(), 0.13, 1e-15);
  point.error = 0.015;  // below its standard error: counts with its upper end
  EXPECT_TRUE(point.mayBeChance());
  EXPECT_NEAR(*point.counted(), 0.045, 1e-15);
  EXPECT_EQ(point.low(), 0.0);
  point.intervalLow = 0.001;
  point.intervalHigh = 0.05;
  EXPECT_EQ(point.low(), 0.001);
  EXPECT_EQ(point.high(), 0.05);
}

TEST(CostPoint, AverageOfOnePacking_HasNoStatisticalError_CountsNowhere) {
  const CostPoint one = average(at(0.0, 1.0), 0.001, {});
  EXPECT_FALSE(one.counted());
  EXPECT_TRUE(paretoFront({one}).empty());
  EXPECT_EQ(one.low(), 0.0);
  EXPECT_TRUE(std::isinf(one.high()));
  const CostCell cell = costCells({one}, {}, {0.01}).front();
  EXPECT_EQ(cell.verdict, Verdict::undecided);
  EXPECT_EQ(cell.decides, "more packings: one shows no statistical error");
  EXPECT_EQ(average(at(0.0, 1.0), 0.001, 1e-4).counted(), 0.001);
}

TEST(CostFront, Points_NoneOtherBeatsInBoth_AreOnIt) {
  const Points points = {
      at(0.1, 1.0),  at(0.2, 2.0), at(0.05, 2.0), at(0.05, 3.0),
      at(0.01, 4.0), at(0.5, 0.5), at(1e-6, {}),  without(at(0.0, 0.1), Status::failed, "NaN")};
  EXPECT_EQ(paretoFront(points), (Places{5, 0, 2, 4}));
  EXPECT_EQ(paretoFront({at(0.1, 1.0), at(0.1, 1.0)}), (Places{0, 1}));  // equal in both
  EXPECT_EQ(paretoFront({at(0.3, 1.0), at(0.1, 1.0), at(0.2, 1.0)}), (Places{1}));
  CostPoint chance = at(0.01, 1.0);
  chance.statistical = 0.2;
  EXPECT_EQ(paretoFront({chance, at(0.1, 1.0)}), (Places{1}));
}

TEST(CostFront, SeveralEnginesAndMeasures_HaveOneEachAndOneOverAll) {
  const Points points = {of("slow", at(0.1, 2.0)), of("slow", at(0.01, 4.0)),
                         of("fast", at(0.1, 1.0)), of("slow", at(0.1, 2.0, "t_c/2", "e_n"))};
  const auto fronts = paretoFronts(points);
  ASSERT_EQ(fronts.size(), 5u);
  EXPECT_EQ(fronts[0].engine, "");
  EXPECT_EQ(fronts[0].points, (Places{2, 1}));
  EXPECT_EQ(fronts[0].errors, (std::vector<double>{0.1, 0.01}));
  EXPECT_EQ(fronts[1].engine, "slow");
  EXPECT_EQ(fronts[1].points, (Places{0, 1}));
  EXPECT_EQ(fronts[2].engine, "fast");
  EXPECT_EQ(fronts[3].measure, "e_n");
  EXPECT_EQ(fronts[4].points, (Places{3}));
}

/// Of the basis of the case's law, unless said.
CostCell cellOf(const Points& points, double target, const std::vector<CostModel>& models = {},
                CostBasis basis = CostBasis::scene) {
  for (const CostCell& cell : costCells(points, models, {target}))
    if (cell.basis == basis) return cell;
  throw std::runtime_error("no such cell");
}

Points collisions() {
  Points points = ladder(0.0, 0.0);
  points.resize(4);
  return points;
}

TEST(CostCells, SeveralSettingsMeetTheTarget_CheapestIsNamed) {
  const CostCell cell = cellOf(collisions(), 0.02);  // 4⁻³ = 0.0156
  EXPECT_EQ(cell.verdict, Verdict::pass);
  EXPECT_EQ(cell.setting, "t_c/8");
  EXPECT_EQ(cell.wallSeconds, 8.0);
  EXPECT_EQ(cell.point, 2u);
  EXPECT_TRUE(costCells({}, {}).empty());
}

TEST(CostCells, LowerEndsAboveTheTarget_OfAllSettings_NotReached) {
  const CostCell cell = cellOf(collisions(), 0.001);
  EXPECT_EQ(cell.verdict, Verdict::fail);
  EXPECT_EQ(cell.setting, "t_c/16");
  EXPECT_EQ(cell.decides, "");
  EXPECT_EQ(cellOf({at(0.01, {}), at(0.01, 5.0)}, 0.1).wallSeconds, 5.0);  // a time that is known
}

TEST(CostCells, IntervalHoldsTheTarget_UndecidedAndSaysWhatWouldDecide) {
  CostPoint point = average(at(0.008, 1.0), 0.008, 0.004);
  EXPECT_EQ(cellOf({point}, 0.01).verdict, Verdict::undecided);
  // Its statistical part must fall from 0.004 to 0.002: 4 times as long.
  EXPECT_EQ(cellOf({point}, 0.01).decides, "4.0 times as much simulated time");
  point.error = 0.01;
  EXPECT_EQ(cellOf({point}, 0.01).decides, "nothing: the error is the target");
  point = at(0.008, 1.0);
  point.referenceError = 0.005;
  EXPECT_EQ(cellOf({point}, 0.01).decides, "a reference known to 2.0e-03");
  point.statistical = 0.005;
  EXPECT_EQ(cellOf({point}, 0.01).decides,
            "a reference known to better than 2.0e-03 and more simulated time");
  point = at(0.008, 1.0);
  point.intervalLow = 0.007;
  point.intervalHigh = 0.012;
  EXPECT_EQ(cellOf({point}, 0.01).verdict, Verdict::undecided);
  EXPECT_EQ(cellOf({point}, 0.01).decides, "more collisions: a larger cost.psi_count");
}

TEST(CostCells, SettingNotRunThatMayDoBetter_NotMeasured) {
  Points points = collisions();
  points[3] = without(points[3], Status::notRun, "would take about 90 s");
  CostCell cell = cellOf(points, 0.005);
  EXPECT_EQ(cell.verdict, Verdict::notMeasured);
  EXPECT_EQ(cell.decides, "t_c/16, which was not run: would take about 90 s");
  points[3].dt = 10.0;  // a larger step would not help
  EXPECT_EQ(cellOf(points, 0.005).verdict, Verdict::fail);
  points[3].knob = "precision";  // another setting may
  EXPECT_EQ(cellOf(points, 0.005).verdict, Verdict::notMeasured);
  for (CostPoint& point : points) point = without(point, Status::notRun, "would take about 90 s");
  EXPECT_EQ(cellOf(points, 0.5).decides,
            "t_c/2 and 3 more, which were not run: would take about 90 s");
  EXPECT_EQ(cellOf({without(at(0.0, 1.0), Status::failed, "NaN")}, 0.1).verdict,
            Verdict::notMeasured);
  EXPECT_EQ(cellOf({without(at(0.0, 1.0), Status::refused, "it has no limit")}, 0.1).decides,
            "it has no limit");
}

/// Another integrator has its steps, too: none beyond 2/ω is named, and the smaller one is.
TEST(CostCells, StepBeyondTheStabilityLimit_DoesNotDecide) {
  Points points = collisions();
  for (const double perContact : {1.2, 2.0, 400.0}) {
    CostPoint left = without(at(0.0, 1.0), Status::notRun, "would take about 90 s");
    left.knob = "integrator";
    left.setting = fmt::format("velocity_verlet, t_c/{:g}", perContact);
    left.stepsPerContact = perContact;
    left.dt = 1.0 / perContact;
    points.push_back(left);
  }
  EXPECT_EQ(cellOf(points, 0.001).decides,
            "velocity_verlet, t_c/400 and 1 more, which were not run: would take about 90 s");
  points.resize(points.size() - 2);  // that of t_c/1.2 is left
  EXPECT_EQ(cellOf(points, 0.001).verdict, Verdict::fail);
}

TEST(CostCells, SettingWithoutAMeasure_IsNotRecommended) {
  Points points = {at(0.005, 1.0, "t_c/10"), at(0.05, 1.0, "t_c/10", "e_n"),
                   at(0.001, 4.0, "t_c/40")};
  EXPECT_EQ(cellOf(points, 0.01).verdict, Verdict::notMeasured);
  EXPECT_EQ(cellOf(points, 0.01).decides, "a setting that was measured in every measure");
  points.push_back(at(0.02, 4.0, "t_c/40", "e_n"));
  EXPECT_EQ(cellOf(points, 0.01).verdict, Verdict::fail);
  EXPECT_EQ(cellOf(points, 0.01).point, 3u);  // the best setting's largest error
  EXPECT_EQ(cellOf(points, 0.03).setting, "t_c/40");
}

/// Discretisation falls as 4⁻ᵏ; a law that is 25 % off stays there.
Points ofAnotherLaw() {
  return {at(0.28, 1.0, "t_c/10"), at(0.252, 4.0, "t_c/40"), at(0.05, 1.0, "t_c/10", "psi_f_own"),
          at(0.004, 4.0, "t_c/40", "psi_f_own")};
}

TEST(CostCells, ModelErrorAboveTheTarget_NotReachedButOwnLimitIs) {
  CostModel model{"a", CostKind::collision, "psi_f", 0.25, 0.249, 0.251};
  Points points = ofAnotherLaw();
  const CostCell own = cellOf(points, 0.01, {model}, CostBasis::own);
  EXPECT_EQ(own.verdict, Verdict::pass);
  EXPECT_EQ(own.setting, "t_c/40");
  EXPECT_FALSE(own.model);
  EXPECT_EQ(cellOf(points, 0.1, {model}).verdict, Verdict::fail);
  EXPECT_EQ(cellOf(points, 0.1, {model}).model, 0u);
  EXPECT_EQ(cellOf(points, 0.3, {model}).verdict, Verdict::pass);
  for (CostPoint& point : points) point.referenceError = 0.3;  // nothing is decided by settings
  EXPECT_EQ(cellOf(points, 0.1).verdict, Verdict::undecided);
  EXPECT_EQ(cellOf(points, 0.1, {model}).verdict, Verdict::fail);
  model.low = 0.1;  // it may be below
  EXPECT_EQ(cellOf(points, 0.1, {model}).verdict, Verdict::undecided);
}

/// YADE of issue "want-contradicts-cells": the step errs by 27 % of its own limit, the model by
/// 26 %, with opposite signs at t_c/10 and as they add up at t_c/400.
TEST(CostCells, StepErrorThatCancelsTheModels_IsNeverTheBest) {
  const CostModel model{"a", CostKind::collision, "psi_f", 0.26, 0.259, 0.261};
  const Points points = {at(0.035, 1.0, "t_c/10"), at(0.27, 1.0, "t_c/10", "psi_f_own"),
                         at(0.2605, 40.0, "t_c/400"), at(0.002, 40.0, "t_c/400", "psi_f_own")};
  for (const double target : {0.1, 0.01}) {
    const CostCell cell = cellOf(points, target, {model});
    const Advice one = advice(points, {model}, {target}).front();
    EXPECT_EQ(cell.verdict, Verdict::fail);
    EXPECT_EQ(cell.setting, "t_c/400");
    EXPECT_EQ(one.verdict, cell.verdict);
    EXPECT_EQ(one.setting, cell.setting);
    EXPECT_EQ(one.model, 0u);
  }
  // By its step's error alone, where nothing is known of the model; then there is no best.
  const Points coarse(points.begin(), points.begin() + 2);
  EXPECT_EQ(cellOf(coarse, 0.1).verdict, Verdict::fail);
  EXPECT_EQ(cellOf(coarse, 0.1).setting, "");
  EXPECT_EQ(advice(coarse, {}, {0.1}).front().setting, "");
  // 0.27 + 0.261 of both parts: reached whatever their signs.
  EXPECT_EQ(cellOf(points, 0.55, {model}).setting, "t_c/10");
  EXPECT_EQ(cellOf(points, 0.3, {model}).setting, "t_c/400");
  // Another law may be nearer to the case's than the engine's own.
  Points other = points;
  other[0].knob = "tangential";
  EXPECT_EQ(cellOf(other, 0.1, {model}).setting, "t_c/10");
}

TEST(CostAdvice, KindThatIsShownNotToReach_DecidesWhateverIsLeftToRun) {
  const CostModel model{"a", CostKind::collision, "psi_f", 0.26, 0.259, 0.261};
  Points points = {at(0.262, 1.0, "t_c/10"), average(at(0.0, 1.0, "t_c/10"), 0.05, 0.001)};
  points.push_back(without(average(at(0.0, 2.0, "t_c/20"), 0.0, {}), Status::notRun, "too slow"));
  EXPECT_EQ(cellOf(points, 0.1, {model}).verdict, Verdict::fail);
  EXPECT_EQ(advice(points, {model}, {0.01}).front().verdict, Verdict::fail);
  EXPECT_EQ(advice(points, {}, {0.01}).front().verdict, Verdict::fail);  // 0.262 at every step
}

/// Wall time that other work adds to, processor time with its interval.
CostPoint timed(CostPoint point, double wall, double cpu, double spread) {
  point.wallSeconds = wall;
  point.cpuSeconds = cpu;
  point.timeLow = cpu / spread;
  point.timeHigh = cpu * spread;
  return point;
}

TEST(CostTime, ProcessorTimeRanks_WallTimeDoesNot) {
  const Points points = {timed(at(0.01, {}, "t_c/100"), 1.66, 0.98, 1.05),
                         timed(at(0.01, {}, "t_c/50"), 13.0, 0.63, 1.05)};
  EXPECT_EQ(cellOf(points, 0.1).setting, "t_c/50");
  EXPECT_EQ(*cellOf(points, 0.1).time(), 0.63);
  EXPECT_TRUE(cellOf(points, 0.1).ties.empty());
  EXPECT_EQ(paretoFront(points), (Places{1}));
  CostPoint silent = points[0];  // an engine that does not report it
  silent.cpuSeconds = 0.0;
  EXPECT_EQ(*silent.time(), 1.66);
}

TEST(CostTime, IntervalsThatOverlap_AreATieInCellsAdviceAndFronts) {
  Points points = {timed(at(0.04, {}, "t_c/100"), 1.0, 1.0, 1.2),
                   timed(at(0.01, {}, "t_c/200"), 1.0, 1.1, 1.2),
                   timed(at(0.001, {}, "t_c/400"), 1.0, 2.0, 1.2)};
  for (std::size_t k = 0; k < points.size(); ++k) points[k].dt = 0.04 / (1 << k);
  const CostCell cell = cellOf(points, 0.1);
  EXPECT_EQ(cell.setting, "t_c/100");
  EXPECT_EQ(cell.ties, (std::vector<TiedSetting>{{"time_step", "t_c/200"}}));
  EXPECT_EQ(advice(points, {}, {0.1}).front().ties, cell.ties);
  EXPECT_TRUE(cellOf(points, 0.02).ties.empty());  // t_c/100 does not reach it
  EXPECT_EQ(paretoFront(points), (Places{0, 1, 2}));
  Points turned = points;  // another run, in which the smaller step was the faster: the same advice
  std::swap(turned[0].cpuSeconds, turned[1].cpuSeconds);
  EXPECT_EQ(cellOf(turned, 0.1).setting, "t_c/100");
  EXPECT_EQ(cellOf(turned, 0.1).ties, cell.ties);
  Points engines = points;
  engines[1].engine = "b";
  engines[2].engine = "c";
  const auto all = advice(engines, {}, {0.1});
  for (const Advice& one : all) EXPECT_EQ(one.cheapest, one.engine != "c") << one.engine;
}

TEST(CostAdvice, CollisionsAndAveragesMeetTheTarget_CheapestIsNamedWithTimeOfAverages) {
  const Advice one = advice(ladder(0.05, 0.002), {}, {0.1}).front();
  EXPECT_EQ(one.verdict, Verdict::pass);
  EXPECT_EQ(one.setting, "t_c/8");  // 1/64 + 0.052; 1/16 + 0.052 is above 0.1
  EXPECT_EQ(one.fragment, "[run]\n# t_c/8\n");
  EXPECT_EQ(one.kinds, (std::vector{CostKind::collision, CostKind::averages}));
  EXPECT_EQ(one.costKind(), CostKind::averages);
  EXPECT_NEAR(*one.wallSeconds, 800.0, 1e-9);
  EXPECT_NEAR(*one.length, 4e-4, 1e-12);  // (0.002/0.1)²
  EXPECT_FALSE(one.obstacle);
  EXPECT_TRUE(one.cheapest);
  EXPECT_TRUE(advice({}, {}, {0.5}).empty());
}

TEST(CostAdvice, AveragesContradict_NotReached) {
  const Points points = ladder(0.05, 0.002);
  const Advice one = advice(points, {}, {0.01}).front();
  EXPECT_EQ(one.verdict, Verdict::fail);
  EXPECT_EQ(one.setting, "t_c/16");
  EXPECT_EQ(one.obstacle, 7u);  // averages at that step: 0.052 to 0.056
  EXPECT_FALSE(one.cheapest);
  // A setting that one kind does not measure does not keep it open.
  Points more = points;
  more.push_back(at(1e-4, 1.0, "velocity_verlet, t_c/8"));
  more.back().knob = "integrator";
  EXPECT_EQ(advice(more, {}, {0.01}).front().verdict, Verdict::fail);
}

TEST(CostAdvice, AveragesCannotDecide_CollisionsDoAndTheOpenAverageIsNamed) {
  const Points points = ladder(0.0, 0.02);
  const Advice one = advice(points, {}, {0.01}).front();
  EXPECT_EQ(one.verdict, Verdict::pass);
  EXPECT_EQ(one.setting, "t_c/16");
  EXPECT_EQ(one.obstacle, 7u);
  // 4⁻⁴ = 0.0039 ± 0.02: the scatter must fall to 0.0061, (0.02/0.0061)² = 10.8
  EXPECT_EQ(one.decides, "10.8 times as much simulated time");
  // Where only averages are measured, these have to show it.
  const Points averages(points.begin() + 4, points.end());
  EXPECT_EQ(advice(averages, {}, {0.01}).front().verdict, Verdict::undecided);
  EXPECT_EQ(advice(averages, {}, {0.1}).front().verdict, Verdict::pass);
}

TEST(CostAdvice, AveragesOfOnePacking_AreNoPartOfIt) {
  const Points points = ladder(0.0, {});
  const Advice one = advice(points, {}, {0.1}).front();
  EXPECT_EQ(one.verdict, Verdict::pass);
  EXPECT_EQ(one.kinds, std::vector{CostKind::collision});
  EXPECT_FALSE(one.obstacle);
  EXPECT_EQ(one.decides, "more packings: one shows no statistical error");
  const Advice alone = advice({points.begin() + 4, points.end()}, {}, {0.1}).front();
  EXPECT_EQ(alone.verdict, Verdict::notMeasured);
  EXPECT_EQ(alone.decides, one.decides);
}

TEST(CostAdvice, SmallerStepNotRun_NotMeasured) {
  Points points = ladder(0.05, 0.002);
  CostPoint left = points.back();
  *left.dt *= 0.5;
  left.setting = "half of it";
  points.push_back(without(left, Status::notRun, "would take about 90 s"));
  const Advice one = advice(points, {}, {0.01}).front();
  EXPECT_EQ(one.verdict, Verdict::notMeasured);
  EXPECT_EQ(one.decides, "half of it, which was not run: would take about 90 s");
  EXPECT_EQ(advice(points, {}, {0.1}).front().verdict, Verdict::pass);
}

TEST(CostAdvice, SettingMeasuredInOneKindOnly_IsNotRecommended) {
  Points points = ladder(0.0, 0.001);
  points.erase(points.begin() + 4, points.end() - 1);  // averages at the smallest step only
  EXPECT_EQ(advice(points, {}, {0.5}).front().setting, "t_c/16");
  points.back().setting = "another";
  EXPECT_EQ(advice(points, {}, {0.5}).front().verdict, Verdict::notMeasured);
}

TEST(CostAdvice, SeveralEngines_CheapestIsOfThoseMeasuredInMostKinds) {
  Points points;
  for (CostPoint point : ladder(0.0, 0.001)) {
    points.push_back(of("fast", point));
    *point.wallSeconds *= 2.0;
    points.push_back(of("slow", point));
    *point.wallSeconds *= 1e-3;
    if (point.kind == CostKind::collision) points.push_back(of("collisions only", point));
  }
  const auto all = advice(points, {}, {0.1});
  ASSERT_EQ(all.size(), 3u);
  for (const Advice& one : all) EXPECT_EQ(one.cheapest, one.engine == "fast") << one.engine;
}

/// Whole runs at 1, 2, 4 and 8 µs, of which that of 4 fails and that of 8 survives by chance.
TEST(CostLargestStep, LiesBelowTheSmallestThatFails) {
  Points points;
  for (const double dt : {1e-6, 2e-6, 4e-6, 8e-6}) {
    CostPoint& point = points.emplace_back();
    point.engine = "a";
    point.knob = "time_step";
    point.kind = CostKind::averages;
    point.dt = dt;
    point.stepsPerContact = 1e-4 / dt;
    if (dt == 4e-6) point.status = Status::failed;
  }
  points.push_back(points.front());
  points.back().kind = CostKind::trajectory;  // whole runs count before windows
  points.back().dt = 16e-6;
  const auto found = largestSteps(points);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].stable, 2e-6);
  EXPECT_EQ(found[0].unstable, 4e-6);
  EXPECT_NEAR(*found[0].contactTime, 1e-4, 1e-16);
  // Where of whole runs there is but the one that failed, paths show what is stable below it.
  points.back().dt = 1e-6;
  const auto paths = largestSteps({points[2], points.back()});
  ASSERT_EQ(paths.size(), 1u);
  EXPECT_EQ(paths[0].kind, CostKind::trajectory);
  EXPECT_EQ(paths[0].stable, 1e-6);
  EXPECT_EQ(paths[0].unstable, 4e-6);
  for (CostPoint& point : points) point.knob = "precision";
  EXPECT_TRUE(largestSteps(points).empty());
}

/// Nothing may touch along a path: a disk that falls bears any step.
TEST(CostLargestStep, OfPathsIsOneThatCollisionsBear) {
  Points points;
  for (const CostKind kind : {CostKind::trajectory, CostKind::collision})
    for (const double dt : {1e-6, 2e-6, 4e-6}) {
      CostPoint& point = points.emplace_back();
      point.engine = "a";
      point.knob = "time_step";
      point.kind = kind;
      point.dt = dt;
      if (kind == CostKind::collision && dt == 4e-6) point.status = Status::failed;
    }
  EXPECT_EQ(largestSteps(points).at(0).stable, 2e-6);
  EXPECT_EQ(largestSteps(points).at(0).unstable, 4e-6);
  // Of the step that failed nothing follows while shorter ones have not been run.
  for (CostPoint& point : points)
    if (point.kind == CostKind::trajectory) point.status = Status::notRun;
  EXPECT_TRUE(largestSteps(points).empty());
}

}  // namespace

// Which setting reaches an accuracy, cell by cell: engine, kind of error, basis, target.
#include "runs/cost/cost_cells.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "runs/cost/target.hpp"

namespace {

using namespace crossgrain;

CostPoint at(const std::string& setting, const std::string& measure, double error, double wall) {
  CostPoint point;
  point.engine = "a";
  point.knob = "time_step";
  point.setting = setting;
  point.measure = measure;
  point.dt = 1.0 / wall;
  point.error = error;
  point.wallSeconds = wall;
  return point;
}

CostCell cellOf(const std::vector<CostPoint>& points, CostBasis basis, double target,
                const std::vector<CostModel>& models = {}) {
  for (const CostCell& cell : costCells(points, models, {target}))
    if (cell.basis == basis) return cell;
  throw std::runtime_error("no such cell");
}

/// Discretisation falls as 4⁻ᵏ; a law that is 25 % off stays there.
std::vector<CostPoint> ofAnotherLaw() {
  return {at("t_c/10", "psi_f", 0.28, 1.0),      at("t_c/20", "psi_f", 0.26, 2.0),
          at("t_c/40", "psi_f", 0.252, 4.0),     at("t_c/10", "psi_f_own", 0.05, 1.0),
          at("t_c/20", "psi_f_own", 0.012, 2.0), at("t_c/40", "psi_f_own", 0.004, 4.0)};
}

TEST(CostCells, KeepAnEnginesModelErrorAndItsDiscretisationApart) {
  const CostModel model{"a", CostKind::collision, "psi_f", 0.25, 0.249, 0.251};
  const CostCell own = cellOf(ofAnotherLaw(), CostBasis::own, 0.01, {model});
  EXPECT_EQ(own.verdict, CostVerdict::reached);
  EXPECT_EQ(own.setting, "t_c/40");
  EXPECT_EQ(own.wallSeconds, 4.0);
  EXPECT_EQ(own.point, 5u);
  EXPECT_FALSE(own.model);
  EXPECT_EQ(cellOf(ofAnotherLaw(), CostBasis::own, 0.1).setting, "t_c/10");
  const CostCell scene = cellOf(ofAnotherLaw(), CostBasis::scene, 0.1, {model});
  EXPECT_EQ(scene.verdict, CostVerdict::notReached);
  EXPECT_EQ(scene.model, 0u);
  EXPECT_EQ(cellOf(ofAnotherLaw(), CostBasis::scene, 0.3, {model}).verdict, CostVerdict::reached);
}

TEST(CostCells, AModelErrorAboveTheTargetDecidesWhatNoSettingDoes) {
  auto points = ofAnotherLaw();
  for (CostPoint& point : points) point.referenceError = 0.3;  // nothing is told apart
  EXPECT_EQ(cellOf(points, CostBasis::scene, 0.1).verdict, CostVerdict::undecided);
  CostModel model{"a", CostKind::collision, "psi_f", 0.25, 0.2, 0.3};
  EXPECT_EQ(cellOf(points, CostBasis::scene, 0.1, {model}).verdict, CostVerdict::notReached);
  EXPECT_EQ(cellOf(points, CostBasis::own, 0.1, {model}).verdict, CostVerdict::undecided);
  model.low = 0.1;  // it may be below
  EXPECT_EQ(cellOf(points, CostBasis::scene, 0.1, {model}).verdict, CostVerdict::undecided);
}

/// Of a limit that is 25 % off and a coarse step that is 12 to 18 % off, and one not run.
TEST(CostCells, AModelErrorDecidesNothingWhereACoarseStepMakesUpForIt) {
  const CostModel model{"a", CostKind::collision, "psi_f", 0.25, 0.249, 0.251};
  CostPoint left = at("t_c/5", "psi_f", 0.0, 0.5);
  left.error.reset();
  left.status = CostStatus::notMeasured;
  CostPoint coarse = at("t_c/10", "psi_f", 0.15, 1.0);
  coarse.referenceError = 0.03;
  left.dt = 0.5 * *coarse.dt;
  const CostCell cell = cellOf({coarse, left}, CostBasis::scene, 0.1, {model});
  EXPECT_EQ(cell.verdict, CostVerdict::notMeasured);
  EXPECT_FALSE(cell.model);
  coarse.error = 0.26;
  EXPECT_EQ(cellOf({coarse, left}, CostBasis::scene, 0.1, {model}).verdict,
            CostVerdict::notReached);
}

TEST(CostCells, AskForEveryMeasureOfTheKind) {
  std::vector<CostPoint> points = {at("t_c/10", "psi_f", 0.005, 1.0),
                                   at("t_c/10", "e_n", 0.05, 1.0),
                                   at("t_c/40", "psi_f", 0.001, 4.0)};
  // t_c/40 has no e_n: it may reach what t_c/10 does not.
  CostCell cell = cellOf(points, CostBasis::scene, 0.01);
  EXPECT_EQ(cell.verdict, CostVerdict::notMeasured);
  EXPECT_EQ(cell.decides, "a setting that was measured in every measure");
  points.push_back(at("t_c/40", "e_n", 0.02, 4.0));
  cell = cellOf(points, CostBasis::scene, 0.01);
  EXPECT_EQ(cell.verdict, CostVerdict::notReached);
  EXPECT_EQ(cell.point, 3u);  // the best setting's largest error
  EXPECT_EQ(cellOf(points, CostBasis::scene, 0.03).setting, "t_c/40");
}

TEST(CostCells, OfABasisThatIsRefusedSayWhy) {
  std::vector<CostPoint> points = ofAnotherLaw();
  for (CostPoint& point : points)
    if (isOwn(point.measure)) {
      point.error.reset();
      point.status = CostStatus::refused;
      point.reason = "it has no limit";
    }
  const CostCell cell = cellOf(points, CostBasis::own, 0.1);
  EXPECT_EQ(cell.verdict, CostVerdict::notMeasured);
  EXPECT_EQ(cell.decides, "it has no limit");
  EXPECT_TRUE(costCells({}, {}).empty());
}

/// Averages: 3 % ± 4 % by measurement, from 0 to 12 % at 95 %; bounded by 0.8 %.
CostPoint average(std::optional<double> bound) {
  CostPoint point = at("t_c/50", "stress_rr", 0.03, 1.0);
  point.kind = CostKind::averages;
  point.statistical = 0.04;
  point.low = 0.0;
  point.high = 0.12;
  point.bound = bound;
  return point;
}

TEST(CostBound, TakesThePlaceOfAMeasurementWhereItIsTheSmaller) {
  EXPECT_EQ(standingOf(average({}), 0.1), Standing::may);
  EXPECT_EQ(standingOf(average(0.008), 0.01), Standing::meets);
  EXPECT_TRUE(measuredError(average(0.008))->boundCounts());
  EXPECT_EQ(measuredError(average(0.5))->high(), 0.12);
  EXPECT_EQ(standingOf(average(0.008), 0.001), Standing::may);  // a bound shows nothing to be above
}

TEST(CostBound, ThatAMeasurementExcludesDoesNotCount) {
  CostPoint point = average(0.008);
  point.low = 0.02;
  EXPECT_FALSE(measuredError(point)->boundCounts());
  EXPECT_EQ(standingOf(point, 0.01), Standing::cannot);
}

TEST(CostBound, AloneIsAllThatIsKnownOfASetting) {
  CostPoint point = average(0.008);
  point.error = point.statistical = point.low = point.high = std::nullopt;
  EXPECT_EQ(standingOf(point, 0.01), Standing::meets);
  EXPECT_EQ(standingOf(point, 0.001), Standing::may);
  EXPECT_EQ(countedError(point), 0.008);
  EXPECT_EQ(whatDecides(point, 0.001), "smaller steps: this one is bounded and not measured");
  point.bound.reset();
  EXPECT_FALSE(measuredError(point));
}

}  // namespace

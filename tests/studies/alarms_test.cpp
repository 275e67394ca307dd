// Alarms for differences so large that no test is needed.
#include "studies/flow/notes.hpp"

#include <gtest/gtest.h>

#include "cases/couette.hpp"
#include "tests/studies/flow_runs.hpp"

namespace crossgrain {
namespace {

using Alarms = std::vector<std::string>;

Alarms alarmsAt(CompareResults results, const std::vector<EndpointRow>& rows = {}) {
  results.endpoints.rows = rows;
  Case oneRing;
  Couette& cell = couetteIn(oneRing);
  cell.cell = {.innerRadius = 1.0, .outerRadius = 2.0, .height = 1.0, .omega = 1.0};
  cell.particles.smallRadius = 0.1;
  cell.times.rings = 1;
  setFlowOfCell(oneRing);
  Alarms what;
  for (const AlarmRow& alarm : alarmsOf(oneRing, results)) what.push_back(alarm.what);
  return what;
}

EndpointRow pressure(double distance, Verdict answer, int packings = 8, int lost = 0) {
  EndpointRow row;
  row.a = "a";
  row.b = "b";
  row.endpoint = "pressure";
  row.distance = distance;
  row.verdict = answer;
  row.packings = packings;
  row.lost = lost;
  return row;
}

TEST(Alarms, BeyondTenMarginsWithoutDisagreement_IsOne) {
  EXPECT_EQ(alarmsAt({}, {pressure(-10.5, Verdict::undecided, 1)}),
            Alarms{"pressure is 10 margins off, which 1 packing cannot prove"});
  EXPECT_EQ(alarmsAt({}, {pressure(9.9, Verdict::undecided)}), Alarms{});
  EXPECT_EQ(alarmsAt({}, {pressure(99.0, Verdict::fail)}), Alarms{});
}

TEST(Alarms, BeyondTenMarginsByChanceAlone_IsNone) {
  EndpointRow row = pressure(12.0, Verdict::undecided);
  row.distanceLow = -3.0;
  row.distanceHigh = 27.0;
  EXPECT_EQ(alarmsAt({}, {row}), Alarms{});
  row.distanceLow = 0.5;
  EXPECT_EQ(alarmsAt({}, {row}),
            Alarms{"pressure is 12 margins off, which 8 packings cannot prove"});
}

/// Eight packings of a and b, of which the first ones have a pressure.
CompareResults withPressure(int ofA, int ofB) {
  CompareResults results;
  for (int packing = 0; packing < 8; ++packing)
    for (const auto& [engine, there] : {std::pair("a", ofA), {"b", ofB}}) {
      const Numbers stress = {packing < there ? 100.0 : 0.0};
      results.runs.push_back(
          test::flowRun(engine, packing,
                        {test::sliced("volume_fraction", {0.8}), test::sliced("stress_rr", stress),
                         test::sliced("stress_pp", stress)}));
    }
  return results;
}

TEST(Alarms, ValueOfOneEngineMissingOnMostPackings_IsOne) {
  EXPECT_EQ(alarmsAt(withPressure(8, 3), {pressure(0.0, Verdict::undecided, 3, 5)}),
            Alarms{"b has no pressure on 5 of 8 packings where a has"});
  EXPECT_EQ(alarmsAt(withPressure(8, 4), {pressure(0.0, Verdict::undecided, 4, 4)}), Alarms{});
  // A value that both engines lack on the same packings is no difference.
  EXPECT_EQ(alarmsAt(withPressure(3, 3), {pressure(0.0, Verdict::undecided, 3, 5)}), Alarms{});
}

TEST(Alarms, OtherRegimeOnMostPackings_IsOne) {
  CompareResults results;
  results.regimes = {{"a", "b", PairKind::peer, 4, {0, 1, 3}}};
  EXPECT_EQ(alarmsAt(results), Alarms{"another regime on 3 of 4 packings"});
  results.regimes[0].differ = {0, 1};
  EXPECT_EQ(alarmsAt(results), Alarms{});
}

TEST(Alarms, DisksGoneFromTheCell_IsOne) {
  CompareResults results;
  results.regimes = {{"a", "b", PairKind::peer, 1, {}}};
  const auto filled = [&](double fraction) {
    results.runs = {test::flowRun("a", 0, {test::sliced("volume_fraction", {0.8})}),
                    test::flowRun("b", 0, {test::sliced("volume_fraction", {fraction})})};
    return alarmsAt(results);
  };
  EXPECT_EQ(filled(0.6), Alarms{"25 % of the disks are gone from the cell"});
  EXPECT_EQ(filled(0.79), Alarms{});  // what crosses the circles of the walls and comes back
}

}  // namespace
}  // namespace crossgrain

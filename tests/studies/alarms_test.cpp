// What is so far off that nobody should wait for a test.
#include "studies/flow/notes.hpp"

#include <gtest/gtest.h>

namespace crossgrain {
namespace {

Case oneRing() {
  Case setup;
  setup.cell.innerRadius = 1.0;
  setup.cell.outerRadius = 2.0;
  setup.cell.height = 1.0;
  setup.particles.smallRadius = 0.1;
  setup.averaging.rings = 1;
  return setup;
}

FlowRun filled(const std::string& engine, double volumeFraction) {
  FlowRun run;
  run.engine = engine;
  run.profiles = {{"slicing", "volume_fraction", "", {volumeFraction}, {}, {}, {}}};
  return run;
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

std::vector<std::string> said(CompareResults results, const std::vector<EndpointRow>& rows = {}) {
  results.endpoints.rows = rows;
  std::vector<std::string> words;
  for (const AlarmRow& alarm : alarmsOf(oneRing(), results)) words.push_back(alarm.what);
  return words;
}

using Alarms = std::vector<std::string>;

TEST(Alarms, AreRaisedBeyondTenMarginsUnlessItIsADisagreementAnyway) {
  EXPECT_EQ(said({}, {pressure(-10.5, Verdict::undecided, 1)}),
            Alarms{"pressure is 10 margins off, which 1 packing cannot prove"});
  EXPECT_EQ(said({}, {pressure(9.9, Verdict::undecided)}), Alarms{});
  EXPECT_EQ(said({}, {pressure(99.0, Verdict::fail)}), Alarms{});
}

/// Eight packings of an engine, of which the first ones have a pressure.
void addRuns(CompareResults& results, const std::string& engine, int there) {
  for (int packing = 0; packing < 8; ++packing) {
    FlowRun run = filled(engine, 0.8);
    run.packing = packing;
    const std::optional<double> stress =
        packing < there ? std::optional(100.0) : std::optional(0.0);
    for (const char* field : {"stress_rr", "stress_pp"})
      run.profiles.push_back({"slicing", field, "", {stress}, {}, {}, {}});
    results.runs.push_back(std::move(run));
  }
}

TEST(Alarms, AreRaisedWhereOneEngineHasNoValueOnMostPackings) {
  CompareResults one, both;
  addRuns(one, "a", 8);
  addRuns(one, "b", 3);
  EXPECT_EQ(said(one, {pressure(0.0, Verdict::undecided, 3, 5)}),
            Alarms{"pressure is missing on 5 of 8 packings"});
  EXPECT_EQ(said(one, {pressure(0.0, Verdict::undecided, 4, 4)}), Alarms{});
  addRuns(both, "a", 3);
  addRuns(both, "b", 3);  // what neither has is no difference
  EXPECT_EQ(said(both, {pressure(0.0, Verdict::undecided, 3, 5)}), Alarms{});
}

TEST(Alarms, AreRaisedForAnotherRegimeOnMostPackings) {
  CompareResults results;
  results.regimes = {{"a", "b", PairKind::peer, 4, {0, 1, 3}}};
  EXPECT_EQ(said(results), Alarms{"another regime on 3 of 4 packings"});
  results.regimes[0].differ = {0, 1};
  EXPECT_EQ(said(results), Alarms{});
}

TEST(Alarms, AreRaisedForDisksThatAreGone) {
  CompareResults results;
  results.regimes = {{"a", "b", PairKind::peer, 1, {}}};
  results.runs = {filled("a", 0.8), filled("b", 0.6)};
  EXPECT_EQ(said(results), Alarms{"25 % of the disks are gone from the cell"});
  results.runs[1] = filled("b", 0.79);  // what crosses the circles of the walls and comes back
  EXPECT_EQ(said(results), Alarms{});
}

}  // namespace
}  // namespace crossgrain

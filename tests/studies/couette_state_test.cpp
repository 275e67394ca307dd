#include "studies/flow/summary.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "adapters/grain.hpp"
#include "cases/couette.hpp"
#include "cases/loader.hpp"
#include "cases/preparation.hpp"
#include "cases/time_step.hpp"
#include "studies/flow/averages.hpp"
#include "studies/flow/ensemble.hpp"
#include "studies/flow/run.hpp"
#include "tests/studies/flow_runs.hpp"
#include "tests/studies/quick_cell.hpp"

namespace {

using namespace crossgrain;

RunSeries seriesOf(double shear, double contacts) {
  RunSeries series;
  for (int k = 0; k < 400; ++k) {
    series["t_s"].push_back(1.0 + 0.0157 * k);
    series["wheel_contacts"].push_back(contacts);
    series["wheel_slip"].push_back(1.0 - shear);
    series["shear_share"].push_back(shear);
  }
  return series;
}

TEST(CouetteRegime, SharesOfTheSeries_GiveTheRegime) {
  const Case setup = test::quickCell();
  EXPECT_EQ(couetteRegime(setup, {}, seriesOf(0.3, 18.0)).regime, Regime::flowing);
  EXPECT_EQ(couetteRegime(setup, {}, seriesOf(0.002, 18.0)).regime, Regime::blocked);
  EXPECT_EQ(couetteRegime(setup, {}, seriesOf(0.3, 0.2)).regime, Regime::collisional);
  // Half of the time it stands still: d/(Ω R_i) is 16 of these samples.
  RunSeries changes = seriesOf(0.3, 18.0);
  for (std::size_t k = 0; k < 200; ++k) changes["shear_share"][k] = 0.0;
  const RegimeRow regime = couetteRegime(setup, {}, changes);
  EXPECT_EQ(regime.regime, Regime::flowing);
  EXPECT_NEAR(*regime.blockedFraction, 0.5, 0.03);
  // A file's snapshots may lack velocities' partners, contacts, walls.
  const RegimeRow unknown = couetteRegime(setup, {}, {});
  EXPECT_FALSE(unknown.regime);
  EXPECT_FALSE(unknown.reason.empty());
}

TEST(CouetteRegime, TwoSamples_BlockForTheTimeBetweenThem) {
  // The rim passes a disk in 2·0.0037/(1·0.03) = 0.247 s, two samples: of 0 and 0.3 the mean is not
  // blocked. Each by itself, one of two would be.
  RunSeries series;
  series["t_s"] = {1.0, 1.125};
  series["shear_share"] = {0.0, 0.3};
  EXPECT_EQ(couetteRegime(test::quickCell(), {}, series).blockedFraction, 0.0);
  series["t_s"] = {1.0, 1.25};  // a disk passes from one sample to the next
  EXPECT_EQ(couetteRegime(test::quickCell(), {}, series).blockedFraction, 0.5);
}

TEST(CouetteSteadiness, Series_DriftOrNot) {
  std::mt19937 generator(3);
  std::normal_distribution<double> normal;
  RunSeries series;
  for (int k = 0; k < 400; ++k) {
    series["wheel_torque"].push_back(2.0 + 0.2 * normal(generator));
    series["outer_pressure"].push_back(
        k % 9 == 0 ? std::nullopt : std::optional(100.0 - 0.1 * k + normal(generator)));
  }
  const auto rows = couetteSteadiness(test::quickCell(), series);
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].quantity, "wheel_torque");
  EXPECT_EQ(rows[0].drift.verdict, Drift::notSeen);
  EXPECT_LT(rows[0].drift.excluded.value(), 0.2);
  EXPECT_EQ(rows[1].drift.verdict, Drift::drifts);
  EXPECT_NEAR(rows[1].drift.change.value(), -0.5, 0.02);
}

/// A run of the sort that the tables take.
FlowRun run(const std::string& engine, int packing, Regime regime, double change, Drift verdict) {
  FlowRun run = test::flowRun(engine, packing);
  run.regime = RegimeRow{regime, "", {}, {}, {}, {}, {}};
  run.steadiness = {{"outer_pressure", {verdict, change, 0.3, std::abs(change) + 0.3}}};
  return run;
}

TEST(Regimes, PairOfEngines_DiffersOnSomePackings) {
  std::vector<FlowRun> runs;
  for (const auto& [engine, packing, regime] : {std::tuple("ours", 0, Regime::flowing),
                                                {"ours", 1, Regime::blocked},
                                                {"peer", 0, Regime::flowing},
                                                {"peer", 1, Regime::flowing},
                                                {"peer", 2, Regime::flowing}})
    runs.push_back(run(engine, packing, regime, 0.0, Drift::cannotTell));
  const auto table = regimesOf(
      runs, {{"ours", "peer", PairKind::peer, ""}, {"ours", "nobody", PairKind::peer, ""}});
  ASSERT_EQ(table.size(), 1u);
  EXPECT_EQ(table[0].packings, 2);
  EXPECT_EQ(table[0].differ, std::vector{1});
}

TEST(Steadiness, FourPackings_DecideWhatNoRunCan) {
  // Each run by itself: −0.4 ± 0.3 to ± 0.5, cannot tell. Four alike: −0.4 ± 0.05.
  std::vector<FlowRun> runs;
  for (int k = 0; k < 4; ++k)
    runs.push_back(run("ours", k, Regime::flowing, -0.4 + 0.01 * k, Drift::cannotTell));
  const EngineDrift row = steadinessOf(runs, {"ours"}, 0.95)[0];
  EXPECT_EQ(row.drift.verdict, Drift::drifts);
  EXPECT_NEAR(row.drift.change.value(), -0.385, 1e-12);
  // t of 3 degrees of freedom at 1 − 0.05/3 is 4.857; sd/√4 of (0, 1, 2, 3)/100 is 0.00645.
  EXPECT_NEAR(row.drift.half.value(), 4.857 * 0.006455, 1e-4);
  EXPECT_EQ(row.packings, 4);
  const auto setChanges = [&](double odd, double even) {
    for (std::size_t k = 0; k < 4; ++k) runs[k].steadiness[0].drift.change = k % 2 ? odd : even;
  };
  setChanges(0.03, -0.03);
  EXPECT_EQ(steadinessOf(runs, {"ours"}, 0.95)[0].drift.verdict, Drift::notSeen);
  setChanges(0.5, -0.6);
  EXPECT_EQ(steadinessOf(runs, {"ours"}, 0.95)[0].drift.verdict, Drift::cannotTell);
}

TEST(Steadiness, TwoPackings_DecideWhereTheyAgree) {
  std::vector<FlowRun> runs = {run("ours", 0, Regime::flowing, -0.5, Drift::drifts),
                               run("ours", 1, Regime::flowing, -0.6, Drift::drifts)};
  const auto verdict = [&] { return steadinessOf(runs, {"ours"}, 0.95)[0].drift.verdict; };
  EXPECT_EQ(verdict(), Drift::drifts);
  EXPECT_EQ(steadinessOf(runs, {"ours"}, 0.95)[0].drifting, (std::vector{0, 1}));
  runs[1] = run("ours", 1, Regime::flowing, 0.6, Drift::drifts);
  EXPECT_EQ(verdict(), Drift::cannotTell) << "one falls, one rises";
  runs[1] = run("ours", 1, Regime::flowing, 0.0, Drift::notSeen);
  EXPECT_EQ(verdict(), Drift::cannotTell);
  EXPECT_TRUE(steadinessOf({}, {"ours"}, 0.95).empty());
}

/// Of packing 0 of that seed.
RegimeRow averaged(int seed) {
  const Case setup =
      loadCase(CROSSGRAIN_TESTS "/studies/blocked.toml",
               {"averaging.rotations=0.25", fmt::format("preparation.seed={}", seed)})
          .front();
  const double dt = timeStep(setup);
  const auto engine = makeGrain();
  const Packing packing = packingOf(setup, 0, dt, *engine, [](double) {});
  const Scene scene = couetteScene(setup, packing, dt);
  engine->load(scene, {});
  FlowAverages averages(setup, scene);
  const double rotation = rotationTime(setup);
  for (int k = 1; k <= 100; ++k) {
    engine->advance(
        (couetteIn(setup).times.settleRotations + couetteIn(setup).times.rotations * k / 100) *
        rotation);
    averages.add(engine->snapshot(ContactReport::instant));
  }
  FlowRun result;
  averages.describe({}, result);
  return result.regime.value();
}

TEST(BlockedPacking, QuickRun_DiffersFromOneThatFlows) {
  const RegimeRow blocked = averaged(2);
  EXPECT_EQ(blocked.regime, Regime::blocked) << blocked.reason;
  EXPECT_EQ(blocked.blockedFraction, 1.0);
  // The wheel is in contact, under pressure, and slips: it has not lost the disks.
  EXPECT_GT(blocked.wheelContacts.value(), 5.0);
  EXPECT_GT(blocked.wheelSlip.value(), 0.9);
  const RegimeRow flowing = averaged(1);
  EXPECT_EQ(flowing.regime, Regime::flowing) << flowing.reason;
  EXPECT_LT(flowing.blockedFraction.value(), 0.5);
}

}  // namespace

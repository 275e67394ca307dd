#include "runs/couette/state.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "adapters/grain.hpp"
#include "cases/couette.hpp"
#include "cases/loader.hpp"
#include "cases/preparation.hpp"
#include "cases/time_step.hpp"
#include "runs/couette/averages.hpp"
#include "runs/couette/run.hpp"
#include "runs/couette/state_table.hpp"

namespace {

using namespace crossgrain;
using nlohmann::json;

json seriesOf(double shear, double contacts) {
  json series;
  for (int k = 0; k < 400; ++k) {
    series["t_s"].push_back(1.0 + 0.0157 * k);
    series["wheel_contacts"].push_back(contacts);
    series["wheel_slip"].push_back(1.0 - shear);
    series["shear_share"].push_back(shear);
  }
  return series;
}

Case quick() {
  return loadCase(CROSSGRAIN_CASES "/couette/quick.toml").front();
}

TEST(CouetteRegime, IsReadFromTheSeries) {
  const Case setup = quick();
  EXPECT_EQ(couetteRegime(setup, {}, seriesOf(0.3, 18.0))["name"], "flowing");
  EXPECT_EQ(couetteRegime(setup, {}, seriesOf(0.002, 18.0))["name"], "blocked");
  EXPECT_EQ(couetteRegime(setup, {}, seriesOf(0.3, 0.2))["name"], "collisional");
  // Half of the time it stands still: d/(Ω R_i) is 16 of these samples.
  json changes = seriesOf(0.3, 18.0);
  for (std::size_t k = 0; k < 200; ++k) changes["shear_share"][k] = 0.0;
  const json regime = couetteRegime(setup, {}, changes);
  EXPECT_EQ(regime["name"], "flowing");
  EXPECT_NEAR(regime["blocked_share"].get<double>(), 0.5, 0.03);
  // A file's snapshots may lack velocities' partners, contacts, walls.
  const json unknown = couetteRegime(setup, {}, json::object());
  EXPECT_TRUE(unknown["name"].is_null());
  EXPECT_FALSE(unknown["reason"].get<std::string>().empty());
}

TEST(CouetteSteadiness, SaysItOfEachSeriesThatIsThere) {
  std::mt19937 generator(3);
  std::normal_distribution<double> normal;
  json series;
  for (int k = 0; k < 400; ++k) {
    series["wheel_torque"].push_back(2.0 + 0.2 * normal(generator));
    series["outer_pressure"].push_back(k % 9 == 0 ? json(nullptr)
                                                  : json(100.0 - 0.1 * k + normal(generator)));
  }
  const json rows = couetteSteadiness(quick(), series);
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0]["quantity"], "wheel_torque");
  EXPECT_EQ(rows[0]["verdict"], "no drift seen");
  EXPECT_LT(rows[0]["excluded"], 0.2);
  EXPECT_EQ(rows[1]["verdict"], "drifts");
  EXPECT_NEAR(rows[1]["change"].get<double>(), -0.5, 0.02);
}

/// A run of the sort that the tables take.
json run(const std::string& engine, int packing, const char* regime, double change,
         const char* verdict) {
  return {{"engine", engine},
          {"packing", packing},
          {"status", "finished"},
          {"regime", {{"name", regime}}},
          {"steadiness",
           {{{"quantity", "outer_pressure"},
             {"verdict", verdict},
             {"change", change},
             {"half_width", 0.3},
             {"excluded", std::abs(change) + 0.3}}}}};
}

TEST(Regimes, PairsSayOnWhichPackingsTheyDiffer) {
  json runs = {
      run("ours", 0, "flowing", 0, "cannot tell"), run("ours", 1, "blocked", 0, "cannot tell"),
      run("peer", 0, "flowing", 0, "cannot tell"), run("peer", 1, "flowing", 0, "cannot tell"),
      run("peer", 2, "flowing", 0, "cannot tell")};
  const json table =
      regimesOf(runs, {{"ours", "peer", "peer", ""}, {"ours", "nobody", "peer", ""}});
  ASSERT_EQ(table.size(), 1u);
  EXPECT_EQ(table[0]["packings"], 2);
  EXPECT_EQ(table[0]["differ"], json({1}));
}

TEST(Steadiness, OverPackingsSeesWhatNoRunCanTell) {
  // Each run by itself: −0.4 ± 0.3 to ± 0.5, cannot tell. Four alike: −0.4 ± 0.05.
  json runs;
  for (int k = 0; k < 4; ++k)
    runs.push_back(run("ours", k, "flowing", -0.4 + 0.01 * k, "cannot tell"));
  json row = steadinessOf(runs, {"ours"}, 0.95)[0];
  EXPECT_EQ(row["verdict"], "drifts");
  EXPECT_NEAR(row["change"].get<double>(), -0.385, 1e-12);
  // t of 3 degrees of freedom at 1 − 0.05/3 is 4.857; sd/√4 of (0, 1, 2, 3)/100 is 0.00645.
  EXPECT_NEAR(row["half_width"].get<double>(), 4.857 * 0.006455, 1e-4);
  EXPECT_EQ(row["packings"], 4);
  for (int k = 0; k < 4; ++k)
    runs[static_cast<std::size_t>(k)]["steadiness"][0]["change"] = k % 2 ? 0.03 : -0.03;
  EXPECT_EQ(steadinessOf(runs, {"ours"}, 0.95)[0]["verdict"], "no drift seen");
  for (int k = 0; k < 4; ++k)
    runs[static_cast<std::size_t>(k)]["steadiness"][0]["change"] = k % 2 ? 0.5 : -0.6;
  EXPECT_EQ(steadinessOf(runs, {"ours"}, 0.95)[0]["verdict"], "cannot tell");
}

TEST(Steadiness, OfFewPackingsIsWhatAllRunsSay) {
  const auto verdict = [](const json& runs) {
    return steadinessOf(runs, {"ours"}, 0.95)[0]["verdict"];
  };
  json runs = {run("ours", 0, "flowing", -0.5, "drifts"),
               run("ours", 1, "flowing", -0.6, "drifts")};
  EXPECT_EQ(verdict(runs), "drifts");
  EXPECT_EQ(steadinessOf(runs, {"ours"}, 0.95)[0]["drifting"], json({0, 1}));
  runs[1] = run("ours", 1, "flowing", 0.6, "drifts");
  EXPECT_EQ(verdict(runs), "cannot tell") << "one falls, one rises";
  runs[1] = run("ours", 1, "flowing", 0.0, "no drift seen");
  EXPECT_EQ(verdict(runs), "cannot tell");
  EXPECT_TRUE(steadinessOf(json::array(), {"ours"}, 0.95).empty());
}

/// Of packing 0 of that seed.
json averaged(int seed) {
  const Case setup =
      loadCase(CROSSGRAIN_TESTS "/runs/blocked.toml",
               {"averaging.rotations=0.25", fmt::format("preparation.seed={}", seed)})
          .front();
  const double dt = timeStep(setup);
  const auto engine = makeGrain();
  const Packing packing = packingOf(setup, 0, dt, *engine, [](double) {});
  const Scene scene = couetteScene(setup, packing, dt);
  engine->load(scene, {});
  CouetteAverages averages(setup, scene);
  const double rotation = rotationTime(setup);
  for (int k = 1; k <= 100; ++k) {
    engine->advance((setup.averaging.settleRotations + setup.averaging.rotations * k / 100) *
                    rotation);
    averages.add(engine->snapshot(ContactReport::instant));
  }
  json result;
  averages.describe({}, result);
  return result;
}

TEST(BlockedPacking, IsToldFromOneThatFlows) {
  const json blocked = averaged(2)["regime"];
  EXPECT_EQ(blocked["name"], "blocked") << blocked;
  EXPECT_EQ(blocked["blocked_share"], 1.0);
  // The wheel is in contact, under pressure, and slips: it has not lost the disks.
  EXPECT_GT(blocked["wheel_contacts"], 5.0);
  EXPECT_GT(blocked["wheel_slip"], 0.9);
  const json flowing = averaged(1)["regime"];
  EXPECT_EQ(flowing["name"], "flowing") << flowing;
  EXPECT_LT(flowing["blocked_share"], 0.5);
}

}  // namespace

#include "runs/collision_sweep.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "adapters/grain.hpp"
#include "tests/cases/thesis_pair.hpp"

namespace {

using namespace crossgrain;
using nlohmann::json;

TEST(CollisionSweep, ScoresTheWholeCurveInUnitsOfItsRange) {
  Case setup = test::smallPairCase();
  setup.collision.psi = {0.0, 1.0, 2.0, 3.0, 4.0};
  setup.collision.vn = {0.01};
  setup.collision.margins["psi_f"] = {0.01, false, "because"};
  const auto starts = collisionStarts(setup);
  const auto oracle = oracleCurve(setup, starts);
  const EngineEntry entry{"here", "", makeGrain, {}, {}, ""};
  const auto engine = makeGrain();
  const json held = runSweep(*engine, entry, setup, 2.18e-3 / 1000.0, starts, oracle, false);
  EXPECT_EQ(held["status"], "finished");
  EXPECT_EQ(held["points"]["psi_f"].size(), 5u);
  EXPECT_EQ(held["score"]["verdict"], "held");
  EXPECT_LT(held["score"]["max_error"].get<double>(), 1e-3);
  const double range = oracle.ends[4]->psi - oracle.ends[1]->psi;
  EXPECT_GE(held["score"]["max_error"].get<double>() * range + 1e-15,
            std::abs(held["points"]["psi_f"][4].get<double>() - oracle.ends[4]->psi));

  setup.collision.margins["psi_f"].value = 1e-9;
  const json shortOf = runSweep(*engine, entry, setup, 2.18e-3 / 50.0, starts, oracle, false);
  EXPECT_EQ(shortOf["score"]["verdict"], "fell short");
}

TEST(CollisionSweep, ALawWithoutALimitHasNoReference) {
  Case setup = test::smallPairCase();
  setup.law.conventions.dashpot = Dashpot::outside;
  const auto oracle = oracleCurve(setup, {{1.0, 0.1}});
  EXPECT_FALSE(oracle.ends[0]);
  EXPECT_NE(oracle.reason.find("dashpot"), std::string::npos);
}

}  // namespace

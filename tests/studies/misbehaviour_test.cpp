#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "cases/collision_scene.hpp"
#include "cases/loader.hpp"
#include "results/schema.hpp"
#include "studies/flow/campaign.hpp"
#include "tests/misbehaving/entries.hpp"
#include "tests/support/pairs.hpp"
#include "tests/support/refusal.hpp"
#include "tests/support/temporary_folder.hpp"

// Engines that misbehave on purpose: each is one clear line that names engine, case, time and the
// last good state, and the others go on.

namespace {

using namespace crossgrain;
namespace fs = std::filesystem;

constexpr double dt = 1e-5;
constexpr std::uint64_t badStep = 25;

class Misbehaviour : public testing::Test {
 protected:
  const TemporaryFolder folder_;

  static Case pairCase() {
    Case setup = ::test::smallPairCase();
    setup.file = "pair.toml";
    collisionIn(setup).psi = {1.0};
    collisionIn(setup).vn = {0.1};
    setup.run.timeout = 1.0;
    return setup;
  }

  /// Error that ends a run with a snapshot every ten steps.
  /// @param seen  gets the snapshots
  std::string endOf(const std::string& mischief, const Case& setup = pairCase(),
                    std::vector<Snapshot>* seen = nullptr) {
    const Scene scene = collisionScene(setup, collisionStarts(setup), dt);
    const auto loaded = loadEngine(crossgrain::test::misbehavingEntry(mischief, badStep), setup,
                                   scene, folder_.path());
    return crossgrain::test::refusalOf<EngineFailure>([&] {
      for (int k = 10; k <= 100; k += 10) {
        loaded.engine->advance(k * dt);
        const Snapshot now = loaded.engine->snapshot(ContactReport::none);
        if (seen != nullptr) seen->push_back(now);
      }
    });
  }
};

TEST_F(Misbehaviour, FatalMischief_IsOneLineWithCaseTimeAndLastGoodState) {
  const std::string good = " (last good snapshot: t = 0.0002 s)";
  const auto begins = [](const std::string& text, const std::string& with) {
    return text.rfind(with, 0) == 0;
  };
  for (const std::string& mischief : crossgrain::test::fatalMischiefs()) {
    const std::string line = endOf(mischief);
    const std::string at = mischief == "nan" || mischief == "short" ? "t = 0.0003" : "t = 0.0002";
    EXPECT_TRUE(begins(line, mischief + ", pair at " + at)) << line;
    EXPECT_TRUE(line.ends_with(good)) << line;
    EXPECT_EQ(line.find('\n'), std::string::npos);
  }
  EXPECT_NE(endOf("exit").find("ended (exit status 3) during advance(t = 0.0003"),
            std::string::npos);
  EXPECT_NE(endOf("crash").find("signal 6 (Aborted)"), std::string::npos);
  EXPECT_NE(endOf("crash").find("the end of its log: step 25"), std::string::npos);
  EXPECT_NE(endOf("hang").find("no answer within 1 s to advance(t = 0.0003"), std::string::npos);
  EXPECT_NE(endOf("garbage").find("is not a JSON object: '%!PS-Adobe-3.0'"), std::string::npos);
  EXPECT_NE(endOf("nan").find("position[0] is nan"), std::string::npos);
  EXPECT_NE(endOf("short").find("position is 2 × f64, expected 4 × f64"), std::string::npos);
}

/// Nothing but its energy gives a pump away: no term accounts for what it brings in, here to two
/// disks that lose nothing.
TEST_F(Misbehaviour, Pump_ShowsInTheEnergyLedger) {
  Case setup = pairCase();
  setup.law.gn = 0.0;
  setup.law.tangential = TangentialLaw::none;
  setup.run.energyLedger = true;
  std::vector<Snapshot> seen;
  EXPECT_EQ(endOf("pump", setup, &seen), "");
  ASSERT_EQ(seen.size(), 10u);
  const double before = seen.front().ledger->initial;
  double most = 0.0;
  for (const Snapshot& now : seen) {
    const double steps = std::round(now.positionTime / dt) - static_cast<double>(badStep);
    const double factor = 1.0 + 0.01 * std::max(steps, 0.0);
    const double kinetic = now.ledger->kinetic / (factor * factor);  // as it would be
    most = std::max(most, residual(*now.ledger));
    EXPECT_NEAR(residual(*now.ledger), now.ledger->kinetic - kinetic, 1e-4 * before);
  }
  EXPECT_GT(most, 0.1 * before);
}

/// One campaign, a good engine among bad ones.
TEST_F(Misbehaviour, EnginesOfACampaign_FailAlone) {
  const Case setup =
      loadCase(fs::path(CROSSGRAIN_CASES) / "couette/quick.toml",
               {"preparation.packings=1", "preparation.shrink_time=0.3",
                "preparation.rotations=0.0", "averaging.settle_rotations=0.0",
                "averaging.rotations=0.005", "run.timeout=2.0", "run.energy_ledger=true"})
          .front();
  std::vector<EngineEntry> engines = {*findEngine("grain")};
  engines.front().command =
      crossgrain::test::misbehavingEntry("none", 0).command;  // no program "__serve" here
  for (const std::string& mischief : crossgrain::test::fatalMischiefs())
    engines.push_back(crossgrain::test::misbehavingEntry(mischief, 60));
  RunCommand command{.out = folder_.path(), .quiet = true};
  RunStore store(command, "compare", soleCase(setup));
  Campaign campaign(setup, command, engines, store);
  campaign.askEngines();
  campaign.preparePackings();
  campaign.timeEngines();
  campaign.run(campaign.wholeCase());
  const std::vector<FlowRun> runs = campaign.study(kindCompare).runs;
  ASSERT_EQ(runs.size(), engines.size());
  for (const FlowRun& run : runs) {
    if (run.engine == "grain") {
      EXPECT_EQ(run.status, Status::finished) << run.reason;
      EXPECT_TRUE(run.series.value().contains("energy_residual"));
      continue;
    }
    EXPECT_EQ(run.status, Status::failed) << run.engine;
    EXPECT_EQ(run.reason.rfind("packing 0: " + run.engine + ", ", 0), 0u) << run.reason;
  }
}

TEST_F(Misbehaviour, ImpossibleScene_IsRefusedBeforeAnyEngineLoadsIt) {
  const Case setup = pairCase();
  Scene scene = collisionScene(setup, collisionStarts(setup), dt);
  const auto refusal = [&] {
    return crossgrain::test::refusalOf([&] {
      loadEngine(crossgrain::test::misbehavingEntry("none", 0), setup, scene, folder_.path());
    });
  };
  EXPECT_EQ(refusal(), "");
  const Vec2 place = scene.disks.position[0];
  scene.disks.position = {{0.5, -0.25}, {0.5, -0.25}};
  EXPECT_EQ(refusal(), "pair.toml: disk 0 and disk 1 have the same centre, (0.5, -0.25) m");
  scene.disks.position[1].x() += 0.9 * ::test::smallRadius;
  EXPECT_EQ(refusal(),
            "pair.toml: disk 0 and disk 1 overlap by 0.00407 m at the start, near (0.5, -0.25) m: "
            "more than the smaller radius, so that a centre lies inside");
  scene.disks.position[1].x() += 0.2 * ::test::smallRadius;
  EXPECT_EQ(refusal(), "");
  scene.disks.position[0].y() = std::nan("");
  EXPECT_EQ(refusal(), "pair.toml: the position of disk 0 is not finite");
  scene.disks.position[0] = place;
  WallBody floor;
  floor.planes.push_back({place + Vec2(0.0, 1e-3), Vec2::UnitY()});
  scene.bodies.push_back(floor);
  EXPECT_EQ(refusal().rfind("pair.toml: disk 0 and plane 0 overlap by 0.0047 m", 0), 0u);
}

}  // namespace

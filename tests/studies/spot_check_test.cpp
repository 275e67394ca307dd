// Faults that begin after lockstep's windows, which cannot see them: the spot check can.
#include <gtest/gtest.h>

#include <numbers>
#include <optional>

#include "studies/flow/interim_analyses.hpp"
#include "studies/flow/lockstep_job.hpp"
#include "studies/lockstep/rules.hpp"
#include "tests/misbehaving/entries.hpp"
#include "tests/studies/quick_cell.hpp"
#include "tests/support/refusal.hpp"
#include "tests/support/temporary_folder.hpp"

namespace crossgrain {
namespace {

/// Runs of the in-house engine and its mirror, which all tests share, so that they are done once.
class SpotCheck : public testing::Test {
 protected:
  static void SetUpTestSuite() { kept_.emplace(); }
  static void TearDownTestSuite() { kept_.reset(); }

  /// The in-house engine, a peer that is right until that step of a run, and the peer's mirror.
  /// @param failing  the in-house engine ends its runs halfway, and another one is there
  static EndpointFindings compared(const std::string& mischief, std::uint64_t step,
                                   LockstepFindings& lockstep, bool failing = false);

  static inline std::optional<TemporaryFolder> kept_;
};

EndpointFindings SpotCheck::compared(const std::string& mischief, std::uint64_t step,
                                     LockstepFindings& lockstep, bool failing) {
  const Case setup = test::quickCell(
      {"preparation.packings=4", "preparation.shrink_time=0.3", "preparation.rotations=0.1",
       "averaging.settle_rotations=0.05",
       failing ? "averaging.rotations=0.1" : "averaging.rotations=0.25", "looks.count=1"});
  EngineEntry inHouse = *findEngine("grain"), peer = test::misbehavingEntry(mischief, step),
              mirror = test::misbehavingEntry("none", 0);
  // No program "__serve" here.
  inHouse.command = failing ? test::misbehavingEntry("exit", 3000).command : mirror.command;
  EngineEntry another = mirror;
  another.name = "another";
  mirror.name = "mirror";
  mirror.mirrors = peer.name;
  RunCommand command;
  std::vector<EngineEntry> entries = {inHouse, peer, mirror};
  if (failing) entries = {inHouse, another, peer, mirror};
  for (const EngineEntry& entry : entries)
    if (entry.mirrors.empty()) command.engines.push_back(entry.name);
  const TemporaryFolder own;
  command.out = failing ? own.path() : kept_->path();
  command.quiet = true;
  command.jobs = 2;
  RunStore store(command, "compare", soleCase(setup));
  Campaign campaign(setup, command, entries, store);
  campaign.askEngines();
  campaign.preparePackings();
  lockstep = lockstepOf(campaign, setup, command, quickLockstepStarts,
                        [&](const EngineEntry& entry) { return entry.name == peer.name; });
  campaign.timeEngines();
  return runWithInterims(setup, campaign, command, lockstep, 1e6);
}

TEST_F(SpotCheck, RightEngine_IsEvaluatedThroughItsMirror) {
  LockstepFindings lockstep;
  const EndpointFindings found = compared("none", 0, lockstep);
  ASSERT_EQ(found.surrogates.size(), 1u);
  EXPECT_TRUE(found.surrogates[0].inUse) << found.surrogates[0].alarm;
  for (const EndpointRow& row : found.rows) {
    EXPECT_EQ(row.surrogateB, "mirror");
    EXPECT_GT(row.reach.value_or(0.0), 0.0);
    // The plate's springs and the forces that predict a damping velocity are not reported.
    EXPECT_LT(row.reach.value_or(1.0), 0.1) << row.endpoint;
  }
  EXPECT_EQ(found.rows.size(), 9u);
  // Its own run is followed to the end: a quarter and a twentieth of a rotation of 2π s.
  const LateWindows& late = found.surrogates[0].late;
  EXPECT_EQ(late.packing, 1);
  EXPECT_EQ(late.times.size(), 18u);
  EXPECT_NEAR(late.times.back() + late.length, 0.3 * 2.0 * std::numbers::pi, late.length);
  ASSERT_EQ(late.equivalents.size(), 2u);
  EXPECT_EQ(late.equivalents[1].constant, "mu");
  EXPECT_EQ(late.beyond, 0u);
  EXPECT_EQ(verdictOf(found.surrogates[0]), Verdict::pass);
}

TEST_F(SpotCheck, FirstEngineFails_TakesResponsesOfTheNext) {
  LockstepFindings lockstep;
  const EndpointFindings found = compared("none", 0, lockstep, true);
  EXPECT_FALSE(found.responses.empty());
  for (const EndpointResponse& response : found.responses) EXPECT_EQ(response.packings, 4);
  ASSERT_EQ(found.surrogates.size(), 1u);
  EXPECT_TRUE(found.surrogates[0].inUse) << found.surrogates[0].alarm;
}

/// Chaos hides in an averaged run what 30 % of the friction do to a few rotations' averages.
TEST_F(SpotCheck, FaultLateInTheRun_IsFoundByItsWindows) {
  LockstepFindings lockstep;
  const EndpointFindings found = compared("worn", 25000, lockstep);
  ASSERT_EQ(lockstep.rows.size(), 1u);
  EXPECT_EQ(lockstep.rows[0].verdict, Equivalence::sameToRounding);
  ASSERT_EQ(found.surrogates.size(), 1u);
  const SurrogateEngine& own = found.surrogates[0];
  for (const SpotCheckNumber& number : own.spotCheck) EXPECT_GT(number.chance.value_or(0.0), 0.05);
  ASSERT_EQ(own.late.equivalents.size(), 2u);
  // From 1 s of 1.88 s on, half of the windows: no less than half of 30 %.
  EXPECT_EQ(own.late.equivalents[1].constant, "mu");
  EXPECT_GT(own.late.equivalents[1].change, 0.14);
  EXPECT_FALSE(own.inUse);
  EXPECT_NE(own.alarm.find("of packing 1"), std::string::npos) << own.alarm;
  // About half of the windows: what lockstep passed is not the engine's law.
  EXPECT_GT(own.late.beyond, own.late.read / 4);
  EXPECT_EQ(verdictOf(own), Verdict::fail);
  for (const EndpointRow& row : found.rows) {
    EXPECT_EQ(row.surrogateB, "");
    EXPECT_FALSE(row.reach);
  }
}

TEST_F(SpotCheck, FaultAfterLockstepsWindows_RunsAllPackings) {
  // 10 000 steps are four windows of 0.1 s, and a fifth of the run.
  LockstepFindings lockstep;
  const EndpointFindings found = compared("slippery", 10000, lockstep);
  ASSERT_EQ(lockstep.rows.size(), 1u);
  EXPECT_EQ(lockstep.rows[0].verdict, Equivalence::sameToRounding);
  ASSERT_EQ(found.surrogates.size(), 1u);
  EXPECT_FALSE(found.surrogates[0].inUse);
  test::expectSays(found.surrogates[0].alarm, {"differs by"});
  // It then runs all packings itself, and rows of the mirror say where the difference lies.
  bool implementation = false;
  for (const EndpointRow& row : found.rows) {
    EXPECT_EQ(row.surrogateB, "");
    EXPECT_EQ(row.packings, 4) << row.endpoint;
    implementation = implementation ||
                     (row.kind == PairKind::mirrorImplementation && row.verdict == Verdict::fail);
  }
  EXPECT_TRUE(implementation);
}

}  // namespace
}  // namespace crossgrain

// A fault that begins after lockstep's windows: they cannot see it, the one whole run can.
#include <gtest/gtest.h>

#include <filesystem>

#include "cases/loader.hpp"
#include "runs/couette/lockstep_job.hpp"
#include "runs/couette/looks.hpp"
#include "runs/lockstep/rules.hpp"
#include "tests/mischief/entries.hpp"

namespace crossgrain {
namespace {

namespace fs = std::filesystem;

/// The in-house engine, a peer that is right until that step of a run, and the peer's mirror.
/// @param failing  the in-house engine ends its runs halfway, and another one is there
EndpointFindings compared(const std::string& mischief, std::uint64_t step,
                          LockstepFindings& lockstep, bool failing = false) {
  const Case setup = loadCase(fs::path(CROSSGRAIN_CASES) / "couette/quick.toml",
                              {"preparation.packings=4", "preparation.shrink_time=0.3",
                               "preparation.rotations=0.1", "averaging.settle_rotations=0.05",
                               "averaging.rotations=0.25", "looks.count=1"})
                         .front();
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
  command.out = fs::path(testing::TempDir()) / ("canary-" + mischief + (failing ? "-failing" : ""));
  command.quiet = true;
  command.jobs = 2;
  fs::remove_all(command.out);
  RunStore store(command, "compare", soleCase(setup));
  Campaign campaign(setup, command, entries, store);
  campaign.askEngines();
  campaign.preparePackings();
  lockstep = lockstepOf(campaign, setup, command, quickLockstepStarts,
                        [&](const EngineEntry& entry) { return entry.name == peer.name; });
  campaign.timeEngines();
  EndpointFindings found = runInLooks(setup, campaign, command, lockstep, 1e6);
  fs::remove_all(command.out);
  return found;
}

TEST(Canary, LetsAnEngineThatIsRightBeCarried) {
  LockstepFindings lockstep;
  const EndpointFindings found = compared("none", 0, lockstep);
  ASSERT_EQ(found.carried.size(), 1u);
  EXPECT_TRUE(found.carried[0].carried) << found.carried[0].alarm;
  for (const EndpointRow& row : found.rows) EXPECT_EQ(row.carrierB, "mirror");
  EXPECT_EQ(found.rows.size(), 9u);
}

TEST(Canary, IsHeldAgainstResponsesOfTheNextEngineWhereTheFirstFails) {
  LockstepFindings lockstep;
  const EndpointFindings found = compared("none", 0, lockstep, true);
  EXPECT_FALSE(found.responses.empty());
  for (const EndpointResponse& response : found.responses) EXPECT_EQ(response.packings, 4);
  ASSERT_EQ(found.carried.size(), 1u);
  EXPECT_TRUE(found.carried[0].carried) << found.carried[0].alarm;
}

TEST(Canary, CatchesWhatBeginsAfterTheWindows) {
  // 10 000 steps are four windows of 0.1 s, and a fifth of the run.
  LockstepFindings lockstep;
  const EndpointFindings found = compared("slippery", 10000, lockstep);
  ASSERT_EQ(lockstep.rows.size(), 1u);
  EXPECT_EQ(lockstep.rows[0].verdict, LockstepVerdict::sameToRounding);
  ASSERT_EQ(found.carried.size(), 1u);
  EXPECT_FALSE(found.carried[0].carried);
  EXPECT_NE(found.carried[0].alarm.find("differs by"), std::string::npos) << found.carried[0].alarm;
  // It then runs all packings itself, and rows of the mirror say where the difference lies.
  bool implementation = false;
  for (const EndpointRow& row : found.rows) {
    EXPECT_EQ(row.carrierB, "");
    EXPECT_EQ(row.packings, 4) << row.endpoint;
    implementation = implementation ||
                     (row.kind == PairKind::mirrorImplementation && row.answer == Answer::disagree);
  }
  EXPECT_TRUE(implementation);
}

}  // namespace
}  // namespace crossgrain

#include "studies/flow/unfinished_run.hpp"

#include <gtest/gtest.h>

#include "adapters/grain.hpp"
#include "tests/support/laws.hpp"
#include "tests/support/refusal.hpp"
#include "tests/support/scenes.hpp"
#include "tests/support/temporary_folder.hpp"

namespace {

using namespace crossgrain;
namespace fs = std::filesystem;

/// Two disks that bounce on a floor.
Scene bouncing() {
  Scene scene{.name = "bouncing", .law = test::thesisLaw()};
  scene.law.gn = 0.05;
  scene.gravity = {0.3, -9.81};
  scene.dt = 4e-5;
  for (const double x : {0.0, 7.3e-3})
    test::addDisk(scene, test::smallRadius, test::smallMass, {x, 5e-3 + x}, {0.02, 0.0}, 3.0);
  WallBody floor;
  floor.name = "floor";
  floor.planes.emplace_back();
  scene.bodies.push_back(floor);
  return scene;
}

class UnfinishedRuns : public testing::Test {
 protected:
  UnfinishedRuns() { engine_->load(scene_, {}); }

  /// Runs to 0.05 s with a snapshot on the way, and leaves the run there.
  void leave() {
    UnfinishedRun run(folder_, "key", scene_, true);
    engine_->advance(0.02);
    run.took(engine_->snapshot(ContactReport::instant));
    run.keep(*engine_, 0.02);
    engine_->advance(0.03);
    run.took(engine_->snapshot(ContactReport::instant));
    engine_->advance(0.05);
    run.keep(*engine_, 0.05);
  }

  const TemporaryFolder scratch_;
  const fs::path folder_ = scratch_.path() / "run";
  const Scene scene_ = bouncing();
  std::unique_ptr<Engine> engine_ = makeGrain(), later_ = makeGrain();
};

TEST_F(UnfinishedRuns, Resumed_GoesOnToTheBit) {
  leave();
  later_->load(scene_, {});
  UnfinishedRun run(folder_, "key", scene_, true);
  const auto before = run.resume(*later_);
  ASSERT_TRUE(before);
  EXPECT_EQ(before->time, 0.05);
  ASSERT_EQ(before->snapshots, 2u);
  EXPECT_EQ(run.snapshot(0).positionTime, 0.02);
  EXPECT_NEAR(run.snapshot(1).positionTime, 0.03, 1e-15);
  for (Engine* engine : {engine_.get(), later_.get()}) engine->advance(0.1);
  const Snapshot a = engine_->snapshot(ContactReport::instant);
  const Snapshot b = later_->snapshot(ContactReport::instant);
  EXPECT_EQ(a.position, b.position);
  EXPECT_EQ(a.velocity, b.velocity);
  EXPECT_EQ(*a.spin, *b.spin);
  EXPECT_EQ(engine_->stats().contactEvaluations, later_->stats().contactEvaluations);
}

TEST_F(UnfinishedRuns, OtherKeyOrDamagedFile_IsForgotten) {
  leave();
  EXPECT_FALSE(UnfinishedRun(folder_, "another key", scene_, true).resume(*later_));
  EXPECT_FALSE(fs::exists(folder_));
  engine_->load(scene_, {});
  leave();
  fs::resize_file(folder_ / "snapshot-00001.bin", 10);
  EXPECT_FALSE(UnfinishedRun(folder_, "key", scene_, true).resume(*later_));
  EXPECT_FALSE(fs::exists(folder_));
}

TEST_F(UnfinishedRuns, CheckpointCutShort_FailsOnce) {
  leave();
  fs::resize_file(folder_ / "engine-2", fs::file_size(folder_ / "engine-2") / 2);
  later_->load(scene_, {});
  const std::string failure = test::refusalOf<EngineFailure>(
      [&] { UnfinishedRun(folder_, "key", scene_, true).resume(*later_); });
  EXPECT_NE(failure.find("cut short"), std::string::npos) << failure;
  EXPECT_FALSE(UnfinishedRun(folder_, "key", scene_, true).resume(*later_));
}

TEST_F(UnfinishedRuns, EngineWithoutCheckpoints_KeepsNothing) {
  UnfinishedRun run(folder_, "key", scene_, false);
  run.took(engine_->snapshot(ContactReport::none));
  run.keep(*engine_, 0.0);
  EXPECT_FALSE(fs::exists(folder_));
  EXPECT_FALSE(run.resume(*engine_));
}

}  // namespace

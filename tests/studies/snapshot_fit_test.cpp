// Snapshots of another cell are refused, with all that does not fit.
#include "studies/flow/snapshot_file.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <functional>

#include "cases/couette.hpp"
#include "cases/loader.hpp"
#include "support/bad_input.hpp"

namespace crossgrain {
namespace {

namespace fs = std::filesystem;

class SnapshotFit : public testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(folder_);
    setup_ = loadCase(fs::path(CROSSGRAIN_CASES) / "couette/quick.toml").front();
    Packing packing;
    packing.disks = diskKinds(setup_.particles);
    for (Vec2& at : packing.disks.position) at = {0.05, 0.0};
    const Scene scene = couetteScene(setup_, packing, 1e-5);
    Snapshot now;
    now.position = scene.disks.position;
    now.velocity = scene.disks.velocity;
    for (const WallBody& body : scene.bodies)
      now.wallPosition.insert(now.wallPosition.end(), body.diskPosition.begin(),
                              body.diskPosition.end());
    now.bodies.resize(2);
    now.bodies[0].angularVelocity = setup_.cell.omega;
    SnapshotFile out(file_, "someone", scene, 1, 1);
    out.offer(now, 1);
    out.close();
  }
  void TearDown() override { fs::remove_all(folder_); }

  /// What is said when the file is held against the case with a change; empty if it fits.
  std::string misfit(const std::function<void(Case&)>& change) const {
    Case other = setup_;
    change(other);
    const SnapshotReader reader(file_, other);
    try {
      requireFit(reader, other);
    } catch (const BadInput& error) {
      return error.what();
    }
    return {};
  }

  fs::path folder_ = fs::temp_directory_path() / ("crossgrain-fit-" + std::to_string(::getpid()));
  fs::path file_ = folder_ / "mine.h5";
  Case setup_;
};

TEST_F(SnapshotFit, TheOwnCaseFits) {
  EXPECT_EQ(misfit([](Case&) {}), "");
}

TEST_F(SnapshotFit, EachMisfitIsNamed) {
  struct Row {
    std::function<void(Case&)> change;
    const char* says;
  };
  for (const Row& row : std::vector<Row>{
           {[](Case& c) { ++c.particles.small; }, " small disks, not "},
           {[](Case& c) { c.particles.smallRadius = 0.00371; }, "disks of radius 0.0037 m, not "},
           {[](Case& c) { c.particles.largeMass *= 1.1; }, "a large disk's mass 0.00049 kg, not "},
           {[](Case& c) { c.cell.omega *= 2.0; }, "a wheel that turns at 1 rad/s, not 2 rad/s"},
           {[](Case& c) { c.cell.outerRadius *= 1.01; }, "the ring's radius "},
           {[](Case& c) { c.cell.innerRadius *= 1.01; }, "the wheel's radius "},
           {[](Case& c) { c.cell.wallRadius *= 1.1; }, "wall disks' radius 0.00125 m, not "},
           {[](Case& c) { c.cell.wallSpacing = 0.007; }, " wall disks of the wheel, not "}})
    EXPECT_NE(misfit(row.change).find(row.says), std::string::npos)
        << row.says << ": " << misfit(row.change);
}

TEST_F(SnapshotFit, TheThesisCellFitsInNothing) {
  const Case big = loadCase(fs::path(CROSSGRAIN_CASES) / "couette/nu-0.804.toml").front();
  const std::string says = misfit([&](Case& c) { c = big; });
  for (const char* const each : {"mine.h5 does not fit", "nu-0.804.toml", "disks, not 2921",
                                 "the wheel's radius 0.03 m, not 0.1032 m", "not between"})
    EXPECT_NE(says.find(each), std::string::npos) << says;
  EXPECT_EQ(says.find('\n'), std::string::npos);
}

TEST_F(SnapshotFit, APackingFilesDisksAreItsOwn) {
  EXPECT_EQ(misfit([](Case& c) {
              c.particles.file = "mine.h5";
              c.particles.small = c.particles.large = 0;
            }),
            "");
}

}  // namespace
}  // namespace crossgrain

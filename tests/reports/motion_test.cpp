// Films of the snapshots that runs kept.
#include "reports/common/motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "reports/couette/report.hpp"
#include "results/snapshot_layout.hpp"
#include "support/files.hpp"
#include "support/hdf5_file.hpp"
#include "tests/reports/sample_results.hpp"
#include "tests/support/temporary_folder.hpp"

namespace crossgrain::reports {
namespace {

namespace fs = std::filesystem;

/// Two disks and a wall disk; the first disk moves along x at 2 m/s, a step of 0.1 s a snapshot.
void writeSnapshots(const fs::path& file, std::size_t count) {
  fs::create_directories(file.parent_path());
  Hdf5File out = Hdf5File::create(file);
  out.write("/disks/radius", std::vector{0.1, 0.1});
  out.write("/walls/radius", std::vector{0.2});
  for (std::size_t k = 0; k < count; ++k) {
    const std::string group = snapshotGroup(k);
    const double t = 0.1 * static_cast<double>(k);
    out.write(group + "/time", std::vector{t, t, t, 0.0});
    out.write(group + "/position", std::vector{2.0 * t, 0.0, 0.0, -1.0});
    out.write(group + "/velocity", std::vector{2.0, 0.0, 0.0, 0.0});
    out.write(group + "/wall_position", std::vector{0.0, 1.0});
  }
  out.save();
}

TEST(Motion, IsThinnedEvenlyWithTheLastSnapshot) {
  const TemporaryFolder folder;
  writeSnapshots(folder.path() / "many.h5", 40);
  const auto motion = readMotion(folder.path() / "many.h5");
  ASSERT_TRUE(motion.has_value());
  ASSERT_EQ(motion->frames.size(), 20u);
  EXPECT_DOUBLE_EQ(motion->frames.front().time, 0.1);
  EXPECT_DOUBLE_EQ(motion->frames.back().time, 3.9);
  EXPECT_DOUBLE_EQ(largestSpeed(*motion), 2.0);
  EXPECT_DOUBLE_EQ(reachOf(*motion), 7.9);
  writeSnapshots(folder.path() / "few.h5", 3);
  EXPECT_EQ(readMotion(folder.path() / "few.h5")->frames.size(), 3u);
}

TEST(Motion, IsAbsentWhereNothingOfUseIsKept) {
  const TemporaryFolder folder;
  EXPECT_FALSE(readMotion(folder.path() / "missing.h5"));
  writeFile(folder.path() / "text.h5", "no snapshots");
  EXPECT_FALSE(readMotion(folder.path() / "text.h5"));
  writeSnapshots(folder.path() / "one.h5", 1);
  EXPECT_FALSE(readMotion(folder.path() / "one.h5")) << "one instant does not move";
  {  // while a file is open nobody else has any
    Hdf5File short_ = Hdf5File::create(folder.path() / "short.h5");
    short_.write("/disks/radius", std::vector{0.1, 0.1});
    for (const std::size_t k : {0u, 1u}) {
      short_.write(snapshotGroup(k) + "/time", std::vector{0.0, 0.0, 0.0, 0.0});
      short_.write(snapshotGroup(k) + "/position", std::vector{0.0, 0.0});  // of one disk
      short_.write(snapshotGroup(k) + "/velocity", std::vector{0.0, 0.0, 0.0, 0.0});
    }
    short_.save();
  }
  EXPECT_FALSE(readMotion(folder.path() / "short.h5"));
}

TEST(Motion, IsToldToTheScriptInFourBytesPerDisk) {
  Motion motion;
  motion.radius = {0.1, 0.1, 0.2};
  motion.frames = {{0.0, {-2.0, 2.0, 0.0}, {2.0, -2.0, 0.0}, {1.0, 0.0}}};
  const auto film = nlohmann::json::parse(motionData(motion, 1.0, 2.0, {"at first"}));
  EXPECT_EQ(film["radii"], nlohmann::json::parse("[[2, 0.025], [1, 0.05]]"));
  EXPECT_EQ(film["disks"], 2);
  EXPECT_EQ(film["told"], nlohmann::json({"at first"}));
  EXPECT_EQ(film["colours"].size(), speedColours().size());
  // Upper left corner, the fastest colour; lower right, the slowest; the middle: 2048 = 0x800.
  EXPECT_EQ(film["data"], "AAAAB////wCACAAA");
}

TEST(Motion, ColoursAreOfThreeDecades) {
  const auto& colours = speedColours();
  EXPECT_DOUBLE_EQ(colours.front().from, 1e-3);
  EXPECT_LT(colours.back().from, 1.0);
  for (std::size_t k = 1; k < colours.size(); ++k)
    EXPECT_NEAR(colours[k].from / colours[k - 1].from, std::pow(10.0, 3.0 / 8.0), 1e-12);
}

TEST(Films, AreOfRunsWhoseSnapshotsAreKeptOnOneScale) {
  const TemporaryFolder folder;
  CompareResults results = sample::compareResults(1, 10);
  EXPECT_TRUE(compareFilms(results, folder.path()).empty());
  writeSnapshots(folder.path() / "snapshots/grain-p0.h5", 4);
  writeSnapshots(folder.path() / "snapshots/yade-p0.h5", 2);
  const auto films = compareFilms(results, folder.path());
  ASSERT_EQ(films.size(), 2u);
  EXPECT_EQ(films[1].name, "motion_2_yade");
  EXPECT_EQ(films[0].drawing.halfWidth, films[1].drawing.halfWidth);
  EXPECT_EQ(nlohmann::json::parse(films[0].film)["told"].size(), 4u);
  const auto rim = results.cell.omega * results.cell.innerRadius;
  EXPECT_DOUBLE_EQ(fastestShown(results, {}), rim);
  results.cell.omega = 0.0;
  EXPECT_DOUBLE_EQ(fastestShown(results, {*readMotion(folder.path() / "snapshots/grain-p0.h5")}),
                   2.0);
}

}  // namespace
}  // namespace crossgrain::reports

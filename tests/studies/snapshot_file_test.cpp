#include "studies/flow/snapshot_file.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "cases/loader.hpp"
#include "studies/flow/average.hpp"
#include "support/bad_input.hpp"
#include "support/files.hpp"

namespace {

using namespace crossgrain;
namespace fs = std::filesystem;

class SnapshotFiles : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() /
              ("crossgrain-" +
               std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    fs::create_directories(folder_);
    setup_ = loadCase(fs::path(CROSSGRAIN_CASES) / "couette/quick.toml",
                      {"particles.small=2", "particles.large=0"})
                 .front();
  }
  void TearDown() override { fs::remove_all(folder_); }

  /// What any other program would write: no spins, no walls, no contacts.
  Hdf5File bareFile(std::size_t disks = 2) {
    Hdf5File file = Hdf5File::create(path());
    file.write("/disks/radius", std::vector(disks, 0.0037));
    file.write("/disks/mass", std::vector(disks, 0.275e-3));
    return file;
  }
  static void addInstant(Hdf5File& file) {
    file.write("/snapshot-000/time", std::vector{0.5, 0.5, 0.5, 0.0});
    const double positions[] = {0.05, 0.0, 0.0, 0.06}, velocities[] = {0.0, 0.2, -0.1, 0.0};
    file.write("/snapshot-000/position", positions, 2, 2);
    file.write("/snapshot-000/velocity", velocities, 2, 2);
  }
  fs::path path() const { return folder_ / "mine.h5"; }

  std::string refusal() {
    try {
      averageSnapshots(setup_, path(), "test");
    } catch (const BadInput& error) {
      return error.what();
    }
    return "no refusal";
  }

  fs::path folder_;
  Case setup_;
};

TEST_F(SnapshotFiles, WhatIsWrittenIsReadBack) {
  Scene scene;
  scene.disks.radius = {0.003, 0.004};
  scene.disks.mass = {1e-3, 2e-3};
  scene.disks.inertia = {1e-9, 2e-9};
  for (const char* name : {"wheel", "ring"}) {
    scene.bodies.emplace_back().name = name;
    scene.bodies.back().diskRadius = {0.001};
  }
  Snapshot now;
  now.positionTime = 1.0;
  now.velocityTime = 1.5;
  now.contactTime = 0.5;
  now.contactInterval = 0.25;
  now.position = {{0.05, 0.0}, {0.0, 0.06}};
  now.velocity = {{0.1, 0.2}, {0.3, 0.4}};
  now.spin = {5.0, -6.0};
  now.wallPosition = {{0.03, 0.0}, {0.075, 0.0}};
  now.bodies.resize(2);
  now.bodies[0].torque = 0.5;
  now.bodies[1].torque = -0.5;
  now.energies = Energies{1.0, 2.0};
  now.contacts.emplace();
  now.contacts->i = {0, 1};
  now.contacts->j = {1, 3};
  now.contacts->normal = {{1.0, 0.0}, {0.0, -1.0}};
  now.contacts->overlap = {1e-6, 2e-6};
  now.contacts->normalForce = {0.1, 0.2};
  now.contacts->tangentialForce = {0.01, -0.02};
  now.contacts->sliding = {0, 1};
  SnapshotFile out(path(), "someone", scene, 3, 3);
  for (int k = 1; k <= 3; ++k) {
    out.offer(now, k);
    EXPECT_TRUE(fs::exists(folder_ / "mine.h5.part"));
    EXPECT_FALSE(fs::exists(path())) << "not whole yet";
  }
  out.close();

  const SnapshotReader in(path(), setup_);
  EXPECT_EQ(in.engine(), "someone");
  ASSERT_EQ(in.count(), 3u);
  EXPECT_EQ(in.scene().disks.inertia, scene.disks.inertia);
  EXPECT_EQ(in.scene().bodies[1].name, "ring");
  EXPECT_EQ(in.scene().wallDiskCount(), 2u);
  EXPECT_EQ(in.scene().law.kn, setup_.law.kn);
  const Snapshot back = in.read(2);
  EXPECT_EQ(back.velocityTime, 1.5);
  EXPECT_EQ(back.contactInterval, 0.25);
  EXPECT_EQ(back.position, now.position);
  EXPECT_EQ(back.velocity, now.velocity);
  EXPECT_EQ(back.spin, now.spin);
  EXPECT_EQ(back.wallPosition, now.wallPosition);
  EXPECT_EQ(back.bodies[1].torque, -0.5);
  EXPECT_FALSE(back.bodies[0].force);
  EXPECT_EQ(back.energies->elastic, 2.0);
  EXPECT_EQ(back.contacts->j, now.contacts->j);
  EXPECT_EQ(back.contacts->normal, now.contacts->normal);
  EXPECT_EQ(back.contacts->tangentialForce, now.contacts->tangentialForce);
  EXPECT_EQ(back.contacts->sliding, now.contacts->sliding);

  const std::string xdmf = readFile(folder_ / "mine.xdmf").value();
  EXPECT_NE(xdmf.find("mine.h5:/snapshot-002/position"), std::string::npos);
  EXPECT_NE(xdmf.find("mine.h5:/snapshot-002/wall_position"), std::string::npos);
}

TEST_F(SnapshotFiles, OfARunBrokenOffIsBegunAnewAndEachSnapshotIsOnDiskAtOnce) {
  Scene scene;
  scene.disks.radius = {0.003};
  scene.disks.mass = {1e-3};
  scene.disks.inertia = {1e-9};
  Snapshot now;
  now.position = {{0.05, 0.0}};
  now.velocity = {{0.1, 0.2}};
  const auto size = [&] { return fs::file_size(folder_ / "mine.h5.part"); };
  std::uintmax_t afterOne = 0;
  for (int attempt = 0; attempt < 2; ++attempt) {
    SnapshotFile out(path(), "someone", scene, 100, 100);
    out.offer(now, 1);
    if (attempt == 0) afterOne = size();
    EXPECT_EQ(size(), afterOne);
    for (int k = 2; k <= 20; ++k) out.offer(now, k);
    EXPECT_GT(size(), afterOne);
  }
}

TEST_F(SnapshotFiles, AFolderThatCannotBeMadeIsOneClearLine) {
  Scene scene;
  Snapshot now;
  fs::create_directories(path());  // where the file should be
  SnapshotFile out(path(), "someone", scene, 1, 1);
  out.offer(now, 1);
  try {
    out.close();
    FAIL() << "no exception";
  } catch (const OutputError& error) {
    EXPECT_NE(std::string(error.what()).find("mine.h5: cannot be written"), std::string::npos)
        << error.what();
  }
}

TEST_F(SnapshotFiles, WhatIsAbsentStaysAbsent) {
  {
    Hdf5File file = bareFile();
    addInstant(file);
    file.save();
  }
  const auto results = averageSnapshots(setup_, path(), "test");
  const std::vector<Profile>& profiles = results.runs[0].profiles;
  EXPECT_FALSE(profileOf(profiles, "spin"));
  EXPECT_FALSE(profileOf(profiles, "stress_rr"));
  EXPECT_EQ(results.engines[0].name, "mine");
  // v_φ of the disk at (0, 0.06) is 0.1: ring 4 of six between 0.03 and 0.075.
  const Profile* velocity = profileOf(profiles, "azimuthal_velocity");
  ASSERT_TRUE(velocity);
  EXPECT_NEAR(velocity->mean[4].value(), 0.1, 1e-12);
  EXPECT_FALSE(velocity->mean[0]);
}

TEST_F(SnapshotFiles, WhatDoesNotFitIsRefusedInOneLine) {
  writeFile(path(), "not HDF5");
  EXPECT_NE(refusal().find("mine.h5: cannot be read as an HDF5 file"), std::string::npos);

  bareFile().save();
  EXPECT_NE(refusal().find("there is no /snapshot-000/position in it"), std::string::npos);

  {
    Hdf5File file = bareFile(3);
    addInstant(file);
    file.save();
  }
  EXPECT_NE(refusal().find("/snapshot-000/position holds 4 numbers, wanted are 6"),
            std::string::npos);

  {
    Hdf5File file = bareFile();
    addInstant(file);
    file.write("/snapshot-000/spin", std::vector{1.0, std::nan("")});
    file.save();
  }
  EXPECT_NE(refusal().find("/snapshot-000/spin holds a number that is not finite"),
            std::string::npos);

  {
    Hdf5File file = bareFile();
    addInstant(file);
    file.write("/snapshot-000/contacts/i", std::vector<std::int32_t>{0});
    file.write("/snapshot-000/contacts/j", std::vector<std::int32_t>{2});
    file.save();
  }
  EXPECT_NE(refusal().find("/contacts/j holds 2; wanted are whole numbers from 0 to 1"),
            std::string::npos);
}

}  // namespace

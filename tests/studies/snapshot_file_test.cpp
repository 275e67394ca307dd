// Files of snapshots: written data are read back, and files that do not fit a case are refused.
#include "studies/flow/snapshot_file.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <functional>

#include "cases/couette.hpp"
#include "studies/flow/average.hpp"
#include "studies/flow/snapshot_fit.hpp"
#include "support/files.hpp"
#include "tests/studies/quick_cell.hpp"
#include "tests/support/refusal.hpp"
#include "tests/support/temporary_folder.hpp"

namespace {

using namespace crossgrain;
namespace fs = std::filesystem;

class SnapshotFiles : public testing::Test {
 protected:
  /// Writes a file as any other program would: no spins, no walls, no contacts.
  /// @param more  into the first snapshot
  void writeBare(std::size_t disks = 2, const std::function<void(Hdf5File&)>& more = {}) const {
    Hdf5File file = Hdf5File::create(path_);
    file.write("/disks/radius", std::vector(disks, 0.0037));
    file.write("/disks/mass", std::vector(disks, 0.275e-3));
    if (more) {
      file.write("/snapshot-000/time", std::vector{0.5, 0.5, 0.5, 0.0});
      const double positions[] = {0.05, 0.0, 0.0, 0.06}, velocities[] = {0.0, 0.2, -0.1, 0.0};
      file.write("/snapshot-000/position", positions, 2, 2);
      file.write("/snapshot-000/velocity", velocities, 2, 2);
      more(file);
    }
    file.save();
  }

  const TemporaryFolder folder_;
  const fs::path path_ = folder_.path() / "mine.h5", part_ = folder_.path() / "mine.h5.part";
  const Case setup_ = test::quickCell({"particles.small=2", "particles.large=0"});
};

Scene sceneOf(std::size_t disks) {
  Scene scene;
  scene.disks.radius.resize(disks, 0.003);
  scene.disks.mass.resize(disks, 1e-3);
  for (std::size_t i = 0; i < disks; ++i)
    scene.disks.inertia.push_back(1e-9 * static_cast<double>(i + 1));
  return scene;
}

TEST_F(SnapshotFiles, InSpace_VectorsAndSpinsHaveThreeColumns) {
  SpaceScene scene;
  scene.disks.radius = {0.5, 0.25};
  scene.disks.mass = scene.disks.inertia = {1.0, 2.0};
  scene.bodies.emplace_back().diskRadius = {0.1};
  SpaceSnapshot now;
  now.positionTime = 1.5;
  now.position = {Vec3(1, 2, 3), Vec3(4, 5, 6)};
  now.velocity = {Vec3(7, 8, 9), Vec3(10, 11, 12)};
  now.spin = std::vector<Vec3>{Vec3(-1, -2, -3), Vec3(-4, -5, -6)};
  now.wallPosition = {Vec3(0, 0, -1)};
  now.bodies.resize(1);
  now.bodies[0].force = Vec3(0.5, 0.0, -2.0);
  auto& contacts = now.contacts.emplace();
  contacts.i = {0};
  contacts.j = {1};
  contacts.normal = {Vec3::UnitZ()};
  contacts.overlap = {0.01};
  contacts.normalForce = {3.0};
  contacts.tangentialForce = {Vec3(0.1, 0.2, 0.0)};
  SnapshotFileOf<3> out(path_, "someone", scene, 1, 1);
  out.offer(now, 1);
  out.close();

  const Hdf5File in = Hdf5File::open(path_);
  using Row = std::vector<double>;
  EXPECT_EQ(in.readAttribute("dimension"), 3.0);
  EXPECT_EQ(in.read("/snapshot-000/position"), (Row{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(in.read("/snapshot-000/spin"), (Row{-1, -2, -3, -4, -5, -6}));
  EXPECT_EQ(in.read("/snapshot-000/wall_position"), (Row{0, 0, -1}));
  EXPECT_EQ(in.read("/snapshot-000/bodies/force"), (Row{0.5, 0.0, -2.0}));
  EXPECT_EQ(in.read("/snapshot-000/contacts/tangential_force"), (Row{0.1, 0.2, 0.0}));
  const std::string xdmf = readFile(fs::path(path_).replace_extension(".xdmf")).value();
  test::expectSays(xdmf, {"GeometryType=\"XYZ\"", "Name=\"spin\" AttributeType=\"Vector\""});
}

TEST_F(SnapshotFiles, Snapshots_WrittenAndRead_AreTheSame) {
  Scene scene = sceneOf(2);
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
  SnapshotFile out(path_, "someone", scene, 3, 3);
  for (int k = 1; k <= 3; ++k) {
    out.offer(now, k);
    EXPECT_TRUE(fs::exists(part_));
    EXPECT_FALSE(fs::exists(path_)) << "not whole yet";
  }
  out.close();

  const SnapshotReader in(path_, setup_);
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

  const std::string xdmf = readFile(folder_.path() / "mine.xdmf").value();
  test::expectSays(xdmf, {"mine.h5:/snapshot-002/position", "mine.h5:/snapshot-002/wall_position"});
}

TEST_F(SnapshotFiles, RunBrokenOff_IsBegunAnewAndEachSnapshotIsOnDiskAtOnce) {
  const Scene scene = sceneOf(1);
  Snapshot now{.position = {{0.05, 0.0}}, .velocity = {{0.1, 0.2}}};
  std::uintmax_t afterOne = 0;
  for (int attempt = 0; attempt < 2; ++attempt) {
    SnapshotFile out(path_, "someone", scene, 100, 100);
    out.offer(now, 1);
    if (attempt == 0) afterOne = fs::file_size(part_);
    EXPECT_EQ(fs::file_size(part_), afterOne);
    for (int k = 2; k <= 20; ++k) out.offer(now, k);
    EXPECT_GT(fs::file_size(part_), afterOne);
  }
}

TEST_F(SnapshotFiles, FolderInItsPlace_ThrowsOutputError) {
  fs::create_directories(path_);
  SnapshotFile out(path_, "someone", Scene(), 1, 1);
  out.offer(Snapshot(), 1);
  const std::string said = test::refusalOf<OutputError>([&] { out.close(); });
  EXPECT_NE(said.find("mine.h5: cannot be written"), std::string::npos) << said;
}

TEST_F(SnapshotFiles, FileWithoutSpinsAndContacts_HasNoAveragesOfThem) {
  writeBare(2, [](Hdf5File&) {});
  const auto results = averageSnapshots(setup_, {path_}, "test");
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

TEST_F(SnapshotFiles, MalformedFile_ThrowsNamingTheData) {
  const auto expectRefusal = [&](const char* words) {
    const std::string said = test::refusalOf([&] { averageSnapshots(setup_, {path_}, "test"); });
    EXPECT_NE(said.find(words), std::string::npos) << said;
  };
  writeFile(path_, "not HDF5");
  expectRefusal("mine.h5: is no HDF5 file");
  writeBare();
  expectRefusal("there is no /snapshot-000/position in it");
  writeBare(3, [](Hdf5File&) {});
  expectRefusal("/snapshot-000/position holds 4 numbers, wanted are 6");
  writeBare(2, [](Hdf5File& file) {
    file.write("/snapshot-000/spin", std::vector{1.0, std::nan("")});
  });
  expectRefusal("/snapshot-000/spin holds a number that is not finite");
  writeBare(2, [](Hdf5File& file) {
    file.write("/snapshot-000/contacts/i", std::vector<std::int32_t>{0});
    file.write("/snapshot-000/contacts/j", std::vector<std::int32_t>{2});
  });
  expectRefusal("/contacts/j holds 2; wanted are whole numbers from 0 to 1");
}

TEST_F(SnapshotFiles, OtherCell_IsRefusedWithEveryMisfit) {
  const Case own = test::quickCell();
  Packing packing;
  packing.disks = diskKinds(couetteIn(own).particles);
  for (Vec2& at : packing.disks.position) at = {0.05, 0.0};
  const Scene scene = couetteScene(own, packing, 1e-5);
  Snapshot now{.position = scene.disks.position, .velocity = scene.disks.velocity};
  for (const WallBody& body : scene.bodies)
    now.wallPosition.insert(now.wallPosition.end(), body.diskPosition.begin(),
                            body.diskPosition.end());
  now.bodies.resize(2);
  now.bodies[0].angularVelocity = couetteIn(own).cell.omega;
  SnapshotFile out(path_, "someone", scene, 1, 1);
  out.offer(now, 1);
  out.close();
  const auto misfit = [&](const std::function<void(Case&)>& change) {
    Case other = own;
    change(other);
    const SnapshotReader reader(path_, other);
    return test::refusalOf(
        [&] { requireFit(reader.scene(), reader.read(0), other, {path_.string()}); });
  };
  EXPECT_EQ(misfit([](Case&) {}), "");
  EXPECT_EQ(misfit([](Case& c) {  // a packing file's disks are its own
              couetteIn(c).particles.file = "mine.h5";
              couetteIn(c).particles.small = couetteIn(c).particles.large = 0;
            }),
            "");
  const std::pair<std::function<void(Case&)>, const char*> misfits[] = {
      {[](Case& c) { ++couetteIn(c).particles.small; }, " small disks, not "},
      {[](Case& c) { couetteIn(c).particles.smallRadius = 0.00371; },
       "disks of radius 0.0037 m, not "},
      {[](Case& c) { couetteIn(c).particles.largeMass *= 1.1; },
       "a large disk's mass 0.00049 kg, not "},
      {[](Case& c) { couetteIn(c).cell.omega *= 2.0; },
       "a wheel that turns at 1 rad/s, not 2 rad/s"},
      {[](Case& c) { couetteIn(c).cell.outerRadius *= 1.01; }, "the ring's radius "},
      {[](Case& c) { couetteIn(c).cell.innerRadius *= 1.01; }, "the wheel's radius "},
      {[](Case& c) { couetteIn(c).cell.wallRadius *= 1.1; }, "wall disks' radius 0.00125 m, not "},
      {[](Case& c) { couetteIn(c).cell.wallSpacing = 0.007; }, " wall disks of the wheel, not "}};
  for (const auto& [change, says] : misfits)
    EXPECT_NE(misfit(change).find(says), std::string::npos) << says << ": " << misfit(change);
  const std::string all = misfit(
      [](Case& c) { c = loadCase(fs::path(CROSSGRAIN_CASES) / "couette/nu-0.804.toml").front(); });
  for (const char* const each : {"mine.h5 does not fit", "nu-0.804.toml", "disks, not 2921",
                                 "the wheel's radius 0.03 m, not 0.1032 m", "not between"})
    EXPECT_NE(all.find(each), std::string::npos) << all;
  EXPECT_EQ(all.find('\n'), std::string::npos);
}

}  // namespace

// Snapshots as files of other programs, on an example that can be checked by hand: signs, sides,
// order and numbers. tests/averaging/mercurycg_test.cpp averages such files.
#include "adapters/files/write_snapshots.hpp"

#include <gtest/gtest.h>

#include <string>

#include "support/files.hpp"
#include "support/hdf5_file.hpp"
#include "tests/support/refusal.hpp"
#include "tests/support/temporary_folder.hpp"

namespace {

using namespace crossgrain;

/// Disks 0 and 1 overlap by 0.02 m; 0 lies on a floor and pushes on the only disk of a post.
///   on 0 by 1: 20 N to the left, 3 N down · on 0 by the post: 5 N up, 1 N to the right
///   on 0 by the floor: 7 N up, 2 N to the right
class WrittenSnapshots : public testing::Test {
 protected:
  WrittenSnapshots() {
    scene_.disks.radius = {0.5, 0.5};
    scene_.disks.mass = {2.0, 0.1};
    scene_.disks.inertia = {0.25, 0.0125};
    WallBody post;
    post.name = "post";
    post.diskPosition = {{1.0, 1.25}};
    post.diskRadius = {0.25};
    WallBody floor;
    floor.name = "floor";
    floor.planes = {{{0.0, 1.505}, Vec2::UnitY()}};
    scene_.bodies = {post, floor};
    now_.positionTime = 0.5;
    now_.velocityTime = 0.25;
    now_.contactTime = 0.5;
    now_.position = {{1.0, 2.0}, {1.98, 2.0}};
    now_.velocity = {{0.1, 0.0}, {0.0, 0.0}};
    now_.spin = {1.0, 0.0};
    now_.wallPosition = {{1.0, 1.25}};
    now_.bodies.resize(2);
    now_.bodies[0].centre = {0.0, 1.25};
    now_.bodies[0].angularVelocity = 2.0;
    now_.contacts.emplace();
    now_.contacts->i = {0, 0, 0};
    now_.contacts->j = {1, 2, 3};
    now_.contacts->normal = {{-1.0, 0.0}, {0.0, 1.0}, {0.0, 1.0}};
    now_.contacts->overlap = {0.02, 0.0, 0.005};
    now_.contacts->normalForce = {20.0, 5.0, 7.0};
    now_.contacts->tangentialForce = {3.0, -1.0, -2.0};  // along z × n
    now_.contacts->rollingTorque = {0.5, 0.0, 0.0};
  }

  std::string written(const std::string& format, const std::string& ending) {
    const auto writer = files::openWriter(format, out_, scene_, {{0.0, 0.0}, {4.0, 4.0}, 0.5});
    writer->write(now_);
    writer->close();
    for (const std::string& line : writer->notWritten()) said_ += line + "\n";
    return readFile(out_.string() + ending).value();
  }

  Scene scene_;
  Snapshot now_;
  const TemporaryFolder folder_;
  const std::filesystem::path out_ = folder_.path() / "deeper" / "run";
  std::string said_;
};

TEST_F(WrittenSnapshots, MercuryDpmData_HasWallDisksAfterDisks) {
  EXPECT_EQ(written("mercurydpm", ".data"),
            "3 0.5 0 0 -0.25 4 4 0.25\n"
            "1 2 0 0.1 0 0 0.5 0 0 0 0 0 1 0\n"
            "1.98 2 0 0 0 0 0.5 0 0 0 0 0 0 1\n"
            "1 1.25 0 0 2 0 0.25 0 0 0 0 0 2 0\n");
  test::expectSays(said_, {"velocities are of -0.25 s, contacts of +0 s from there"});
}

/// Densities 2/(π/4) and 0.1/(π/4) kg/m², the wall disk fixed.
TEST_F(WrittenSnapshots, MercuryDpmRestart_HasDensitiesAndFixedParticles) {
  EXPECT_EQ(
      written("mercurydpm", ".restart"),
      "MercuryDPM 1.0 name run\n"
      "dataFile    fileType ONE_FILE saveCount 1 counter 0\n"
      "fStatFile   fileType ONE_FILE saveCount 1 counter 0\n"
      "eneFile     fileType ONE_FILE saveCount 1 counter 0\n"
      "restartFile fileType ONE_FILE saveCount 1 counter 0\n"
      "statFile    fileType ONE_FILE saveCount 1 counter 0\n"
      "interactionFile fileType NO_FILE saveCount 0 counter 0\n"
      "xMin 0 xMax 4 yMin 0 yMax 4 zMin -0.25 zMax 0.25\n"
      "timeStep 1 time 0.5 ntimeSteps 0 timeMax 0.5\n"
      "systemDimensions 3 particleDimensions 2 gravity 0 0 0 backgroundDrag 0\n"
      "Species 2\n"
      "LinearViscoelasticSpecies id 0 density 2.5464790894703255 stiffness 1 dissipation 0\n"
      "LinearViscoelasticSpecies id 1 density 0.12732395447351627 stiffness 1 dissipation 0\n"
      "LinearViscoelasticMixedSpecies idA 1 idB 0 stiffness 1 dissipation 0\n"
      "Walls 0\nBoundaries 0\nParticles 3\n"
      "SphericalParticle id 0 indSpecies 0 position 1 2 0 orientation 1 0 0 0 velocity 0.1 0 0 "
      "angularVelocity 0 0 1 force 0 0 0 torque 0 0 0 radius 0.5 invMass 0.5 timeStamp 0\n"
      "SphericalParticle id 1 indSpecies 1 position 1.98 2 0 orientation 1 0 0 0 velocity 0 0 0 "
      "angularVelocity 0 0 0 force 0 0 0 torque 0 0 0 radius 0.5 invMass 10 timeStamp 0\n"
      "SphericalParticle id 2 indSpecies 0 position 1 1.25 0 orientation 1 0 0 0 velocity 0 2 0 "
      "angularVelocity 0 0 2 force 0 0 0 torque 0 0 0 radius 0.25 invMass 0 timeStamp 0\n"
      "Interactions 0\n");
}

/// Two lines of two free disks, one of a fixed partner, and of a wall n and t the other way round:
/// on 0 acts −(7 (0, −1) + 2 (−1, 0)).
TEST_F(WrittenSnapshots, MercuryDpmForces_HaveItsSidesAndFlippedWalls) {
  EXPECT_EQ(written("mercurydpm", ".fstat"),
            "# 0.5 1\n"
            "# 0 0 -0.25 4 4 0.25\n"
            "# 0.25 0.5 0 0 0 0\n"
            "0.5 0 1 1.49 2 0 0.02 0 20 3 -1 0 0 0 -1 0\n"
            "0.5 1 0 1.49 2 0 0.02 0 20 3 1 0 0 0 1 0\n"
            "0.5 0 2 1 1.5 0 0 0 5 1 0 1 0 1 0 0\n"
            "0.5 0 -1 1 1.5025 0 0.005 0 7 2 0 -1 0 -1 0 0\n");
}

/// As lmp of 29 Sep 2021 prints them for the computes that adapters/files/write_lammps.cpp names.
/// Rolling: R* n × f = 0.25 (−1, 0) × (0, −2) = 0.5 N m.
TEST_F(WrittenSnapshots, LammpsDumps_HaveTypesOfWallsAndContactsWithPlanes) {
  const std::string head = "ITEM: UNITS\nsi\nITEM: TIME\n0.5\nITEM: TIMESTEP\n0\n";
  const std::string box = "ITEM: BOX BOUNDS ff ff pp\n0 4\n0 4\n-0.25 0.25\n";
  EXPECT_EQ(written("lammps", ".dump"),
            head + "ITEM: NUMBER OF ATOMS\n3\n" + box +
                "ITEM: ATOMS id type x y z radius mass vx vy vz omegax omegay omegaz f_w0[1] "
                "f_w0[2] f_w0[3] f_w0[4] f_w0[5] f_w0[6] f_w0[7] f_w0[8]\n"
                "1 1 1 2 0 0.5 2 0.1 0 0 0 0 1 1 2 7 0 1 1.505 0 0.5\n"
                "2 1 1.98 2 0 0.5 0.1 0 0 0 0 0 0 0 0 0 0 0 0 0 0\n"
                "3 2 1 1.25 0 0.25 0 0 2 0 0 0 2 0 0 0 0 0 0 0 0\n");
  EXPECT_EQ(readFile(out_.string() + ".contacts").value(),
            head + "ITEM: NUMBER OF ENTRIES\n2\n" + box +
                "ITEM: ENTRIES index c_p[1] c_p[2] c_q[1] c_q[2] c_q[3] c_q[4] c_q[5] c_q[6] "
                "c_q[7] c_q[8] c_q[9] c_q[10] c_q[11] c_q[12] c_q[13]\n"
                "1 1 2 20 0 -3 0 3 0 -2 0 2 0 -0.98 0 0\n"
                "2 1 3 5 1 0 0 1 0 0 0 0 0 0 0.75 0\n");
}

TEST_F(WrittenSnapshots, OnDem_ForcesAreOnTheSecondAndTractionIsPositive) {
  EXPECT_GT(written("ondem", "-000.vtkhdf").size(), 0u);
  EXPECT_FALSE(std::filesystem::exists(out_.string() + "-001.vtkhdf"));
  const Hdf5File file = Hdf5File::open(out_.string() + "-000.vtkhdf");
  const auto numbers = [&](const std::string& path) { return file.read(path).value(); };
  using Numbers = std::vector<double>;
  const std::string contacts = "/ONDEM/Interactions/contact/";
  EXPECT_EQ(numbers(contacts + "id1"), (Numbers{0, 0, 0}));
  EXPECT_EQ(numbers(contacts + "id2"), (Numbers{1, 2, 3}));
  // From id1 to id2; on id2 acts −normal_force · normal + shear_force.
  EXPECT_EQ(numbers(contacts + "normal"), (Numbers{1, 0, 0, 0, -1, 0, 0, -1, 0}));
  EXPECT_EQ(numbers(contacts + "normal_force"), (Numbers{-20, -5, -7}));
  EXPECT_EQ(numbers(contacts + "shear_force"), (Numbers{0, 3, 0, -1, 0, 0, -2, 0, 0}));
  EXPECT_EQ(numbers(contacts + "overlap"), (Numbers{0.02, 0, 0.005}));
  const std::string points = "/VTKHDF/Points/PointData/", others = "/VTKHDF/Others/";
  EXPECT_EQ(numbers("/VTKHDF/Points/Points"), (Numbers{1, 2, 0, 1.98, 2, 0, 1, 1.25, 0}));
  EXPECT_EQ(numbers(points + "body_id"), (Numbers{0, 1, 2}));
  EXPECT_EQ(numbers(points + "blocked_dofs"), (Numbers{28, 28, 63}));
  EXPECT_EQ(numbers(points + "angular_velocity"), (Numbers{0, 0, 1, 0, 0, 0, 0, 0, 2}));
  EXPECT_EQ(numbers(points + "inertia")[8], 0.25);
  EXPECT_TRUE(std::isnan(numbers(points + "mass")[2]));
  EXPECT_EQ(numbers(others + "Points"), (Numbers{0, 1.505, 0}));
  EXPECT_EQ(numbers(others + "PointData/body_id"), (Numbers{3}));
  EXPECT_EQ(numbers(others + "PointData/plane_normal"), (Numbers{0, 1, 0}));
  EXPECT_EQ(numbers("/ONDEM/Materials/0/density"), (Numbers{2.1 / (2 * 3.141592653589793 * .125)}));
}

/// 0.1 + 0.2 is 0.30000000000000004, and not 0.3.
TEST_F(WrittenSnapshots, Numbers_ReadBackAsTheSameDoubles) {
  now_.position[1].x() = 0.1 + 0.2;
  EXPECT_NE(written("mercurydpm", ".data").find("\n0.30000000000000004 2 0 "), std::string::npos);
}

TEST_F(WrittenSnapshots, Unfinished_LeavesNoFile) {
  {
    const auto writer = files::openWriter("lammps", out_, scene_, {});
    writer->write(now_);
    EXPECT_TRUE(std::filesystem::exists(out_.string() + ".dump.part"));
  }
  EXPECT_TRUE(std::filesystem::is_empty(out_.parent_path()));
}

TEST_F(WrittenSnapshots, UnknownFormat_ThrowsNamingTheOthers) {
  const std::string said = test::refusalOf([&] { files::openWriter("pdb", out_, scene_, {}); });
  test::expectSays(said, {"\"pdb\"", "mercurydpm, lammps, ondem"});
}

TEST_F(WrittenSnapshots, NoContacts_IsSaid) {
  now_.contacts.reset();
  EXPECT_EQ(written("mercurydpm", ".fstat"), "# 0.5 1\n# 0 0 -0.25 4 4 0.25\n# 0.25 0.5 0 0 0 0\n");
  EXPECT_NE(said_.find("contacts: the snapshots have none"), std::string::npos) << said_;
}

}  // namespace

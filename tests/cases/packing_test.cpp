#include "cases/packing.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "support/bad_input.hpp"
#include "support/hdf5_file.hpp"

namespace {

using namespace crossgrain;
namespace fs = std::filesystem;

fs::path file(const char* name) {
  return fs::path(testing::TempDir()) / name;
}

Case kinds() {
  Case setup;
  setup.particles.smallRadius = 1.0;
  setup.particles.largeRadius = 2.0;
  setup.particles.smallMass = 3.0;
  setup.particles.largeMass = 7.0;
  return setup;
}

TEST(Packing, ComesBackFromItsFileBitForBit) {
  Packing packing;
  packing.disks.radius = {1.0, 2.0};
  packing.disks.mass = {3.0, 1.0 / 3.0};
  packing.disks.inertia = {0.1, 0.2};
  packing.disks.position = {Vec2(0.1, 0.2), Vec2(-5.0, 1e-17)};
  packing.disks.velocity = {Vec2(1.0, 0.0), Vec2(0.0, -1.0)};
  packing.disks.spin = {4.0, -0.0};
  packing.wheelAngle = 0.7;
  packing.hash = "abc";
  writePacking(packing, file("packing.h5"));
  const Packing back = readPacking(file("packing.h5"), kinds());
  EXPECT_EQ(back.disks.radius, packing.disks.radius);
  EXPECT_EQ(back.disks.mass, packing.disks.mass);
  EXPECT_EQ(back.disks.inertia, packing.disks.inertia);
  EXPECT_EQ(back.disks.position, packing.disks.position);
  EXPECT_EQ(back.disks.velocity, packing.disks.velocity);
  EXPECT_EQ(back.disks.spin, packing.disks.spin);
  EXPECT_EQ(back.wheelAngle, 0.7);
  EXPECT_EQ(back.hash, "abc");
}

TEST(Packing, AUsersFileNeedsRadiiAndPositionsOnly) {
  {
    Hdf5File out = Hdf5File::create(file("user.h5"));
    const std::vector<double> position = {0.0, 0.0, 5.0, 0.0};
    out.write("radius", std::vector<double>{1.0, 2.0});
    out.write("position", position.data(), 2, 2);
    out.save();
  }
  const Packing packing = readPacking(file("user.h5"), kinds());
  EXPECT_EQ(packing.disks.mass, (std::vector<double>{3.0, 7.0}));  // by kind, from the case
  EXPECT_EQ(packing.disks.inertia, (std::vector<double>{0.5 * 3.0 * 1.0, 0.5 * 7.0 * 4.0}));
  EXPECT_EQ(packing.disks.velocity[1], Vec2::Zero());
}

TEST(Packing, BadFilesAreBadInput) {
  EXPECT_THROW(readPacking(file("none.h5"), kinds()), BadInput);
  {
    Hdf5File out = Hdf5File::create(file("short.h5"));
    out.write("radius", std::vector<double>{1.0, 2.0});
    out.write("position", std::vector<double>{0.0, 0.0});
    out.save();
  }
  try {
    readPacking(file("short.h5"), kinds());
    FAIL() << "accepted";
  } catch (const BadInput& bad) {
    EXPECT_NE(std::string(bad.what()).find("position has 2 values for 2 disks; 4 are needed"),
              std::string::npos);
  }
  std::ofstream(file("text.h5")) << "not HDF5";
  EXPECT_THROW(readPacking(file("text.h5"), kinds()), BadInput);
}

}  // namespace

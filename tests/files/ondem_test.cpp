/// ON-DEM's VTKHDF: a file of the layout of its sample test_5spheres, made here.
#include <gtest/gtest.h>

#include "tests/files/samples.hpp"

namespace {

using namespace crossgrain::files;
using namespace crossgrain::files::sampled;

using OnDem = Sampled;

TEST_F(OnDem, Scene_ForceOnTheFirst_WallSecond) {
  writeOnDem(folder_.path() / "a.vtkhdf");
  EXPECT_EQ(formatOf(folder_.path() / "a.vtkhdf"), "ondem");
  const FileFrame frame = samples_.read("ondem", {"a.vtkhdf"}).front();
  EXPECT_EQ(frame.time, 0.5);
  EXPECT_EQ(frame.particles.id, (std::vector<std::int64_t>{7, 9}));
  EXPECT_EQ(frame.particles.spin[0], Vec3(0, 0, 1));
  const FileContacts& contacts = *frame.contacts;
  ASSERT_EQ(contacts.size(), 2u);  // the third is virtual
  EXPECT_EQ(contacts.first, (std::vector<std::int64_t>{7, 7}));
  EXPECT_EQ(contacts.second, (std::vector<std::int64_t>{9, -1}));
  // normal is from id1 to id2, forces on id2.
  EXPECT_EQ(contacts.normal[0], Vec3(-1, 0, 0));
  EXPECT_EQ(contacts.force[0], Vec3(-20, -3, 0));
  EXPECT_EQ(contacts.normal[1], Vec3(0, 0, 1));
  EXPECT_EQ(contacts.force[1], Vec3(0, 0, 5));
  EXPECT_EQ(contacts.overlap[1], 0.005);
}

/// Without shear_force the forces are those along the normal, and not all of them.
TEST_F(OnDem, ForcesAlongTheNormalAlone_AreNotWhole) {
  writeOnDem(folder_.path() / "a.vtkhdf",
             {.sign = 1.0, .without = {"/ONDEM/Interactions/shear_force"}});
  const FileContacts contacts = *samples_.read("ondem", {"a.vtkhdf"}).front().contacts;
  EXPECT_TRUE(contacts.force.empty());
  EXPECT_EQ(contacts.normalForce, (std::vector{20.0, 5.0}));
}

TEST_F(OnDem, WhatTheExporterLeavesOut_IsNamed) {
  writeOnDem(folder_.path() / "a.vtkhdf", {.sign = 1.0, .without = {"/VTKHDF/PointData/body_id"}});
  EXPECT_EQ(samples_.refusal("ondem", {"a.vtkhdf"}),
            "a.vtkhdf: there is no /VTKHDF/PointData/body_id: the exporter left it out (it prints "
            "\"SKIPPED\" then)");
  writeOnDem(folder_.path() / "a.vtkhdf", {.sign = 1.0, .without = {"/ONDEM/Interactions/id1"}});
  EXPECT_FALSE(samples_.read("ondem", {"a.vtkhdf"}).front().contacts);
  writeOnDem(folder_.path() / "a.vtkhdf",
             {.sign = 1.0, .without = {"/ONDEM/Interactions/normal_force"}});
  EXPECT_EQ(samples_.refusal("ondem", {"a.vtkhdf"}),
            "a.vtkhdf: there is no /ONDEM/Interactions/normal_force: the exporter left it out (it "
            "prints \"SKIPPED\" then)");
}

/// The schema has normal_force "positive in traction", the exporter in pressure.
TEST_F(OnDem, Traction_HasToBeSaid) {
  writeOnDem(folder_.path() / "a.vtkhdf", {.sign = -1.0, .without = {}});
  EXPECT_EQ(
      samples_.refusal("ondem", {"a.vtkhdf"}),
      "a.vtkhdf: /ONDEM/Interactions/normal_force is negative where bodies overlap: it counts "
      "traction as positive, the exporter's files count pressure so; say columns = "
      "normal_force=traction");
  const FileContacts contacts =
      *samples_.read("ondem", {"a.vtkhdf"}, {"normal_force=traction"}).front().contacts;
  EXPECT_EQ(contacts.force[0], Vec3(-20, -3, 0));
}

TEST_F(OnDem, NoHdf5_IsRefused) {
  samples_.write("a.vtkhdf", "\x89HDF\r\n\x1a\nVTKHDF");
  EXPECT_EQ(samples_.refusal("ondem", {"a.vtkhdf"}), "a.vtkhdf: cannot be read as an HDF5 file");
}

}  // namespace

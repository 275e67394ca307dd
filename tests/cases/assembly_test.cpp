// Disks and walls of a case file's arrangements.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "cases/assembly_scene.hpp"
#include "support/bad_input.hpp"
#include "tests/support/refusal.hpp"

namespace {

using namespace crossgrain;

Case twoDisks() {
  Case setup;
  setup.source = Assembly();
  setup.run.dt = 1e-3;
  assemblyIn<2>(setup).duration = 1.0;
  DiskGroup group;
  group.radius = 0.5;
  group.mass = 3.0;
  group.places = gridPlaces(2, 1, {1.0, 1.0}, false);
  group.velocity = {1.0, 2.0};
  group.spin = 4.0;
  assemblyIn<2>(setup).disks.push_back(group);
  WallGroup wall;
  wall.planes.push_back({{0.0, -0.5}, {0.0, 1.0}});
  assemblyIn<2>(setup).walls.push_back(wall);
  assemblyIn<2>(setup).gravity = {0.0, -10.0};
  return setup;
}

TEST(Places, GridsAndHeaps) {
  const auto grid = gridPlaces(2, 3, {1.0, 2.0}, true);
  ASSERT_EQ(grid.size(), 6u);
  EXPECT_EQ(grid[3], Vec2(1.5, 2.0));
  EXPECT_EQ(grid[5], Vec2(1.0, 4.0));
  const auto heap = heapPlaces(3, 1.0);
  ASSERT_EQ(heap.size(), 6u);
  EXPECT_NEAR(heap[3].x(), 0.5, 1e-15);
  for (const int below : {0, 1})  // touches the two that it lies on
    EXPECT_NEAR((heap[3] - heap[static_cast<std::size_t>(below)]).norm(), 1.0, 1e-15);
}

TEST(AssemblyScene, DisksWallsStep) {
  const Scene scene = assemblyScene(twoDisks());
  ASSERT_EQ(scene.disks.size(), 2u);
  EXPECT_EQ(scene.disks.position[1], Vec2(1.0, 0.0));
  EXPECT_EQ(scene.disks.inertia[0], 0.5 * 3.0 * 0.25);
  EXPECT_EQ(scene.bodies.at(0).planes.at(0).point, Vec2(0.0, -0.5));
  EXPECT_EQ(scene.dt, 1e-3);
}

TEST(AssemblyScene, Placement_MirrorTurnShiftBoost) {
  Case setup = twoDisks();
  assemblyIn<2>(setup).placement.mirror = true;
  assemblyIn<2>(setup).placement.turn = std::numbers::pi / 2.0;
  assemblyIn<2>(setup).placement.offset = {10.0, 0.0};
  assemblyIn<2>(setup).placement.boost = {0.0, 7.0};
  const Scene scene = assemblyScene(setup);
  // (1, 0) → (−1, 0) → (0, −1) → (10, −1); velocity (1, 2) → (−1, 2) → (−2, −1) → (−2, 6).
  EXPECT_NEAR((scene.disks.position[1] - Vec2(10.0, -1.0)).norm(), 0.0, 1e-14);
  EXPECT_NEAR((scene.disks.velocity[1] - Vec2(-2.0, 6.0)).norm(), 0.0, 1e-14);
  EXPECT_EQ(scene.disks.spin[0], -4.0);
  EXPECT_NEAR((scene.gravity - Vec2(10.0, 0.0)).norm(), 0.0, 1e-14);
  const WallBody& wall = scene.bodies.at(0);
  EXPECT_NEAR((wall.planes[0].normal - Vec2(-1.0, 0.0)).norm(), 0.0, 1e-14);
  EXPECT_EQ(wall.motion.kind, Motion::Kind::translating);
  EXPECT_EQ(wall.motion.velocity, Vec2(0.0, 7.0));
  const Vec2 later = scene.disks.position[1] + 2.0 * assemblyIn<2>(setup).placement.boost;
  EXPECT_NEAR((assemblyIn<2>(setup).placement.undoneAt(later, 2.0) - Vec2(1.0, 0.0)).norm(), 0.0,
              1e-14);
}

TEST(AssemblyScene, Randomness_BySeed) {
  Case setup = twoDisks();
  assemblyIn<2>(setup).disks[0].places = gridPlaces(10, 10, {1.5, 1.5}, false);
  assemblyIn<2>(setup).disks[0].jitter = 0.1;
  assemblyIn<2>(setup).disks[0].radiusSpread = 0.2;
  assemblyIn<2>(setup).disks[0].velocityRms = 1.0;
  assemblyIn<2>(setup).disks[0].position = {0.0, 1.0};
  const Scene one = assemblyScene(setup), same = assemblyScene(setup);
  EXPECT_EQ(one.disks.position, same.disks.position);
  EXPECT_EQ(one.disks.radius, same.disks.radius);
  assemblyIn<2>(setup).seed = 2;
  EXPECT_NE(one.disks.position, assemblyScene(setup).disks.position);
  for (std::size_t i = 0; i < 100; ++i) {
    EXPECT_LE(std::abs(one.disks.radius[i] - 0.5), 0.1);
    EXPECT_DOUBLE_EQ(one.disks.mass[i] / 3.0,  // of disks of one material
                     one.disks.radius[i] * one.disks.radius[i] / 0.25);
  }
}

TEST(AssemblyScene, CoincidentCentres_AreBadInput) {
  Case setup = twoDisks();
  assemblyIn<2>(setup).disks[0].places = {Vec2::Zero(), Vec2::Zero()};
  assemblyIn<2>(setup).maxOverlap = 2.0;
  EXPECT_THROW(assemblyScene(setup), BadInput);
}

Case spheres() {
  Case setup{.dimension = 3, .source = AssemblyOf<3>()};
  setup.run.dt = 1e-3;
  assemblyIn<3>(setup).duration = 1.0;
  DiskGroupOf<3> group;
  group.radius = 0.5;
  group.mass = 3.0;
  group.position = {0.0, 0.0, 1.0};
  group.places = latticePlaces({4, 4, 4}, Vec3(1.5, 1.5, 1.5), false);
  group.spin = {1.0, 2.0, 3.0};
  assemblyIn<3>(setup).disks.push_back(group);
  return setup;
}

/// Conway and Sloane 1999: twelve touch each sphere of a close packing.
TEST(Places, ClosePackedLattice_TwelveNeighboursTouch) {
  const auto places =
      latticePlaces({5, 5, 5}, Vec3(1.0, std::sqrt(0.75), std::sqrt(2.0 / 3.0)), true);
  ASSERT_EQ(places.size(), 125u);
  const Vec3 middle = places[2 * 25 + 2 * 5 + 2];
  int touching = 0;
  for (const Vec3& place : places) {
    const double distance = (place - middle).norm();
    EXPECT_TRUE(distance == 0.0 || distance > 1.0 - 1e-12);
    touching += distance > 0.5 && distance < 1.0 + 1e-12;
  }
  EXPECT_EQ(touching, 12);
}

TEST(AssemblyScene, Spheres_MassAsCubeInertiaOfSpheres) {
  Case setup = spheres();
  assemblyIn<3>(setup).disks[0].radiusSpread = 0.2;
  assemblyIn<3>(setup).disks[0].velocityRms = 0.5;
  assemblyIn<3>(setup).gravity = {0.0, 0.0, -10.0};
  assemblyIn<3>(setup).box = BoxOf<3>{Vec3::Zero(), Vec3::Constant(6.0), {true, true, false}};
  const SpaceScene scene = assemblyScene<3>(setup);
  ASSERT_EQ(scene.disks.size(), 64u);
  EXPECT_EQ(scene.gravity.z(), -10.0);
  EXPECT_TRUE(scene.box->periodic[1]);
  for (std::size_t i = 0; i < 64; ++i) {
    const double a = scene.disks.radius[i], m = scene.disks.mass[i];
    EXPECT_NEAR(m, 3.0 * std::pow(a / 0.5, 3), 1e-14);
    EXPECT_NEAR(scene.disks.inertia[i], 0.4 * m * a * a, 1e-14);
    EXPECT_EQ(scene.disks.spin[i], Vec3(1.0, 2.0, 3.0));
    EXPECT_NE(scene.disks.velocity[i].z(), 0.0);
  }
}

TEST(AssemblyScene, ChosenPlaces_AreDifferentAndOthersInEachPacking) {
  Case setup = spheres();
  assemblyIn<3>(setup).disks[0].choose = 40;
  const DisksOf<3> one = assemblyDisks<3>(setup, 0), other = assemblyDisks<3>(setup, 1);
  ASSERT_EQ(one.size(), 40u);
  EXPECT_EQ(one.position, assemblyDisks<3>(setup, 0).position);
  EXPECT_NE(one.position, other.position);
  for (std::size_t i = 0; i < 40; ++i)
    for (std::size_t j = 0; j < i; ++j) EXPECT_NE(one.position[i], one.position[j]);
}

TEST(AssemblyScene, WallSpheres_MoveOn) {
  Case setup = spheres();
  WallGroupOf<3> wall{.position = {{0.0, 0.0, -0.5}, {1.0, 0.0, -0.5}}, .radius = 0.5};
  wall.motion.kind = MotionKind::translating;
  wall.motion.velocity = {0.0, 2.0, 0.0};
  assemblyIn<3>(setup).walls.push_back(wall);
  const SpaceScene scene = assemblyScene<3>(setup, assemblyDisks<3>(setup, 0), 0.25, 1e-3);
  EXPECT_EQ(scene.bodies.at(0).diskPosition.at(1), Vec3(1.0, 0.5, -0.5));
  EXPECT_EQ(scene.bodies[0].motion.velocity, Vec3(0.0, 2.0, 0.0));
}

/// Across the border of a box 6.01 m wide the first and the last of a row overlap by 0.49 m.
TEST(AssemblyScene, StartThatOverlapsAcrossTheBorder_IsBadInput) {
  Case setup = spheres();
  assemblyIn<3>(setup).disks[0].places = {{0.1, 0.0, 0.0}, {5.6, 0.0, 0.0}};
  EXPECT_NO_THROW(assemblyScene<3>(setup));
  assemblyIn<3>(setup).box = BoxOf<3>{Vec3::Zero(), Vec3(6.01, 6.0, 6.0), {false, true, false}};
  EXPECT_NO_THROW(assemblyScene<3>(setup));
  assemblyIn<3>(setup).box->periodic = {true, false, false};
  test::expectSays(test::refusalOf([&] { assemblyScene<3>(setup); }),
                   {"sphere 0 and sphere 1 overlap by 0.49 m"});
}

TEST(AssemblyScene, OfAnotherDimension_IsBadInput) {
  EXPECT_THROW(assemblyScene(spheres()), BadInput);
  EXPECT_THROW(assemblyScene<3>(twoDisks()), BadInput);
}

}  // namespace

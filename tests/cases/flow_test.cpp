// Flows of a case of any kind: packings of an assembly, and its walls along the way.
#include "cases/flow.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/support/two_disks.hpp"

namespace crossgrain {
namespace {

constexpr double pi = std::numbers::pi;

Case swingingBox() {
  Case setup = test::twoDisks();
  assemblyIn<2>(setup).disks.front().radiusSpread = 0.1;
  assemblyIn<2>(setup).walls.resize(2);
  assemblyIn<2>(setup).walls[0].planes = {{{0.0, 0.0}, Vec2::UnitY()}};
  assemblyIn<2>(setup).walls[0].motion = {.kind = Motion::Kind::translating,
                                          .velocity = {0.0, 0.5}};
  assemblyIn<2>(setup).walls[1].position = {{1.0, 0.0}};
  assemblyIn<2>(setup).walls[1].radius = 0.1;
  assemblyIn<2>(setup).walls[1].motion = {.kind = Motion::Kind::rotating, .angularVelocity = pi};
  setup.region = Region{.from = 1.0, .snapshots = 4};
  return setup;
}

Packing packing(const Case& setup, int index) {
  const auto none = std::unique_ptr<Engine>();
  return flowPacking(setup, index, 1e-3, *none, [](double) {});
}

TEST(Flow, OfAnAssemblyIsTimedInSeconds) {
  const Case setup = swingingBox();
  const FlowTimes times = flowTimes(setup);
  EXPECT_EQ(times.settled, 1.0);
  EXPECT_EQ(times.interval, 0.5);
  EXPECT_EQ(times.end(), 3.0);
  EXPECT_EQ(flowDiameter(setup), 0.9);  // of the smallest that may be drawn
}

TEST(Flow, HasPackingsOfTheirOwnThatAreAlwaysTheSame) {
  const Case setup = swingingBox();
  EXPECT_EQ(packing(setup, 1).hash, packing(setup, 1).hash);
  EXPECT_NE(packing(setup, 0).hash, packing(setup, 1).hash);
  EXPECT_EQ(expectedPacking(setup, 1, 1e-3).hash, packing(setup, 1).hash);
}

TEST(Flow, GoesOnWithWallsWhereTheyAre) {
  const Case setup = swingingBox();
  const Packing start = packing(setup, 0);
  const Scene scene = flowScene(setup, start, 1e-3);
  Snapshot now;
  now.positionTime = 0.5;
  now.position = scene.disks.position;
  now.velocity = scene.disks.velocity;
  now.bodies.resize(2);
  const Packing later = packingAt(start, scene, now);
  EXPECT_NE(later.hash, start.hash);  // the walls are elsewhere
  const Scene there = flowScene(setup, later, 1e-3);
  EXPECT_NEAR(there.bodies[0].planes[0].point.y(), 0.25, 1e-15);
  EXPECT_EQ(there.bodies[0].motion.velocity.y(), 0.5);
  // A quarter turn from (1, 0).
  EXPECT_NEAR((there.bodies[1].diskPosition[0] - Vec2(0.0, 1.0)).norm(), 0.0, 1e-15);
}

TEST(Flow, BeginsAnewWhereSwingingWallsPassTheirMiddle) {
  Case setup = swingingBox();
  EXPECT_EQ(flowRestart(setup, 0.7), 0.7);
  assemblyIn<2>(setup).walls[0].motion = {
      .kind = Motion::Kind::oscillating, .amplitude = {0.1, 0.0}, .frequency = 4.0 * pi};
  EXPECT_NEAR(flowRestart(setup, 0.7), 0.5, 1e-15);
}

TEST(Flow, TellsStartsByTheirFixedDisksToo) {
  Case setup = swingingBox();
  const std::string none = packing(setup, 0).hash;
  assemblyIn<2>(setup).starts.fixedPosition = {{0.5, 0.0}};
  assemblyIn<2>(setup).starts.fixedRadius = {0.1};
  const Packing fixed = packing(setup, 0);
  EXPECT_NE(fixed.hash, none);
  EXPECT_EQ(expectedPacking(setup, 0, 1e-3).hash, fixed.hash);
  Snapshot now{.position = fixed.disks.position, .velocity = fixed.disks.velocity};
  now.bodies.resize(2);
  EXPECT_EQ(packingAt(fixed, flowScene(setup, fixed, 1e-3), now).hash, fixed.hash);
  assemblyIn<2>(setup).starts.fixedRadius = {0.2};
  EXPECT_NE(packing(setup, 0).hash, fixed.hash);
}

TEST(Flow, TakesFilesInTurnWithVelocitiesOfEachPacking) {
  Case setup = swingingBox();
  Disks one;
  one.radius = {0.5};
  one.mass = {1.0};
  one.inertia = {0.1};
  one.position = {{0.0, 3.0}};
  one.velocity = {Vec2::Zero()};
  one.spin = {0.0};
  Disks two = one;
  two.position = {{0.0, 4.0}};
  assemblyIn<2>(setup).disks.clear();
  assemblyIn<2>(setup).starts = {{"a.csv", "b.csv"}, {one, two}, {}, 0.0};
  setup.preparation.packings = 5;
  EXPECT_TRUE(packingsAreFiles(setup));
  EXPECT_EQ(flowPackings(setup), 2);
  EXPECT_EQ(packing(setup, 1).disks.position[0].y(), 4.0);
  assemblyIn<2>(setup).starts.velocityRms = 0.1;
  EXPECT_EQ(flowPackings(setup), 5);
  EXPECT_EQ(packing(setup, 2).disks.position[0].y(), 3.0);
  EXPECT_NE(packing(setup, 2).disks.velocity[0], packing(setup, 0).disks.velocity[0]);
}

}  // namespace
}  // namespace crossgrain

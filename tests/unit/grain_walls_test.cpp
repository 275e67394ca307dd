#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/grain_scenes.hpp"

namespace {

using namespace grain;
using namespace crossgrain::test;

/// A disk that its weight has sunk into a floor, x at v [m/s].
grain::Setup onAFloor(double v, double dt) {
  grain::Setup setup{.law = thesisLaw(), .gravityY = -9.81, .dt = dt};
  const double sink = smallMass * 9.81 / thesis.kn;  // k_n δ = m g
  addDisk(setup.disks, 0.0, smallRadius - sink, v, 0.0, 0.0);
  setup.walls.push_back(standing({{0.0, 0.0, 0.0, 1.0}}));
  return setup;
}

TEST(GrainWalls, ADiskAtRestOnAPlaneWeighsOnIt) {
  const double sink = smallMass * 9.81 / thesis.kn;
  const Simulation simulation = advanced(onAFloor(0.0, 4e-5), 10000);
  EXPECT_NEAR(simulation.y(0), smallRadius - sink, 1e-15);
  EXPECT_NEAR(simulation.wallLoad(0).fy, -smallMass * 9.81, 1e-12);
  ASSERT_EQ(simulation.contacts().size(), 1u);
  EXPECT_EQ(simulation.contacts()[0].j, 1);  // planes come after all disks
  EXPECT_NEAR(simulation.contacts()[0].overlap, sink, 1e-15);
}

TEST(GrainWalls, ASlidingDiskRollsInTheEndAtTwoThirdsOfItsSpeed) {
  // Friction acts at the contact only, so L about it is kept: m v a = m v' a + ½ m a² ω', v' = −ω'
  // a.
  const Simulation simulation = advanced(onAFloor(0.3, 2e-5), 20000);
  EXPECT_NEAR(simulation.velocityX(0), 0.2, 1e-4);  // the sunk contact: δ/a = 2e-3 of the arm
  EXPECT_NEAR(simulation.spin(0), -0.2 / smallRadius, 1e-4 / smallRadius);
}

TEST(GrainWalls, AWheelTurnsExactlyAndFeelsTheOppositeForceAndTorque) {
  Wall wheel;
  const double rim = 0.03;
  wheel.diskX = {rim};
  wheel.diskY = {0.0};
  wheel.diskRadius = {wallRadius};
  const double omega = 2.0;
  wheel.motion = [&](double t) { return WallState{.angle = omega * t, .spin = omega}; };
  grain::Setup setup;
  setup.law = thesisLaw();
  setup.law.conventions.leverArm = LeverArm::contactPoint;
  setup.dt = 4e-5;
  addDisk(setup.disks, rim + smallRadius + wallRadius - 1e-5, 0.0, 0.0, 0.0, 0.0);
  setup.walls.push_back(wheel);
  Simulation simulation(std::move(setup));
  simulation.step();
  const double angle = omega * simulation.time();
  EXPECT_NEAR(simulation.x(1), rim * std::cos(angle), 1e-17);
  EXPECT_NEAR(simulation.y(1), rim * std::sin(angle), 1e-17);

  ASSERT_EQ(simulation.contacts().size(), 1u);
  const Contact& c = simulation.contacts()[0];
  const double fx = c.normalForce * c.nx - c.tangentialForce * c.ny;
  const double fy = c.normalForce * c.ny + c.tangentialForce * c.nx;
  EXPECT_GT(c.tangentialForce, 0.0);  // the wheel drags the disk along +y
  const WallLoad load = simulation.wallLoad(0);
  EXPECT_DOUBLE_EQ(load.fx, -fx);
  EXPECT_DOUBLE_EQ(load.fy, -fy);
  // About the centre the pair's forces act at one point, with the contact point as arm.
  const double lever = smallRadius - c.overlap * wallRadius / (smallRadius + wallRadius);
  const double px = simulation.x(0) - lever * c.nx;
  const double py = simulation.y(0) - lever * c.ny;
  EXPECT_NEAR(load.torque, -(px * fy - py * fx), 1e-15 * std::abs(fx));
}

TEST(GrainBottom, BrakesSpinAndNeverDrivesIt) {
  const BottomConstants<double> plate(thesisBottom<BottomPlate>(), 1e-5);
  double springX = 0.0, springY = 0.0;
  const auto left =
      bottomForce<true>(plate, smallMass, smallRadius, 0.0, 0.0, 3.0, springX, springY);
  const auto right =
      bottomForce<true>(plate, smallMass, smallRadius, 0.0, 0.0, -3.0, springX, springY);
  EXPECT_LT(left.torque, 0.0);
  EXPECT_DOUBLE_EQ(left.torque, -right.torque);
  // γ_b ω a = 1.7e-3 N is far beyond the bound µ_b m g, so the torque is µ_b m g (2/3) a.
  EXPECT_DOUBLE_EQ(left.torque, -2e-5 * smallMass * 9.81 * (2.0 / 3.0) * smallRadius);
}

}  // namespace

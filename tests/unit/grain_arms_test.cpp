#include <gtest/gtest.h>

#include "tests/unit/grain_scenes.hpp"

// The arm of f_t and the arm of the spins in v_t, each by itself: one step by hand.

namespace {

using namespace grain;
namespace test = crossgrain::test;

constexpr double dt = 1e-6, overlap = 2e-4, gt = test::thesis.gt;
constexpr double radiusI = test::smallRadius, radiusJ = test::largeRadius;
constexpr double spinI = 7.0, spinJ = -3.0;

double arm(LeverArm lever, double a, double other) {
  if (lever == LeverArm::radius) return a;
  return lever == LeverArm::contactPoint ? a - overlap * other / (a + other) : a - 0.5 * overlap;
}

/// f_t = −γ_t v_t, out of reach of its bound, under Euler's scheme: what a force does in one step
/// is F dt, and the law sees the velocities that the disks start with.
grain::Setup viscous(LeverArm lever, VelocityArm velocity, PlaneArm plane) {
  grain::Setup setup;
  setup.law.kn = test::thesis.kn;
  setup.law.tangential = TangentialLaw::viscous;
  setup.law.gt = gt;
  setup.law.mu = 1e6;
  setup.law.conventions.leverArm = lever;
  setup.law.conventions.velocityArm = velocity;
  setup.law.conventions.planeArm = plane;
  setup.law.conventions.dampingVelocity = DampingVelocity::lagged;
  setup.law.conventions.integrator = Integrator::semiImplicitEuler;
  setup.dt = dt;
  return setup;
}

constexpr LeverArm levers[] = {LeverArm::radius, LeverArm::contactPoint, LeverArm::overlapMiddle};

/// The same arm in v_t by its own name.
VelocityArm ofVelocity(LeverArm arm) {
  if (arm == LeverArm::radius) return VelocityArm::radius;
  return arm == LeverArm::contactPoint ? VelocityArm::contactPoint : VelocityArm::overlapMiddle;
}

/// Disk 0 to the right of disk 1: n = (1, 0), s = (0, 1). With resting centres
///   v_t = −(c_i ω_i + c_j ω_j), f_t = γ_t (c_i ω_i + c_j ω_j), J dω/dt = −l f_t, and
///   dL/dt = (|x_i − x_j| − l_i − l_j) f_t: 0, or −δ f_t with the radii as l.
TEST(GrainArms, TorqueAndVelocityHaveEachTheirOwn) {
  for (const LeverArm lever : levers)
    for (const LeverArm velocity : levers) {
      grain::Setup setup = viscous(lever, ofVelocity(velocity), PlaneArm::surface);
      const double distance = radiusI + radiusJ - overlap;
      test::addDisk(setup.disks, distance, 0.0, 0.0, 0.0, spinI);
      test::addDisk(setup.disks, 0.0, 0.0, 0.0, 0.0, spinJ);
      setup.disks.radius[1] = radiusJ;
      const std::vector<double> mass = setup.disks.mass, inertia = setup.disks.inertia;
      Simulation simulation(std::move(setup));

      const double cI = arm(velocity, radiusI, radiusJ), cJ = arm(velocity, radiusJ, radiusI);
      const double lI = arm(lever, radiusI, radiusJ), lJ = arm(lever, radiusJ, radiusI);
      const double force = gt * (cI * spinI + cJ * spinJ);
      ASSERT_EQ(simulation.contacts().size(), 1u);
      EXPECT_NEAR(simulation.contacts()[0].tangentialForce, force, 1e-12 * force);

      const auto angularMomentum = [&] {
        double sum = 0.0;
        for (const std::size_t k : {0u, 1u})
          sum += mass[k] * (simulation.x(k) * simulation.velocityY(k) -
                            simulation.y(k) * simulation.velocityX(k)) +
                 inertia[k] * simulation.spin(k);
        return sum;
      };
      const double before = angularMomentum();
      simulation.step();
      EXPECT_NEAR(simulation.spin(0) - spinI, -dt * lI * force / inertia[0], 1e-14);
      EXPECT_NEAR(simulation.spin(1) - spinJ, -dt * lJ * force / inertia[1], 1e-14);
      EXPECT_NEAR(angularMomentum() - before, dt * (distance - lI - lJ) * force,
                  1e-12 * std::abs(before));
      const double drift = lever == LeverArm::radius ? -overlap * force : 0.0;
      EXPECT_NEAR(dt * (distance - lI - lJ) * force, dt * drift, 1e-15 * dt * radiusI);
    }
}

TEST(GrainArms, VelocityTakesThatOfTheForceUnlessItHasItsOwn) {
  for (const LeverArm lever : levers) {
    const auto forceOf = [&](VelocityArm velocity) {
      grain::Setup setup = viscous(lever, velocity, PlaneArm::surface);
      test::addDisk(setup.disks, radiusI + radiusI - overlap, 0.0, 0.0, 0.0, spinI);
      test::addDisk(setup.disks, 0.0, 0.0, 0.0, 0.0, spinJ);
      return Simulation(std::move(setup)).contacts()[0].tangentialForce;
    };
    EXPECT_EQ(forceOf(VelocityArm::leverArm), forceOf(ofVelocity(lever)));
  }
}

/// On the plane x = 0 the arms are a, a − δ or a − δ/2; f_t acts on the wall at the contact point.
TEST(GrainArms, OnAPlane) {
  const auto planeArm = [](LeverArm lever, PlaneArm plane) {
    if (lever == LeverArm::radius || plane == PlaneArm::radius) return radiusI;
    return plane == PlaneArm::middle ? radiusI - 0.5 * overlap : radiusI - overlap;
  };
  for (const PlaneArm plane : {PlaneArm::surface, PlaneArm::middle, PlaneArm::radius})
    for (const LeverArm lever : levers)
      for (const LeverArm velocity : levers) {
        grain::Setup setup = viscous(lever, ofVelocity(velocity), plane);
        test::addDisk(setup.disks, radiusI - overlap, 0.0, 0.0, 0.0, spinI);
        setup.walls.push_back(test::standing({{0.0, 0.0, 1.0, 0.0}}));
        const double inertia = setup.disks.inertia[0];
        Simulation simulation(std::move(setup));
        const double force = gt * planeArm(velocity, plane) * spinI;
        ASSERT_EQ(simulation.contacts().size(), 1u);
        EXPECT_NEAR(simulation.contacts()[0].tangentialForce, force, 1e-12 * force);
        // About the origin: f_t acts along y at the distance that x has there.
        const bool inside = lever != LeverArm::radius && plane == PlaneArm::middle;
        EXPECT_NEAR(simulation.wallLoad(0).torque, -(inside ? -0.5 * overlap : 0.0) * force,
                    1e-12 * radiusI * force);
        simulation.step();
        EXPECT_NEAR(simulation.spin(0) - spinI, -dt * planeArm(lever, plane) * force / inertia,
                    1e-14);
      }
}

}  // namespace

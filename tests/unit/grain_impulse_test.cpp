#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "tests/unit/grain_scenes.hpp"

// Rigid disks: impulses against Walton's law, which is exact for two of them.

namespace {

using namespace grain;

constexpr double en = 0.8, et0 = 0.3, mu = 0.4, speed = 0.1;

/// Two disks that touch after half a step, head on, both turning so that v_t = Ψ_i v_n.
grain::Setup headOn(double psi, double dt = 1e-5) {
  grain::Setup setup;
  setup.law.normal = Normal::impulse;
  setup.law.tangential = Tangential::coulomb;
  setup.law.en = en;
  setup.law.et0 = et0;
  setup.law.mu = mu;
  setup.law.lever = Lever::contactPoint;
  setup.integrator = Integrator::semiImplicitEuler;
  setup.dt = dt;
  const double ahead = 0.25 * speed * dt, spin = -psi * speed / (2.0 * test::radius);
  test::addDisk(setup.disks, test::radius + ahead, 0.0, -0.5 * speed, 0.0, spin);
  test::addDisk(setup.disks, -test::radius - ahead, 0.0, 0.5 * speed, 0.0, spin);
  return setup;
}

double psiAfter(const Simulation& now) {
  const double slip =
      now.velocityY(0) - now.velocityY(1) - test::radius * (now.spin(0) + now.spin(1));
  return slip / speed;
}

TEST(GrainImpulse, StickingAndSlidingAreWaltons) {
  for (const double psi : {0.0, 0.5, 1.0, 2.0, 4.0, -1.0, -4.0}) {
    Simulation simulation(headOn(psi));
    simulation.advance(10);
    const double sliding = std::abs(psi) - 3.0 * (1.0 + en) * mu;
    const double expected = (psi < 0.0 ? -1.0 : 1.0) * std::max(-et0 * std::abs(psi), sliding);
    EXPECT_NEAR(simulation.velocityX(0) - simulation.velocityX(1), en * speed, 1e-9) << psi;
    // Half a step of overlap is missing from the lever arm, and the normal turns by as little.
    EXPECT_NEAR(psiAfter(simulation), expected, 1e-3 * (1.0 + std::abs(psi))) << psi;
  }
}

TEST(GrainImpulse, ActsOnceAndMoreFinelyTheShorterTheStep) {
  Simulation simulation(headOn(2.0));
  simulation.advance(3);
  const double after = simulation.velocityX(0);
  simulation.advance(1000);
  EXPECT_EQ(simulation.velocityX(0), after);
  EXPECT_TRUE(simulation.contacts().empty());
}

TEST(GrainImpulse, OnAPlaneTheDiskIsTheWholeMass) {
  grain::Setup setup = headOn(0.0);
  test::putOnPlane(setup);
  setup.disks.vy = {0.5 * speed * 0.5};  // Ψ_i = 0.5: sticks
  Simulation simulation(setup);
  simulation.advance(10);
  EXPECT_NEAR(simulation.velocityX(0), en * 0.5 * speed, 1e-12);
  const double slip = simulation.velocityY(0) - test::radius * simulation.spin(0);
  EXPECT_NEAR(slip, -et0 * 0.25 * speed, 1e-4 * speed);
}

TEST(GrainImpulse, NeedsTheSchemeInWhichAKickIsAnImpulse) {
  for (const Integrator scheme : {Integrator::positionVerlet, Integrator::velocityVerlet}) {
    grain::Setup setup = headOn(1.0);
    setup.integrator = scheme;
    EXPECT_THROW(Simulation{setup}, std::invalid_argument);
  }
}

}  // namespace

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/grain_scenes.hpp"

namespace {

using namespace grain;
using namespace crossgrain::test;

struct Totals {
  double px = 0.0, py = 0.0, angular = 0.0;
};

Totals totals(const Simulation& s) {
  Totals t;
  for (std::size_t i = 0; i < s.movingCount(); ++i) {
    t.px += smallMass * s.velocityX(i);
    t.py += smallMass * s.velocityY(i);
    t.angular +=
        smallMass * (s.x(i) * s.velocityY(i) - s.y(i) * s.velocityX(i)) + smallInertia * s.spin(i);
  }
  return t;
}

TEST(GrainConservation, MomentumOfACrowdIsKeptToRounding) {
  Simulation simulation(crowd(12, 7, 4e-5));
  const Totals before = totals(simulation);
  double largest = 0.0;
  for (int step = 0; step < 2000; ++step) {
    simulation.step();
    for (std::size_t i = 0; i < simulation.movingCount(); ++i)
      largest = std::max(largest, smallMass * std::abs(simulation.velocityX(i)));
  }
  const Totals after = totals(simulation);
  // 144 disks, 2000 sums each: rounding of 1e-16 per sum on momenta of `largest`.
  EXPECT_NEAR(after.px, before.px, 1e-12 * largest * 144);
  EXPECT_NEAR(after.py, before.py, 1e-12 * largest * 144);
}

TEST(GrainConservation, EnergyIsNeverGained) {
  Simulation simulation(crowd(12, 7, 4e-5));
  double last = simulation.kineticEnergy() + simulation.elasticEnergy();
  const double first = last;
  for (int block = 0; block < 50; ++block) {
    for (int step = 0; step < 40; ++step) simulation.step();
    const double now = simulation.kineticEnergy() + simulation.elasticEnergy();
    // The scheme's energy swings by (ω dt)²/8 = 5e-4 within a contact.
    EXPECT_LT(now, last + 1e-3 * first);
    last = now;
  }
  EXPECT_LT(last, 0.7 * first);
}

TEST(GrainConservation, EnergyOfAnElasticPairIsKept) {
  auto setup = collidingPair(0.1, 0.3, 0.0, contactTime() / 1000.0);
  setup.law.gn = 0.0;
  setup.law.tangential = Tangential::none;
  Simulation simulation(std::move(setup));
  const double before = simulation.kineticEnergy();
  for (int step = 0; step < 3000; ++step) simulation.step();
  ASSERT_TRUE(simulation.contacts().empty());
  EXPECT_NEAR(simulation.kineticEnergy(), before, 1e-5 * before);  // (ω dt)² = 1e-5
}

/// An oblique collision with spin; L against Σ −δ f_t dt along the way.
void expectAngularMomentum(Lever lever, double expectedDriftShare) {
  auto setup = collidingPair(0.1, 0.4, 12.0, contactTime() / 2000.0);
  setup.law.lever = lever;
  Simulation simulation(std::move(setup));
  const double before = totals(simulation).angular;
  double integral = 0.0;  // of −δ f_t, trapezoidal
  double last = 0.0;
  for (int step = 0; step < 4000; ++step) {
    simulation.step();
    const auto contacts = simulation.contacts();
    const double now = contacts.empty() ? 0.0 : -contacts[0].overlap * contacts[0].tangentialForce;
    integral += 0.5 * (last + now) * simulation.dt();
    last = now;
  }
  ASSERT_TRUE(simulation.contacts().empty());
  ASSERT_GT(std::abs(integral), 1e-3 * std::abs(before) * 1e-2);  // there is something to see
  const double drift = totals(simulation).angular - before;
  // Kept: rounding. Radius: the trapezoidal sum is good to the jumps at the contact's two ends.
  EXPECT_NEAR(drift, expectedDriftShare * integral,
              expectedDriftShare == 0.0 ? 1e-13 * std::abs(before) : 2e-3 * std::abs(integral));
}

TEST(GrainConservation, AngularMomentumIsKeptWithTheContactPointAsArm) {
  expectAngularMomentum(Lever::contactPoint, 0.0);
  expectAngularMomentum(Lever::overlapMiddle, 0.0);
}

TEST(GrainConservation, AngularMomentumFallsByOverlapTimesForceWithTheRadiusAsArm) {
  expectAngularMomentum(Lever::radius, 1.0);
}

TEST(GrainConservation, LookingAtContactsDoesNotChangeTheRun) {
  Simulation watched(crowd(8, 3, 4e-5)), alone(crowd(8, 3, 4e-5));
  double seen = 0.0;
  for (int step = 0; step < 500; ++step) {
    watched.step();
    alone.step();
    for (const Contact& contact : watched.contacts()) seen += contact.normalForce;
    seen += watched.kineticEnergy() + watched.elasticEnergy();
  }
  EXPECT_GT(seen, 0.0);
  for (std::size_t i = 0; i < alone.movingCount(); ++i) {
    EXPECT_EQ(watched.x(i), alone.x(i));
    EXPECT_EQ(watched.velocityY(i), alone.velocityY(i));
    EXPECT_EQ(watched.spin(i), alone.spin(i));
  }
}

/// The crowd after some steps, with each disk's place and velocity put through a map first.
template <typename Map>
Simulation mapped(Map map) {
  auto setup = crowd(6, 5, 4e-5);
  for (std::size_t i = 0; i < setup.disks.size(); ++i)
    map(setup.disks.x[i], setup.disks.y[i], setup.disks.vx[i], setup.disks.vy[i],
        setup.disks.spin[i]);
  Simulation simulation(std::move(setup));
  for (int step = 0; step < 250; ++step) simulation.step();
  return simulation;
}

TEST(GrainConservation, ShiftedMirroredAndTurnedScenesGiveTheSamePhysics) {
  const Simulation original = mapped([](double&, double&, double&, double&, double&) {});
  const Simulation shifted = mapped([](double& x, double& y, double&, double&, double&) {
    x += 0.25;
    y -= 0.125;
  });
  const Simulation mirrored = mapped([](double&, double& y, double&, double& vy, double& spin) {
    y = -y;
    vy = -vy;
    spin = -spin;
  });
  const Simulation turned = mapped([](double& x, double& y, double& vx, double& vy, double&) {
    std::tie(x, y) = std::pair(-y, x);
    std::tie(vx, vy) = std::pair(-vy, vx);
  });
  ASSERT_GT(original.contactEvaluations(), 1000u);
  // Rounding, grown over some tens of collisions a disk: chaos multiplies it by about e per
  // collision.
  const double place = 1e-9 * smallRadius, spin = 1e-6;
  for (std::size_t i = 0; i < original.movingCount(); ++i) {
    EXPECT_NEAR(shifted.x(i) - 0.25, original.x(i), place);
    EXPECT_NEAR(shifted.spin(i), original.spin(i), spin);
    EXPECT_NEAR(mirrored.y(i), -original.y(i), place);
    EXPECT_NEAR(mirrored.spin(i), -original.spin(i), spin);
    EXPECT_NEAR(turned.x(i), -original.y(i), place);
    EXPECT_NEAR(turned.y(i), original.x(i), place);
    EXPECT_NEAR(turned.spin(i), original.spin(i), spin);
  }
}

}  // namespace

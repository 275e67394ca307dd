#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "tests/unit/grain_scenes.hpp"

// Two disks of any size that collide under any law.

namespace {

using namespace grain;
namespace test = crossgrain::test;

double between(double low, double high) {
  const int share = *rc::gen::inRange(0, 1000001);
  return low + (high - low) * 1e-6 * share;
}

template <class T>
T oneOf(std::initializer_list<T> values) {
  return *rc::gen::elementOf(std::vector<T>(values));
}

/// Every convention that dissipates. `signedForce` is left out: under tension it drives.
ContactLaw anyLaw() {
  ContactLaw law;
  law.kn = between(50.0, 1000.0);
  law.gn = *rc::gen::arbitrary<bool>() ? between(0.01, 0.3) : 0.0;
  law.kt = law.kn * between(0.1, 1.0);
  law.gt = between(0.0, 0.15);
  law.mu = between(0.0, 1.0);
  law.tangential = oneOf({TangentialLaw::none, TangentialLaw::coulomb, TangentialLaw::viscous,
                          TangentialLaw::spring, TangentialLaw::springDashpot});
  law.conventions.coulombBound = oneOf({CoulombBound::compression, CoulombBound::magnitude});
  law.conventions.tension = oneOf({Tension::allow, Tension::cut});
  law.conventions.dashpot = oneOf({Dashpot::inside, Dashpot::outside});
  law.conventions.leverArm =
      oneOf({LeverArm::radius, LeverArm::contactPoint, LeverArm::overlapMiddle});
  law.conventions.springUpdate =
      oneOf({SpringUpdate::after, SpringUpdate::before, SpringUpdate::midpoint});
  law.conventions.dampingVelocity =
      oneOf({DampingVelocity::lagged, DampingVelocity::predicted, DampingVelocity::implicit});
  return law;
}

double period(const ContactLaw& law, double lightest) {
  return M_PI * std::sqrt(0.5 * lightest / law.kn);
}

grain::Setup anyCollision() {
  grain::Setup setup;
  setup.law = anyLaw();
  setup.rotation = *rc::gen::arbitrary<bool>();
  setup.generalKernels = *rc::gen::arbitrary<bool>();
  setup.law.conventions.integrator = oneOf(
      {Integrator::positionVerlet, Integrator::velocityVerlet, Integrator::semiImplicitEuler});
  Disks& disks = setup.disks;
  for (const double side : {-1.0, 1.0}) {
    const double a = between(1e-3, 5e-3);
    test::addDisk(disks, 0.0, 0.0, -0.5 * side * between(0.01, 0.3), between(-0.1, 0.1),
                  between(-50.0, 50.0));
    disks.radius.back() = a;
    disks.mass.back() = test::smallMass * a * a / (test::smallRadius * test::smallRadius);
    disks.inertia.back() = 0.5 * disks.mass.back() * a * a;
  }
  const double lightest = std::min(disks.mass[0], disks.mass[1]);
  setup.dt = period(setup.law, lightest) / 1000.0;
  const double reach = disks.radius[0] + disks.radius[1] + 1e-9;
  const double sine = between(-0.7, 0.7);
  disks.x[1] = reach * std::sqrt(1.0 - sine * sine);
  disks.y[1] = reach * sine;
  return setup;
}

struct Totals {
  double px = 0.0, py = 0.0, angular = 0.0, energy = 0.0;
};

Totals totals(const Simulation& s, const Disks& disks) {
  Totals t;
  for (std::size_t i = 0; i < 2; ++i) {
    const double m = disks.mass[i];
    t.px += m * s.velocityX(i);
    t.py += m * s.velocityY(i);
    t.angular += m * (s.x(i) * s.velocityY(i) - s.y(i) * s.velocityX(i));
    if (s.rotates()) t.angular += disks.inertia[i] * s.spin(i);
  }
  t.energy = s.kineticEnergy();
  return t;
}

/// Runs until the disks have parted; false where they have not met.
bool collide(Simulation& simulation) {
  std::size_t touched = 0;
  for (int step = 0; step < 40000; ++step) {
    simulation.step();
    if (!simulation.contacts().empty())
      ++touched;
    else if (touched > 0)
      return true;
  }
  return false;
}

RC_GTEST_PROP(AnyLaw, KeepsMomentum, ()) {
  const grain::Setup setup = anyCollision();
  Simulation simulation(setup);
  const Totals before = totals(simulation, setup.disks);
  RC_PRE(collide(simulation));
  const Totals after = totals(simulation, setup.disks);
  // Some thousand steps, each of which rounds two momenta of at most this size by 2^-53.
  const double largest = std::max(setup.disks.mass[0], setup.disks.mass[1]) * 0.5;
  RC_ASSERT(std::abs(after.px - before.px) < 1e-13 * largest);
  RC_ASSERT(std::abs(after.py - before.py) < 1e-13 * largest);
}

RC_GTEST_PROP(AnyLaw, KeepsAngularMomentumWhereTheArmsMeet, ()) {
  // l_i + l_j = |x_i − x_j|, and the disks turn; or no force along s. The arms in v_t are no
  // matter.
  grain::Setup setup = anyCollision();
  setup.rotation = true;
  setup.law.conventions.velocityArm =
      oneOf({VelocityArm::radius, VelocityArm::contactPoint, VelocityArm::overlapMiddle});
  if (setup.law.conventions.leverArm == LeverArm::radius)
    setup.law.tangential = TangentialLaw::none;
  Simulation simulation(setup);
  const Totals before = totals(simulation, setup.disks);
  RC_PRE(collide(simulation));
  const Totals after = totals(simulation, setup.disks);
  const double largest = std::max(setup.disks.mass[0], setup.disks.mass[1]) * 0.5 * 0.01;
  RC_ASSERT(std::abs(after.angular - before.angular) < 1e-12 * largest);
}

RC_GTEST_PROP(AnyLaw, NeverGainsEnergy, ()) {
  grain::Setup setup = anyCollision();
  setup.dt /= 8.0;
  // With the dashpot's force inside the bound, slip sets the spring to what the dashpot carried:
  // that stores energy without a source, whatever the step (Lätzel 2003, Eq. 4.25).
  if (setup.law.tangential == TangentialLaw::springDashpot)
    setup.law.conventions.dashpot = Dashpot::outside;
  Simulation simulation(setup);
  const Totals before = totals(simulation, setup.disks);
  RC_PRE(collide(simulation));
  const Totals after = totals(simulation, setup.disks);
  // A spring that is stretched after the force lags by dt, which feeds k_t dt v_t² into the motion:
  // over t_c = 8000 dt, with a third of the reduced mass along s, 6 π²/8000 k_t/k_n < 0.8 % of it.
  RC_ASSERT(after.energy < before.energy * 1.01);
}

// Crowds and one pair under the law of the thesis.

TEST(GrainConservation, Crowd_NeverGainsEnergy) {
  Simulation simulation(test::crowd(12, 7, 4e-5));
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

/// An oblique collision with spin: L is kept where the arms meet, and falls by Σ δ f_t dt where
/// they are the radii.
TEST(GrainConservation, AngularMomentum_FallsByOverlapTimesForce_OnlyWithTheRadiusAsArm) {
  for (const LeverArm lever : {LeverArm::contactPoint, LeverArm::overlapMiddle, LeverArm::radius}) {
    auto setup = test::collidingPair(0.1, 0.4, 12.0, test::contactTime() / 2000.0);
    setup.law.conventions.leverArm = lever;
    const Disks disks = setup.disks;
    Simulation simulation(std::move(setup));
    const double before = totals(simulation, disks).angular;
    double integral = 0.0, last = 0.0;  // of −δ f_t, trapezoidal
    for (int step = 0; step < 4000; ++step) {
      simulation.step();
      const auto contacts = simulation.contacts();
      const double now =
          contacts.empty() ? 0.0 : -contacts[0].overlap * contacts[0].tangentialForce;
      integral += 0.5 * (last + now) * simulation.dt();
      last = now;
    }
    ASSERT_TRUE(simulation.contacts().empty());
    ASSERT_GT(std::abs(integral), 1e-5 * std::abs(before));  // there is something to see
    const double drift = totals(simulation, disks).angular - before;
    // Kept: rounding. Radius: the trapezoidal sum is good to the jumps at the contact's two ends.
    if (lever == LeverArm::radius) {
      EXPECT_NEAR(drift, integral, 2e-3 * std::abs(integral));
    } else {
      EXPECT_NEAR(drift, 0.0, 1e-13 * std::abs(before));
    }
  }
}

/// The crowd after some steps, with each disk's place and velocity put through a map first.
template <typename Map>
Simulation mapped(Map map) {
  auto setup = test::crowd(6, 5, 4e-5);
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
  const double place = 1e-9 * test::smallRadius, spin = 1e-6;
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

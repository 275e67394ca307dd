#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>
#include <utility>
#include <vector>

#include "tests/unit/grain_packed.hpp"

// Rigid disks: impulses against Walton's law, which is exact for two of them.

namespace {

using namespace grain;
namespace test = crossgrain::test;

constexpr double en = 0.8, et0 = 0.3, mu = 0.4, speed = 0.1;

/// Two disks that touch after half a step, head on, both turning so that v_t = Ψ_i v_n.
grain::Setup headOn(double psi, double dt = 1e-5) {
  grain::Setup setup;
  setup.law.normal = NormalLaw::rigid;
  setup.law.tangential = TangentialLaw::coulomb;
  setup.law.en = en;
  setup.law.et0 = et0;
  setup.law.mu = mu;
  setup.law.conventions.leverArm = LeverArm::contactPoint;
  setup.law.conventions.integrator = Integrator::semiImplicitEuler;
  setup.dt = dt;
  const double ahead = 0.25 * speed * dt, spin = -psi * speed / (2.0 * test::smallRadius);
  test::addDisk(setup.disks, test::smallRadius + ahead, 0.0, -0.5 * speed, 0.0, spin);
  test::addDisk(setup.disks, -test::smallRadius - ahead, 0.0, 0.5 * speed, 0.0, spin);
  return setup;
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
  const double slip = simulation.velocityY(0) - test::smallRadius * simulation.spin(0);
  EXPECT_NEAR(slip, -et0 * 0.25 * speed, 1e-4 * speed);
}

/// Walton's model in closed form, for two disks of any masses and radii: arms a_i, and the normal
/// at the instant of the impact.
TEST(GrainImpulse, IsWaltonsClosedFormToRounding) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> one(-1.0, 1.0);
  for (int trial = 0; trial < 200; ++trial) {
    grain::Setup setup = headOn(0.0);
    setup.law.conventions.leverArm = LeverArm::radius;
    grain::Disks& d = setup.disks;
    for (const std::size_t k : {0u, 1u}) {
      d.radius[k] *= std::exp(one(random));
      d.mass[k] *= std::exp(2.0 * one(random));
      d.inertia[k] = (0.5 + 0.1 * one(random)) * d.mass[k] * d.radius[k] * d.radius[k];
      d.vx[k] = one(random);
      d.vy[k] = one(random);
      d.spin[k] = 300.0 * one(random);
    }
    const double angle = M_PI * one(random), reach = (1.0 - 1e-12) * (d.radius[0] + d.radius[1]);
    d.x = {reach * std::cos(angle), 0.0};
    d.y = {reach * std::sin(angle), 0.0};
    const double nx = std::cos(angle), ny = std::sin(angle);
    const double vn = (d.vx[0] - d.vx[1]) * nx + (d.vy[0] - d.vy[1]) * ny;
    if (vn >= -0.01) continue;
    const double vt = (d.vy[0] - d.vy[1]) * nx - (d.vx[0] - d.vx[1]) * ny -
                      (d.radius[0] * d.spin[0] + d.radius[1] * d.spin[1]);
    const double mn = d.mass[0] * d.mass[1] / (d.mass[0] + d.mass[1]);
    double compliance = 1.0 / mn;
    for (const std::size_t k : {0u, 1u}) compliance += d.radius[k] * d.radius[k] / d.inertia[k];
    const double jn = -(1.0 + en) * mn * vn;
    const double stick = -(1.0 + et0) * vt / compliance;
    const double jt = std::copysign(std::min(std::abs(stick), mu * jn), stick);

    Simulation after(setup);
    after.advance(1);
    for (const std::size_t k : {0u, 1u}) {
      const double side = k == 0 ? 1.0 : -1.0;
      const double vx = d.vx[k] + side * (jn * nx - jt * ny) / d.mass[k];
      const double vy = d.vy[k] + side * (jn * ny + jt * nx) / d.mass[k];
      const double spin = d.spin[k] - d.radius[k] * jt / d.inertia[k];
      EXPECT_NEAR(after.velocityX(k), vx, 1e-14 * 10.0);  // of velocities of up to 10 m/s
      EXPECT_NEAR(after.velocityY(k), vy, 1e-14 * 10.0);
      EXPECT_NEAR(after.spin(k), spin, 1e-14 * 3000.0);
    }
  }
}

/// Ten equal disks in a row that touch: the last one leaves with the speed of the first, which
/// stops, whichever way their contacts are taken.
TEST(GrainImpulse, ARowOfDisksPassesTheImpactOn) {
  for (const double direction : {1.0, -1.0}) {
    grain::Setup setup = headOn(0.0);
    setup.law.en = 1.0;
    setup.law.mu = 0.0;
    setup.disks = {};
    for (int k = 0; k < 10; ++k)
      test::addDisk(setup.disks, direction * k * (2.0 - 1e-9) * test::smallRadius, 0.0,
                    k == 0 ? direction * speed : 0.0, 0.0, 0.0);
    Simulation simulation(setup);
    simulation.advance(3);
    for (std::size_t k = 0; k < 10; ++k)
      EXPECT_NEAR(simulation.velocityX(k), k == 9 ? direction * speed : 0.0, 1e-14 * speed) << k;
    EXPECT_EQ(simulation.unfinishedImpacts(), 0u);
  }
}

/// A gas of 38 % in a box, in which many a disk meets several others within a step.
grain::Setup gas(double restitution, double friction) {
  grain::Setup setup = headOn(0.0, 5e-4);
  setup.law.en = restitution;
  setup.law.mu = friction;
  setup.disks = {};
  std::mt19937_64 random(3);
  std::normal_distribution<double> velocity(0.0, 0.3);
  const double spacing = std::sqrt(M_PI / 0.38) * test::smallRadius;
  for (int row = 0; row < 12; ++row)
    for (int column = 0; column < 12; ++column)
      test::addDisk(setup.disks, (column + 0.5) * spacing, (row + 0.5) * spacing, velocity(random),
                    velocity(random), friction > 0.0 ? 100.0 * velocity(random) : 0.0);
  const double side = 12.0 * spacing;
  setup.walls.push_back(test::standing({{0.0, 0.0, 1.0, 0.0},
                                        {side, 0.0, -1.0, 0.0},
                                        {0.0, 0.0, 0.0, 1.0},
                                        {0.0, side, 0.0, -1.0}}));
  return setup;
}

/// Every impact takes energy or leaves it, friction or not: no look finds more than the one before,
/// and without losses all of them the same.
TEST(GrainImpulse, NoGasGains_AnElasticOneKeepsItsEnergyToRounding) {
  for (const double restitution : {1.0, 0.7, 0.0})
    for (const double friction : {0.0, 0.4}) {
      Simulation simulation(gas(restitution, friction));
      const double initial = simulation.kineticEnergy();
      double last = initial;
      int crowded = 0;  // looks at which a disk touches more than one
      for (int look = 0; look < 100; ++look) {
        simulation.advance(20);
        EXPECT_LE(simulation.kineticEnergy(), last + 1e-13 * initial) << restitution << friction;
        last = simulation.kineticEnergy();
        std::vector<int> partners(simulation.movingCount(), 0);
        for (const Contact& contact : simulation.contacts())
          for (const auto id : {contact.i, contact.j})
            if (static_cast<std::size_t>(id) < partners.size())
              ++partners[static_cast<std::size_t>(id)];
        crowded += *std::ranges::max_element(partners) > 1 ? 1 : 0;
      }
      if (restitution == 1.0 && friction == 0.0) {
        EXPECT_GT(crowded, 10);  // else it tests nothing but pairs
        EXPECT_NEAR(last, initial, 1e-12 * initial);
      }
    }
}

/// A ball above a floor at x = 0, thrown up.
grain::Setup ball(double restitution, double dt, double gravity = 9.81) {
  grain::Setup setup = headOn(0.0, dt);
  test::putOnPlane(setup);
  setup.law.en = restitution;
  setup.gravityX = -gravity;
  setup.disks.x = {test::smallRadius};
  // Half a step later it has the speed that it is thrown with: Euler's first kick is a whole one.
  setup.disks.vx = {0.5 + 0.5 * gravity * dt};
  return setup;
}

/// With e = 1 a leapfrog is reversed at the impact, so ½ v² + g x of each apex is the one before to
/// rounding, at any step and wherever in the step the floor is met. A reflection of the velocity
/// that holds the kick gains g dt every time: 13 m g a in 20 s at this step.
TEST(GrainImpulse, AnElasticBallRisesToTheSameHeightForEver) {
  for (const double dt : {5e-4, 1.3e-4}) {
    Simulation simulation(ball(1.0, dt));
    double lowest = 1.0, highest = 0.0;
    double before = 0.0;
    bool rises = true;
    int apexes = 0;
    for (double t = 0.0; t < 20.0; t += dt) {
      simulation.advance(1);
      const double x = simulation.x(0);
      if (rises && x < before) {
        lowest = std::min(lowest, before);
        highest = std::max(highest, before);
        ++apexes;
      }
      rises = x >= before;
      before = x;
    }
    EXPECT_GT(apexes, 190);
    EXPECT_NEAR(lowest, test::smallRadius + 0.5 * 0.5 * 0.5 / 9.81, 9.81 * dt * dt);
    EXPECT_NEAR(highest, lowest, 1e-10) << dt;
  }
}

/// The exact, event-driven solution: flights of 2 v/g, v after each bounce e times that before.
/// Bounces are seen up to a step late, so heights and times are of first order in dt: ten times
/// shorter steps err a tenth. @returns the largest error of x until t = 0.5 s, five bounces [m]
double errorOfABouncingBall(double dt) {
  constexpr double e = 0.9, g = 9.81, end = 0.5;
  Simulation simulation(ball(e, dt));
  double largest = 0.0, from = 0.0, thrown = 0.5;
  for (std::uint64_t step = 1; static_cast<double>(step) * dt < end; ++step) {
    simulation.advance(1);
    const double t = static_cast<double>(step) * dt;
    for (; t > from + 2.0 * thrown / g; thrown *= e) from += 2.0 * thrown / g;
    const double exact =
        test::smallRadius + thrown * (t - from) - 0.5 * g * (t - from) * (t - from);
    largest = std::max(largest, std::abs(simulation.x(0) - exact));
  }
  return largest;
}

TEST(GrainImpulse, ABouncingBallIsTheExactOneToFirstOrder) {
  const double coarse = errorOfABouncingBall(1e-4), fine = errorOfABouncingBall(1e-5),
               finest = errorOfABouncingBall(1e-6);
  EXPECT_LT(coarse, 6.0 * 1e-4 * 0.5);  // five bounces, each a step late at 0.5 m/s and less
  EXPECT_NEAR(coarse / fine, 10.0, 5.0);
  EXPECT_NEAR(fine / finest, 10.0, 5.0);
}

/// A heap of disks in a box.
grain::Setup heap(double restitution, double friction) {
  grain::Setup setup = gas(restitution, friction);
  grain::Disks all = std::exchange(setup.disks, {});
  for (std::size_t k = 0; k < 24; ++k)
    test::addDisk(setup.disks, all.x[k], all.y[k], 0.1 * all.vx[k], 0.1 * all.vy[k], 0.0);
  setup.gravityY = -9.81;
  return setup;
}

/// Nothing rebounds from the kick that it is held against: a heap comes to rest, with any e < 1,
/// friction or not. With rebounds of e g dt it kept 2·10⁻⁵ of the energy for ever.
TEST(GrainImpulse, AHeapComesToRest) {
  for (const double restitution : {0.0, 0.9})
    for (const double friction : {0.0, 0.4}) {
      Simulation simulation(heap(restitution, friction));
      const double energy = 24.0 * test::smallMass * 9.81 * 0.02;
      simulation.advance(4000);
      EXPECT_LT(simulation.kineticEnergy(), 1e-8 * energy) << restitution << " " << friction;
      if (friction == 0.0) {
        EXPECT_EQ(simulation.unfinishedImpacts(), 0u) << restitution;
      }
    }
}

/// Four disks on top of each other stay where they are under gravity for two seconds, the topmost
/// up to a million times as heavy as the others, and each contact carries the weight above it.
TEST(GrainImpulse, AColumnRests_HoweverHeavyItsTop) {
  for (const double ratio : {1.0, 1e3, 1e6})
    for (const double restitution : {0.0, 0.7}) {
      grain::Setup setup = ball(restitution, 5e-4);
      setup.disks = {};
      for (int k = 0; k < 4; ++k)
        test::addDisk(setup.disks, (1.0 - 1e-9 + k * (2.0 - 2e-9)) * test::smallRadius, 0.0, 0.0,
                      0.0, 0.0);
      setup.disks.mass[3] *= ratio;
      setup.disks.inertia[3] *= ratio;
      const Simulation simulation = test::advanced(setup, 4000);
      for (std::size_t k = 0; k < 4; ++k)
        EXPECT_NEAR(simulation.x(k), setup.disks.x[k], 1e-6 * test::smallRadius) << ratio;
      EXPECT_EQ(simulation.unfinishedImpacts(), 0u) << ratio;
      if (ratio > 1.0 || restitution > 0.0) continue;
      const double weight = 9.81 * test::smallMass;
      for (const Contact& contact : simulation.contacts()) {
        const double above = contact.j < 4 ? 3.0 - contact.i : 4.0;  // disks; j = 4 is the floor
        EXPECT_NEAR(contact.normalForce, above * weight, 1e-6 * weight) << contact.j;
      }
      EXPECT_EQ(simulation.contacts().size(), 4u);
    }
}

/// A slope holds a disk with friction that rolls, x = g sin/3 t², and none without: g sin/2 t².
/// Coulomb's bound: one that cannot roll slides from tan > µ on.
TEST(GrainImpulse, RollsAndSlidesDownASlopeAsItShould) {
  constexpr double g = 9.81, slope = 0.35, dt = 1e-4, t = 0.5;
  for (const double friction : {0.0, 0.05, 0.6}) {
    grain::Setup setup = ball(0.5, dt, g * std::cos(slope));
    setup.disks.vx = {0.0};
    setup.law.mu = friction;
    setup.gravityY = g * std::sin(slope);
    Simulation simulation(setup);
    simulation.advance(static_cast<std::uint64_t>(std::llround(t / dt)));
    const bool rolls = friction > std::tan(slope) / 3.0;
    const double pull = rolls ? g * std::sin(slope) * 2.0 / 3.0
                              : g * (std::sin(slope) - friction * std::cos(slope));
    EXPECT_NEAR(simulation.y(0), 0.5 * pull * t * t, pull * t * dt) << friction;
    EXPECT_NEAR(simulation.x(0), test::smallRadius, g * dt * dt);  // until the first step touches
  }
}

/// A disk on a plate that shakes with less than gravity stays on it: a wall that speeds up is a
/// kick, not an impact.
TEST(GrainImpulse, AShakenPlateCarriesItsDisk) {
  grain::Setup setup = ball(1.0, 1e-4);
  const double amplitude = 1e-3, omega = std::sqrt(0.9 * 9.81 / amplitude);
  setup.disks.vx = {amplitude * omega};
  setup.walls[0].moves = true;
  setup.walls[0].motion = [=](double t) {
    WallState state;
    state.x = amplitude * std::sin(omega * t);
    state.vx = amplitude * omega * std::cos(omega * t);
    return state;
  };
  Simulation simulation(setup);
  double farthest = 0.0;
  for (int look = 0; look < 2000; ++look) {
    simulation.advance(5);
    const double plate = amplitude * std::sin(omega * simulation.time());
    farthest = std::max(farthest, std::abs(simulation.x(0) - plate - test::smallRadius));
  }
  EXPECT_LT(farthest, 0.01 * amplitude);
}

/// A disk between two walls that close in can never part from both: the step goes on, and says so.
TEST(GrainImpulse, SaysWhereImpactsDoNotEnd) {
  grain::Setup setup = headOn(0.0);
  setup.law.en = 0.5;
  test::putOnPlane(setup);
  setup.disks.x = {0.999 * test::smallRadius};
  grain::Wall press;
  press.planes = {{1.998 * test::smallRadius, 0.0, -1.0, 0.0}};
  press.motion = [](double t) { return grain::WallState{.x = -0.01 * t, .vx = -0.01}; };
  setup.walls.push_back(press);
  Simulation simulation(setup);
  simulation.advance(10);
  EXPECT_GT(simulation.unfinishedImpacts(), 5u);
  EXPECT_TRUE(std::isfinite(simulation.kineticEnergy()));
}

TEST(GrainImpulse, TheSameBitsOnAnyNumberOfThreads) {
  grain::Setup setup = gas(0.9, 0.3);
  const Simulation one = test::advanced(setup, 500);
  setup.threads = 3;
  EXPECT_EQ(test::difference(one, test::advanced(setup, 500)), "");
}

TEST(GrainImpulse, NeedsTheSchemeInWhichAKickIsAnImpulse) {
  for (const Integrator scheme : {Integrator::positionVerlet, Integrator::velocityVerlet}) {
    grain::Setup setup = headOn(1.0);
    setup.law.conventions.integrator = scheme;
    EXPECT_THROW(Simulation{setup}, std::invalid_argument);
  }
}

}  // namespace

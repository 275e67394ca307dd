#include <gtest/gtest.h>

#include <cmath>

#include "engines/grain/contact_force.hpp"
#include "tests/unit/grain_packed.hpp"

// Resistance to rolling: closed forms on a plane and of two disks (J ω' = −f a − M, m v' = f, with
// N = m g and J = m a²/2 of a disk), the ledger, and the bits of the step.

namespace {

using namespace grain;
namespace test = crossgrain::test;

constexpr double g = 9.81, mass = 2.0, radius = 0.1, inertia = 0.5 * mass * radius * radius;
constexpr double load = mass * g;

/// Hard enough that the overlap at rest is 2e-5 of the radius.
ContactLaw rollingLaw(RollingLaw rolling) {
  ContactLaw law;
  law.kn = 1e7;
  law.gn = 0.5 * std::sqrt(law.kn * mass);
  law.kt = 0.8 * law.kn;
  law.gt = law.gn;
  law.mu = 0.8;
  law.tangential = TangentialLaw::springDashpot;
  law.rolling = rolling;
  law.muR = 0.1;
  return law;
}

/// A disk at rest on a plane that falls by `slope` = tan β to the right.
grain::Setup onPlane(const ContactLaw& law, double slope = 0.0) {
  grain::Setup setup{.law = law, .dt = 2e-5};
  const double beta = std::atan(slope);
  setup.gravityX = g * std::sin(beta);
  setup.gravityY = -g * std::cos(beta);
  setup.disks = {
      {0.0},    {radius - load * std::cos(beta) / law.kn}, {0.0}, {0.0}, {0.0}, {radius}, {mass},
      {inertia}};
  Wall wall;
  wall.planes.push_back({0.0, 0.0, 0.0, 1.0});
  wall.motion = [](double) { return WallState{}; };
  wall.moves = false;
  setup.walls.push_back(wall);
  return setup;
}

/// To the right, without slip.
grain::Setup rollingAt(grain::Setup setup, double speed) {
  setup.disks.vx[0] = speed;
  setup.disks.spin[0] = -speed / radius;
  return setup;
}

void advanceTo(Simulation& simulation, double time) {
  while (simulation.time() < time - 0.5 * simulation.dt()) simulation.step();
}

double stopOf(grain::Setup setup, double speed) {
  Simulation simulation(rollingAt(std::move(setup), speed));
  while (simulation.velocityX(0) > 0.0) simulation.step();
  return simulation.x(0);
}

TEST(RollingConstantTorque, RollingDisk_StopsAfterItsClosedDistance) {
  // a = −µ_r g/(1 + q), so x = (1 + q) v²/(2 µ_r g).
  EXPECT_NEAR(stopOf(onPlane(rollingLaw(RollingLaw::constantTorque)), 0.5),
              1.5 * 0.25 / (2.0 * 0.1 * g), 2e-5);
}

TEST(RollingConstantTorque, TwiceTheLength_HalvesTheDistance) {
  ContactLaw law = rollingLaw(RollingLaw::constantTorque);
  law.conventions.rollingLength = RollingLength::twiceEffective;
  EXPECT_NEAR(stopOf(onPlane(law), 0.5), 0.75 * 0.25 / (2.0 * 0.1 * g), 2e-5);
}

TEST(RollingConstantTorque, SpinWithoutFriction_FallsByTwoMuGOverR) {
  ContactLaw law = rollingLaw(RollingLaw::constantTorque);
  law.tangential = TangentialLaw::none;
  grain::Setup setup = onPlane(law);
  setup.disks.spin[0] = 5.0;
  Simulation simulation(std::move(setup));
  ASSERT_TRUE(simulation.rotates());
  advanceTo(simulation, 0.1);
  EXPECT_NEAR(simulation.spin(0), 5.0 - 2.0 * 0.1 * g / radius * 0.1, 1e-9);
  EXPECT_EQ(simulation.velocityX(0), 0.0);
}

TEST(RollingConstantTorque, AtRest_FlipsByHalfAStepOfItsTorque) {
  ContactLaw law = rollingLaw(RollingLaw::constantTorque);
  law.tangential = TangentialLaw::none;
  grain::Setup setup = onPlane(law);
  setup.disks.spin[0] = 1e-3;
  Simulation simulation(std::move(setup));
  simulation.advance(1000);
  const double flip = 0.1 * radius * load * simulation.dt() / inertia;
  for (int k = 0; k < 4; ++k) {
    simulation.step();
    EXPECT_LE(std::abs(simulation.spin(0)), flip);
  }
}

TEST(RollingConstantTorque, OfTheElasticLoad_IgnoresTheDashpot) {
  // At the first touch there is no overlap: the elastic load is small, the dashpot's is not.
  for (const RollingLoad of : {RollingLoad::compression, RollingLoad::elastic}) {
    ContactLaw law = rollingLaw(RollingLaw::constantTorque);
    law.conventions.rollingLoad = of;
    grain::Setup setup = onPlane(law);
    setup.disks.y[0] = radius - 1e-9;
    setup.disks.vy[0] = -1.0;
    setup.disks.spin[0] = 1.0;
    Simulation simulation(std::move(setup));
    simulation.step();
    const Contact contact = simulation.contacts().front();
    const double expected =
        of == RollingLoad::elastic ? law.kn * contact.overlap : contact.normalForce;
    EXPECT_NEAR(contact.rollingTorque, -0.1 * radius * expected, 1e-12 * contact.normalForce);
    EXPECT_GT(contact.normalForce, 1.2 * law.kn * contact.overlap);
  }
}

TEST(RollingViscous, RollingDisk_DecaysExponentially) {
  // v = v₀ exp(−c t/((1 + q) m a²)) with c = γ_r L².
  ContactLaw law = rollingLaw(RollingLaw::viscous);
  law.gr = 3.0;
  Simulation simulation(rollingAt(onPlane(law), 0.5));
  advanceTo(simulation, 1.0);
  EXPECT_NEAR(simulation.velocityX(0), 0.5 * std::exp(-3.0 / (1.5 * mass)), 2e-5);
}

TEST(RollingViscousByLoad, RollingDisk_DecaysWithItsLoad) {
  // c = µ_r L N L, µ_r in s/m.
  ContactLaw law = rollingLaw(RollingLaw::viscousByLoad);
  Simulation simulation(rollingAt(onPlane(law), 0.5));
  advanceTo(simulation, 1.0);
  EXPECT_NEAR(simulation.velocityX(0), 0.5 * std::exp(-0.1 * load / (1.5 * mass)), 2e-5);
}

ContactLaw springLaw(double stiffness = 1e4) {
  ContactLaw law = rollingLaw(RollingLaw::spring);
  law.kr = stiffness;
  return law;
}

TEST(RollingSpring, Incline_StandsUpToMuAndRollsBeyond) {
  // Critically damped, so that it comes to rest: x = a² m g sin β/k_r + m g sin β/k_t.
  ContactLaw law = springLaw();
  law.gr = 2.0 * std::sqrt(law.kr * 1.5 * mass);
  const double slope = 0.08, down = load * std::sin(std::atan(slope));
  Simulation stands(onPlane(law, slope));
  advanceTo(stands, 1.0);
  EXPECT_NEAR(stands.x(0), down / law.kr + down / law.kt, 1e-4 * down / law.kr);
  EXPECT_NEAR(stands.velocityX(0), 0.0, 1e-9);
  // a = g (sin β − µ_r cos β)/(1 + q); its beginning, while the spring loads, takes less than 2 ms.
  Simulation rolls(onPlane(law, 0.2));
  advanceTo(rolls, 0.5);
  const double v = rolls.velocityX(0);
  advanceTo(rolls, 1.0);
  const double beta = std::atan(0.2);
  EXPECT_NEAR(rolls.velocityX(0) - v, 0.5 * g * (std::sin(beta) - 0.1 * std::cos(beta)) / 1.5,
              1e-5);
}

TEST(RollingSpring, BelowItsBound_OscillatesAtItsFrequency) {
  // ω₀² = k/((1 + q) m a²), k = k_r L²; by the time between two zeros of the velocity.
  ContactLaw law = springLaw();
  law.conventions.springUpdate = SpringUpdate::midpoint;
  law.gt = 0.0;
  const double amplitude = 1e-4;
  const double omega = std::sqrt(law.kr / (1.5 * mass));
  Simulation simulation(rollingAt(onPlane(law), amplitude * omega));
  const auto nextTurn = [&] {
    double before = 0.0;
    do {
      before = simulation.velocityX(0);
      simulation.step();
    } while (before * simulation.velocityX(0) > 0.0);
    const double after = simulation.velocityX(0);
    return simulation.time() - simulation.dt() * after / (after - before);
  };
  nextTurn();
  const double first = nextTurn(), second = nextTurn();
  // The friction spring is softer than none: 1/k_t of its own to the period.
  EXPECT_NEAR(second - first, M_PI / omega, 1e-3 * M_PI / omega);
}

TEST(RollingSpring, RollingDisk_StopsAfterItsClosedDistanceAndTheSpringsOwn) {
  // (1 + q) v²/(2 µ_r g) + ½ µ_r a² N/k, k = k_r a².
  const ContactLaw law = springLaw();
  EXPECT_NEAR(stopOf(onPlane(law), 0.5), 1.5 * 0.25 / (2.0 * 0.1 * g) + 0.05 * load / law.kr, 2e-5);
}

/// Two heavy disks of unequal radii, pressed together; `turn` [rad/s] of the first.
grain::Setup heldPair(const ContactLaw& law, double overlap, double turn) {
  grain::Setup setup{.law = law, .dt = 1e-5};
  const double heavy = 1e9, light = 1e-3;
  setup.disks = {{0.0, 0.3 - overlap}, {0.0, 0.0}, {0.0, 0.0},     {0.0, 0.0},
                 {turn, 0.0},          {0.1, 0.2}, {heavy, heavy}, {light, 2.0 * light}};
  return setup;
}

TEST(RollingSpring, PairWithCentresHeld_ItsTorqueIsTheConventions) {
  // Slipping: −µ_r L N. L = R₁₂ = 0.0667 m, 2 R₁₂, the smaller radius or their mean.
  const double effective = 0.1 * 0.2 / 0.3, overlap = 1e-5;
  for (const auto& [length, metres] :
       {std::pair{RollingLength::effective, effective},
        std::pair{RollingLength::twiceEffective, 2.0 * effective},
        std::pair{RollingLength::smallerRadius, 0.1}, std::pair{RollingLength::meanRadius, 0.15}}) {
    ContactLaw law = springLaw(1e8);
    law.tangential = TangentialLaw::none;
    law.conventions.rollingLength = length;
    Simulation simulation(heldPair(law, overlap, 100.0));
    simulation.advance(20);
    const Contact contact = simulation.contacts().front();
    EXPECT_TRUE(contact.rollingSlides);
    EXPECT_NEAR(contact.rollingTorque, -0.1 * metres * contact.normalForce,
                1e-9 * contact.normalForce);
  }
  // Sticking: −k θ with k = k_r L², k_r a_i a_j or k_r.
  for (const auto& [stiffness, factor] :
       {std::pair{RollingStiffness::lengthSquare, effective * effective},
        std::pair{RollingStiffness::radii, 0.02}, std::pair{RollingStiffness::constant, 1.0}}) {
    ContactLaw law = springLaw(10.0);
    law.tangential = TangentialLaw::none;
    law.conventions.rollingStiffness = stiffness;
    Simulation simulation(heldPair(law, overlap, 1e-6));
    simulation.advance(10);
    const Contact contact = simulation.contacts().front();
    EXPECT_FALSE(contact.rollingSlides);
    EXPECT_GT(contact.angle, 0.0);
    // θ was stretched by the last step after its torque was taken.
    const double turned =
        contact.angle - (simulation.spin(0) - simulation.spin(1)) * simulation.dt();
    EXPECT_NEAR(contact.rollingTorque, -10.0 * factor * turned, 1e-5 * 10.0 * factor * turned);
  }
}

TEST(RollingSpring, WithoutLoad_HasNoLimitWhereTheConventionSaysSo) {
  ContactLaw law = springLaw(10.0);
  for (const RollingLoad counts : {RollingLoad::compression, RollingLoad::whileCompressed}) {
    law.conventions.rollingLoad = counts;
    const auto general = generalLaw<double>(law, 1e-5, true);
    const auto motion = rollingMotion(general, 0.2, 0.0, 0.0);  // L = a = 0.2 m, ω_r = 0
    double angle = 0.01;
    const double free = counts == RollingLoad::whileCompressed ? -10.0 * 0.2 * 0.2 * 0.01 : 0.0;
    EXPECT_NEAR(rollingTorque(general, motion, {}, 0.0, angle).torque, free, 1e-15);
    angle = 1e3;  // with a load both have the limit
    EXPECT_NEAR(rollingTorque(general, motion, {}, 5.0, angle).torque, -0.1 * 0.2 * 5.0, 1e-12);
  }
}

TEST(RollingSpring, DashpotOutsideTheBound_EndsWithTheSlip) {
  // Inside, spring and dashpot share the bound; outside, a sticking contact may exceed it.
  for (const bool outside : {false, true}) {
    ContactLaw law = springLaw(1e3);
    law.tangential = TangentialLaw::none;
    law.conventions.rollingDashpot = outside ? Dashpot::outside : Dashpot::inside;
    law.gr = 1e3;
    Simulation simulation(heldPair(law, 1e-5, 5.0));
    simulation.step();
    const Contact contact = simulation.contacts().front();
    const double bound = 0.1 * (0.02 / 0.3) * contact.normalForce;
    EXPECT_EQ(std::abs(contact.rollingTorque) > 1.5 * bound, outside);
    EXPECT_EQ(contact.rollingSlides, !outside);
  }
}

TEST(RollingSpring, CriticalDamper_IsTheDampingRatio) {
  // On a plane I = J + m a²: η = 0.3 gives the logarithmic decrement 2π η/√(1 − η²) a period.
  ContactLaw law = springLaw();
  law.conventions.rollingDamper = RollingDamper::critical;
  law.gr = 0.3;
  law.conventions.springUpdate = SpringUpdate::midpoint;
  const double omega = std::sqrt(law.kr / (1.5 * mass));
  Simulation simulation(rollingAt(onPlane(law), 1e-4 * omega));
  double peaks[2] = {0.0, 0.0};
  for (double& peak : peaks) {  // the first to the right, and the next one
    double before = -1.0, now = simulation.x(0);
    while (!(before > now && now > 0.0)) {
      before = now;
      simulation.step();
      now = simulation.x(0);
    }
    peak = before;
    while (simulation.velocityX(0) < 0.0) simulation.step();
  }
  const double decrement = 2.0 * M_PI * 0.3 / std::sqrt(1.0 - 0.09);
  EXPECT_NEAR(std::log(peaks[0] / peaks[1]), decrement, 0.02 * decrement);
}

TEST(RollingSpring, WhereTwoDisksChangePlaces_KeepsItsSign) {
  // The pair rises along y, one disk up to the left of the other: which is first in memory depends
  // on whether both are in one row of cells. θ grows on by ω_r dt.
  ContactLaw law = springLaw(10.0);
  law.tangential = TangentialLaw::none;
  for (int start = 0; start < 6; ++start) {
    grain::Setup setup = heldPair(law, 1e-5, 1e-6);
    setup.disks.inertia = {1e9, 1e9};
    const double distance = 0.3 - 1e-5;
    setup.disks.x = {0.0, -0.8 * distance};
    setup.disks.y = {0.07 * start, 0.07 * start + 0.6 * distance};
    setup.disks.vy = {2.5, 2.5};  // 0.2 m in 8192 steps
    Simulation simulation(std::move(setup));
    simulation.advance(3 * 8192);
    // θ is one step ahead: it is stretched after its force, at t = 0 as well.
    EXPECT_NEAR(simulation.contacts().front().angle, 1e-6 * (simulation.time() + simulation.dt()),
                1e-9 * 1e-6);
  }
}

TEST(RollingLedger, OnATurningPlane_ClosesAtSecondOrder) {
  // The plane does work by its torque against rolling, too.
  const auto worst = [](RollingLaw rolling, double dt) {
    ContactLaw law = springLaw(500.0);
    law.rolling = rolling;
    law.gr = 2.0;
    law.conventions.springUpdate = SpringUpdate::midpoint;
    grain::Setup setup = rollingAt(onPlane(law), 0.4);
    setup.dt = dt;
    setup.ledger = true;
    setup.walls[0].moves = true;
    setup.walls[0].motion = [](double t) {
      WallState state{};
      state.angle = 0.02 * t;
      state.spin = 0.02;
      return state;
    };
    Simulation simulation(std::move(setup));
    double most = 0.0;
    while (simulation.time() < 0.05) {
      simulation.step();
      most = std::max(most, std::abs(test::residual(*simulation.energyLedger())));
    }
    EXPECT_GT(
        simulation.energyLedger()->lostRolling + simulation.energyLedger()->lostRollingDamping,
        0.01);
    EXPECT_NE(simulation.energyLedger()->workOfWalls, 0.0);
    return most;
  };
  for (const RollingLaw rolling : {RollingLaw::constantTorque, RollingLaw::viscous,
                                   RollingLaw::viscousByLoad, RollingLaw::spring})
    EXPECT_NEAR(std::log2(worst(rolling, 2e-5) / worst(rolling, 5e-6)) / 2.0, 2.0, 0.3)
        << static_cast<int>(rolling);
}

TEST(RollingLedger, RollingToRest_ItsTorqueTakesAll) {
  ContactLaw law = rollingLaw(RollingLaw::constantTorque);
  grain::Setup setup = rollingAt(onPlane(law), 0.5);
  setup.ledger = true;
  Simulation simulation(std::move(setup));
  while (simulation.velocityX(0) > 0.0) simulation.step();
  const double kinetic = 0.75 * mass * 0.25;  // ½ (1 + q) m v²
  EXPECT_NEAR(simulation.energyLedger()->lostRolling, kinetic, 1e-3 * kinetic);
}

/// Each law in a scene in which it rolls, slides and holds.
grain::Setup rollingCrowd(RollingLaw rolling) {
  grain::Setup setup = test::packed(5, 21);
  setup.law.rolling = rolling;
  setup.law.muR = rolling == RollingLaw::viscousByLoad ? 10.0 : 0.05;
  setup.law.kr = 0.1 * setup.law.kn;
  setup.law.gr = 0.1 * setup.law.gn;
  return setup;
}

class RollingBits : public testing::TestWithParam<std::tuple<RollingLaw, Precision>> {};

TEST_P(RollingBits, KernelsThreadsAndRestarts_GiveTheSame) {
  const auto [rolling, precision] = GetParam();
  grain::Setup setup = rollingCrowd(rolling);
  setup.precision = precision;
  const Simulation whole = test::withSameBits(setup, 8250);  // across a renumbering
  std::size_t slides = 0, holds = 0;
  for (const Contact& contact : whole.contacts()) {
    slides += contact.rollingSlides;
    holds += contact.rollingTorque != 0.0 && !contact.rollingSlides;
  }
  EXPECT_EQ(slides > 0, rolling == RollingLaw::constantTorque || rolling == RollingLaw::spring);
  EXPECT_EQ(holds > 0, rolling != RollingLaw::constantTorque);
}

INSTANTIATE_TEST_SUITE_P(
    Laws, RollingBits,
    testing::Combine(testing::Values(RollingLaw::constantTorque, RollingLaw::viscous,
                                     RollingLaw::viscousByLoad, RollingLaw::spring),
                     testing::Values(Precision::float64, Precision::float32)));

TEST(RollingLaw, WithoutAStiffnessOrOfImpulses_IsRefused) {
  grain::Setup soft = onPlane(springLaw(0.0));
  EXPECT_THROW(Simulation{std::move(soft)}, std::invalid_argument);
  ContactLaw law = rollingLaw(RollingLaw::constantTorque);
  law.normal = NormalLaw::rigid;
  grain::Setup rigid = onPlane(law);
  rigid.law.conventions.integrator = Integrator::semiImplicitEuler;
  EXPECT_THROW(Simulation{std::move(rigid)}, std::invalid_argument);
}

}  // namespace

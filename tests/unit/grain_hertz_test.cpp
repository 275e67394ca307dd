#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/grain_scenes.hpp"

// Contacts whose stiffness changes with the overlap, against closed forms.

namespace {

using namespace grain;
namespace test = crossgrain::test;
using grain::Setup;

/// Two equal spheres head on, after Chung and Ooi (2011), test 1; E in Pa, density in kg/m³.
struct Spheres {
  double radius, young, poisson, density, speed;

  double mass() const { return 4.0 / 3.0 * M_PI * radius * radius * radius * density; }
  double reducedMass() const { return 0.5 * mass(); }
  double reducedRadius() const { return 0.5 * radius; }
  double effectiveModulus() const { return young / (2.0 * (1.0 - poisson * poisson)); }
  /// G₁₂ = G/(2 (2 − ν)), G = E/(2 (1 + ν)).
  double effectiveShear() const { return young / (4.0 * (1.0 + poisson) * (2.0 - poisson)); }
  /// (15 m₁₂ v²/(16 E₁₂ √R₁₂))^(2/5), v the speed of approach.
  double deepest() const {
    const double v = 2.0 * speed;
    return std::pow(
        15.0 * reducedMass() * v * v / (16.0 * effectiveModulus() * std::sqrt(reducedRadius())),
        0.4);
  }
  double largestForce() const {
    return 4.0 / 3.0 * effectiveModulus() * std::sqrt(reducedRadius()) * std::pow(deepest(), 1.5);
  }
  double contactTime() const { return 2.9432 * deepest() / (2.0 * speed); }
};

constexpr Spheres glass{0.010, 48e9, 0.20, 2800.0, 10.0};
constexpr Spheres limestone{0.010, 20e9, 0.25, 2500.0, 10.0};

Setup headOn(const Spheres& s, double dt, double offset = 0.0, double spin = 0.0) {
  Setup setup;
  setup.law.normal = NormalLaw::hertz;
  setup.law.kn = 4.0 / 3.0 * s.effectiveModulus();
  setup.dt = dt;
  setup.law.conventions.integrator = Integrator::velocityVerlet;
  const double nx = std::sqrt(1.0 - offset * offset);
  const double ahead = 0.5 * s.speed * dt;
  for (const double side : {1.0, -1.0}) {
    setup.disks.x.push_back(side * (s.radius * nx + ahead));
    setup.disks.y.push_back(side * s.radius * offset);
    setup.disks.vx.push_back(-side * s.speed);
    setup.disks.vy.push_back(0.0);
    setup.disks.spin.push_back(spin);
    setup.disks.radius.push_back(s.radius);
    setup.disks.mass.push_back(s.mass());
    setup.disks.inertia.push_back(0.4 * s.mass() * s.radius * s.radius);
  }
  return setup;
}

struct Impact {
  double deepest = 0.0, largestForce = 0.0, contactTime = 0.0, restitution = 0.0;
};

Impact impact(const Setup& setup) {
  Impact found;
  const double v = setup.disks.vx[1] - setup.disks.vx[0];
  Simulation simulation(setup);
  std::uint64_t touching = 0;
  do {
    simulation.step();
    for (const Contact& contact : simulation.contacts()) {
      found.deepest = std::max(found.deepest, contact.overlap);
      found.largestForce = std::max(found.largestForce, contact.normalForce);
      ++touching;
    }
  } while (simulation.steps() < 3 || !simulation.contacts().empty());
  found.contactTime = static_cast<double>(touching) * setup.dt;
  found.restitution = (simulation.velocityX(0) - simulation.velocityX(1)) / v;
  return found;
}

TEST(GrainHertz, ClosedFormsAreTheValuesPublishedForTestOne) {
  EXPECT_NEAR(glass.deepest(), 274.1e-6, 0.1e-6);
  EXPECT_NEAR(glass.largestForce(), 10.70e3, 10.0);
  EXPECT_NEAR(glass.contactTime(), 40.3e-6, 0.1e-6);
  EXPECT_NEAR(limestone.deepest(), 368.3e-6, 0.1e-6);
  EXPECT_NEAR(limestone.largestForce(), 7.11e3, 10.0);
  EXPECT_NEAR(limestone.contactTime(), 54.2e-6, 0.1e-6);
}

TEST(GrainHertz, ElasticSpheresDeformAsHertzSays) {
  for (const Spheres& spheres : {glass, limestone}) {
    const double dt = spheres.contactTime() / 4000.0;
    const Impact found = impact(headOn(spheres, dt));
    // Near its deepest point δ is flat: half a step off costs (dt/t_c)². Times are whole steps.
    EXPECT_NEAR(found.deepest, spheres.deepest(), 1e-6 * spheres.deepest());
    EXPECT_NEAR(found.largestForce, spheres.largestForce(), 2e-6 * spheres.largestForce());
    EXPECT_NEAR(found.contactTime, spheres.contactTime(), 2.0 * dt);
    EXPECT_NEAR(found.restitution, 1.0, 1e-6);
  }
}

/// f = k(δ^(3/2) + 3/2 A √δ δ̇): 1 − e grows as A v^(1/5), to first order
/// 1 − e = 1.15344 · 3/2 A (k/m₁₂)^(2/5) v^(1/5) (Ramírez et al. 1999), k = k_n √R₁₂.
TEST(GrainHertz, ViscoelasticSpheresLoseMoreWhereTheyAreFaster) {
  Spheres spheres = glass;
  for (const double speed : {0.01, 0.1, 1.0}) {
    spheres.speed = speed;
    grain::Setup setup = headOn(spheres, spheres.contactTime() / 4000.0);
    const double k = setup.law.kn * std::sqrt(spheres.reducedRadius());
    setup.law.damper = Damper::viscoelastic;
    setup.law.gn = 2e-10;  // A [s]
    const double loss = 1.15344 * 1.5 * setup.law.gn * std::pow(k / spheres.reducedMass(), 0.4) *
                        std::pow(2.0 * speed, 0.2);
    ASSERT_LT(loss, 0.01);  // the next order is 3/5 loss² of it
    EXPECT_NEAR(1.0 - impact(setup).restitution, loss, 0.01 * loss) << speed;
  }
}

/// The disk that Lätzel measured (2003, Fig. 4.4): f = 8.456e9 δ² − 3.73e12 δ³. Its deepest overlap
/// is where the work of f equals the kinetic energy.
TEST(GrainPolynomial, TheMeasuredDiskStopsWhereItsWorkIsTheKineticEnergy) {
  const double v = 0.1, reduced = 0.5 * test::smallMass;
  grain::Setup setup = test::collidingPair(v, 0.0, 0.0, 1e-8);
  setup.law = {};
  setup.law.normal = NormalLaw::polynomial;
  setup.law.kn = 8.456e9;
  setup.law.kn3 = -3.73e12;
  const Impact found = impact(setup);
  const double d = found.deepest;
  const double work = 8.456e9 * d * d * d / 3.0 - 3.73e12 * d * d * d * d / 4.0;
  EXPECT_NEAR(work, 0.5 * reduced * v * v, 1e-6 * work);
  EXPECT_NEAR(found.largestForce, 8.456e9 * d * d - 3.73e12 * d * d * d, 1e-9 * found.largestForce);
  EXPECT_NEAR(found.restitution, 1.0, 1e-5);
}

class Mindlin : public testing::TestWithParam<History> {};
INSTANTIATE_TEST_SUITE_P(Histories, Mindlin,
                         testing::Values(History::displacement, History::force));

Setup spinning(History history, double mu, double spin) {
  const double dt = glass.contactTime() / 4000.0;
  grain::Setup setup = headOn(glass, dt, 0.0, spin);
  setup.law.tangential = TangentialLaw::spring;
  setup.law.conventions.history = history;
  setup.law.conventions.springUpdate = SpringUpdate::midpoint;
  setup.law.kt = 8.0 * glass.effectiveShear();
  setup.law.mu = mu;
  return setup;
}

/// A fast spin slips throughout: the impulse is µ times the normal one, whatever the stiffness.
TEST_P(Mindlin, FastSpinsSlipThroughout) {
  const double mu = 0.1, spin = -2e4;
  Simulation simulation(spinning(GetParam(), mu, spin));
  simulation.advance(5000);
  ASSERT_TRUE(simulation.contacts().empty());
  // Impulses 2 m v on each normally: Δω = a µ 2 m v/(2/5 m a²) = 5 µ v/a.
  EXPECT_NEAR(simulation.spin(0) - spin, 5.0 * mu * glass.speed / glass.radius,
              2e-3 * 5.0 * mu * glass.speed / glass.radius);
  EXPECT_EQ(simulation.spin(0), simulation.spin(1));
}

/// A contact that sticks, slips and springs back gains no energy, whichever history it keeps.
TEST_P(Mindlin, GainsNoEnergy) {
  for (const double spin : {-2e3, -1e3, -3e2, 3e2}) {
    Simulation simulation(spinning(GetParam(), 0.35, spin));
    const double before = simulation.kineticEnergy();
    simulation.advance(5000);
    ASSERT_TRUE(simulation.contacts().empty());
    EXPECT_LE(simulation.kineticEnergy(), before * (1.0 + 1e-6)) << spin;
  }
}

TEST(GrainHistory, OfALinearLawIsTheSameAsForceAndAsDisplacement) {
  grain::Setup setup = test::collidingPair(0.1, 0.3, 20.0, test::contactTime() / 200.0);
  grain::Setup other = setup;
  other.law.conventions.history = History::force;
  Simulation a(setup), b(other);
  a.advance(400);
  b.advance(400);
  EXPECT_NEAR(a.spin(0), b.spin(0), 1e-10 * std::abs(a.spin(0)));
  EXPECT_NEAR(a.velocityY(0), b.velocityY(0), 1e-12);
}

/// ½ m v² goes into the contact and comes back: the stored energy of Hertz' law is the integral of
/// its force.
TEST(GrainHertz, StoresWhatItTakesFromTheMotion) {
  Simulation simulation(headOn(glass, glass.contactTime() / 4000.0));
  const double total = simulation.kineticEnergy();
  for (int k = 0; k < 4000; ++k) {
    simulation.step();
    ASSERT_NEAR(simulation.kineticEnergy() + simulation.elasticEnergy(), total, 1e-6 * total);
  }
}

/// A sphere on a plane: R₁₂ is its own radius.
TEST(GrainHertz, OnAPlaneTheRadiusIsTheSpheresOwn) {
  const Spheres aluminium{0.1, 70e9, 0.30, 2699.0, 0.2};
  // Rigid plane: E₁₂ = E/(1 − ν²). Chung and Ooi (2011), test 2: 49.7 µm, 11.37 kN.
  grain::Setup setup = headOn(aluminium, 732e-6 / 4000.0);
  test::putOnPlane(setup);
  setup.law.kn = 4.0 / 3.0 * 70e9 / (1.0 - 0.09);
  Simulation simulation(setup);
  double deepest = 0.0, largest = 0.0;
  for (int k = 0; k < 4500; ++k) {
    simulation.step();
    for (const Contact& contact : simulation.contacts()) {
      deepest = std::max(deepest, contact.overlap);
      largest = std::max(largest, contact.normalForce);
    }
  }
  EXPECT_NEAR(deepest, 49.7e-6, 0.05e-6);
  EXPECT_NEAR(largest, 11.37e3, 10.0);
}

}  // namespace

// Spheres in a hollow cylinder: closed forms, turned scenes, the plane as its limit, restarts.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <sstream>
#include <string>

#include "engines/grain/spheres.hpp"
#include "tests/support/refusal.hpp"

namespace {

using namespace grain;
using Vector = grain::Vec3<double>;

constexpr double a = 0.005, mass = 1.309e-3, g = 9.81;  // [m, kg, m/s²]
constexpr double inertia = 0.4 * mass * a * a;
constexpr double bore = 0.05;  // radius of the cylinder [m]

ContactLaw springLaw() {
  ContactLaw law{.tangential = TangentialLaw::springDashpot, .kn = 1e5, .kt = 2.857e4, .mu = 0.5};
  law.conventions.springUpdate =
      SpringUpdate::before;  // after the force an undamped spring would gain energy
  return law;
}

/// A cylinder along z about the origin that turns at that rate.
SpaceWall cylinder(double radius, double omega = 0.0) {
  SpaceWall wall;
  wall.cylinders.push_back({{}, {0.0, 0.0, 1.0}, radius});
  wall.motion = [omega](double t) {
    return SpaceWall::State{{}, {}, {0.0, 0.0, omega * t}, {0.0, 0.0, omega}};
  };
  return wall;
}

void add(SpheresSetup& setup, const Vector& x, const Vector& v = {}, const Vector& spin = {}) {
  setup.position.push_back(x);
  setup.velocity.push_back(v);
  setup.spin.push_back(spin);
  setup.radius.push_back(a);
  setup.mass.push_back(mass);
  setup.inertia.push_back(inertia);
}

SpheresSetup inCylinder(double omega = 0.0) {
  SpheresSetup setup;
  setup.law = springLaw();
  setup.dt = M_PI * std::sqrt(mass / setup.law.kn) / 40.0;
  setup.walls.push_back(cylinder(bore, omega));
  return setup;
}

/// Kinetic, of height along y, and of both springs of each contact [J].
double energyOf(Spheres& spheres, const ContactLaw& law) {
  double energy = 0.0;
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    const Vector v = spheres.velocity(i), w = spheres.spin(i);
    energy += 0.5 * (mass * dot(v, v) + inertia * dot(w, w)) + mass * g * spheres.position(i).y;
  }
  for (const SpaceContact& contact : spheres.contacts())
    energy += 0.5 * law.kn * contact.overlap * contact.overlap +
              0.5 * dot(contact.tangentialForce, contact.tangentialForce) / law.kt;
  return energy;
}

TEST(Cylinder, SphereRollingAtItsBottom_SwingsAsAPendulum) {
  // Rolling without slip, (1 + q) m (R − a) φ̈ = −m g sin φ: ω² = g/((1 + q)(R − a)), q = 2/5.
  // Of the rest: φ0²/16 of the amplitude, m g/((R − a) k_t) of the spring, δ/(R − a) of the
  // overlap, each below 1e-5 of ω, so below 2e-4 φ0 after 1.5 periods.
  const double start = 0.01, omega = std::sqrt(g / (1.4 * (bore - a)));
  for (const SpringTurn turn :
       {SpringTurn::rotated, SpringTurn::firstOrder, SpringTurn::rescaled, SpringTurn::projected}) {
    SpheresSetup setup = inCylinder();
    setup.law.conventions.springTurn = turn;
    setup.gravity = {0.0, -g, 0.0};
    const double arm = bore - a + mass * g / setup.law.kn;
    add(setup, {arm * std::sin(start), -arm * std::cos(start), 0.0});
    Spheres spheres(setup);
    const double before = energyOf(spheres, setup.law);
    const double swing = mass * g * arm * (1.0 - std::cos(start));
    for (int part = 0; part < 12; ++part) {
      spheres.advance(static_cast<std::uint64_t>(0.125 * 2.0 * M_PI / omega / setup.dt));
      const Vector x = spheres.position(0);
      EXPECT_NEAR(std::atan2(x.x, -x.y), start * std::cos(omega * spheres.time()), 2e-4 * start);
      EXPECT_EQ(x.z, 0.0);
      // The scheme's own energy differs from this one by (ω_n dt)²/24 of what the contact's small
      // oscillation has, and the spring of f_t by a step's stretch.
      EXPECT_NEAR(energyOf(spheres, setup.law), before, 1e-3 * swing);
    }
  }
}

TEST(Cylinder, SphereThatTurnsWithIt_StaysWhereItIsOnTheWall) {
  // Both turn as one body: k_n δ = m Ω² (R − a + δ), and nothing slips where the contact point is
  // on the wall, a − δ from the centre.
  const double omega = 20.0;
  SpheresSetup setup = inCylinder(omega);
  setup.law.conventions.leverArm = LeverArm::contactPoint;
  const double ratio = mass * omega * omega / setup.law.kn;
  const double arm = (bore - a) / (1.0 - ratio);
  add(setup, {arm, 0.0, 0.3}, {0.0, omega * arm, 0.0}, {0.0, 0.0, omega});
  Spheres spheres(setup);
  spheres.advance(static_cast<std::uint64_t>(2.0 * M_PI / omega / setup.dt));
  const double angle = omega * spheres.time();
  const Vector x = spheres.position(0);
  // The scheme turns it by (Ω dt)²/24 more: 1e-8 over a turn.
  EXPECT_LT(length(x - Vector{arm * std::cos(angle), arm * std::sin(angle), 0.3}), 1e-6 * arm);
  ASSERT_EQ(spheres.contacts().size(), 1u);
  const SpaceContact contact = spheres.contacts()[0];
  EXPECT_EQ(contact.j, 1);
  EXPECT_NEAR(contact.normalForce, mass * omega * omega * arm, 1e-4 * contact.normalForce);
  EXPECT_LT(length(contact.tangentialForce), 1e-4 * contact.normalForce);
}

TEST(Cylinder, SphereInATurningDrum_IsSpunUpUntilItRolls) {
  // The wall's point below it moves at Ω R: at rest when a ω = Ω R, at the very bottom, as nothing
  // resists rolling. Until then µ m g drives it. Dashpots end the swing.
  const double omega = 3.0;
  SpheresSetup setup = inCylinder(omega);
  setup.law.gn = 1.5;
  setup.law.gt = 0.4;
  setup.gravity = {0.0, -g, 0.0};
  add(setup, {0.0, -(bore - a), 0.0});
  Spheres spheres(setup);
  // It slips for Ω R/(7/2 µ g) = 8.7 ms, after the first touch has settled.
  spheres.advance(static_cast<std::uint64_t>(0.003 / setup.dt));
  const double early = spheres.spin(0).z, t = spheres.time();
  spheres.advance(static_cast<std::uint64_t>(0.003 / setup.dt));
  EXPECT_NEAR((spheres.spin(0).z - early) / (spheres.time() - t),
              setup.law.mu * mass * g * a / inertia, 0.03 * setup.law.mu * mass * g * a / inertia);
  // It swings on, rolling: what its surface has there, around the axis and about itself, is Ω R.
  spheres.advance(static_cast<std::uint64_t>(1.0 / setup.dt));
  const Vector x = spheres.position(0), v = spheres.velocity(0);
  const Vector outward = (1.0 / std::hypot(x.x, x.y)) * Vector{x.x, x.y, 0.0};
  const double around = dot(Vector{-outward.y, outward.x, 0.0}, v);
  EXPECT_NEAR(around + a * spheres.spin(0).z, omega * bore, 1e-3 * omega * bore);
  const auto [force, torque] = spheres.wallLoad(0);
  const SpaceContact contact = spheres.contacts().at(0);
  EXPECT_LT(length(force + contact.normalForce * contact.normal + contact.tangentialForce), 1e-12);
  EXPECT_LT(length(torque - cross(bore * outward, force)), 1e-12);
}

TEST(Cylinder, OfLargeRadius_IsThePlaneUpToItsCurvature) {
  const auto bounced = [](double radius) {
    SpheresSetup setup;
    setup.law = springLaw();
    setup.law.gn = 1.0;
    setup.law.gt = 0.3;
    setup.dt = 4e-6;
    setup.gravity = {0.0, -g, 0.0};
    if (radius > 0.0) {
      setup.walls.push_back(cylinder(radius));
      setup.walls[0].cylinders[0].point = {0.0, radius, 0.0};
    } else {
      SpaceWall floor;
      floor.planes.push_back({{}, {0.0, 1.0, 0.0}});
      floor.motion = [](double) { return SpaceWall::State{}; };
      setup.walls.push_back(floor);
    }
    add(setup, {0.0, a + 1e-5, 0.0}, {0.3, -0.5, 0.1}, {40.0, -20.0, 90.0});
    Spheres spheres(setup);
    spheres.advance(1000);
    return std::pair(spheres.velocity(0), spheres.spin(0));
  };
  const auto [plane, spin] = bounced(0.0);
  EXPECT_GT(plane.y, 0.1);
  double before = 0.0;
  for (const double radius : {10.0, 100.0, 1000.0}) {
    const auto [velocity, turning] = bounced(radius);
    const double apart = length(velocity - plane) + a * length(turning - spin);
    if (before > 0.0) {
      EXPECT_NEAR(before / apart, 10.0, 0.2) << radius;
    }
    before = apart;
  }
  EXPECT_LT(before, 1e-5);
}

/// Five spheres in a drum that turns, some at its wall, under way in all directions.
SpheresSetup tumbling() {
  SpheresSetup setup = inCylinder(15.0);
  setup.law.gn = 1.15;
  setup.law.gt = 0.33;
  setup.gravity = {200.0, -100.0 * g, 50.0};  // so that the wall is touched at all times
  const double arm = bore - 0.999 * a;
  for (int k = 0; k < 5; ++k) {
    const double angle = -1.9 + 0.2205 * k;
    add(setup, {arm * std::cos(angle), arm * std::sin(angle), 1e-4 * k},
        {0.2 - 0.1 * k, 0.1, 0.05 * k}, {30.0, -20.0 * k, 50.0});
  }
  return setup;
}

TEST(Cylinder, InATurnedScene_GivesTheTurnedMotion) {
  // As of all of it in space: rounding of the turned start, which contacts amplify by about ten.
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  for (const SpringTurn how :
       {SpringTurn::rotated, SpringTurn::firstOrder, SpringTurn::rescaled, SpringTurn::projected}) {
    SpheresSetup setup = tumbling();
    setup.law.conventions.springTurn = how;
    Vector axis{normal(random), normal(random), normal(random)};
    axis = (1.0 / length(axis)) * axis;
    const double angle = normal(random), c = std::cos(angle), s = std::sin(angle);
    const Vector shift{0.02, -0.01, 0.03};
    const auto turn = [&](const Vector& v) {
      return c * v + s * cross(axis, v) + ((1.0 - c) * dot(axis, v)) * axis;
    };
    SpheresSetup there = setup;
    for (Vector& v : there.position) v = turn(v) + shift;
    for (auto* list : {&there.velocity, &there.spin})
      for (Vector& v : *list) v = turn(v);
    there.gravity = turn(setup.gravity);
    there.walls[0].cylinders[0] = {turn({0.0, 0.0, 0.2}) + shift, turn({0.0, 0.0, 1.0}), bore};
    there.walls[0].motion = [=, motion = setup.walls[0].motion](double t) {
      const SpaceWall::State now = motion(t);
      return SpaceWall::State{shift, {}, turn(now.angle), turn(now.spin)};
    };
    Spheres own(setup), other(there);
    for (int piece = 0; piece < 10; ++piece) {
      own.advance(50);
      other.advance(50);
      for (std::size_t i = 0; i < own.size(); ++i) {
        EXPECT_LT(length(turn(own.position(i)) + shift - other.position(i)), 1e-11 * a);
        EXPECT_LT(length(turn(own.velocity(i)) - other.velocity(i)), 1e-10);
        EXPECT_LT(a * length(turn(own.spin(i)) - other.spin(i)), 1e-10);
      }
      EXPECT_LT(length(turn(own.wallLoad(0).second) - other.wallLoad(0).second), 1e-9);
    }
    EXPECT_GT(own.contactEvaluations(), 1000u);
    EXPECT_GT(own.contacts().size(), 3u);
  }
}

TEST(Cylinder, RestoredRun_GoesOnToTheBit) {
  const SpheresSetup setup = tumbling();
  Spheres first(setup);
  first.advance(300);
  EXPECT_FALSE(first.contacts().empty());
  std::stringstream file;
  first.save(file);
  Spheres second(setup);
  second.restore(file);
  EXPECT_EQ(first.wallLoad(0), second.wallLoad(0));
  first.advance(200);
  second.advance(200);
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(first.position(i), second.position(i));
    EXPECT_EQ(first.spin(i), second.spin(i));
  }
  EXPECT_EQ(first.wallLoad(0), second.wallLoad(0));
  // Of a cylinder of another radius, or another direction, it is of another setup.
  for (const bool wider : {true, false}) {
    SpheresSetup changed = setup;
    SpaceWall::Cylinder& wall = changed.walls[0].cylinders[0];
    if (wider)
      wall.radius *= 1.0001;
    else
      wall.axis = {0.0, 1e-3, 1.0};
    std::stringstream again(file.str());
    EXPECT_THROW(Spheres(changed).restore(again), std::runtime_error);
  }
}

TEST(Cylinder, RunThatBeginsUnderWay_GoesOnAsTheOneItIsOf) {
  SpheresSetup setup = tumbling();
  setup.law.conventions.dampingVelocity =
      DampingVelocity::lagged;  // predicted velocities need the forces of a step before
  Spheres first(setup);
  first.advance(300);
  for (std::size_t i = 0; i < first.size(); ++i) {
    setup.position[i] = first.position(i);
    setup.velocity[i] = first.velocity(i);
    setup.spin[i] = first.spin(i);
  }
  Spheres second(setup);  // the cylinder turns at an even rate, so that its start is any time
  second.beginUnderWay(first.contacts());
  first.advance(100);
  second.advance(100);
  for (std::size_t i = 0; i < first.size(); ++i)
    EXPECT_LT(length(first.position(i) - second.position(i)), 1e-10 * a);
}

TEST(Cylinder, SphereThroughItsWall_EndsTheRunByName) {
  SpheresSetup setup = inCylinder();
  setup.law.kn = 10.0;
  SpaceWall floor;
  floor.planes.push_back({{0.0, -1.0, 0.0}, {0.0, 1.0, 0.0}});
  floor.motion = [](double) { return SpaceWall::State{}; };
  setup.walls.push_back(floor);  // number 1, so that the cylinder is 2
  add(setup, {0.0, bore - 1.01 * a, 0.0}, {0.0, 5.0, 0.0});
  Spheres spheres(setup);
  const std::string why =
      crossgrain::test::refusalOf<std::runtime_error>([&] { spheres.advance(10000); });
  EXPECT_TRUE(why.starts_with("sphere 0 and cylinder 0 overlap by 1.")) << why;
}

}  // namespace

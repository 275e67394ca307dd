#include "averaging/wall_balance.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "averaging/global.hpp"
#include "tests/averaging/scenes.hpp"
#include "tests/support/thesis.hpp"

// Structures at rest whose thrust on the wall is known, in a cell of the thesis' size.

namespace crossgrain {
namespace {

using test::Instant;
using test::wallRadius;

using std::numbers::pi;
constexpr double innerRadius = 0.1032, outerRadius = 0.2524, height = 0.006, d = 0.0074;
constexpr double a = 0.5 * d;

Rings ringsOfWidth(double width) {
  return Rings({innerRadius, outerRadius - width, outerRadius}, height, d);
}

/// A ring of wall disks, `count` of them from the angle 0 on, numbered after the disks.
Instant walled(int count) {
  Instant instant;
  std::vector<Vec2> places;
  for (int k = 0; k < count; ++k) {
    const double phi = 2.0 * pi * k / count;
    places.emplace_back(outerRadius * std::cos(phi), outerRadius * std::sin(phi));
  }
  instant.addWall("outside", places, wallRadius);
  return instant;
}

double pressureOn(const Instant& instant) {
  return *radialPressure(instant.scene, instant.snapshot, "outside", outerRadius, height);
}

/// Spokes of disks that touch, each pressed on a wall disk with one force, from far inside R_o − Δr
/// on.
Instant spokes(int count, double force) {
  constexpr int disks = 4;
  Instant instant = walled(count);
  for (int k = 0; k < count; ++k)
    for (int m = 0; m < disks; ++m) {
      const double phi = 2.0 * pi * k / count;
      const double r = outerRadius - wallRadius - (2 * m + 1) * a;
      instant.addDisk({r * std::cos(phi), r * std::sin(phi)}, a);
    }
  for (int k = 0; k < count; ++k) {
    const double phi = 2.0 * pi * k / count;
    const Vec2 outward(std::cos(phi), std::sin(phi));
    instant.addContact(disks * k, disks * count + k, -outward, force, 0.0);
    for (int m = 1; m < disks; ++m)
      instant.addContact(disks * k + m - 1, disks * k + m, outward, force, 0.0);
  }
  std::ranges::fill(instant.snapshot.contacts->overlap, 0.0);
  return instant;
}

TEST(WallBalance, SpokesHaveNoHoopStressAndCarryTheirThrust) {
  constexpr int count = 100;
  constexpr double force = 1e-3;
  const Instant instant = spokes(count, force);
  const double p = count * force / (2.0 * pi * outerRadius * height);
  EXPECT_NEAR(pressureOn(instant), p, 1e-13 * p);
  for (const double width : {1.01 * d, 0.5 * d, 2.3 * d}) {
    const Rings rings = ringsOfWidth(width);
    const WallBalance found = *outerWallBalance(rings, instant.scene, instant.snapshot);
    // r σ_rr = R_o P at every r: σ_rr averaged over the ring is P R_o/r_m, to rounding.
    const double mean = outerRadius - 0.5 * width;
    EXPECT_NEAR(found.alongBranches, p * outerRadius / mean, 1e-12 * p);
    EXPECT_NEAR(found.hoopTerm, 0.0, 1e-12 * p);
  }
}

TEST(WallBalance, SlicingPutsAShareOfTheThrustOnTopThatTheFirstDisksDepthGives) {
  constexpr int count = 100;
  constexpr double force = 1e-3, width = 1.01 * d;
  const Instant instant = spokes(count, force);
  const Rings rings = ringsOfWidth(width);
  const WallBalance along = *outerWallBalance(rings, instant.scene, instant.snapshot);
  const auto moments = test::momentsOf(rings, instant);
  // By hand: the first disk reaches from 1.25 mm to 8.65 mm below R_o, the ring ends at 7.474 mm.
  // c = 1.176 mm: c/2a = 0.1589 of the branches and 0.1023 of the area lie below.
  const double c = wallRadius + 2.0 * a - width;
  const double theta = 2.0 * std::acos(1.0 - c / a);
  const double area = (theta - std::sin(theta)) / (2.0 * pi);
  EXPECT_NEAR(c / (2.0 * a), 0.1589, 5e-5);
  EXPECT_NEAR(area, 0.1023, 5e-5);
  const double excess = 2.0 * a / width * (c / (2.0 * a) - area);
  EXPECT_NEAR(excess, 0.0561, 5e-5);
  const double slicing = test::valueOf("stress_rr", rings, moments, 1);
  // The formula cuts with a straight edge, which bends by a²/2r at the disk's sides: some 10⁻⁴.
  EXPECT_NEAR(slicing / along.alongBranches - 1.0, excess, 1e-3);
}

TEST(WallBalance, AnArchIsHeldByItsHoopForces) {
  // A closed ring of disks that press on their neighbours with T and so on the wall, each with
  // 2 T sin(π/N): in equilibrium without friction.
  constexpr int count = 150;
  constexpr double thrust = 2e-3;
  Instant instant = walled(count);
  const double centre = outerRadius - wallRadius - a;
  const auto at = [&](int k) {
    const double phi = 2.0 * pi * k / count;
    return Vec2(centre * std::cos(phi), centre * std::sin(phi));
  };
  // Radii such that neighbours touch half way between their centres: branches end at the contacts.
  const double half = centre * std::sin(pi / count);
  for (int k = 0; k < count; ++k) instant.addDisk(at(k), half);
  const double push = 2.0 * thrust * std::sin(pi / count);
  for (int k = 0; k < count; ++k) {
    const int next = (k + 1) % count;
    const Vec2 toNext = (at(next) - at(k)).normalized();
    const bool first = k < next;
    instant.addContact(first ? k : next, first ? next : k, first ? Vec2(-toNext) : toNext, thrust,
                       0.0);
  }
  for (int k = 0; k < count; ++k) instant.addContact(k, count + k, -at(k).normalized(), push, 0.0);
  std::ranges::fill(instant.snapshot.contacts->overlap, 0.0);
  const double p = pressureOn(instant);
  EXPECT_NEAR(p, count * push / (2.0 * pi * outerRadius * height), 1e-12 * p);
  // The wall's branches must meet the disks' at one point, as those of touching disks do: from the
  // disk's centre `half` outward, and the rest of the way from the wall disk's.
  for (double& radius : instant.scene.bodies[0].diskRadius) radius = outerRadius - centre - half;
  for (const double width : {1.5 * d, 3.0 * d}) {
    const WallBalance found =
        *outerWallBalance(ringsOfWidth(width), instant.scene, instant.snapshot);
    const double mean = outerRadius - 0.5 * width;
    EXPECT_GT(found.hoopTerm, 0.1 * p);
    EXPECT_NEAR(found.alongBranches, p * outerRadius / mean - found.hoopTerm, 1e-9 * p) << width;
  }
}

TEST(WallBalance, IsAbsentWithoutContacts) {
  Instant instant = walled(10);
  instant.snapshot.contacts.reset();
  EXPECT_FALSE(outerWallBalance(ringsOfWidth(d), instant.scene, instant.snapshot));
}

}  // namespace
}  // namespace crossgrain

#include "averaging/regime.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "averaging/global.hpp"
#include "tests/averaging/scenes.hpp"

namespace crossgrain {
namespace {

using test::Instant;

constexpr double omega = 2.0;

/// Walls at 1 and 2, d = 0.1.
Rings cell() {
  return Rings(1.0, 2.0, 10, 0.5, 0.1);
}

/// Disks all around at some radii; each turns about the origin at the rate that is given for it.
template <class Rate>
Instant turning(Rate rate) {
  Instant instant;
  for (const double r : {1.06, 1.25, 1.5, 1.75, 1.94})
    for (int k = 0; k < 12; ++k) {
      const double phi = 2.0 * std::numbers::pi * k / 12;
      const Vec2 x(r * std::cos(phi), r * std::sin(phi));
      instant.addDisk(x, 0.05, 1.0, rate(r) * perpendicular(x));
    }
  return instant;
}

RegimeVerdict verdictOf(const Instant& instant, double contacts, double inertial,
                        double omegaOfWheel = omega) {
  RegimeFigures figures;
  figures.wheelContacts = contacts;
  figures.motion = wheelMotion(instant.scene, instant.snapshot, cell(), omegaOfWheel);
  figures.inertialNumber = inertial;
  return regimeOf(figures);
}

TEST(WheelMotion, SharesOfTheWheelsRotationAddUp) {
  // ω falls from 0.6 Ω at the wheel to 0.1 Ω at the ring, which stands; whichever way it turns.
  for (const double wheel : {omega, -omega}) {
    const Instant instant = turning([&](double r) { return wheel * (r < 1.1 ? 0.6 : 0.1); });
    const WheelMotion motion = *wheelMotion(instant.scene, instant.snapshot, cell(), wheel);
    EXPECT_NEAR(motion.slip, 0.4, 1e-14);
    EXPECT_NEAR(motion.shear, 0.5, 1e-14);
  }
}

TEST(WheelMotion, IsAbsentWithoutDisksAtAWall) {
  Instant instant;
  instant.addDisk({1.5, 0.0}, 0.05);
  EXPECT_FALSE(wheelMotion(instant.scene, instant.snapshot, cell(), omega));
}

TEST(Regime, FlowsShearInABand_BlockedStandOrTurnAsOnePiece_CollisionsAreFewOrFast) {
  const Instant band = turning([](double r) { return omega * 0.4 * std::exp(-(r - 1.06) / 0.15); });
  const Instant layer = turning([](double r) { return r < 1.1 ? 0.4 * omega : 0.0; });
  const Instant other = turning([](double r) { return r < 1.1 ? -0.4 * omega : 0.0; });
  const Instant still = turning([](double) { return 0.002 * omega; });
  const Instant piece = turning([](double) { return omega; });  // no slip, and no shear either
  EXPECT_EQ(verdictOf(band, 18.0, 0.016).regime, Regime::flowing);
  EXPECT_EQ(verdictOf(other, 18.0, 0.016, -omega).regime, Regime::flowing);
  EXPECT_EQ(verdictOf(still, 15.0, 1e-4).regime, Regime::blocked);
  EXPECT_NE(verdictOf(still, 15.0, 1e-4).reason.find("0.1"), std::string::npos);
  EXPECT_EQ(verdictOf(piece, 15.0, 1e-4).regime, Regime::blocked);
  EXPECT_EQ(verdictOf(still, 0.3, 1e-4).regime, Regime::collisional);
  EXPECT_EQ(verdictOf(layer, 0.3, 0.01).regime, Regime::collisional);
  EXPECT_EQ(verdictOf(layer, 12.0, 0.27).regime, Regime::collisional);
}

TEST(Regime, WhatIsNotShownCannotBeTold) {
  EXPECT_FALSE(regimeOf({}).regime);
  RegimeFigures figures;
  figures.motion = WheelMotion{0.7, 0.3};
  EXPECT_FALSE(regimeOf(figures).regime) << "contacts are not known";
  figures.motion = WheelMotion{0.99, 0.01};
  EXPECT_EQ(regimeOf(figures).regime, Regime::blocked) << "standing still needs no contacts to see";
}

TEST(BlockedShare, CountsWindows) {
  std::vector<double> shear(40, 0.3);
  for (int t = 10; t < 20; ++t) shear[static_cast<std::size_t>(t)] = 0.01;
  EXPECT_EQ(blockedFraction(shear, 10), 0.25);
  // One fast jolt in an otherwise still window is a mean, not a sample.
  shear.assign(10, 0.0);
  shear[3] = 0.9;
  EXPECT_EQ(blockedFraction(shear, 10), 1.0);
  EXPECT_FALSE(blockedFraction(shear, 11));
  EXPECT_FALSE(blockedFraction({}, 0));
}

TEST(InertialNumber, ByHand) {
  // v_φ = 0.4 and 0.2 m/s in rings of 0.1 m: ∂v/∂r = −2, v/r = 0.3/1.1; p = 50, ρ = 200.
  Profile v{"slicing", "azimuthal_velocity", "m/s", {0.4, 0.2}, {}, {}, {}};
  Profile rr{"slicing", "stress_rr", "N/m²", {60.0, 0.0}, {}, {}, {}};
  Profile pp{"slicing", "stress_pp", "N/m²", {40.0, 0.0}, {}, {}, {}};
  const double rate = 2.0 + 0.3 / 1.1;
  EXPECT_NEAR(inertialNumber(cell(), std::vector{v, rr, pp}, 200.0).value(), rate * 0.1 * 2.0,
              1e-12);
  rr.mean[0] = -50.0;
  EXPECT_FALSE(inertialNumber(cell(), std::vector{v, rr, pp}, 200.0));
  EXPECT_FALSE(inertialNumber(cell(), std::vector{v}, 200.0));
}

TEST(ContactsOf, CountsThoseOfOneBody) {
  Instant instant;
  instant.addDisk({1.5, 0.0}, 0.25);
  instant.addDisk({2.0, 0.0}, 0.25);
  instant.scene.bodies.push_back({"wheel", Vec2::Zero(), {Vec2(1.15, 0.0)}, {0.1}, {}, {}});
  instant.scene.bodies.push_back(
      {"ring", Vec2::Zero(), {Vec2(2.35, 0.0), Vec2(-2.35, 0.0)}, {0.1, 0.1}, {}, {}});
  instant.addContact(0, 1, {-1.0, 0.0}, 7.0, 0.0);
  instant.addContact(0, 2, {1.0, 0.0}, 9.0, 0.0);
  instant.addContact(1, 3, {-1.0, 0.0}, 5.0, 1.0);
  instant.addContact(1, 4, {-1.0, 0.0}, 5.0, 1.0);
  EXPECT_EQ(contactsOf(instant.scene, instant.snapshot, "wheel"), 1.0);
  EXPECT_EQ(contactsOf(instant.scene, instant.snapshot, "ring"), 2.0);
  instant.addContact(0, 2, {1.0, 0.0}, 0.0, 0.0);  // listed, and transmits nothing
  EXPECT_EQ(contactsOf(instant.scene, instant.snapshot, "wheel"), 1.0);
  // A wheel that nobody knows the disks of touches an unknown number, not none.
  instant.scene.bodies.push_back({"axle", Vec2::Zero(), {}, {}, {}, {}});
  EXPECT_FALSE(contactsOf(instant.scene, instant.snapshot, "axle"));
  instant.snapshot.contacts.reset();
  EXPECT_FALSE(contactsOf(instant.scene, instant.snapshot, "wheel"));
}

}  // namespace
}  // namespace crossgrain

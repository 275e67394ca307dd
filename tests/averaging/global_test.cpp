#include "averaging/global.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <stdexcept>

#include "tests/averaging/scenes.hpp"

namespace crossgrain {
namespace {

using test::Instant;

using std::numbers::pi;

/// Two disks side by side between a wheel (wall disk 2) and a ring (wall disks 3 and 4, plane 5).
Instant cell() {
  Instant instant;
  instant.addDisk({1.5, 0.0}, 0.25, 2.0, {3.0, 4.0}, 2.0);
  instant.addDisk({2.0, 0.0}, 0.25, 1.0, {0.0, 1.0}, 0.0);
  instant.addWall("wheel", {Vec2(1.15, 0.0)}, 0.1);
  instant.addWall("ring", {Vec2(2.35, 0.0), Vec2(-2.35, 0.0)}, 0.1);
  instant.scene.bodies[1].planes = {Plane{Vec2(0.0, -3.0), Vec2(0.0, 1.0)}};
  instant.snapshot.bodies[0].torque = -0.6;
  instant.addContact(0, 1, {-1.0, 0.0}, 7.0, 0.0);
  instant.addContact(0, 2, {1.0, 0.0}, 9.0, 0.0);
  instant.addContact(1, 3, {-1.0, 0.0}, 5.0, 1.0);
  return instant;
}

TEST(GlobalNumbers, ByHand) {
  Instant instant = cell();
  instant.snapshot.contacts->overlap = {1e-7, 4e-7, 1e-7};
  const GlobalNumbers numbers = globalNumbers(instant.scene, instant.snapshot);
  // ½·2·25 + ½·(½·2·0.25²)·4 + ½·1·1
  EXPECT_NEAR(numbers.kineticEnergy, 25.0 + 0.125 + 0.5, 1e-14);
  EXPECT_EQ(numbers.coordination, 2.0);  // four ends on two disks
  EXPECT_EQ(numbers.maxOverlap, 4e-7);
  EXPECT_NEAR(numbers.meanOverlap.value(), 2e-7, 1e-20);
  EXPECT_FALSE(numbers.slidingFraction);
  instant.snapshot.contacts->sliding = {0, 1, 0};
  EXPECT_NEAR(globalNumbers(instant.scene, instant.snapshot).slidingFraction.value(), 1.0 / 3.0,
              1e-15);
}

/// One of the three pairs carries nothing: two ends on two disks are contacts, four are listed.
TEST(GlobalNumbers, ContactsAreThosePairsThatCarryAForce) {
  Instant instant = cell();
  Contacts& pairs = *instant.snapshot.contacts;
  pairs.overlap = {5e-7, 4e-7, 2e-7};
  pairs.normalForce[0] = 0.0;
  pairs.sliding = {1, 1, 0};
  const GlobalNumbers numbers = globalNumbers(instant.scene, instant.snapshot);
  EXPECT_EQ(numbers.coordination, 1.0);
  EXPECT_EQ(numbers.listedPairs, 2.0);
  EXPECT_NEAR(numbers.meanOverlap.value(), 3e-7, 1e-20);
  EXPECT_EQ(numbers.maxOverlap, 5e-7);
  EXPECT_EQ(numbers.slidingFraction, 0.5);
}

TEST(GlobalNumbers, WithoutDataAreAbsent) {
  Instant instant = cell();
  instant.snapshot.contacts = Contacts{};
  EXPECT_EQ(globalNumbers(instant.scene, instant.snapshot).coordination, 0.0);
  EXPECT_FALSE(globalNumbers(instant.scene, instant.snapshot).maxOverlap);
  instant.snapshot.contacts.reset();
  instant.snapshot.spin.reset();
  const GlobalNumbers numbers = globalNumbers(instant.scene, instant.snapshot);
  EXPECT_FALSE(numbers.coordination);
  EXPECT_NEAR(numbers.kineticEnergy, 25.5, 1e-14);
  instant.snapshot.velocity.pop_back();
  EXPECT_THROW(globalNumbers(instant.scene, instant.snapshot), std::invalid_argument);
}

TEST(RadialPressure, CountsContactByContact) {
  Instant instant = cell();
  const auto pressure = [&](const char* body, double radius) {
    return radialPressure(instant.scene, instant.snapshot, body, radius, 0.5);
  };
  EXPECT_NEAR(pressure("ring", 2.35).value(), 5.0 / (2.0 * pi * 2.35 * 0.5), 1e-14);
  EXPECT_NEAR(pressure("wheel", 1.15).value(), -9.0 / (2.0 * pi * 1.15 * 0.5), 1e-14);  // inward

  // A third disk pushes the far side with the same force: net force 0, pressure doubled. Its id
  // shifts the walls' ids by one.
  instant.addDisk({-2.0, 0.0}, 0.25);
  for (auto& j : instant.snapshot.contacts->j) j += j >= 2 ? 1 : 0;
  instant.addContact(2, 5, {1.0, 0.0}, 5.0, 0.0);
  EXPECT_NEAR(pressure("ring", 2.35).value(), 10.0 / (2.0 * pi * 2.35 * 0.5), 1e-14);
  // And one that presses on the ring's plane (id 6) from above.
  instant.addContact(2, 6, {0.0, 1.0}, 3.0, 0.0);
  instant.snapshot.position[2] = {0.0, -2.75};
  EXPECT_NEAR(pressure("ring", 2.35).value(),
              (5.0 + 3.0 + 5.0 * 0.25 / std::hypot(0.25, 2.75)) / (2.0 * pi * 2.35 * 0.5), 1e-14);
  instant.snapshot.contacts.reset();
  EXPECT_FALSE(pressure("ring", 2.35));
  EXPECT_THROW(pressure("lid", 1.0), std::invalid_argument);
}

TEST(ForceOnWall, OfAPlaneIsThatOfItsContacts_OfABodyWhatTheEngineReports) {
  Instant instant = cell();
  const std::size_t ring = instant.scene.bodies.size() - 1;
  const std::size_t planes = instant.scene.bodies[ring].planes.size();
  ASSERT_EQ(planes, 1u);
  instant.addContact(0, 5, {0.6, 0.8}, 5.0, 0.0);  // the plane's id, the last of all
  instant.snapshot.bodies[ring].force = Vec2(7.0, 8.0);
  const auto force = [&](std::optional<std::size_t> plane) {
    return forceOnWall(instant.scene, instant.snapshot, ring, plane).value();
  };
  EXPECT_EQ(force({}), Vec2(7.0, 8.0));  // the wall disks' too
  EXPECT_NEAR(force(0).x(), -3.0, 1e-14);
  EXPECT_NEAR(force(0).y(), -4.0, 1e-14);
  instant.snapshot.contacts.reset();
  EXPECT_FALSE(forceOnWall(instant.scene, instant.snapshot, ring, std::size_t{0}));
}

TEST(DrivingTorque, IsWhatTheWheelDoesToTheDisks) {
  const Instant instant = cell();
  EXPECT_EQ(drivingTorque(instant.scene, instant.snapshot, "wheel"), 0.6);
  EXPECT_FALSE(drivingTorque(instant.scene, instant.snapshot, "ring"));
}

TEST(ContactsOf, CountsThoseOfOneBodyThatCarryAForce) {
  Instant instant = cell();
  const auto contacts = [&](const char* body) {
    return contactsOf(instant.scene, instant.snapshot, body);
  };
  instant.addContact(1, 4, {-1.0, 0.0}, 5.0, 1.0);
  EXPECT_EQ(contacts("wheel"), 1.0);
  EXPECT_EQ(contacts("ring"), 2.0);
  instant.addContact(0, 2, {1.0, 0.0}, 0.0, 0.0);  // listed, and transmits nothing
  EXPECT_EQ(contacts("wheel"), 1.0);
  // A wheel of unknown disks touches an unknown number, not none.
  instant.scene.bodies.push_back({"axle", Vec2::Zero(), {}, {}, {}, {}});
  EXPECT_FALSE(contacts("axle"));
  instant.snapshot.contacts.reset();
  EXPECT_FALSE(contacts("wheel"));
}

}  // namespace
}  // namespace crossgrain

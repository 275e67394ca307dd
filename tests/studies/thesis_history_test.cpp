// What the history of a run says, for snapshots of one disk that can be added up by hand.
#include "studies/thesis/case_run.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "cases/couette.hpp"
#include "tests/studies/quick_cell.hpp"

namespace crossgrain::test {
namespace {

/// One disk in the quick cell, which settles for a rotation and a half and is averaged for one.
Case oneDisk() {
  return quickCell({"particles.small=1", "particles.large=0", "averaging.settle_rotations=1.5",
                    "averaging.rotations=1.0", "averaging.snapshots_per_rotation=2"});
}

class History : public testing::Test {
 protected:
  History() {
    Packing packing;
    packing.disks = diskKinds(couetteIn(setup_).particles);
    scene_ = couetteScene(setup_, packing, 4e-5);
  }

  /// The disk between R_i and the first ring's middle, at `speed` along φ.
  /// @param force  of a wheel's disk on it [N]; none: no contact  @param ring  of the ring's disk
  Snapshot at(double rotations, double speed, std::optional<double> force = {},
              std::optional<double> ring = {}) const {
    Snapshot now;
    now.positionTime = now.velocityTime = now.contactTime = rotations * rotationTime(setup_);
    now.position = {{radius_, 0.0}};
    now.velocity = {{0.0, speed}};
    now.spin = std::vector<double>{0.0};
    now.bodies.resize(2);
    now.bodies[0].torque = -2.0 * speed;  // on the wheel; it drives the disks with the opposite
    for (const WallBody& body : scene_.bodies)
      now.wallPosition.insert(now.wallPosition.end(), body.diskPosition.begin(),
                              body.diskPosition.end());
    Contacts contacts;
    const auto add = [&](std::size_t wall, double f, const Vec2& normal) {
      contacts.i.push_back(0);
      contacts.j.push_back(static_cast<std::int32_t>(1 + wall));
      contacts.normal.push_back(normal);
      contacts.overlap.push_back(f * 1e-3);
      contacts.normalForce.push_back(f);
      contacts.tangentialForce.push_back(0.0);
    };
    if (force) add(0, *force, {1.0, 0.0});
    if (ring) add(scene_.bodies[0].diskPosition.size(), *ring, {-1.0, 0.0});
    now.contacts = contacts;
    return now;
  }

  const Case setup_ = oneDisk();
  const double radius_ =
      couetteIn(setup_).cell.innerRadius + couetteIn(setup_).particles.smallRadius;
  Scene scene_;
};

TEST_F(History, Spans_AreRotationsFromTheAveragedTimeOn) {
  ThesisHistory history(setup_, scene_, 3);
  // A snapshot at the end of a span belongs to it.
  for (const double when : {0.5, 1.0, 1.5, 2.0, 2.5}) history.add(at(when, 1.0));
  const auto spans = history.spans();
  ASSERT_EQ(spans.size(), 3u);
  const double ends[][2] = {{0.0, 1.0}, {1.0, 1.5}, {1.5, 2.5}};
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(spans[k].from, ends[k][0]);
    EXPECT_EQ(spans[k].to, ends[k][1]);
  }
}

TEST_F(History, Numbers_AreMeansOfSnapshots) {
  ThesisHistory history(setup_, scene_, 3);
  history.add(at(0.5, 1.0, 4.0));
  history.add(at(1.0, 3.0, {}, 6.0));
  history.add(at(1.5, 5.0));
  const auto spans = history.spans();
  ASSERT_EQ(spans.size(), 2u);  // nothing was averaged
  const ThesisSpan& first = spans.front();
  const double mass = couetteIn(setup_).particles.smallMass;
  EXPECT_DOUBLE_EQ(*first.kineticEnergy, 0.5 * mass * (1.0 + 9.0) / 2.0);
  EXPECT_DOUBLE_EQ(*spans[1].kineticEnergy, 0.5 * mass * 25.0);
  EXPECT_DOUBLE_EQ(*first.wheelTorque, (2.0 + 6.0) / 2.0);
  EXPECT_EQ(*first.wheelContacts, 0.5);
  EXPECT_EQ(*first.wheelTouched, 0.5);
  EXPECT_EQ(*spans[1].wheelTouched, 0.0);
  EXPECT_EQ(*first.coordination, 1.0);
  EXPECT_EQ(*first.maxOverlap, 6e-3);  // the largest
  EXPECT_DOUBLE_EQ(*first.meanOverlap, 5e-3);
  EXPECT_FALSE(spans[1].maxOverlap);  // nothing touches: absent, not zero
  const Cell& cell = couetteIn(setup_).cell;
  const double mantle = 2.0 * std::numbers::pi * cell.outerRadius * cell.height;
  EXPECT_NEAR(*first.outerPressure, (0.0 + 6.0) / 2.0 / mantle, 1e-9 * 6.0 / mantle);
  EXPECT_NEAR(*first.velocityAtWheel, 2.0 / (cell.omega * cell.innerRadius), 1e-3);
  EXPECT_EQ(*first.volumeFractionOutside, 0.0);
}

TEST_F(History, RestoredState_GoesOnToTheBit) {
  ThesisHistory whole(setup_, scene_, 3), before(setup_, scene_, 3), after(setup_, scene_, 3);
  const auto first = {at(0.5, 0.1, 1.0 / 3.0), at(1.0, 0.7, 0.1)};
  const auto second = {at(1.5, 1.0 / 7.0), at(2.0, 0.3, 0.2), at(2.5, 0.9)};
  for (const Snapshot& snapshot : first) {
    whole.add(snapshot);
    before.add(snapshot);
  }
  after.restore(nlohmann::json::parse(before.state().dump()));
  for (const Snapshot& snapshot : second) {
    whole.add(snapshot);
    after.add(snapshot);
  }
  EXPECT_EQ(whole.state(), after.state());
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_EQ(whole.spans()[k].kineticEnergy, after.spans()[k].kineticEnergy);
}

}  // namespace
}  // namespace crossgrain::test

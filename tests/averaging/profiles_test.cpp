#include "averaging/profiles.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>

#include "averaging/statistics.hpp"
#include "tests/averaging/scenes.hpp"

namespace crossgrain {
namespace {

using test::Instant;
using test::twoRings;

const Profile& find(const std::vector<Profile>& profiles, const std::string& field) {
  for (const Profile& profile : profiles)
    if (profile.field == field) return profile;
  throw std::out_of_range(field);
}

TEST(Profiles, VelocityIsTheRatioOfTimeSums) {
  // Two disks of equal size. In one snapshot both are in ring 0 at 1 m/s, in the other only the
  // first is, at 4 m/s. Mean per disk and instant (1 + 1 + 4)/3 = 2, not the mean of momentary
  // means 2.5.
  Instant instant;
  instant.addDisk({1.5, 0.0}, 0.1, 1.0, {0.0, 1.0});
  instant.addDisk({0.0, 1.5}, 0.1, 1.0, {-1.0, 0.0});
  ProfileAccumulator accumulator(twoRings(), {WeightMethod::slicing}, instant.scene);
  accumulator.add(instant.snapshot);
  instant.snapshot.velocity[0] = {0.0, 4.0};
  instant.snapshot.position[1] = {0.0, 2.5};
  accumulator.add(instant.snapshot);
  const auto profiles = accumulator.profiles();
  EXPECT_NEAR(find(profiles, "azimuthal_velocity").mean[0].value(), 2.0, 1e-14);
  EXPECT_NEAR(find(profiles, "volume_fraction").mean[0].value(), 1.5 * 0.01 / 3.0, 1e-15);
  EXPECT_FALSE(find(profiles, "volume_fraction").standardError[0]);  // two snapshots give no bar
}

TEST(Profiles, BarsOfAPlainMeanAreThoseOfItsSeries) {
  Instant instant;
  instant.addDisk({1.5, 0.0}, 0.1, 2.0);
  ProfileAccumulator accumulator(twoRings(), {WeightMethod::slicing}, instant.scene);
  std::mt19937_64 generator(8);
  std::normal_distribution<double> normal;
  std::vector<double> velocity, dynamic;
  for (int t = 0; t < 300; ++t) {
    velocity.push_back(1.0 + 0.1 * normal(generator));
    dynamic.push_back(2.0 * velocity.back() * velocity.back() / (std::numbers::pi * 1.5));
    instant.snapshot.velocity[0] = {velocity.back(), 0.0};
    accumulator.add(instant.snapshot);
  }
  const auto profiles = accumulator.profiles();
  for (const auto& [name, series] :
       {std::pair{"dynamic_stress_rr", dynamic}, std::pair{"radial_velocity", velocity}}) {
    const MeanEstimate expected = estimateMean(series);
    const Profile& profile = find(profiles, name);
    EXPECT_NEAR(profile.mean[0].value(), expected.mean, 1e-12);
    EXPECT_NEAR(profile.standardError[0].value() / expected.standardError.value(), 1.0, 1e-9);
    EXPECT_NEAR(profile.nEff[0].value() / expected.nEff, 1.0, 1e-9);
  }
}

TEST(Profiles, BarsOfARatioAreHonest) {
  // A ring that holds one or two disks at random; the second disk is faster, so numerator and
  // denominator fluctuate together. True ratio: (1·1 + ½·3)/(1 + ½) = 5/3.
  int covered = 0;
  constexpr int repeats = 400;
  std::mt19937_64 generator(9);
  std::bernoulli_distribution inRing(0.5);
  for (int k = 0; k < repeats; ++k) {
    Instant instant;
    instant.addDisk({1.5, 0.0}, 0.1, 1.0, {1.0, 0.0});
    instant.addDisk({1.5, 0.0}, 0.1, 1.0, {3.0, 0.0});
    ProfileAccumulator accumulator(twoRings(), {WeightMethod::centre}, instant.scene);
    for (int t = 0; t < 100; ++t) {
      instant.snapshot.position[1] = {inRing(generator) ? 1.5 : 2.5, 0.0};
      accumulator.add(instant.snapshot);
    }
    const auto profiles = accumulator.profiles();
    const Profile& velocity = find(profiles, "radial_velocity");
    const double half =
        studentQuantile(0.95, velocity.dof[0].value()) * velocity.standardError[0].value();
    covered += std::abs(velocity.mean[0].value() - 5.0 / 3.0) < half;
  }
  // 95 % ± 3 binomial sd (1.1 %), and the upper side open: short white series get wide bars.
  EXPECT_GT(covered, 0.917 * repeats);
}

TEST(Profiles, AFieldWithoutDataIsAbsent) {
  Instant instant;
  instant.addDisk({1.5, 0.0}, 0.1);
  instant.snapshot.spin.reset();
  instant.snapshot.contacts.reset();
  ProfileAccumulator accumulator(twoRings(), {WeightMethod::slicing}, instant.scene);
  EXPECT_TRUE(accumulator.profiles().empty());
  accumulator.add(instant.snapshot);
  for (const Profile& profile : accumulator.profiles()) {
    EXPECT_EQ(fieldSpec(profile.field).needs, Needs::kinematics) << profile.field;
    const bool filling = profile.field == "volume_fraction" || profile.field == "density";
    EXPECT_EQ(profile.mean[1].has_value(), filling) << profile.field;
  }
}

/// Disks at 1.5 m and 2.5 m that turn 3 W into heat, the second beside a wall disk with 5 W more.
Instant warm() {
  Instant instant;
  instant.addDisk({1.5, 0.0}, 0.2);
  instant.addDisk({2.5, 0.0}, 0.2);
  instant.addWall("ring", {Vec2(2.9, 0.0)}, 0.1);
  instant.addContact(0, 1, {-1.0, 0.0}, 1.0, 0.0);
  instant.addContact(1, 2, {-1.0, 0.0}, 1.0, 0.0);
  instant.snapshot.contacts->dissipation = {3.0, 5.0};
  return instant;
}

TEST(Profiles, Dissipation_IsTheHeatOfEachDisksContactsOverTheVolume) {
  const Instant instant = warm();
  ProfileAccumulator accumulator(twoRings(), {WeightMethod::centre}, instant.scene);
  accumulator.add(instant.snapshot);
  const Profile field = find(accumulator.profiles(), "dissipation");
  // Half of 3 W; the other half and all 5 W. π (2² − 1²) · 0.5 m³ and π (3² − 2²) · 0.5 m³.
  EXPECT_NEAR(field.mean[0].value(), 1.5 / (1.5 * std::numbers::pi), 1e-15);
  EXPECT_NEAR(field.mean[1].value(), 6.5 / (2.5 * std::numbers::pi), 1e-15);
  EXPECT_EQ(field.unit, "W/m³");
  EXPECT_TRUE(fieldSpec("dissipation").perVolume);
}

TEST(Profiles, Dissipation_IsAbsentUnlessEverySnapshotWithContactsReportsIt) {
  const auto has = [](const ProfileAccumulator& accumulator) {
    return std::ranges::any_of(accumulator.profiles(),
                               [](const Profile& p) { return p.field == "dissipation"; });
  };
  const Instant reported = warm();
  Instant without = warm(), apart = warm();
  without.snapshot.contacts->dissipation.clear();
  apart.snapshot.contacts = Contacts{};
  ProfileAccumulator accumulator(twoRings(), {WeightMethod::centre}, reported.scene);
  accumulator.add(apart.snapshot);
  EXPECT_FALSE(has(accumulator));
  accumulator.add(reported.snapshot);
  accumulator.add(apart.snapshot);
  EXPECT_TRUE(has(accumulator));
  accumulator.add(without.snapshot);
  EXPECT_FALSE(has(accumulator));
}

TEST(Profiles, SnapshotsOfOneAverageMustHoldTheSame) {
  Instant instant;
  instant.addDisk({1.5, 0.0}, 0.1);
  ProfileAccumulator accumulator(twoRings(), {WeightMethod::slicing}, instant.scene);
  accumulator.add(instant.snapshot);
  instant.snapshot.contacts.reset();
  EXPECT_THROW(accumulator.add(instant.snapshot), std::invalid_argument);
  EXPECT_EQ(accumulator.snapshots(), 1u);
}

}  // namespace
}  // namespace crossgrain

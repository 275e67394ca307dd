#include "averaging/distributions.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "tests/averaging/scenes.hpp"

namespace crossgrain {
namespace {

using test::Instant;

const Distribution& find(const std::vector<Distribution>& all, const std::string& quantity,
                         std::optional<int> ring = {}) {
  const auto found = std::ranges::find_if(
      all, [&](const Distribution& d) { return d.quantity == quantity && d.ring == ring; });
  if (found == all.end()) throw std::runtime_error("no " + quantity);
  return *found;
}

/// The density at a value; of two axes at a pair.
double at(const Distribution& d, double x, std::optional<double> y = {}) {
  std::size_t cell = d.axes[0].slot(x) - 1;
  if (y) cell += (d.axes[1].slot(*y) - 1) * static_cast<std::size_t>(d.axes[0].count);
  return d.density[cell];
}

TEST(Bins, BelowInsideAndBeyond) {
  const Bins bins{-1.0, 0.5, 4};
  EXPECT_EQ(bins.high(), 1.0);
  EXPECT_EQ(bins.slot(-1.1), 0u);
  EXPECT_EQ(bins.slot(-1.0), 1u);
  EXPECT_EQ(bins.slot(0.2), 3u);
  EXPECT_EQ(bins.slot(1.0), 5u);
  EXPECT_EQ(bins.slot(1e300), 5u);
}

/// Rings 1 … 2, 2 … 3 with d = 0.5. Two disks in ring 0, one of them next to the wheel; one in ring
/// 1.
Instant threeDisks() {
  Instant instant;
  instant.addDisk({0.0, 1.2}, 0.1, 1.0, {-1.0, 0.2}, -2.0);  // v_φ = 1, v_r = 0.2
  instant.addDisk({1.8, 0.0}, 0.1, 1.0, {0.0, 0.0}, 0.0);
  instant.addDisk({0.0, -2.5}, 0.1, 1.0, {0.0, 9.0}, 1.0);  // v_r = −9: below all bins
  instant.addContact(0, 1, {1.0, 0.0}, 3.0, -0.2);
  instant.addContact(1, 2, {1.0, 0.0}, 1.0, 0.6);
  return instant;
}

TEST(Distributions, ByHand) {
  const Instant instant = threeDisks();
  // Velocities in units of 2, spins in units of 4.
  DistributionAccumulator sums(Rings(1.0, 3.0, 2, 1.0, 0.5), instant.scene, {2.0, 4.0});
  sums.add(instant.snapshot);
  const auto all = sums.distributions();
  const Distribution& radial = find(all, "radial_velocity", 0);
  EXPECT_NEAR(at(radial, 0.1), 0.5 / 0.04, 1e-12);  // half of the disks in a bin 0.04 wide
  EXPECT_NEAR(at(radial, 0.0), 0.5 / 0.04, 1e-12);
  EXPECT_EQ(radial.samples, 2.0);
  EXPECT_NEAR(radial.outside, 0.0, 1e-12);
  EXPECT_NEAR(find(all, "radial_velocity", 1).outside, 1.0, 1e-12);
  EXPECT_NEAR(at(find(all, "azimuthal_velocity", 0), 0.5), 0.5 / 0.04, 1e-12);
  EXPECT_NEAR(at(find(all, "spin", 1), 0.25), 1.0 / 0.06, 1e-12);
  // Only the disk at r = 1.2 is within one d of the wheel.
  const Distribution& joint = find(all, "azimuthal_velocity_and_spin");
  EXPECT_EQ(joint.samples, 1.0);
  EXPECT_NEAR(at(joint, 0.5, -0.5), 1.0 / (0.04 * 0.06), 1e-9);
  // Contacts per disk 1, 2, 1; forces 3 and 1 over their mean 2; 0.2 and 0.6 over 0.4.
  EXPECT_NEAR(at(find(all, "coordination"), 1.0), 2.0 / 3.0, 1e-12);
  EXPECT_NEAR(at(find(all, "normal_force"), 1.5), 0.5 / 0.2, 1e-12);
  EXPECT_NEAR(at(find(all, "normal_force"), 0.5), 0.5 / 0.2, 1e-12);
  EXPECT_NEAR(at(find(all, "tangential_force"), 1.5001), 0.5 / 0.2, 1e-12);
}

TEST(Distributions, DirectionsOfContactsAreOutwardAndTurnedWithTheDisk) {
  const Instant instant = threeDisks();
  DistributionAccumulator sums(Rings(1.0, 3.0, 2, 1.0, 0.5), instant.scene, {2.0, 4.0});
  sums.add(instant.snapshot);
  const auto all = sums.distributions();
  using std::numbers::pi;
  const double bin = pi / 18.0;
  // Normals point from j to i along +x. Disk 0 at (0, 1.2) has its contact at −x, which is +φ
  // there; disk 1 at (1.8, 0) one at +x = r and, being i of the other, one at −x: π, counted as −π.
  // Disk 2 at (0, −2.5) has it at +x = φ.
  const Distribution& inner = find(all, "contact_direction", 0);
  EXPECT_EQ(inner.samples, 3.0);
  EXPECT_EQ(inner.outside, 0.0);
  for (const double angle : {0.5 * pi, 0.0})
    EXPECT_NEAR(at(inner, angle + 0.5 * bin), 1.0 / (3.0 * bin), 1e-12) << angle;
  EXPECT_NEAR(inner.density.front() + inner.density.back(), 1.0 / (3.0 * bin), 1e-12);
  EXPECT_NEAR(at(find(all, "contact_direction", 1), 0.5 * pi + 0.5 * bin), 1.0 / bin, 1e-12);
}

TEST(Distributions, WhatIsNotThereIsAbsent) {
  Instant instant = threeDisks();
  instant.snapshot.spin.reset();
  instant.snapshot.contacts.reset();
  DistributionAccumulator sums(Rings(1.0, 3.0, 2, 1.0, 0.5), instant.scene, {2.0, 4.0});
  EXPECT_TRUE(sums.distributions().empty());
  sums.add(instant.snapshot);
  for (const Distribution& d : sums.distributions())
    EXPECT_TRUE(d.quantity == "radial_velocity" || d.quantity == "azimuthal_velocity")
        << d.quantity;
}

TEST(BlockedCounts, ErrorsOfIndependentCountsAreBinomial) {
  // 5000 snapshots of 4 events that fall into slot 1 with probability 0.3: √(p(1 − p)/20000).
  std::mt19937_64 generator(18);
  std::bernoulli_distribution hit(0.3);
  double square = 0.0, mean = 0.0;
  constexpr int repeats = 200;
  for (int repeat = 0; repeat < repeats; ++repeat) {
    BlockedCounts counts(2);
    for (int snapshot = 0; snapshot < 5000; ++snapshot) {
      for (int k = 0; k < 4; ++k) counts.count(hit(generator));
      counts.endSnapshot();
    }
    const auto fractions = counts.fractions();
    EXPECT_EQ(fractions.total, 20000.0);
    mean += fractions.mean[1] / repeats;
    square += fractions.standardError[1] * fractions.standardError[1] / repeats;
  }
  EXPECT_NEAR(mean, 0.3, 0.001);
  // About 19 blocks a time: the mean square of 200 scatters by 2.4 %.
  EXPECT_NEAR(std::sqrt(square), std::sqrt(0.21 / 20000.0), 0.05 * std::sqrt(0.21 / 20000.0));
}

}  // namespace
}  // namespace crossgrain

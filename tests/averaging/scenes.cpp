#include "tests/averaging/scenes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <random>

#include "tests/support/scenes.hpp"

namespace crossgrain::test {

Rings thesisRings(int count) {
  return {0.1032, 0.2524, count, 0.006, 0.0074};
}

Rings twoRings() {
  return {1.0, 3.0, 2, 0.5, 0.2};
}

Instant::Instant() {
  scene.name = "instant";
  snapshot.spin.emplace();
  snapshot.contacts.emplace();
}

void Instant::addDisk(const Vec2& position, double radius, double mass, const Vec2& velocity,
                      double spin) {
  test::addDisk(scene, radius, mass, position, velocity, spin);
  snapshot.position.push_back(position);
  snapshot.velocity.push_back(velocity);
  snapshot.spin->push_back(spin);
}

void Instant::addWall(const std::string& name, const std::vector<Vec2>& places, double radius) {
  WallBody body{.name = name, .diskPosition = places};
  body.diskRadius.assign(places.size(), radius);
  scene.bodies.push_back(body);
  snapshot.bodies.emplace_back();
  snapshot.wallPosition.insert(snapshot.wallPosition.end(), places.begin(), places.end());
}

void Instant::addContact(std::int32_t i, std::int32_t j, const Vec2& normal, double normalForce,
                         double tangentialForce) {
  snapshot.contacts->i.push_back(i);
  snapshot.contacts->j.push_back(j);
  snapshot.contacts->normal.push_back(normal);
  snapshot.contacts->overlap.push_back(1e-7);
  snapshot.contacts->normalForce.push_back(normalForce);
  snapshot.contacts->tangentialForce.push_back(tangentialForce);
}

Instant randomInstant(std::uint64_t seed, int disks) {
  std::mt19937_64 generator(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::normal_distribution<double> normal;
  Instant instant;
  instant.scene.law.kn = thesis.kn;
  instant.scene.law.kt = thesis.kt;
  for (int p = 0; p < disks; ++p) {
    const double r = 0.095 + 0.165 * unit(generator);
    const double angle = 2.0 * std::numbers::pi * unit(generator);
    const bool large = unit(generator) < 0.15;
    instant.addDisk(r * Vec2(std::cos(angle), std::sin(angle)), large ? largeRadius : smallRadius,
                    large ? largeMass : smallMass, 0.1 * Vec2(normal(generator), normal(generator)),
                    normal(generator));
  }
  instant.addWall("wheel", {Vec2(0.1032, 0.0), Vec2(-0.1032, 0.0)}, wallRadius);
  std::uniform_int_distribution<std::int32_t> anyDisk(0, disks - 1);
  for (int c = 0; c < disks; ++c) {
    const std::int32_t i = anyDisk(generator);
    const std::int32_t j = c % 10 == 0 ? disks + c / 10 % 2 : anyDisk(generator);
    const double angle = 2.0 * std::numbers::pi * unit(generator);
    if (i != j)
      instant.addContact(std::min(i, j), std::max(i, j), Vec2(std::cos(angle), std::sin(angle)),
                         1e-4 * unit(generator), 4e-5 * normal(generator));
  }
  return instant;
}

Instant lattice(double a, const Vec2& e1, const Vec2& e2, const std::vector<Bond>& bonds) {
  constexpr int reach = 80;
  Instant instant;
  std::vector<std::int32_t> index(4 * reach * reach, -1);
  const auto slot = [&](int m, int n) {
    return static_cast<std::size_t>((m + reach) * 2 * reach + n + reach);
  };
  for (int m = -reach; m < reach; ++m)
    for (int n = -reach; n < reach; ++n) {
      const Vec2 x = m * e1 + n * e2;
      if (x.norm() > 0.28) continue;
      index[slot(m, n)] = static_cast<std::int32_t>(instant.scene.disks.size());
      instant.addDisk(x, a);
    }
  for (int m = -reach + 1; m < reach - 1; ++m)
    for (int n = -reach + 1; n < reach - 1; ++n)
      for (const Bond& bond : bonds) {
        const std::int32_t here = index[slot(m, n)];
        const std::int32_t there = index[slot(m + bond.m, n + bond.n)];
        if (here < 0 || there < 0) continue;
        const Vec2 outward = (bond.m * e1 + bond.n * e2).normalized();
        const bool first = here < there;
        instant.addContact(first ? here : there, first ? there : here,
                           first ? Vec2(-outward) : outward, bond.force, 0.0);
      }
  return instant;
}

Instant triangularLattice(double a, double force) {
  return lattice(a, {2.0 * a, 0.0}, {a, std::sqrt(3.0) * a},
                 {{1, 0, force}, {0, 1, force}, {-1, 1, force}});
}

std::vector<Moments> momentsOf(const Coordinates& coordinates, const Instant& instant,
                               Weight weight, bool countWallDisks) {
  // The sums keep what they share; here the caller's coordinates outlive them.
  const std::shared_ptr<const Coordinates> borrowed(&coordinates, [](const Coordinates*) {});
  std::vector<std::vector<Moments>> sums;
  MomentSums(borrowed, {weight}, instant.scene, countWallDisks).compute(instant.snapshot, sums);
  return sums[0];
}

double fieldIn(std::size_t slot, const char* field, const Coordinates& coordinates,
               const std::vector<Moments>& moments, SpringConstants springs) {
  const auto value = evaluate(fieldSpec(field), BinView(coordinates, moments, slot, springs));
  EXPECT_TRUE(value.has_value()) << field;
  return value ? value->value : std::nan("");
}

double valueOf(const char* field, const Rings& rings, const std::vector<Moments>& moments, int ring,
               SpringConstants springs) {
  return fieldIn(rings.slot(ring), field, rings, moments, springs);
}

double total(const std::vector<Moments>& moments, Moment which, int k) {
  double sum = 0.0;
  for (const Moments& bin : moments) sum += at(bin, which, k);
  return sum;
}

}  // namespace crossgrain::test

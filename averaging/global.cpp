#include "averaging/global.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "averaging/contact_rule.hpp"

namespace crossgrain::inline averaging {

namespace {

std::size_t bodyIndex(const Scene& scene, std::string_view name) {
  const auto found = std::ranges::find(scene.bodies, name, &WallBody::name);
  if (found == scene.bodies.end())
    throw std::invalid_argument(
        fmt::format("averaging: scene \"{}\" has no body \"{}\"", scene.name, name));
  return static_cast<std::size_t>(found - scene.bodies.begin());
}

const BodySnapshot& bodyState(const Snapshot& snapshot, std::size_t index) {
  if (index >= snapshot.bodies.size())
    throw std::invalid_argument(
        fmt::format("averaging: the snapshot has {} bodies, number {} is asked for",
                    snapshot.bodies.size(), index));
  return snapshot.bodies[index];
}

/// Which ids belong to a body: first its disks, and after all bodies' disks its planes.
struct BodyIds {
  std::size_t firstDisk, endDisk, firstPlane, endPlane;

  bool contain(std::size_t id) const {
    return (id >= firstDisk && id < endDisk) || (id >= firstPlane && id < endPlane);
  }
};

BodyIds idsOf(const Scene& scene, std::size_t index) {
  BodyIds ids{};
  ids.firstDisk = scene.disks.size();
  ids.firstPlane = scene.disks.size() + scene.wallDiskCount();
  for (std::size_t b = 0; b < index; ++b) {
    ids.firstDisk += scene.bodies[b].diskRadius.size();
    ids.firstPlane += scene.bodies[b].planes.size();
  }
  ids.endDisk = ids.firstDisk + scene.bodies[index].diskRadius.size();
  ids.endPlane = ids.firstPlane + scene.bodies[index].planes.size();
  return ids;
}

double kineticEnergy(const Disks& disks, const Snapshot& snapshot) {
  double energy = 0.0;
  for (std::size_t p = 0; p < disks.size(); ++p) {
    energy += 0.5 * disks.mass[p] * snapshot.velocity[p].squaredNorm();
    if (snapshot.spin) energy += 0.5 * disks.inertia[p] * (*snapshot.spin)[p] * (*snapshot.spin)[p];
  }
  return energy;
}

/// How many of two disks a pair joins.
std::size_t ends(const Contacts& pairs, std::size_t k, std::size_t disks) {
  return static_cast<std::size_t>(pairs.j[k]) < disks ? 2 : 1;
}

void addContactNumbers(const Contacts& pairs, std::size_t disks, GlobalNumbers& numbers) {
  std::size_t listed = 0, carrying = 0, contacts = 0, sliding = 0;
  double overlaps = 0.0;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    listed += ends(pairs, k, disks);
    if (!transmits(pairs, k)) continue;
    carrying += ends(pairs, k, disks);
    overlaps += pairs.overlap[k];
    if (!pairs.sliding.empty() && pairs.sliding[k] == 1) ++sliding;
    ++contacts;
  }
  if (disks > 0) {
    numbers.coordination = static_cast<double>(carrying) / static_cast<double>(disks);
    numbers.listedPairs = static_cast<double>(listed) / static_cast<double>(disks);
  }
  if (pairs.size() > 0) numbers.maxOverlap = std::ranges::max(pairs.overlap);
  if (contacts == 0) return;
  const auto count = static_cast<double>(contacts);
  numbers.meanOverlap = overlaps / count;
  if (!pairs.sliding.empty()) numbers.slidingFraction = static_cast<double>(sliding) / count;
}

}  // namespace

GlobalNumbers globalNumbers(const Scene& scene, const Snapshot& snapshot) {
  const std::size_t disks = scene.disks.size();
  if (snapshot.velocity.size() != disks || (snapshot.spin && snapshot.spin->size() != disks))
    throw std::invalid_argument(
        fmt::format("averaging: the snapshot has {} velocities, the scene has {} disks",
                    snapshot.velocity.size(), disks));
  GlobalNumbers numbers;
  numbers.kineticEnergy = kineticEnergy(scene.disks, snapshot);
  if (snapshot.contacts) addContactNumbers(*snapshot.contacts, disks, numbers);
  return numbers;
}

std::optional<double> contactsOf(const Scene& scene, const Snapshot& snapshot,
                                 std::string_view body) {
  const BodyIds ids = idsOf(scene, bodyIndex(scene, body));
  const bool nothing = ids.firstDisk == ids.endDisk && ids.firstPlane == ids.endPlane;
  if (!snapshot.contacts || nothing) return std::nullopt;
  const Contacts& pairs = *snapshot.contacts;
  double count = 0.0;
  for (std::size_t c = 0; c < pairs.size(); ++c)
    count += ids.contain(static_cast<std::size_t>(pairs.j[c])) && transmits(pairs, c);
  return count;
}

std::optional<double> radialPressure(const Scene& scene, const Snapshot& snapshot,
                                     std::string_view body, double radius, double height) {
  const std::size_t index = bodyIndex(scene, body);
  const BodyIds ids = idsOf(scene, index);
  const Vec2 centre = bodyState(snapshot, index).centre;
  if (!snapshot.contacts) return std::nullopt;
  const Contacts& contacts = *snapshot.contacts;
  double force = 0.0;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    if (!ids.contain(static_cast<std::size_t>(contacts.j[c]))) continue;
    const auto i = static_cast<std::size_t>(contacts.i[c]);
    const Vec2& n = contacts.normal[c];
    const Vec2 outward =
        (snapshot.position.at(i) - scene.disks.radius.at(i) * n - centre).normalized();
    force -= contacts.force(c).dot(outward);
  }
  return force / (2.0 * std::numbers::pi * radius * height);
}

std::optional<double> drivingTorque(const Scene& scene, const Snapshot& snapshot,
                                    std::string_view body) {
  const BodySnapshot& state = bodyState(snapshot, bodyIndex(scene, body));
  if (!state.torque) return std::nullopt;
  return -*state.torque;
}

}  // namespace crossgrain::inline averaging

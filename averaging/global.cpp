#include "averaging/global.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
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

/// Which ids belong to a body: its disks, after all bodies' disks its planes, then its cylinders.
struct BodyIds {
  struct Range {
    std::size_t first, end;
  };
  std::array<Range, 3> ranges;

  bool contain(std::size_t id) const {
    return std::ranges::any_of(ranges, [&](const Range& r) { return id >= r.first && id < r.end; });
  }
};

template <int D>
BodyIds idsOf(const SceneOf<D>& scene, std::size_t index) {
  BodyIds ids{};
  std::size_t next = scene.disks.size();
  const auto count = [&](BodyIds::Range& range, auto WallBodyOf<D>::*members) {
    for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
      const std::size_t size = (scene.bodies[b].*members).size();
      if (b == index) range = {next, next + size};
      next += size;
    }
  };
  count(ids.ranges[0], &WallBodyOf<D>::diskRadius);
  count(ids.ranges[1], &WallBodyOf<D>::planes);
  count(ids.ranges[2], &WallBodyOf<D>::cylinders);
  return ids;
}

template <int D>
double kineticEnergy(const DisksOf<D>& disks, const SnapshotOf<D>& snapshot) {
  double energy = 0.0;
  for (std::size_t p = 0; p < disks.size(); ++p) {
    energy += 0.5 * disks.mass[p] * snapshot.velocity[p].squaredNorm();
    if (!snapshot.spin) continue;
    const SpinOf<D>& spin = (*snapshot.spin)[p];
    if constexpr (D == 2)
      energy += 0.5 * disks.inertia[p] * spin * spin;
    else
      energy += spinEnergy(disks, p, spin, turnIn(snapshot, p));
  }
  return energy;
}

/// How many of two disks a pair joins.
template <int D>
std::size_t ends(const ContactsOf<D>& pairs, std::size_t k, std::size_t disks) {
  return static_cast<std::size_t>(pairs.j[k]) < disks ? 2 : 1;
}

template <int D>
void addContactNumbers(const ContactsOf<D>& pairs, std::size_t disks, GlobalNumbers& numbers) {
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

/// The lowest and the highest body of a cell between two walls, and the direction between them.
struct TwoWalls {
  int across;
  std::size_t low, high;
};

template <int D>
std::optional<TwoWalls> twoWalls(const SceneOf<D>& scene) {
  if (!scene.box || std::ranges::count(scene.box->periodic, false) != 1) return std::nullopt;
  TwoWalls walls{};
  walls.across =
      static_cast<int>(std::ranges::find(scene.box->periodic, false) - scene.box->periodic.begin());
  std::optional<double> lowest, highest;
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const auto& body = scene.bodies[b];
    double sum = 0.0;
    for (const auto& place : body.diskPosition) sum += place[walls.across];
    for (const auto& plane : body.planes) sum += plane.point[walls.across];
    const auto members = static_cast<double>(body.diskPosition.size() + body.planes.size());
    if (members == 0.0) continue;
    const double place = sum / members;
    if (!lowest || place < *lowest) lowest = place, walls.low = b;
    if (!highest || place > *highest) highest = place, walls.high = b;
  }
  if (!lowest || walls.low == walls.high) return std::nullopt;
  return walls;
}

}  // namespace

template <int D>
std::optional<VecOf<D>> forceOnWall(const SceneOf<D>& scene, const SnapshotOf<D>& snapshot,
                                    std::size_t body, std::optional<std::size_t> plane) {
  BodyIds ids = idsOf(scene, body);
  std::size_t members = 0;
  for (const BodyIds::Range& range : ids.ranges) members += range.end - range.first;
  if (body < snapshot.bodies.size() && snapshot.bodies[body].force && (!plane || members == 1))
    return snapshot.bodies[body].force;
  if (!snapshot.contacts) return std::nullopt;
  if (plane) {
    const std::size_t first = ids.ranges[1].first + *plane;
    ids = {};
    ids.ranges[1] = {first, first + 1};
  }
  VecOf<D> force = VecOf<D>::Zero();
  for (std::size_t c = 0; c < snapshot.contacts->size(); ++c)
    if (ids.contain(static_cast<std::size_t>(snapshot.contacts->j[c])))
      force -= snapshot.contacts->force(c);
  return force;
}
template std::optional<Vec2> forceOnWall(const Scene&, const Snapshot&, std::size_t,
                                         std::optional<std::size_t>);
template std::optional<Vec3> forceOnWall(const SpaceScene&, const SpaceSnapshot&, std::size_t,
                                         std::optional<std::size_t>);

template <int D>
bool hasTwoWalls(const SceneOf<D>& scene) {
  return twoWalls(scene).has_value();
}
template bool hasTwoWalls(const Scene&);
template bool hasTwoWalls(const SpaceScene&);

template <int D>
std::optional<WallStresses> wallStresses(const SceneOf<D>& scene, const SnapshotOf<D>& snapshot,
                                         double height) {
  const auto walls = twoWalls(scene);
  if (!walls) return std::nullopt;
  const auto low = forceOnWall(scene, snapshot, walls->low);
  const auto high = forceOnWall(scene, snapshot, walls->high);
  if (!low || !high) return std::nullopt;
  VecOf<D> sides = scene.box->high - scene.box->low;
  sides[walls->across] = D == 2 ? height : 1.0;
  const VecOf<D> half = (*high - *low) / (2.0 * sides.prod());
  return WallStresses{half[walls->across], -half[walls->across == 0 ? 1 : 0]};
}
template std::optional<WallStresses> wallStresses(const Scene&, const Snapshot&, double);
template std::optional<WallStresses> wallStresses(const SpaceScene&, const SpaceSnapshot&, double);

template <int D>
GlobalNumbers globalNumbers(const SceneOf<D>& scene, const SnapshotOf<D>& snapshot) {
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
template GlobalNumbers globalNumbers(const Scene&, const Snapshot&);
template GlobalNumbers globalNumbers(const SpaceScene&, const SpaceSnapshot&);

std::optional<double> contactsOf(const Scene& scene, const Snapshot& snapshot,
                                 std::string_view body) {
  const BodyIds ids = idsOf(scene, bodyIndex(scene, body));
  const bool nothing = std::ranges::all_of(
      ids.ranges, [](const BodyIds::Range& range) { return range.first == range.end; });
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

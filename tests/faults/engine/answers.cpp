#include "answers.hpp"

#include <algorithm>
#include <map>
#include <numeric>

namespace crossgrain::planted {
namespace {

using crossgrain_worker::turned;

std::vector<double> flat(const std::vector<Vector>& list, std::size_t begin, std::size_t end) {
  std::vector<double> numbers;
  for (std::size_t k = begin; k < end; ++k) numbers.insert(numbers.end(), {list[k].x, list[k].y});
  return numbers;
}

/// By which number each disk is shown: its own, or of each kind in the opposite order.
std::vector<std::size_t> shownNumbers(const World& world, const Faults& faults) {
  std::vector<std::size_t> number(world.radius.size() + 4096);
  std::iota(number.begin(), number.end(), 0);
  if (faults.showRenumbered == 0.0) return number;
  std::map<double, std::vector<std::size_t>> kinds;
  for (std::size_t i = 0; i < world.disks; ++i) kinds[world.radius[i]].push_back(i);
  for (const auto& [radius, members] : kinds)
    for (std::size_t k = 0; k < members.size(); ++k)
      number[members[k]] = members[members.size() - 1 - k];
  return number;
}

}  // namespace

Loads loadsOf(const Simulation& simulation) {
  return {simulation.contacts(), simulation.forceOnBodies(), simulation.torqueOnBodies()};
}

void addDisks(ArrayFile& arrays, const Simulation& simulation, const Faults& faults) {
  const World& world = simulation.world();
  const std::vector<std::size_t> number = shownNumbers(world, faults);
  std::vector<Vector> position(world.disks), velocity(world.disks);
  std::vector<double> spin(world.disks);
  for (std::size_t i = 0; i < world.disks; ++i) {
    const std::size_t k = number[i];
    velocity[k] = simulation.velocity(i);
    position[k] = world.position[i] - faults.showEarlier * velocity[k];
    spin[k] = faults.showSpin * simulation.spin(i);
    if (faults.showFloat != 0.0)
      position[k] = {static_cast<float>(position[k].x), static_cast<float>(position[k].y)};
  }
  if (faults.showSwappedPlaces != 0.0 && world.disks > 1) std::swap(position[0], position[1]);
  arrays.add("wall_position", flat(world.position, world.disks, world.position.size()));
  arrays.add("position", flat(position, 0, world.disks));
  arrays.add("velocity", flat(velocity, 0, world.disks));
  if (world.law.friction) arrays.add("spin", spin);
}

void addContacts(ArrayFile& arrays, const Simulation& simulation, const Loads& loads,
                 const Faults& faults) {
  const World& world = simulation.world();
  const std::vector<std::size_t> number = shownNumbers(world, faults);
  std::vector<std::int32_t> i, j;
  std::vector<double> normal, overlap, fn, ft;
  std::vector<std::uint8_t> sliding;
  unsigned long long count = 0;
  for (const Contact& c : loads.contacts) {
    if (everyNth(faults.showDropEvery, ++count)) continue;
    auto one = static_cast<std::int32_t>(number[static_cast<std::size_t>(c.i)]);
    auto other = static_cast<std::int32_t>(number[static_cast<std::size_t>(c.j)]);
    const bool wall = static_cast<std::size_t>(c.j) >= world.disks;
    Vector n = c.normal;
    if (other < one) {
      std::swap(one, other);
      n = -1.0 * n;
    }
    if (wall && faults.showFlippedWalls == static_cast<double>(c.i + 1)) n = -1.0 * n;
    i.push_back(one);
    j.push_back(other);
    normal.insert(normal.end(), {n.x, n.y});
    overlap.push_back(c.overlap);
    fn.push_back(faults.showElastic != 0.0 ? c.elastic : c.fn);
    ft.push_back(c.ft);
    sliding.push_back(c.sliding && faults.showSlidingAsSticking == 0.0);
  }
  arrays.add("contacts.i", i);
  arrays.add("contacts.j", j);
  arrays.add("contacts.normal", normal);
  arrays.add("contacts.overlap", overlap);
  arrays.add("contacts.normal_force", fn);
  arrays.add("contacts.tangential_force", ft);
  arrays.add("contacts.sliding", sliding);
}

Json bodiesOf(const Simulation& simulation, const Loads& loads, const Faults& faults) {
  Json list = Json::array();
  for (std::size_t b = 0; b < loads.force.size(); ++b) {
    const Body& body = simulation.world().bodies[b];
    const Vector force = loads.force[b];
    const double more =
        faults.showTorqueAboutOrigin != 0.0 ? crossgrain_worker::cross(body.centre, force) : 0.0;
    list.push_back({{"centre", {body.centre.x, body.centre.y}},
                    {"angle", body.angle},
                    {"velocity", {body.velocity.x, body.velocity.y}},
                    {"angular_velocity", body.spin},
                    {"force", {faults.showWallForce * force.x, faults.showWallForce * force.y}},
                    {"torque", loads.torque[b] + more}});
  }
  return list;
}

}  // namespace crossgrain::planted

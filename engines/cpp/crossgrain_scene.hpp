#pragma once

// Disks, walls and contacts as the protocol has them, for engines in C++17.

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "crossgrain_walls.hpp"
#include "crossgrain_worker.hpp"

namespace crossgrain_worker {

struct Disk {
  double radius, mass, inertia;  ///< [m], [kg], [kg m²]; inertia INFINITY: its spin stays
  Vector position, velocity;     ///< [m], [m/s]
  double spin;                   ///< [rad/s]
};

/// The vectors of an array.
inline std::vector<Vector> vectorsOf(const std::vector<double>& numbers) {
  std::vector<Vector> list;
  for (std::size_t k = 0; k + 1 < numbers.size(); k += 2)
    list.push_back({numbers[k], numbers[k + 1]});
  return list;
}

inline std::vector<Disk> disksOf(const Arrays& arrays) {
  const std::vector<Vector> position = vectorsOf(arrays.at("disks.position")),
                            velocity = vectorsOf(arrays.at("disks.velocity"));
  std::vector<Disk> disks;
  for (std::size_t i = 0; i < position.size(); ++i)
    disks.push_back({arrays.at("disks.radius")[i], arrays.at("disks.mass")[i],
                     arrays.at("disks.inertia")[i], position[i], velocity[i],
                     arrays.at("disks.spin")[i]});
  return disks;
}

inline std::vector<Body> bodiesOf(const Json& scene, const Arrays& arrays) {
  std::vector<Body> bodies;
  for (const Json& body : scene.at("bodies")) {
    const std::string name = "bodies." + std::to_string(bodies.size()) + ".disk_";
    bodies.emplace_back(body, arrays.at(name + "position"), arrays.at(name + "radius"));
  }
  return bodies;
}

/// Ids of walls: which body each wall disk and plane belongs to. Disks come first, then wall disks,
/// then planes.
class WallIds {
 public:
  WallIds(std::size_t disks, const std::vector<Body>& bodies) : disks_(disks) {
    for (std::size_t b = 0; b < bodies.size(); ++b)
      for (std::size_t k = 0; k < bodies[b].radius.size(); ++k) owner_.push_back({b, k});
    planes_ = disks_ + owner_.size();
    for (std::size_t b = 0; b < bodies.size(); ++b)
      for (std::size_t p = 0; p < bodies[b].planes.size(); ++p) owner_.push_back({b, p});
  }

  bool isWall(std::size_t id) const { return id >= disks_; }
  bool isPlane(std::size_t id) const { return id >= planes_; }
  std::size_t body(std::size_t wall) const { return owner_[wall - disks_].first; }
  /// Number of a wall disk, or of a plane, in its body.
  std::size_t part(std::size_t wall) const { return owner_[wall - disks_].second; }

 private:
  std::size_t disks_, planes_;
  std::vector<std::pair<std::size_t, std::size_t>> owner_;
};

/// Contacts of a snapshot, one after the other: the arrays that all of them have.
class ContactColumns {
 public:
  /// @param normal  from j to i  @param overlap  [m]
  /// @param fn, ft  on i along the normal and along z × normal [N]
  void add(std::int32_t i, std::int32_t j, Vector normal, double overlap, double fn, double ft) {
    i_.push_back(i);
    j_.push_back(j);
    append(normal_, normal);
    overlap_.push_back(overlap);
    fn_.push_back(fn);
    ft_.push_back(ft);
  }

  void writeTo(ArrayFile& arrays) const {
    arrays.add("contacts.i", i_);
    arrays.add("contacts.j", j_);
    arrays.add("contacts.normal", normal_);
    arrays.add("contacts.overlap", overlap_);
    arrays.add("contacts.normal_force", fn_);
    arrays.add("contacts.tangential_force", ft_);
  }

 private:
  std::vector<std::int32_t> i_, j_;
  std::vector<double> normal_, overlap_, fn_, ft_;
};

}  // namespace crossgrain_worker

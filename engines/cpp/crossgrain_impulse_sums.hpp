#pragma once

// Impulses summed over steps, and the mean forces that a snapshot shows of them.

#include <map>
#include <utility>

#include "crossgrain_impulse_space.hpp"
#include "crossgrain_worker.hpp"

namespace crossgrain_worker {

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

/// n from the second to the first, and how deep they overlap [m].
struct Geometry {
  Vector normal;
  double overlap;
};

/// Impulses since some step, and what walls got of them.
struct ImpulseSums {
  struct Impulse {
    double pressing = 0.0, along = 0.0,
           rolling = 0.0;  ///< as PairImpulse's; normals turn meanwhile
  };
  std::map<std::pair<std::int32_t, std::int32_t>, Impulse> onFirst;
  std::vector<Vector> onBody;
  std::vector<double> torqueOnBody;  ///< about the body's centre [N m s]
  long long steps = 0;

  void clear(std::size_t bodies) {
    onFirst.clear();
    onBody.assign(bodies, {});
    torqueOnBody.assign(bodies, 0.0);
    steps = 0;
  }

  void add(const PairImpulse& impulse, const WallIds& ids, const std::vector<Body>& bodies) {
    Impulse& sum = onFirst[{impulse.i, impulse.j}];
    sum.pressing += impulse.pressing;
    sum.along += impulse.along;
    sum.rolling += impulse.rolling;
    const auto j = static_cast<std::size_t>(impulse.j);
    if (!ids.isWall(j)) return;
    const std::size_t b = ids.body(j);
    const Vector on = -1.0 * impulse.onFirst();
    onBody[b] = onBody[b] + on;
    torqueOnBody[b] += cross(impulse.place - bodies[b].centre, on) - impulse.rolling;
  }
};

inline void append(std::vector<double>& numbers, Vector v) {
  numbers.insert(numbers.end(), {v.x, v.y});
}

/// Mean forces over an interval [s].
/// @param rolls  whether anything resists rolling
/// @param geometry  of two ids as they are now
template <typename GeometryOf>
void addContacts(ArrayFile& arrays, const ImpulseSums& sums, double interval, bool rolls,
                 const GeometryOf& geometry) {
  std::vector<std::int32_t> i, j;
  std::vector<double> normal, overlap, fn, ft, rolling;
  for (const auto& [pair, impulse] : sums.onFirst) {
    const Geometry between =
        geometry(static_cast<std::size_t>(pair.first), static_cast<std::size_t>(pair.second));
    i.push_back(pair.first);
    j.push_back(pair.second);
    append(normal, between.normal);
    overlap.push_back(between.overlap);
    fn.push_back(impulse.pressing / interval);
    ft.push_back(impulse.along / interval);
    rolling.push_back(impulse.rolling / interval);
  }
  arrays.add("contacts.i", i);
  arrays.add("contacts.j", j);
  arrays.add("contacts.normal", normal);
  arrays.add("contacts.overlap", overlap);
  arrays.add("contacts.normal_force", fn);
  arrays.add("contacts.tangential_force", ft);
  if (rolls) arrays.add("contacts.rolling_torque", rolling);
}

}  // namespace crossgrain_worker

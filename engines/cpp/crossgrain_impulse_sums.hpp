#pragma once

// Impulses summed over steps, and the mean forces that a snapshot shows of them.

#include <map>
#include <utility>

#include "crossgrain_impulse_space.hpp"

namespace crossgrain_worker {

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

/// Mean forces over an interval [s].
/// @param rolls  whether anything resists rolling
/// @param geometry  of two ids as they are now
template <typename GeometryOf>
void addContacts(ArrayFile& arrays, const ImpulseSums& sums, double interval, bool rolls,
                 const GeometryOf& geometry) {
  ContactColumns contacts;
  std::vector<double> rolling;
  for (const auto& [pair, impulse] : sums.onFirst) {
    const Geometry between =
        geometry(static_cast<std::size_t>(pair.first), static_cast<std::size_t>(pair.second));
    contacts.add(pair.first, pair.second, between.normal, between.overlap,
                 impulse.pressing / interval, impulse.along / interval);
    rolling.push_back(impulse.rolling / interval);
  }
  contacts.writeTo(arrays);
  if (rolls) arrays.add("contacts.rolling_torque", rolling);
}

}  // namespace crossgrain_worker

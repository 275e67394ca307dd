#pragma once

// Impulses summed over steps, and the mean forces that a snapshot shows of them.

#include <map>
#include <utility>

#include "crossgrain_impulse_space.hpp"
#include "crossgrain_point_sums.hpp"

namespace crossgrain_worker {

/// n from the second to the first, and how deep they overlap [m].
template <int D>
struct GeometryOf {
  VectorOf<D> normal;
  double overlap;
};

/// Impulses since some step, and what walls got of them.
template <int D>
struct ImpulseSumsOf {
  /// As PairImpulse's; normals turn meanwhile, and what is along them with them.
  struct Impulse {
    double pressing = 0.0;
    TangentOf<D> along = {};
    SpinOf<D> rolling = {};
    VectorOf<D> normal;  ///< of the last
  };
  std::map<std::pair<std::int32_t, std::int32_t>, Impulse> onFirst;
  /// Instead, of convex bodies.
  std::map<std::pair<std::int32_t, std::int32_t>, PointSumsOf<D>> points;
  std::vector<VectorOf<D>> onBody;
  std::vector<SpinOf<D>> torqueOnBody;  ///< about the body's centre [N m s]
  long long steps = 0;

  void clear(std::size_t bodies) {
    onFirst.clear();
    points.clear();
    onBody.assign(bodies, {});
    torqueOnBody.assign(bodies, {});
    steps = 0;
  }

  void add(const PairImpulseOf<D>& impulse, const WallIds& ids,
           const std::vector<BodyOf<D>>& bodies) {
    const auto [known, isNew] = onFirst.try_emplace({impulse.i, impulse.j});
    Impulse& sum = known->second;
    if (!isNew) sum.along = carriedAlong(sum.along, sum.normal, impulse.normal);
    sum.normal = impulse.normal;
    sum.pressing += impulse.pressing;
    sum.along += impulse.along;
    sum.rolling += impulse.rolling;
    loadWall(impulse, ids, bodies);
  }

  void addPoint(const PairImpulseOf<D>& impulse, const WallIds& ids,
                const std::vector<BodyOf<D>>& bodies) {
    points[{impulse.i, impulse.j}].add(impulse.normal, impulse.pressing, impulse.onFirst(),
                                       impulse.place, impulse.depth);
    loadWall(impulse, ids, bodies);
  }

  void loadWall(const PairImpulseOf<D>& impulse, const WallIds& ids,
                const std::vector<BodyOf<D>>& bodies) {
    const auto j = static_cast<std::size_t>(impulse.j);
    if (!ids.isWall(j)) return;
    const std::size_t b = ids.body(j);
    const VectorOf<D> on = -1.0 * impulse.onFirst();
    onBody[b] = onBody[b] + on;
    torqueOnBody[b] += cross(impulse.place - bodies[b].centre, on) - impulse.rolling;
  }
};

inline double meanOf(double sum, double interval) {
  return sum / interval;
}
inline Vector3 meanOf(Vector3 sum, double interval) {
  return (1.0 / interval) * sum;
}

/// Mean forces over an interval [s].
/// @param rolls  whether anything resists rolling
/// @param geometry  of two ids as they are now
template <int D, typename GeometryOfIds>
void addContacts(ArrayFile& arrays, const ImpulseSumsOf<D>& sums, double interval, bool rolls,
                 const GeometryOfIds& geometry) {
  ContactColumnsOf<D> contacts;
  std::vector<double> rolling;
  for (const auto& [pair, impulse] : sums.onFirst) {
    const GeometryOf<D> between =
        geometry(static_cast<std::size_t>(pair.first), static_cast<std::size_t>(pair.second));
    contacts.add(pair.first, pair.second, between.normal, between.overlap,
                 impulse.pressing / interval,
                 meanOf(carriedAlong(impulse.along, impulse.normal, between.normal), interval));
    append(rolling, meanOf(impulse.rolling, interval));
  }
  contacts.writeTo(arrays);
  if (rolls) arrays.add("contacts.rolling_torque", rolling);
}

/// As addContacts(), of convex bodies: one contact of each pair, at the mean of its points, with
/// the moment that is left about there.
template <int D>
void addPoints(ArrayFile& arrays, const ImpulseSumsOf<D>& sums, double interval) {
  ContactColumnsOf<D> contacts;
  std::vector<double> left, points;
  for (const auto& [pair, sum] : sums.points) {
    const auto one = sum.contact();
    contacts.add(pair.first, pair.second, one.normal, sum.depth, one.pressing / interval,
                 meanOf(one.along, interval));
    append(left, meanOf(one.left, interval));
    append(points, one.place);
  }
  contacts.writeTo(arrays);
  arrays.add("contacts.rolling_torque", left);
  arrays.add("contacts.point", points);
}

}  // namespace crossgrain_worker

#pragma once

// Two bodies that touch in several points, as one contact of the pair.

#include <algorithm>
#include <limits>

#include "crossgrain_vector.hpp"

namespace crossgrain_worker {

/// Of a pair: all that pushes on the first, its moment about the origin, and normal and place
/// weighed with what presses.
template <int D>
struct PointSumsOf {
  double weight = 0.0, depth = -std::numeric_limits<double>::infinity();
  VectorOf<D> push = {}, normal = {}, place = {};
  SpinOf<D> moment = {};

  /// @param n  from the second to the first  @param onFirst  of which `pressing` is along n
  void add(VectorOf<D> n, double pressing, VectorOf<D> onFirst, VectorOf<D> at, double overlap) {
    constexpr double least = 1e-200;  // a point that only rubs has a place, too
    const double by = std::max(pressing, least);
    weight += by;
    depth = std::max(depth, overlap);
    push = push + onFirst;
    normal = normal + by * n;
    place = place + by * at;
    moment += cross(at, onFirst);
  }

  /// All of it at the mean of the points, with the moment that is left about there.
  struct Contact {
    VectorOf<D> normal, place;
    double pressing;
    TangentOf<D> along;
    SpinOf<D> left;
  };
  Contact contact() const {
    Contact one;
    one.normal = (1.0 / norm(normal)) * normal;
    one.place = (1.0 / weight) * place;
    one.pressing = dot(push, one.normal);
    one.along = tangentOf(push - one.pressing * one.normal, one.normal);
    one.left = moment - cross(one.place, push);
    return one;
  }
};

}  // namespace crossgrain_worker

#pragma once

#include <functional>
#include <optional>
#include <string>

#include "adapters/scene.hpp"

namespace crossgrain {

/// A disk, and what it overlaps at the start: another, a wall disk, a plane or a cylinder.
template <int D>
struct DeepStartOf {
  std::size_t i, j;  ///< ids, as nameOfId() takes them
  VecOf<D> place;    ///< centre of the first [m]
  double overlap;    ///< [m]
  double allowed;    ///< overlap [m]
  bool sameCentre;
};
using DeepStart = DeepStartOf<2>;

/// The first pair with one centre, or with an overlap beyond limit(radius, radius) [m], in a
/// periodic box also across its borders. Disks of walls may overlap each other; to a plane, both
/// radii are the disk's. The radius of a convex body is the shortest way from its centre out of it.
/// @pre all positions are finite
template <int D>
std::optional<DeepStartOf<D>> deepStart(const SceneOf<D>& scene,
                                        const std::function<double(double, double)>& limit);

/// The first disk, wall disks counting on from N, whose position is not finite.
template <int D>
std::optional<std::size_t> firstNotFinite(const SceneOf<D>& scene);

/// Why no engine can make sense of the scene's start, one line; empty if one can: a position that
/// is not finite, coincident centres, which have no normal, or a disk whose centre lies inside the
/// other (behind a plane), where no law of small overlaps means anything.
template <int D>
std::string startFault(const SceneOf<D>& scene);

}  // namespace crossgrain

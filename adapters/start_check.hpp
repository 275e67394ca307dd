#pragma once

#include <functional>
#include <optional>
#include <string>

#include "adapters/scene.hpp"

namespace crossgrain {

/// A disk, and what it overlaps at the start: another, a wall disk or a plane.
struct DeepStart {
  std::size_t i, j;  ///< ids, as nameOfId() takes them
  Vec2 place;        ///< centre of the first [m]
  double overlap;    ///< [m]
  bool sameCentre;
};

/// The first pair with one centre, or with an overlap beyond limit(radius, radius) [m]. Disks of
/// walls may overlap each other; to a plane, both radii are the disk's.
/// @pre all positions are finite
std::optional<DeepStart> deepStart(const Scene& scene,
                                   const std::function<double(double, double)>& limit);

/// The first disk, wall disks counting on from N, whose position is not finite.
std::optional<std::size_t> firstNotFinite(const Scene& scene);

/// Why no engine can make sense of the scene's start, one line; empty if one can: a position that
/// is not finite, coincident centres, which have no normal, or a disk whose centre lies inside the
/// other (behind a plane), where no law of small overlaps means anything.
std::string startFault(const Scene& scene);

}  // namespace crossgrain

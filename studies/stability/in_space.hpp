#pragma once

#include <memory>

#include "adapters/engine.hpp"

namespace crossgrain::inline studies {

/// How far a sphere may leave the plane of its scene [radius of the smallest]: distances between
/// spheres are off by half its square then.
inline constexpr double leavesPlane = 1e-3;

/// The disks as spheres, J = 2/5 m a²: what an engine in space has.
Scene ofSpheres(Scene scene);

/// Runs scenes of the plane in a plane of space, where every equation is the plane's
/// (docs/dimensions.md, section 4): one that is along no axis, or, for an engine that has planes
/// along axes alone and a scene with planes, that of y and z. Snapshots are those of the plane
/// again.
///
/// Rounding moves spheres off their plane, and what grows from that is no fault of anybody's:
/// snapshot() throws UnsupportedScene once one has left it.
/// @param engine  has scenes in space
std::unique_ptr<Engine> runInSpace(std::unique_ptr<Engine> engine);

}  // namespace crossgrain::inline studies

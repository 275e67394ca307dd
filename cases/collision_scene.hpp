#pragma once

#include <string>
#include <vector>

#include "adapters/scene.hpp"
#include "cases/case.hpp"
#include "oracle/collision_end.hpp"
#include "oracle/convex_impact.hpp"

namespace crossgrain::inline cases {

/// The two bodies of a collision case.
CollidingPair collidingPair(const Case& setup);

/// Every collision of a case's sweep: all Ψ_i at each v_n (or at the one speed) and counter-spin.
std::vector<CollisionStart> collisionStarts(const Case& setup);

/// Convex bodies at the instant when they touch, in the frame n, s (, b) with the contact at 0,
/// where the wall, or the centre of mass of both, is at rest.
template <int D>
struct ConvexTouchOf {
  DisksOf<D> bodies;  ///< two, or one on a wall; `shape` is their place in the scene's shapes
  ConvexImpactStart<D> impact;  ///< of the case's law
  /// How much farther from each other they are, at least, where they may touch next [m].
  double next = 0.0;
};
template <int D>
ConvexTouchOf<D> convexTouch(const Case& setup, const CollisionStart& start);

/// How long after the touch convex bodies may touch elsewhere, at the earliest [s].
/// @param impact  of the touch, which ends as any of its hypotheses says
/// @param speed   of approach [m/s]
template <int D>
double freeFlight(const ConvexTouchOf<D>& touch, const ConvexImpact<D>& impact, double speed);

/// Steps after which velocities of rigid bodies are read: what an engine needs to find an impact
/// and bring it to an end. And the time of it, from the scene's start [s].
inline constexpr double readingSteps = 21.0;
inline double readingTime(double dt) {
  return readingSteps * dt;
}

/// All collisions of a sweep side by side in one scene, far enough apart not to meet.
/// Pair k is disks 2k (on the right, i) and 2k + 1 (on the left, j), its centre of mass at rest.
/// They touch start_phase·dt after the start, then with their centres on a parallel to x and
/// moving as motionBefore() says. With a wall disk k is on the right of the one plane, normal +x,
/// that all meet; the plane moves, and the disks move as said with respect to it.
/// @throws BadInput for a case in space
Scene collisionScene(const Case& setup, const std::vector<CollisionStart>& starts, double dt);

/// The same of spheres in space: x, y and z of the plane's scene are n, s and b of each collision,
/// and all of it is turned as the case says.
SpaceScene spaceCollisionScene(const Case& setup, const std::vector<CollisionStart>& starts,
                               double dt);

/// Columns are where n, s and b of the case's collisions are in its scene.
Eigen::Matrix3d turnOf(const Case& setup);

/// A kind of pair that a case brings together: "small-large", "large-wall", "i-j"; "large-wheel"
/// and "large-ring" where these are of two materials.
struct NamedPair {
  std::string name;
  CollidingPair bodies;
  ContactLaw law;  ///< of their materials
};

/// Of a cell's disks with each other and with wall disks; of a collision its two bodies; of an
/// assembly "disk1-disk2", "disk1-plane3", disks by the radius of their group, of start files the
/// smallest and the largest of the first.
std::vector<NamedPair> pairsOf(const Case& setup);

/// All collisions of a sweep side by side, in the plane or in space.
template <int D>
SceneOf<D> sweepScene(const Case& setup, const std::vector<CollisionStart>& starts, double dt);

}  // namespace crossgrain::inline cases

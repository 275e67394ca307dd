#pragma once

#include <vector>

#include "adapters/scene.hpp"
#include "adapters/snapshot.hpp"
#include "cases/case.hpp"
#include "cases/collision_end.hpp"

namespace crossgrain {

/// The two disks of a collision case.
CollidingPair collidingPair(const Case& setup);

/// All collisions of a sweep side by side in one scene, far enough apart not to meet.
/// Pair k is disks 2k (on the right, i) and 2k + 1 (on the left, j), its centre of mass at rest.
/// They touch start_phase·dt after the start, then with their centres on a parallel to x and
/// moving as motionBefore() says.
Scene collisionScene(const Case& setup, const std::vector<CollisionStart>& starts, double dt);

/// Traces the free flight after the collision back to the instant when the disks parted. An end
/// without maxOverlap and lost, which the flight does not tell.
/// @param scene  of collisionScene() @param start  of that pair
/// @returns none if they never met or still touch
std::optional<CollisionEnd> collisionEnd(const Scene& scene, const Snapshot& after,
                                         std::size_t pair, const CollisionStart& start);

}  // namespace crossgrain

#pragma once

#include <optional>

#include "adapters/scene.hpp"
#include "adapters/snapshot.hpp"
#include "oracle/collision_end.hpp"

namespace crossgrain::inline oracle {

/// Collisions side by side in one scene: disks 2k and 2k + 1 are pair k; where there is a wall,
/// disk k and its one plane.
template <int D>
CollidingPair pairOf(const SceneOf<D>& scene, std::size_t pair);

/// Traces the free flight after the collision back to the instant when the disks parted, under JKR
/// where the scene's law lets go. An end
/// without maxOverlap and lost, which the flight does not have.
/// @param scene  as in pairOf() @param start  of that pair
/// @returns none if they never met or still touch
std::optional<CollisionEnd> collisionEnd(const Scene& scene, const Snapshot& after,
                                         std::size_t pair, const CollisionStart& start);

/// The same in space, of a linear law.
/// @param turn  takes n, s and b of the start to where they are in the scene: its columns
std::optional<CollisionEnd> collisionEnd(const SpaceScene& scene, const SpaceSnapshot& after,
                                         std::size_t pair, const CollisionStart& start,
                                         const Eigen::Matrix3d& turn);

}  // namespace crossgrain::inline oracle

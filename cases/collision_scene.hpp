#pragma once

#include <vector>

#include "adapters/scene.hpp"
#include "cases/case.hpp"
#include "oracle/collision_end.hpp"

namespace crossgrain::inline cases {

/// The two bodies of a collision case.
CollidingPair collidingPair(const Case& setup);

/// Every collision of a case's sweep: all Ψ_i at each v_n (or at the one speed) and counter-spin.
std::vector<CollisionStart> collisionStarts(const Case& setup);

/// All collisions of a sweep side by side in one scene, far enough apart not to meet.
/// Pair k is disks 2k (on the right, i) and 2k + 1 (on the left, j), its centre of mass at rest.
/// They touch start_phase·dt after the start, then with their centres on a parallel to x and
/// moving as motionBefore() says. With a wall disk k is on the right of the one plane, normal +x,
/// that all meet; the plane moves, and the disks move as said with respect to it.
Scene collisionScene(const Case& setup, const std::vector<CollisionStart>& starts, double dt);

}  // namespace crossgrain::inline cases

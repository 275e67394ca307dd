#pragma once

#include <vector>

#include "adapters/scene.hpp"
#include "adapters/snapshot.hpp"
#include "cases/case.hpp"

namespace crossgrain {

/// One head-on collision with spin: Ψ_i = v_t/v_n with v_n the speed of approach.
struct CollisionStart {
  double psi = 0.0;
  double vn = 0.0;  ///< > 0 [m/s]
};

/// What is left after a collision, at the instant of separation and with that instant's normal.
struct CollisionEnd {
  double en = 0.0;   ///< −v_n after / v_n before
  double psi = 0.0;  ///< Ψ_f = v_t after / speed of approach; < 0 reversed
};

/// All collisions of a sweep side by side in one scene, far enough apart not to meet.
/// Pair k is disks 2k (on the right, i) and 2k + 1 (on the left, j); each pair approaches along x,
/// its centre of mass at rest, both disks turning alike so that v_t = Ψ_i v_n. They touch
/// start_phase·dt after the start.
Scene collisionScene(const Case& setup, const std::vector<CollisionStart>& starts, double dt);

/// Traces the free flight after the collision back to the instant when the disks parted.
/// Absent if they never met or still touch.
std::optional<CollisionEnd> collisionEnd(const Scene& scene, const Snapshot& after,
                                         std::size_t pair, const CollisionStart& start);

}  // namespace crossgrain

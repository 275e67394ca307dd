#pragma once

#include "adapters/snapshot.hpp"
#include "results/collision.hpp"
#include "studies/collide/sweep.hpp"

namespace crossgrain::inline studies {

/// Outcomes of a start by Newton's, Poisson's and Stronge's restitution.
ConvexOutcomes convexOutcomes(const Case& setup, const CollisionStart& start);

/// State after a collision of convex bodies; absent where nothing has pushed them apart.
template <int D>
std::optional<CollisionEnd> convexEndOf(const Case& setup, const SnapshotOf<D>& after,
                                        std::size_t pair, const CollisionStart& start);

/// The list of a case that its figures are drawn over: the first of orientations, Ψ_i and spins
/// that has more than one value.
std::vector<double> Collision::*sweptList(const Collision& collision);

/// @param fine   oracle on the fine grid
/// @param sweep  and at the points of all curves
ConvexSweep convexSweep(const Case& setup, const std::vector<CollisionStart>& starts,
                        const OracleCurve& fine, const OracleCurve& sweep);

}  // namespace crossgrain::inline studies

#pragma once

#include <vector>

#include "adapters/snapshot.hpp"
#include "cases/case.hpp"
#include "results/collision.hpp"
#include "studies/collide/sweep.hpp"
#include "studies/core/study.hpp"

namespace crossgrain::inline studies {

struct CollideOptions {
  bool strict = false;
};

/// Two-particle collisions: sweeps of every case and variant of a file, or of all collisions of a
/// folder, against the oracle.
extern const Study<CollideOptions, CollideResults> collideStudy;

/// Runs the sweep of every variant and time step of a collision case on every engine and scores the
/// whole curve against the oracle of the same planar problem. Finished cases are kept in the store
/// at once, and loaded from there.
/// @param variants  one case per variant, from one file or several
/// @throws BadInput, UnsupportedScene, Interrupted
CollideResults collideEngines(const std::vector<Case>& variants, const RunCommand& command,
                              RunStore& store);

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

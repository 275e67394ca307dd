#pragma once

#include <vector>

#include "results/diff.hpp"
#include "runs/baseline/kept_collisions.hpp"

namespace crossgrain::inline runs {

/// Quantities of a sweep that are not the same bits, those that changed most first. A collision
/// that has a value on one side only has changed by as much as there is: by 1 in relative terms.
/// @pre the same collisions: sameCollisions()
std::vector<CollisionChange> collisionChanges(const KeptCollisions& before,
                                              const KeptCollisions& now);

/// Whether both are of the same case and impacts.
bool sameCollisions(const KeptCollisions& before, const KeptCollisions& now);

/// By the largest relative change: rules.hpp has the limits and their reasons.
DiffVerdict verdictOf(const std::vector<CollisionChange>& changes);

}  // namespace crossgrain::inline runs

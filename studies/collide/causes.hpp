#pragma once

#include <optional>
#include <vector>

#include "adapters/engine.hpp"
#include "cases/case.hpp"
#include "results/collision_score.hpp"
#include "studies/collide/sweep.hpp"

namespace crossgrain::inline studies {

/// Causes of an engine's sweep being another than the in-house engine's on the scene as the case
/// has it, by runs of the in-house engine under mixtures of both laws. Where a soft engine does not
/// do what it declares, its law is the one that it is seen to have: one for which the in-house
/// engine leaves less than termUnexplained of what is left under the declared one, in the states
/// after the collisions.
/// @param scene  the case's
/// @param peer   as the engine declares to run it: its law, its step
/// @param score  of the sweep, whose units and limits are taken
/// @returns nothing where the sweeps do not differ by more than rounding does
template <int D>
std::optional<CollisionCauses> causesOfSweep(const Case& setup,
                                             const std::vector<CollisionStart>& starts,
                                             const SceneOf<D>& scene, const SceneOf<D>& peer,
                                             const Outcomes& found, const CurveScore& score);

}  // namespace crossgrain::inline studies

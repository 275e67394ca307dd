#pragma once

#include <optional>
#include <vector>

#include "adapters/engine.hpp"
#include "results/lockstep_findings.hpp"
#include "studies/causes/changes.hpp"

namespace crossgrain::inline studies {

/// Causes of how far an engine's law takes disks from where the case's does.
/// @param mirror   of the engine
/// @param scenes   of the case's law in the engine's steps, by start: the first are followed, as
/// many
///                 as take a tenth of the windows that all took, one at least
/// @param mirrors  the engine's mirror's, likewise
/// @param term     that it does otherwise than it declares; null: nothing is named
/// @returns nothing where there is no difference
/// @throws Interrupted
template <int D>
std::optional<LockstepCauses> causesInLockstep(Engine& mirror,
                                               const std::vector<SceneOf<D>>& scenes,
                                               const std::vector<SceneOf<D>>& mirrors,
                                               const NamedTerm* term, double diameter);

}  // namespace crossgrain::inline studies

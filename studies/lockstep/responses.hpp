#pragma once

#include <functional>
#include <string>
#include <vector>

#include "adapters/engine.hpp"
#include "studies/lockstep/window.hpp"

/// How far small changes take an engine from what it does without.
namespace crossgrain::inline studies {

/// How far referencePerturbations move each disk from one start, by the times reported; change by
/// change [d].
using Responses = std::vector<std::vector<double>>;

/// How far referencePerturbations take an engine from what it does without, from one start.
/// @param unchanged  what it does, at the times reported
/// @param load       has the engine load the start's scene, the reference constant changed by that
/// part of
///                   itself; returns the engine's time step [s]
/// @param box        the scene's, of an engine that may wrap paths
/// @throws EngineFailure, Interrupted; what `load` throws
template <int D>
Responses referenceResponses(Engine& engine, const std::vector<LockstepFrameOf<D>>& unchanged,
                             double diameter, const std::function<double(double)>& load,
                             const std::optional<BoxOf<D>>& box = {});

/// How far rounding alone may part an engine of a precision from its mirror, by frame [d]: an
/// engine that rounds its state in every step does as much harm in each as the mirror takes from
/// one rounding, of its start; so that the n-th step may show 1 + n times the separation of the
/// mirror, started from the rounded state, from itself. Chaos is in that, as the mirror has it.
/// @param precision  as declared, EffectiveParameters::precision
/// @param scene      the mirror's
/// @param unchanged  what the mirror does, after those steps
/// @returns empty of double precision, the mirror's own
template <int D>
std::vector<double> precisionLimits(const std::string& precision, Engine& mirror,
                                    const SceneOf<D>& scene,
                                    const std::vector<LockstepFrameOf<D>>& unchanged,
                                    const std::vector<std::uint64_t>& steps, double diameter);

}  // namespace crossgrain::inline studies

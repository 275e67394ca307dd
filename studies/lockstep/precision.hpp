#pragma once

#include <functional>
#include <string>
#include <vector>

#include "adapters/engine.hpp"
#include "studies/lockstep/window.hpp"

namespace crossgrain::inline studies {

/// How far rounding alone may part an engine of a precision from its mirror, by frame [d]: an
/// engine that rounds its state in every step does as much harm in each as the mirror takes from
/// one rounding, of its start; so that the n-th step may show 1 + n times the separation of the
/// mirror, started from the rounded state, from itself. Chaos is in that, as the mirror has it.
/// @param precision  as declared, EffectiveParameters::precision
/// @param scene      the mirror's
/// @param unchanged  what the mirror does, after those steps
/// @returns empty of double precision, the mirror's own
std::vector<double> precisionLimits(const std::string& precision, Engine& mirror,
                                    const Scene& scene, const std::vector<LockstepFrame>& unchanged,
                                    const std::vector<std::uint64_t>& steps, double diameter);

}  // namespace crossgrain::inline studies

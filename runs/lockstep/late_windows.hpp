#pragma once

#include <functional>

#include "adapters/engine_entry.hpp"
#include "cases/case.hpp"
#include "cases/packing.hpp"
#include "results/endpoints.hpp"

namespace crossgrain::inline runs {

/// Follows one run of an engine from the hand-over to its end, without loading it again, and
/// compares it window after window with its mirror, which begins each from the engine's own
/// positions, velocities and tangential forces. So what begins late, or depends on how long the
/// engine has run, is seen without chaos: separations begin anew with every window. Their
/// yardstick is, as in lockstep, the mirror's separation from itself where a constant is changed,
/// for every constant of changedCases().
///
/// What it cannot see: what happens on other packings alone (n windows alike leave at most 3/n of
/// all unlike). The plate's springs, which no engine shows, begin relaxed.
/// @param engine    started; that of `entry`
/// @param packing   that the run begins with; `index` is its own
/// @param dt        the case's [s]
/// @param measured  windows that the yardstick is applied to at least; those that differ by more
///                  than rounding all are
/// @throws Interrupted, BadInput
LateWindows followLate(Engine& engine, const EngineEntry& entry, const Case& setup,
                       const Packing& packing, int index, double dt, std::size_t measured,
                       const std::function<void(double)>& progress);

}  // namespace crossgrain::inline runs

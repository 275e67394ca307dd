#pragma once

#include <functional>

#include "adapters/engine_entry.hpp"
#include "cases/case.hpp"
#include "cases/packing.hpp"
#include "results/endpoints.hpp"

namespace crossgrain::inline studies {

/// Follows one run of an engine from the hand-over to its end, without loading it again, and
/// compares it window after window with its mirror, which begins each from the engine's own
/// positions, velocities, tangential forces, torques against rolling and bonds
/// (beginUnderWay() of adapters/grain.hpp): a right
/// engine in double precision remains the same to rounding. So what begins late, or depends on how
/// long the engine has run, is seen without chaos: separations begin anew with every window. Their
/// measure is, as in lockstep, the mirror's separation from itself where a constant is changed,
/// for every constant of changedCases().
///
/// Windows follow one another without gaps. To first order an average over the run answers to the
/// mean over it of what is changed, so the mean over windows is what bounds averages; its interval
/// says what another run may be like.
///
/// Blind spots: what happens on other packings alone (n windows alike leave at most 3/n of
/// all unlike), and forces of the normal direction that are reported wrongly. The plate's springs,
/// which no engine reports, begin relaxed, and of predicted damping the first force is that of the
/// instant's velocity: engines of which that matters have larger ε_late, and no false ones.
/// @param engine    started; that of `entry`
/// @param packing   that the run begins with; `index` is its own
/// @param dt        the case's [s]
/// @param measured  windows that reference perturbations are applied to at least; those that differ
/// by more
///                  than rounding all are
/// @throws EngineFailure, Interrupted, BadInput
LateWindows followLate(Engine& engine, const EngineEntry& entry, const Case& setup,
                       const Packing& packing, int index, double dt, std::size_t measured,
                       const std::function<void(double)>& progress);

}  // namespace crossgrain::inline studies

#pragma once

#include "cases/case.hpp"
#include "results/collision_score.hpp"
#include "studies/core/engine_access.hpp"

namespace crossgrain::inline studies {

/// Largest deviation from its own scheme that an engine of double precision is allowed, in units of
/// d and v_n. Rounding gives 1e-14 of d and 3e-13 of v_n (overlaps of d/100 in positions of d's
/// size, some hundred steps); k_n off by 1e-9 is 1e-9 of v_n.
constexpr double ownSchemeLimit = 1e-12;

/// One head-on impact of the case's two bodies, step by step, against the discrete oracle of the
/// engine's own scheme and declared law (oracle/discrete_impact.hpp): free flight, contact and free
/// flight again. Tells a fault from truncation, at any time step.
///
/// The speed is not the case's but such that the overlap is a hundredth of the sum of radii,
/// where rounded positions give the force to 1e-14 (of an undamped law); a linear law is the same
/// at all speeds. The bodies touch a quarter of a step after a step, so that before and after are
/// not alike, and a wall stands still. Coulomb's law without a spring is frictionless there, as
/// nothing slips.
/// @throws EngineFailure, UnsupportedScene, BadInput
SchemeScore schemeScore(Engine& engine, const EngineEntry& entry, const Case& setup, double dt);

}  // namespace crossgrain::inline studies

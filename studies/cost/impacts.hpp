#pragma once

#include <vector>

#include "cases/case.hpp"
#include "cases/packing.hpp"
#include "results/cost.hpp"

namespace crossgrain::inline studies {

/// Speeds and sizes of the contacts that begin while a case's flow goes on from some of its states,
/// on the in-house engine, by kind of pair (pairsOf()). The speed of a contact is that of approach,
/// −(v_i − v_j)·n, a few steps before it is first seen; contacts of the start do not count.
/// @param states  of the flow  @param dt  the case's [s]
/// @throws UnsupportedScene, EngineFailure, Interrupted
SceneImpacts impactsIn(const Case& setup, const std::vector<Packing>& states, double dt);

}  // namespace crossgrain::inline studies

#pragma once

#include <optional>

#include "adapters/registry.hpp"
#include "adapters/suitability.hpp"
#include "cases/case.hpp"

namespace crossgrain::inline runs {

/// What an engine can do, asked once in the life of this program. Absent if it cannot be started.
std::optional<Capabilities> capabilitiesOf(const EngineEntry& entry, double timeout);

/// The scene that a mirror is given: the one that its peer runs. Effects that the peer lacks are
/// gone, its conventions stand in place of those that it lacks, and its time step is taken, so that
/// what is left between the two is nobody's model. All of it follows from the peer's capabilities.
/// Where the peer has another normal law (soft contacts that stand for rigid ones) law and step are
/// the mirror's own, as contacts of another kind need another step.
///
/// The mirror's precision stays its own: a peer's rounding is the peer's implementation.
/// Deviations say what came from the peer, in the peer's words.
/// @throws UnsupportedScene if the case does not let the peer run it
Adapted sceneOfPeer(const EngineEntry& mirror, const Case& setup, const Scene& scene);

}  // namespace crossgrain::inline runs

#pragma once

#include <memory>
#include <string>

#include "adapters/engine.hpp"

namespace crossgrain {

/// The in-house engine.
std::unique_ptr<Engine> makeGrain();

/// The in-house engine held to a peer's conventions (law option → value): where it follows the
/// peer, what remains between the scene's law and the peer is the model's; where it does not,
/// somebody's implementation is at fault.
std::unique_ptr<Engine> makeGrainMirror(std::map<std::string, std::string> conventions);

/// The in-house engine with contacts `factor` times as stiff, for peers with rigid ones: k_n and
/// k_t grow by it, γ_n and γ_t by its root, so that restitutions stay, and the time step shrinks by
/// its root like the contact time.
std::unique_ptr<Engine> makeStiffGrain(double factor);

}  // namespace crossgrain

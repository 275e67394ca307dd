#pragma once

#include "adapters/engine.hpp"

namespace crossgrain {

/// The worker's side of the protocol: reads requests from descriptor 3, lets the engine do them and
/// answers on descriptor 4, until "quit" or the end of the requests. What the engine throws becomes
/// an answer. @returns the exit status of the process: 0
int serve(Engine& engine);

/// Version of the protocol that this program speaks.
inline constexpr int protocolVersion = 1;

}  // namespace crossgrain

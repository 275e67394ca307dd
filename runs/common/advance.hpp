#pragma once

#include "adapters/engine.hpp"

namespace crossgrain::inline runs {

/// Advances in pieces that an engine can answer within its time-out; Ctrl-C is heard in between.
/// @throws EngineFailure if it stops anywhere else, Interrupted
void advanceInPieces(Engine& engine, const Realised& realised, double from, double to);

}  // namespace crossgrain::inline runs

#pragma once

#include <memory>

#include "adapters/engine.hpp"

namespace crossgrain {

/// Box2D's own impulse solver for rigid disks, extended by tangential restitution.
std::unique_ptr<Engine> makeBox2dImpulse();

/// The scene's soft law on Box2D's collision detection.
std::unique_ptr<Engine> makeBox2dPenalty();

}  // namespace crossgrain

#pragma once

#include <memory>
#include <string>
#include <vector>

#include "adapters/engine.hpp"
#include "engines/box2d/members.hpp"

namespace crossgrain {

/// Box2D's own impulse solver for rigid disks, extended by tangential restitution.
std::unique_ptr<Engine> makeBox2dImpulse();

/// The scene's soft law on Box2D's collision detection.
std::unique_ptr<Engine> makeBox2dPenalty();

/// Helpers of both Box2D engines: settings, limits, and a scene as a model of engines/box2d.

/// Version of the CMake package, and b2_version of the library that runs where it differs: 2.4.1
/// was released with a b2_version of 2.4.0.
std::string box2dVersion();

/// Limits of both: walls are rigid. Moments of inertia and directions of planes are not limited,
/// and each pair has its own restitution, set when a contact begins.
SceneLimits box2dLimits();

/// Both engines' setting for Box2D's unit of length.
SettingSpec lengthUnitSetting();

/// A setting's value, or its default.
/// @throws std::invalid_argument if a setting that `specs` lacks, or one of another type, is given
double numberSetting(const Settings& settings, const std::vector<SettingSpec>& specs,
                     const std::string& name);

/// @param lengthUnit  [m]; 0: the power of two nearest to a fifth of the smallest radius, so that
///                    changing units rounds nothing
/// @throws UnsupportedScene if a wall is not rigid
box2d_granular::Model box2dModel(const Scene& scene, double dt, double lengthUnit);

inline Vec2 toVec2(box2d_granular::Vector v) {
  return {v.x, v.y};
}

/// Disks, walls and times of a snapshot; contacts and loads are the engine's own.
Snapshot kinematicSnapshot(const box2d_granular::Members& members, double time, bool spins);

}  // namespace crossgrain

#pragma once

#include <array>
#include <set>
#include <string>

#include "adapters/scene.hpp"

namespace crossgrain {

/// What a scene may call for; an engine should simulate these and nothing else.
enum class Effect {
  normalDamping,
  friction,
  tangentialSpring,
  tangentialDamping,
  rotation,
  bottomFriction,
  bottomSpinFriction,
  gravity,
  movingWalls
};

inline constexpr std::array allEffects = {
    Effect::normalDamping,      Effect::friction, Effect::tangentialSpring,
    Effect::tangentialDamping,  Effect::rotation, Effect::bottomFriction,
    Effect::bottomSpinFriction, Effect::gravity,  Effect::movingWalls};

/// The name used in case files and reports, e.g. "bottom_spin_friction".
std::string toString(Effect effect);

using Effects = std::set<Effect>;

/// The effects a scene calls for. Where there is no friction, or the case blocks spins,
/// no rotation: nothing can change a spin there.
Effects effectsOf(const Scene& scene);

}  // namespace crossgrain

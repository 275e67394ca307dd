#pragma once

#include <array>
#include <set>
#include <string>
#include <string_view>

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

/// As in case files, the worker protocol and reports, in enum order.
inline constexpr std::array<std::string_view, 9> effectNames = {
    "normal_damping",       "friction", "tangential_spring",
    "tangential_damping",   "rotation", "bottom_friction",
    "bottom_spin_friction", "gravity",  "moving_walls"};
std::string toString(Effect effect);

using Effects = std::set<Effect>;

/// The effects a scene calls for. Where there is no friction, or the case blocks spins,
/// no rotation: nothing can change a spin there.
Effects effectsOf(const Scene& scene);

}  // namespace crossgrain

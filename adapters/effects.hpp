#pragma once

#include <array>
#include <set>
#include <string>
#include <string_view>

#include "adapters/scene.hpp"

namespace crossgrain {

/// Effects that a scene may call for; an engine should simulate those it calls for and no others.
enum class Effect {
  normalDamping,
  friction,
  tangentialSpring,
  tangentialDamping,
  rotation,
  bottomFriction,
  bottomSpinFriction,
  gravity,
  movingWalls,
  rollingResistance,
  cohesion,
  pairMaterials  ///< pairs of bodies differ in the law's constants
};

inline constexpr std::array allEffects = {
    Effect::normalDamping,      Effect::friction, Effect::tangentialSpring,
    Effect::tangentialDamping,  Effect::rotation, Effect::bottomFriction,
    Effect::bottomSpinFriction, Effect::gravity,  Effect::movingWalls,
    Effect::rollingResistance,  Effect::cohesion, Effect::pairMaterials};

/// As in case files, the worker protocol and reports, in enum order.
inline constexpr std::array<std::string_view, 12> effectNames = {
    "normal_damping",       "friction", "tangential_spring",
    "tangential_damping",   "rotation", "bottom_friction",
    "bottom_spin_friction", "gravity",  "moving_walls",
    "rolling_resistance",   "cohesion", "pair_materials"};
std::string toString(Effect effect);

using Effects = std::set<Effect>;

/// The effects a scene calls for. Where there is neither friction nor rolling resistance, or the
/// case blocks spins, no rotation: nothing can change a spin there.
template <int D>
Effects effectsOf(const SceneOf<D>& scene);

}  // namespace crossgrain

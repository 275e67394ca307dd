#pragma once

#include <optional>
#include <string>

#include "adapters/engine.hpp"
#include "cases/case.hpp"

namespace crossgrain::inline runs {

// Whose time step an engine takes, first to last:
//   [engines.NAME] dt             of the case, 0 meaning the case's own step
//   [run] dt                      a step that the case gives is everybody's
//   the setting's default         5e-4 s of an engine whose contacts need no resolving, say
//   the case's                    t_c / steps_per_contact
// A step that is not the scene's is a deviation (loadScene()).

/// The step of the first three lines [s]; absent where the engine follows the case.
std::optional<double> stepOfItsOwn(const Case& setup, const std::string& engine,
                                   const Capabilities& can);

/// What the case says under [engines.NAME], and where it is silent the engine's own file.
Settings settingsSaid(const Case& setup, const std::string& engine);

/// The settings with the rule above spelt out: an engine with a default of its own is told to take
/// the scene's step where the case gives one.
Settings withStep(Settings settings, const Case& setup, const Capabilities& can);

/// That the engine takes other steps than the scene's; absent if it does not.
std::optional<Deviation> stepDeviation(double engineStep, double sceneStep);

}  // namespace crossgrain::inline runs

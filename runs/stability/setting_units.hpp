#pragma once

#include <optional>
#include <string>
#include <vector>

#include "adapters/engine.hpp"
#include "stability/transform.hpp"

namespace crossgrain::inline runs {

/// What a setting of that unit ("m", "m/s") is multiplied by in other units; absent: of a unit that
/// is not known here.
std::optional<double> factorOf(const std::string& unit, const Units& units);

/// An engine's settings for a scene in other units: those with a unit are multiplied, defaults
/// said. What is 0 stays, whatever its unit.
/// @throws UnsupportedScene naming a setting whose unit is not known
Settings inUnits(Settings settings, const std::vector<SettingSpec>& specs, const Units& units);

}  // namespace crossgrain::inline runs

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "adapters/registry.hpp"
#include "cases/case.hpp"

namespace crossgrain::inline runs {

/// How an engine runs a case.
struct Suitability {
  std::optional<double> dt;               ///< its time step, where it has loaded the scene [s]
  std::vector<std::string> deviations;    ///< one note each
  std::vector<std::string> notSimulated;  ///< effects that the scene calls for
};

/// What `check` says of an engine and a case. The engine has loaded the scene then, so that `check`
/// and the reports of runs tell the same; of a scene that no engine can start from, it is what is
/// known before.
/// @throws UnsupportedScene in the engine's own words, BadInput for a setting
Suitability suitabilityOf(Engine& engine, const EngineEntry& entry, const Case& setup,
                          const Scene& scene);

}  // namespace crossgrain::inline runs

#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "adapters/registry.hpp"
#include "cases/case.hpp"

namespace crossgrain {

/// Engines by the names given on the command line, in that order; "all" is every engine that is not
/// a mirror.
/// @throws BadInput naming the unknown engine and the nearest known one, or one named twice
std::vector<EngineEntry> selectEngines(const std::vector<std::string>& names);

/// The mirrors in the registry whose peer is among `engines`.
std::vector<EngineEntry> mirrorsOf(const std::vector<EngineEntry>& engines);

/// Starts the engine's worker. @throws EngineFailure, BadInput if it is not installed
std::unique_ptr<Engine> startEngine(const EngineEntry& entry, const std::filesystem::path& scratch,
                                    double timeout);

/// The settings of one engine in a case. @throws BadInput for one that the engine does not have, or
/// of another type or choice, naming the nearest
Settings settingsFor(const Case& setup, const std::string& engine, const Capabilities& can);

/// An engine that has loaded a scene.
struct LoadedEngine {
  std::unique_ptr<Engine> engine;
  Realised realised;  ///< with the deviations that the case allows
  Capabilities can;
};

/// Starts an engine and has it load the scene as far as the case lets it differ.
/// @throws UnsupportedScene, EngineFailure, BadInput
LoadedEngine loadEngine(const EngineEntry& entry, const Case& setup, const Scene& scene,
                        const std::filesystem::path& scratch);

/// The same in an engine that runs already.
Realised loadScene(Engine& engine, const EngineEntry& entry, const Case& setup, const Scene& scene);

}  // namespace crossgrain

#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "adapters/registry.hpp"
#include "adapters/suitability.hpp"
#include "adapters/worker/exchange.hpp"
#include "cases/case.hpp"

namespace crossgrain::inline runs {

/// Engines by the names given on the command line, in that order; "all" is every installed engine
/// that is not a mirror.
/// @throws BadInput naming the unknown engine and the nearest known one, or one named twice
std::vector<EngineEntry> selectEngines(const std::vector<std::string>& names);

/// Whether the user asked for this engine by its own name, so that a refusal is theirs to resolve.
bool isNamed(const std::vector<std::string>& names, const EngineEntry& entry);

/// @throws BadInput for a section [engines.NAME] of an engine that does not exist
void checkEngineSections(const Case& setup);

/// The mirrors in the registry whose peer is among `engines`.
std::vector<EngineEntry> mirrorsOf(const std::vector<EngineEntry>& engines);

/// Whether a mirror is one in a scene of this law.
bool standsForItsPeer(const EngineEntry& mirror, const ContactLaw& law);

/// The engines named and, if the case wants them, their mirrors. @throws BadInput like
/// selectEngines() and checkEngineSections()
std::vector<EngineEntry> enginesFor(const Case& setup, const std::vector<std::string>& names);

/// This program's path, which serves engines as workers, too.
std::string ownProgram();

/// Starts the engine's worker. @throws EngineFailure, BadInput if it is not installed
/// @param listener  is told every request and answer
std::unique_ptr<Engine> startEngine(const EngineEntry& entry, const std::filesystem::path& scratch,
                                    double timeout, ExchangeListener listener = {});

/// The same, every snapshot of it audited (audited_engine.hpp).
std::unique_ptr<Engine> startAudited(const EngineEntry& entry, const std::filesystem::path& scratch,
                                     double timeout);

/// The settings of one engine in a case, its time step by the rule of engine_step.hpp. @throws
/// BadInput for one that the engine does not have, or of another type or choice, naming the nearest
Settings settingsFor(const Case& setup, const std::string& engine, const Capabilities& can);

/// The scene as the case lets this engine run it; of a mirror, as it lets its peer.
/// @throws UnsupportedScene saying what it cannot do
Adapted sceneFor(const Capabilities& can, const EngineEntry& entry, const Case& setup,
                 const Scene& scene);

/// Whether an engine can run the scene with the settings and liberties of the case.
/// @throws UnsupportedScene naming engine, case and what it cannot do; BadInput for a setting
void checkSuitable(const Capabilities& can, const EngineEntry& entry, const Case& setup,
                   const Scene& scene);

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

/// Has an engine load the scene as far as the case lets it differ, a mirror that of its peer. What
/// it then really does, with all deviations, its time step among them.
/// @throws UnsupportedScene saying what it cannot do
Realised loadAdapted(Engine& engine, const EngineEntry& entry, const Case& setup,
                     const Scene& scene);

/// The same, and refusals name engine and case. A scene that no engine can start from
/// (whyNoStart()) is BadInput.
Realised loadScene(Engine& engine, const EngineEntry& entry, const Case& setup, const Scene& scene);

}  // namespace crossgrain::inline runs

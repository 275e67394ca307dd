#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <ranges>
#include <string>
#include <vector>

#include "adapters/registry.hpp"
#include "adapters/suitability.hpp"
#include "adapters/worker/worker_pool.hpp"
#include "cases/case.hpp"
#include "runs/common/progress.hpp"

namespace crossgrain::inline runs {

/// Engines by the names given on the command line, in that order; "all" is every installed engine
/// that is not a mirror.
/// @throws BadInput naming the unknown engine and the nearest known one, or one named twice
std::vector<EngineEntry> selectEngines(const std::vector<std::string>& names);

/// Whether the user asked for this engine by its own name, so that a refusal is theirs to resolve.
bool isNamed(const std::vector<std::string>& names, const EngineEntry& entry);

/// @throws BadInput for a section [engines.NAME] that is a misspelt engine's. One that is like none
/// may be of an engine of the user's own, which this command was not given.
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

/// A worker of the engine, for one run: one that another run has done with, or a new one
/// (adapters/worker/worker_pool.hpp). @throws EngineFailure, BadInput if it is not installed
std::unique_ptr<Engine> startEngine(const EngineEntry& entry, const std::filesystem::path& scratch,
                                    double timeout);

/// A new process that is nobody else's, where the process itself is looked at: what it is asked
/// first, how long it takes to start, the memory that it holds, what it does after another one's
/// end. @throws likewise
/// @param listener  is told every request and answer
std::unique_ptr<Engine> startNew(const EngineEntry& entry, const std::filesystem::path& scratch,
                                 double timeout, ExchangeListener listener = {});

/// startEngine(), every snapshot of it audited (audited_engine.hpp).
std::unique_ptr<Engine> startAudited(const EngineEntry& entry, const std::filesystem::path& scratch,
                                     double timeout);

/// What the engine showed cannot be: its worker is not to be another run's.
void distrust(Engine& engine);

/// Tells of those engines that get a new process for each run, since they were not seen to start
/// afresh with a second load.
void sayWhatIsAlwaysNew(std::ranges::input_range auto&& engines, Progress& progress) {
  for (const EngineEntry& entry : engines)
    if (const std::string why = workerPool().whyAlwaysNew(entry.name); !why.empty())
      progress.say(fmt::format("{}: {}; each of its runs gets a new process", entry.name, why));
}

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

/// Has an engine of startEngine() load the scene as far as the case lets it differ.
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

/// What is compared over several starts of a case has one step and one precision.
/// @throws EngineFailure where the engine has others than from the first start
void requireSameStep(const Realised& first, const Realised& now);

}  // namespace crossgrain::inline runs

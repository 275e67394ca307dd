#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <ranges>
#include <string>
#include <vector>

#include "adapters/engine.hpp"
#include "adapters/registry.hpp"
#include "adapters/suitability.hpp"
#include "adapters/worker/worker_pool.hpp"
#include "cases/case.hpp"
#include "studies/core/executor.hpp"

namespace crossgrain::inline studies {

/// None of the engines that a command is for can do it: why, a line for each.
struct AllRefused : UnsupportedScene {
  explicit AllRefused(std::vector<std::string> why)
      : UnsupportedScene(fmt::format("{}", fmt::join(why, "; "))), lines(std::move(why)) {}
  std::vector<std::string> lines;
};

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

/// @throws BadInput for the first that is not installed, saying why
void requireInstalled(const std::vector<EngineEntry>& engines);

/// This program's path, which serves engines as workers, too.
std::string ownProgram();

/// A worker of the engine, for one run: one that another run has done with, or a new one
/// (adapters/worker/worker_pool.hpp). @throws EngineFailure, BadInput if it is not installed
std::unique_ptr<Engine> startEngine(const EngineEntry& entry, const std::filesystem::path& scratch,
                                    double timeout);

/// A new process for one caller alone, where the process itself matters: its first request, the
/// time that it takes to start, its memory, its behaviour after another one's end. @throws likewise
/// @param listener  gets every request and answer
std::unique_ptr<Engine> startNew(const EngineEntry& entry, const std::filesystem::path& scratch,
                                 double timeout, ExchangeListener listener = {});

/// The engine, with an audit of every snapshot (adapters/audit.hpp) before the caller gets it: an
/// impossible one is an EngineFailure of one line.
std::unique_ptr<Engine> audited(std::string name, std::unique_ptr<Engine> engine);

/// startEngine(), audited.
std::unique_ptr<Engine> startAudited(const EngineEntry& entry, const std::filesystem::path& scratch,
                                     double timeout);

/// Keeps a worker from other runs after an impossible snapshot.
void discardWorker(Engine& engine);

/// Tells of those engines that get a new process for each run, since they were not seen to start
/// afresh with a second load.
void reportNonReusableWorkers(std::ranges::input_range auto&& engines, Progress& progress) {
  for (const EngineEntry& entry : engines)
    if (const std::string why = workerPool().reasonNotReused(entry.name); !why.empty())
      progress.say(fmt::format("{}: {}; each of its runs gets a new process", entry.name, why));
}

/// The settings of one engine in a case, its time step by the rule below. @throws
/// BadInput for one that the engine does not have, or of another type or choice, naming the nearest
Settings settingsFor(const Case& setup, const std::string& engine, const Capabilities& can);

/// The scene as the case lets this engine run it; of a mirror, as it lets its peer.
/// @throws UnsupportedScene saying what it cannot do
template <int D>
AdaptedOf<D> sceneFor(const Capabilities& can, const EngineEntry& entry, const Case& setup,
                      const SceneOf<D>& scene);

/// Whether an engine can run the scene with the settings and liberties of the case.
/// @throws UnsupportedScene naming engine, case and what it cannot do; BadInput for a setting
void checkSuitable(const Capabilities& can, const EngineEntry& entry, const Case& setup,
                   const Scene& scene);
/// The same, where what may_differ could allow is refused with that advice only if the engine then
/// runs the scene: it is loaded so. Else the refusal adds what stands in the way even then.
template <int D>
void checkSuitable(Engine& engine, const EngineEntry& entry, const Case& setup,
                   const SceneOf<D>& scene);

/// An engine that has loaded a scene.
struct LoadedEngine {
  std::unique_ptr<Engine> engine;
  EffectiveParameters effective;  ///< with the deviations that the case allows
  Capabilities can;
};

/// Has an engine of startAudited() load the scene as far as the case lets it differ.
/// @throws UnsupportedScene, EngineFailure, BadInput
template <int D>
LoadedEngine loadEngine(const EngineEntry& entry, const Case& setup, const SceneOf<D>& scene,
                        const std::filesystem::path& scratch);

/// Has an engine load the scene as far as the case lets it differ, a mirror that of its peer. What
/// it then really does, with all deviations, its time step among them.
/// @throws UnsupportedScene naming engine, case and what it cannot do; BadInput for a scene that no
/// engine can start from (startFault())
template <int D>
EffectiveParameters loadScene(Engine& engine, const EngineEntry& entry, const Case& setup,
                              const SceneOf<D>& scene);

/// Requires one step and one precision of several starts of a case.
/// @throws EngineFailure where the engine has others than from the first start
void requireSameStep(const EffectiveParameters& first, const EffectiveParameters& now);

// Whose time step an engine takes, first to last:
//   [engines.NAME] dt             of the case, 0 meaning the case's own step
//   [run] dt                      a step that the case gives is everybody's
//   the setting's default         5e-4 s of an engine whose contacts need no resolving, say
//   the case's                    t_c / steps_per_contact
// A step that is not the scene's is a deviation (loadScene()).

/// The step of the first three lines [s]; absent where the engine follows the case.
std::optional<double> stepOfItsOwn(const Case& setup, const std::string& engine,
                                   const Capabilities& can);

/// That the engine takes other steps than the scene's; absent if it does not.
std::optional<Deviation> stepDeviation(double engineStep, double sceneStep);

/// How an engine runs a case.
struct Suitability {
  std::optional<double> dt;               ///< its time step, where it has loaded the scene [s]
  std::vector<std::string> deviations;    ///< one note each
  std::vector<std::string> notSimulated;  ///< effects that the scene calls for
};

/// Words of `check` on an engine and a case. The engine has loaded the scene then, so that `check`
/// and the reports of runs tell the same; of a scene that no engine can start from, it is what is
/// known before.
/// @throws UnsupportedScene in the engine's own words, BadInput for a setting
template <int D>
Suitability suitabilityOf(Engine& engine, const EngineEntry& entry, const Case& setup,
                          const SceneOf<D>& scene);

}  // namespace crossgrain::inline studies

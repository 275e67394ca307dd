#pragma once

#include <string>
#include <vector>

#include <functional>
#include <memory>
#include "adapters/engine.hpp"
#include "adapters/engine_entry.hpp"
#include "cases/case.hpp"
#include "cases/packing.hpp"
#include "results/lockstep_findings.hpp"
#include "studies/core/executor.hpp"
#include "studies/core/run_store.hpp"
#include "studies/lockstep/starts.hpp"

namespace crossgrain::inline studies {

/// An engine that is to be compared with its mirror.
struct LockstepEngine {
  EngineEntry entry;
  std::string version;  ///< empty: it did not answer
};

/// The states that all start from, and what became of each engine.
struct LockstepPlan {
  std::vector<Packing> packings;  ///< that the flow starts from
  double dt = 0.0;                ///< the case's [s]
  std::size_t starts = 0;
  int jobs = 1;  ///< packings and engines side by side
  /// Why no time is left; empty: there is some. What is then not finished is not measured.
  std::function<std::string()> outOfTime = [] { return std::string(); };
};

/// Why an engine has no mirror in this scene; empty: it has one.
std::string noMirrorReason(const EngineEntry& entry, const Capabilities& can, const Case& setup);

/// Holds each engine against its mirror. Everything finished is kept in the store at once.
/// @throws BadInput, OutputError, Interrupted
LockstepFindings holdAgainstMirrors(const std::vector<LockstepEngine>& engines, const Case& setup,
                                    const LockstepPlan& plan, const RunStore& store,
                                    Progress& progress);

/// The scene that an engine runs from a state, for its mirror: with the engine's conventions,
/// effects, time step and time stepping as it declares them, in double precision.
/// @param realised  of the engine, which has loaded the scene
/// @throws UnsupportedScene where the in-house engine has no such time stepping
template <int D>
SceneOf<D> sceneOfMirror(const Capabilities& can, const EngineEntry& entry, const Case& setup,
                         const SceneOf<D>& scene, const EffectiveParameters& effective);

/// The in-house engine, for that scene: as it is, or moving disks before it kicks them where the
/// engine declares that. @throws likewise
template <int D>
std::unique_ptr<Engine> mirrorOf(const Capabilities& can, const EngineEntry& entry,
                                 const Case& setup, const SceneOf<D>& scene,
                                 const EffectiveParameters& effective);

/// Whether a term may be named: something was read that is more than leastNamed.
bool hasTerm(const LockstepRow& row);

/// Holds one engine against its mirror, from each of the states.
/// @param engine  started; that of `entry`
/// @param dt      the case's [s]
/// @returns not measured, with the reason, where the engine refuses the scene or has no mirror in
/// it
/// @throws Interrupted, BadInput
LockstepRow holdAgainstMirror(Engine& engine, const EngineEntry& entry, const Case& setup,
                              const std::vector<FlowState>& states, double dt,
                              const std::function<void(double)>& progress);

}  // namespace crossgrain::inline studies
